/* Bytes as base64 text (RFC 4648), for pages that hold everything. */
#ifndef IO_BASE64_H
#define IO_BASE64_H

#include "io/file.h"
#include "io/text_buffer.h"

/* Into a file, three bytes at a time with what is left over kept for the next call; begin with the file and zeros. */
typedef struct base64_writer {
    file_writer *file;
    unsigned char rest[3];
    int held;
} base64_writer;
fram_status base64_write(base64_writer *b, const void *data, size_t size, fram_error *error);
fram_status base64_end(base64_writer *b, fram_error *error);

/* All at once. */
void base64_text(context *ctx, text_buffer *out, const void *data, size_t size);

#endif
