/* Paths of files in a folder: one size and one rule for all that makes them. */
#ifndef IO_PATH_H
#define IO_PATH_H

#include "base/context.h"

/* The NUL included: what Linux takes in one call (PATH_MAX). */
enum { PATH_ROOM = 4096 };

/* "FOLDER/NAME".  FRAM_ERROR_INPUT when that is too long. */
fram_status path_join(const char *folder, const char *name, char out[PATH_ROOM], fram_error *error);
/* Whether both are the same file, which is there, however the paths are spelt. */
bool path_is_same(const char *one, const char *other);
/* Whether the path names one of the files that the run in the folder is made of. */
bool path_is_own(const char *run, const char *path);
/* FRAM_ERROR_USAGE, key "output", where it does: nothing that is made from a run is written over it. */
fram_status path_refuse_own(const char *run, const char *path, fram_error *error);
/* A file that Fram names itself, about to be written in a folder that somebody may have sent: a link, a device or a
   pipe that stands there is taken away, so that nothing outside the folder is written.  What a user names is gone
   through. A folder, or a link to one, stays for who writes to refuse (io/folder.h). */
fram_status path_claim(const char *path, fram_error *error);
/* path_join, and the same. */
fram_status path_own(const char *folder, const char *name, char out[PATH_ROOM], fram_error *error);
/* path_refuse_own, then path_claim where the path lies in the run's folder itself, whoever named it: an output of what
   looks at the run. */
fram_status path_take(const char *run, const char *path, fram_error *error);
/* FRAM_ERROR_USAGE, with the key, where the path names the file `read`, or one that the run in that folder is made of:
   what something is made from is not written over. */
fram_status path_refuse_read(const char *read, const char *path, const char *key, fram_error *error);
/* FRAM_ERROR_INPUT, of the file `given`, where `path`, which is named after it, has a longer name than the file system
   takes: asked before the first of several files is written. */
fram_status path_refuse_long(const char *given, const char *path, fram_error *error);
/* "FOLDER/NAME", or `given` alone where it is not NULL: the output that a caller may have named, which is no file that
   the run in the folder is made of, and is claimed there (path_take).  folder NULL: there is none. */
fram_status path_given_or(const char *given, const char *folder, const char *name, char out[PATH_ROOM],
                          fram_error *error);
/* The path from the root, as the working folder is now, so that it lasts when that changes; false, and an empty text,
   where it does not fit or the working folder is gone. */
bool path_absolute(const char *path, char *out, size_t size);

#endif
