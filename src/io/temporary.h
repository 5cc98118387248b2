/* Files and folders that stand beside their place until they are whole.  Their names cannot be foreseen and nothing
   that is there is opened, so that two programs that write one output never write into one file, and a link that
   somebody laid is not followed.  A name begins with / or ./ : no program that it is handed to takes it for an option
   or an address. One module with file, which writes what this names. */
#ifndef IO_TEMPORARY_H
#define IO_TEMPORARY_H

#include "io/file.h"

/* An empty file in the folder of `path`, open for reading and writing; *name is in memory of ctx.  Errors name `path`.
 */
fram_status temporary_file(context *ctx, const char *path, char **name, int *descriptor, fram_error *error);
/* The same for a folder. */
fram_status temporary_folder(context *ctx, const char *path, char **name, fram_error *error);
/* Whether `name`, without its folder, is that of a temporary file or folder for `base`: what a program that was killed
   left behind. */
bool temporary_is_of(const char *name, const char *base);
/* The same for any base. */
bool temporary_is_name(const char *name);

#endif
