#include "io/base64.h"

/* Bytes encoded at a time. */
enum { ENCODED_AT_ONCE = 3072 };

base64_writer base64_begin(file_writer *file)
{
    base64_writer b = {.file = file};
    base64_encode_init(&b.state);
    return b;
}

fram_status base64_write(base64_writer *b, const void *data, size_t size, fram_error *error)
{
    const uint8_t *bytes = data;
    char text[BASE64_ENCODE_LENGTH(ENCODED_AT_ONCE)];
    fram_status status = FRAM_OK;
    for (size_t i = 0; i < size && status == FRAM_OK; i += ENCODED_AT_ONCE) {
        size_t part = size - i < ENCODED_AT_ONCE ? size - i : ENCODED_AT_ONCE;
        status = file_write(b->file, text, base64_encode_update(&b->state, text, part, bytes + i), error);
    }
    return status;
}

fram_status base64_end(base64_writer *b, fram_error *error)
{
    char text[BASE64_ENCODE_FINAL_LENGTH];
    return file_write(b->file, text, base64_encode_final(&b->state, text), error);
}

void base64_text(context *ctx, text_buffer *out, const void *data, size_t size)
{
    const uint8_t *bytes = data;
    char text[BASE64_ENCODE_RAW_LENGTH(ENCODED_AT_ONCE)];
    for (size_t i = 0; i < size; i += ENCODED_AT_ONCE) {
        size_t part = size - i < ENCODED_AT_ONCE ? size - i : ENCODED_AT_ONCE; /* a multiple of 3 but for the last */
        base64_encode_raw(text, part, bytes + i);
        text_add_bytes(ctx, out, text, BASE64_ENCODE_RAW_LENGTH(part));
    }
}
