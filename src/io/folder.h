/* Names in a folder, one rule for all that list one. */
#ifndef IO_FOLDER_H
#define IO_FOLDER_H

#include <dirent.h>

/* The next name but "." and ".."; NULL at the end, and when the folder cannot be read further: then *failure is the
   errno value, which is 0 otherwise. */
const char *folder_next(DIR *folder, int *failure);

#endif
