#include "io/base64.h"

static void encode(const unsigned char in[3], int count, char out[4])
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned v = (unsigned)in[0] << 16 | (unsigned)(count > 1 ? in[1] : 0) << 8 | (count > 2 ? in[2] : 0);
    for (int i = 0; i < 4; i++)
        out[i] = i <= count ? letters[v >> (18 - 6 * i) & 63] : '=';
}

fram_status base64_write(base64_writer *b, const void *data, size_t size, fram_error *error)
{
    const unsigned char *bytes = data;
    char text[4096];
    size_t filled = 0;
    for (size_t i = 0; i < size; i++) {
        b->rest[b->held++] = bytes[i];
        if (b->held < 3)
            continue;
        encode(b->rest, 3, text + filled);
        filled += 4;
        b->held = 0;
        if (filled < sizeof text)
            continue;
        fram_status status = file_write(b->file, text, filled, error);
        if (status != FRAM_OK)
            return status;
        filled = 0;
    }
    return file_write(b->file, text, filled, error);
}

fram_status base64_end(base64_writer *b, fram_error *error)
{
    char text[4];
    if (b->held == 0)
        return FRAM_OK;
    encode(b->rest, b->held, text);
    b->held = 0;
    return file_write(b->file, text, sizeof text, error);
}

void base64_text(context *ctx, text_buffer *out, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i += 3) {
        unsigned char three[3] = {0};
        char text[4];
        int count = size - i < 3 ? (int)(size - i) : 3;
        for (int k = 0; k < count; k++)
            three[k] = bytes[i + (size_t)k];
        encode(three, count, text);
        text_add_bytes(ctx, out, text, sizeof text);
    }
}
