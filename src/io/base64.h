/* Bytes as base64 text (RFC 4648, by nettle), for pages that hold everything. */
#ifndef IO_BASE64_H
#define IO_BASE64_H

#include "io/file.h"
#include "io/text_buffer.h"

#include <nettle/base64.h>

/* Into a file, as it comes; what is left over of a call is kept for the next. */
typedef struct base64_writer {
    file_writer *file;
    struct base64_encode_ctx state;
} base64_writer;
base64_writer base64_begin(file_writer *file);
fram_status base64_write(base64_writer *b, const void *data, size_t size, fram_error *error);
fram_status base64_end(base64_writer *b, fram_error *error);

/* All at once. */
void base64_text(context *ctx, text_buffer *out, const void *data, size_t size);

#endif
