/* Paths of files in a folder: one size and one rule for all that makes them. */
#ifndef IO_PATH_H
#define IO_PATH_H

#include "base/context.h"

/* The NUL included: what Linux takes in one call (PATH_MAX). */
enum { PATH_ROOM = 4096 };

/* "FOLDER/NAME".  FRAM_ERROR_INPUT when that is too long. */
fram_status path_join(const char *folder, const char *name, char out[PATH_ROOM], fram_error *error);
/* The same, or `given` alone where it is not NULL: the output that a caller may have named. */
fram_status path_given_or(const char *given, const char *folder, const char *name, char out[PATH_ROOM],
                          fram_error *error);
/* The path from the root, as the working folder is now, so that it lasts when that changes; false, and an empty text,
   where it does not fit or the working folder is gone. */
bool path_absolute(const char *path, char *out, size_t size);

#endif
