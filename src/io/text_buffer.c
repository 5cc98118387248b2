/* Text that grows, with the failure kept for the end. */
#include "io/text_buffer.h"
#include <stdio.h>
#include <string.h>

void text_add_bytes(context *ctx, text_buffer *b, const char *data, size_t size)
{
    if (b->failed)
        return;
    if (size >= (size_t)(INT32_MAX - b->count) || !array_reserve(ctx, b, b->count + (int32_t)size + 1)) {
        b->failed = true;
        return;
    }
    memcpy(b->data + b->count, data, size);
    b->count += (int32_t)size;
    b->data[b->count] = '\0';
}

void text_add(context *ctx, text_buffer *b, const char *text) { text_add_bytes(ctx, b, text, strlen(text)); }

void text_format(context *ctx, text_buffer *b, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (b->failed || length < 0 || length >= INT32_MAX - b->count || !array_reserve(ctx, b, b->count + length + 1)) {
        b->failed = true;
    } else {
        vsnprintf(b->data + b->count, (size_t)length + 1, format, again);
        b->count += length;
    }
    va_end(again);
}

void text_quoted(context *ctx, text_buffer *b, const char *text)
{
    text_add(ctx, b, "\"");
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            text_format(ctx, b, "\\%c", *text);
        else if ((unsigned char)*text < 0x20)
            text_format(ctx, b, "\\u%04x", (unsigned)*text);
        else
            text_format(ctx, b, "%c", *text);
    }
    text_add(ctx, b, "\"");
}

void text_free(context *ctx, text_buffer *b)
{
    array_free(ctx, b);
    b->failed = false;
}
