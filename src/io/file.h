/* Files of bytes: read whole, written through a buffer, or replaced in one go.  Every result of the operating system is
   checked; errors name the file and say what the system said. */
#ifndef IO_FILE_H
#define IO_FILE_H

#include "base/context.h"

/* The file's name, what was tried ("write") and the text of an errno value.  FRAM_ERROR_INPUT when the name is at
   fault: nothing there, too long, no permission; otherwise FRAM_ERROR_IO. */
fram_status file_error(fram_error *error, const char *path, const char *attempt, int number);
/* The same of a file or folder that could not be made: where the folder is missing that it would be in, which; where a
   link in its place or on the way leads nowhere, that. */
fram_status file_place_error(fram_error *error, const char *path, const char *attempt, int number);

/* A regular file for reading: *descriptor for the caller to close, *size its bytes now.  Never waits for a pipe's other
   end.  FRAM_ERROR_INPUT when it is not there or longer than `limit` bytes, and for a folder, a pipe, a socket, a
   device or a file of /proc that has no size, each told by its kind. */
fram_status file_open_regular(const char *path, uint64_t limit, int *descriptor, uint64_t *size, fram_error *error);

/* That it can be opened so, whatever its size. */
fram_status file_check(const char *path, fram_error *error);
/* The same as an answer. */
bool file_is_readable(const char *path);

/* The whole of a regular file and a NUL after it, in memory of ctx.  FRAM_ERROR_INPUT when it is not there, is no
   regular file, or is longer than `limit` bytes. */
fram_status file_read(context *ctx, const char *path, uint64_t limit, char **data, size_t *size, fram_error *error);

/* `size` bytes at `offset` of an open file; FRAM_ERROR_INPUT when it ends before. */
fram_status file_read_at(int descriptor, const char *path, uint64_t offset, void *data, size_t size, fram_error *error);

/* What the heads of binary files hold as their byte order, and what a machine of the other one reads there. */
#define FILE_BYTE_ORDER 0x01020304u
#define FILE_BYTE_ORDER_SWAPPED 0x04030201u
/* The checksum of what `crc` is that of (0: nothing) and these bytes behind it: zlib's CRC-32.  data may be NULL for no
   bytes. */
uint32_t file_crc(uint32_t crc, const void *data, size_t size);

/* A buffered writer of one open file.  After a failed write every later call fails too. */
typedef struct file_writer {
    context *ctx;
    char *path;      /* as it was asked for, which errors name */
    char *temporary; /* what is written instead, NULL: nothing */
    int descriptor;  /* of an open writer: also readable */
    char *buffer;    /* NULL: closed */
    size_t filled;
    uint64_t length; /* of the file, once the buffer is written */
    int failed;      /* errno of the first write that failed, 0 */
    double waited;   /* for room in a stream since a stop was asked for [s] */
} file_writer;

/* An empty file, whatever was there, but what has no beginning of its own (io/fill.h).  When this or file_open fails,
   nothing is left to close. */
fram_status file_create(context *ctx, const char *path, file_writer *w, fram_error *error);
/* The same in a temporary file (io/temporary.h) beside `path`; its name is w->temporary. */
fram_status file_create_temporary(context *ctx, const char *path, file_writer *w, fram_error *error);
/* From here on errors name it so: a file in a folder that is moved to its place when it is whole. */
fram_status file_tell_as(file_writer *w, const char *path, fram_error *error);
/* An existing file, to be continued at its end; FRAM_ERROR_INPUT when it is not there. */
fram_status file_open(context *ctx, const char *path, file_writer *w, fram_error *error);
/* Whether the writer's file is still what its path names. */
bool file_is_in_place(const file_writer *w);
/* Forget what stands after `length`; FRAM_ERROR_INPUT when the file is shorter. */
fram_status file_cut(file_writer *w, uint64_t length, fram_error *error);
fram_status file_write(file_writer *w, const void *data, size_t size, fram_error *error);
/* What a descriptor's file holds goes on to the disk; good where there is none below it, as of a device, a pipe, and
   some file systems.  Otherwise errno tells why. */
bool file_sync(int descriptor);
/* The buffer to the system; with `sync` on to the disk. */
fram_status file_flush(file_writer *w, bool sync, fram_error *error);
/* Flush and close; always frees, also after an error.  Safe on a writer that is closed or all zero. */
fram_status file_close(file_writer *w, fram_error *error);
/* Close without flushing. */
void file_abandon(file_writer *w);

#endif
