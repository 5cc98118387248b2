/* Names in a folder, one rule for all that list one or write into one. */
#ifndef IO_FOLDER_H
#define IO_FOLDER_H

#include "base/context.h"

#include <dirent.h>
#include <stdbool.h>

/* The next name but "." and ".."; NULL at the end, and when the folder cannot be read further: then *failure is the
   errno value, which is 0 otherwise. */
const char *folder_next(DIR *folder, int *failure);

/* Whether a name is `begin`, so many digits or more, and `end`: "floes_000012.vtp". */
bool name_is_numbered(const char *name, const char *begin, size_t digits, const char *end);

/* To list a folder that is Fram's own inside another one, and may be emptied: NULL where it is no folder, or a link to
   one, which may lead anywhere. */
DIR *folder_open_own(const char *path);
/* One that is to be written into is made, or is there; FRAM_ERROR_INPUT for a link to one, or what is none. */
fram_status folder_make_own(const char *path, fram_error *error);
/* The same error, where there is something: asked before the work of one that is made at its end. */
fram_status folder_refuse_other(const char *path, fram_error *error);

/* Removes the files in a folder (folder_open_own) whose names are such; one that cannot be listed or removed stays. */
void folder_remove_files(const char *path, bool (*is_such)(const char *name));

/* Whether a regular file of this name in the folder begins with a text of up to 64 bytes. */
bool folder_file_begins(const char *folder, const char *name, const char *text);

/* A folder that is not there is empty too. */
fram_status folder_is_empty(const char *path, bool *empty, fram_error *error);

/* Whether a file, or a folder, that is not there yet can be made where its path says, or where a link there leads:
   asked before the work, and told as its writer would. */
fram_status folder_check_place(const char *path, bool folder, fram_error *error);

/* The error of results that are to go into a folder that is not empty. */
fram_status folder_refuse(const char *path, fram_error *error);

#endif
