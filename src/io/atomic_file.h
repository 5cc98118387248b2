/* Files that are there whole or not at all: written beside their place, synced, then renamed over it.  A device, a pipe
   and a symbolic link (/dev/stdout) are written through as they stand: a rename would take them away. */
#ifndef IO_ATOMIC_FILE_H
#define IO_ATOMIC_FILE_H

#include "io/file.h"
#include "io/text_buffer.h"

typedef struct atomic_file {
    file_writer writer; /* give it to file_write */
    char *path;
    bool direct; /* no temporary file: the path is no regular one */
} atomic_file;

/* Begin the temporary file (io/temporary.h).  FRAM_ERROR_INPUT when the path is a folder. */
fram_status atomic_file_begin(context *ctx, const char *path, atomic_file *a, fram_error *error);
/* The same where a link, device or pipe at the path is replaced: for a program's own files in its folder. */
fram_status atomic_file_begin_over(context *ctx, const char *path, atomic_file *a, fram_error *error);
/* Flush, sync, rename, sync the folder.  On an error the old file is untouched and the temporary one is removed. */
fram_status atomic_file_commit(atomic_file *a, fram_error *error);
/* Flush and rename without waiting for the disk, as atomic_file_put. */
fram_status atomic_file_place(atomic_file *a, fram_error *error);
/* Remove the temporary file. */
void atomic_file_abandon(atomic_file *a);

/* For a temporary file that something else has filled and closed: sync, rename, sync the folder; on an error
   the temporary file is removed.  FRAM_ERROR_INPUT when the path is no regular file. */
fram_status atomic_file_adopt(context *ctx, const char *temporary, const char *path, fram_error *error);
/* Whether it will: asked before long work on the temporary file. */
fram_status atomic_file_check(const char *path, fram_error *error);

/* Begin, write and commit. */
fram_status atomic_file_write(context *ctx, const char *path, const void *data, size_t size, fram_error *error);
/* Of a text, which may have failed: then its memory is what is told. */
fram_status text_file_write(context *ctx, const char *path, const text_buffer *text, fram_error *error);
/* The same without waiting for the disk, for what is made again at any time: whole or not there whatever becomes of the
   program, but a power cut within seconds may take it. */
fram_status atomic_file_put(context *ctx, const char *path, const void *data, size_t size, fram_error *error);

#endif
