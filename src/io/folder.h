/* Names in a folder, one rule for all that list one or write into one. */
#ifndef IO_FOLDER_H
#define IO_FOLDER_H

#include "base/context.h"

#include <dirent.h>
#include <stdbool.h>

/* The next name but "." and ".."; NULL at the end, and when the folder cannot be read further: then *failure is the
   errno value, which is 0 otherwise. */
const char *folder_next(DIR *folder, int *failure);

/* A folder that is not there is empty too. */
fram_status folder_is_empty(const char *path, bool *empty, fram_error *error);

/* The error of results that are to go into a folder that is not empty. */
fram_status folder_refuse(const char *path, fram_error *error);

#endif
