/* Files of bytes: read whole, written through a buffer, or replaced in one go.  Every result of the operating system is
   checked; errors name the file and say what the system said. */
#ifndef IO_FILE_H
#define IO_FILE_H

#include "base/context.h"

/* FRAM_ERROR_IO with the file's name, what was tried ("write") and the text of an errno value. */
fram_status file_error(fram_error *error, const char *path, const char *attempt, int number);

/* The whole of a regular file and a NUL after it, in memory of ctx.  FRAM_ERROR_INPUT when it is not there, is no regular
   file, or is longer than `limit` bytes. */
fram_status file_read(context *ctx, const char *path, uint64_t limit, char **data, size_t *size, fram_error *error);

/* A buffered writer of one open file. */
typedef struct file_writer {
    context *ctx;
    char *path;
    int descriptor; /* -1: closed */
    char *buffer;
    size_t filled;
    uint64_t length; /* of the file, once the buffer is written */
    fram_status failed; /* of the first write that failed: later calls answer the same */
} file_writer;

/* An empty file, whatever was there. */
fram_status file_create(context *ctx, const char *path, file_writer *w, fram_error *error);
/* An existing file, cut to `length` and continued; FRAM_ERROR_INPUT when it is shorter. */
fram_status file_continue(context *ctx, const char *path, uint64_t length, file_writer *w, fram_error *error);
fram_status file_write(file_writer *w, const void *data, size_t size, fram_error *error);
/* The buffer to the system; with `sync` on to the disk. */
fram_status file_flush(file_writer *w, bool sync, fram_error *error);
/* Flush and close; always frees, also after an error.  Safe on a writer that is closed or all zero. */
fram_status file_close(file_writer *w, fram_error *error);
/* Close without flushing. */
void file_abandon(file_writer *w);

#endif
