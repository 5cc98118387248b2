/* Text that grows, with the failure kept for the end. */
#include "io/text_buffer.h"
#include "base/number_text.h"
#include "io/utf8.h"
#include <math.h>
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

void text_add_utf8(context *ctx, text_buffer *b, const char *text)
{
    for (const char *end = text + strlen(text), *next = text; text < end; text = next) {
        if (utf8_next(&next, end) >= 0) {
            text_add_bytes(ctx, b, text, (size_t)(next - text));
        } else {
            text_add(ctx, b, UTF8_REPLACEMENT_TEXT);
            next = text + 1;
        }
    }
}

void text_add_escaped(context *ctx, text_buffer *b, const char *text)
{
    for (const char *end = text + strlen(text), *next = text; text < end; text = next) {
        int32_t code = utf8_shown(&next, end);
        const char *name = code == '&'                ? "&amp;"
                           : code == '<'              ? "&lt;"
                           : code == '>'              ? "&gt;"
                           : code == '"'              ? "&quot;"
                           : code == UTF8_REPLACEMENT ? UTF8_REPLACEMENT_TEXT
                                                      : NULL;
        if (name)
            text_add(ctx, b, name);
        else
            text_add_bytes(ctx, b, text, (size_t)(next - text));
    }
}

void text_real_or_null(context *ctx, text_buffer *b, double value)
{
    char number[NUMBER_TEXT_SIZE];
    real_to_text(value, number);
    text_add(ctx, b, isfinite(value) ? number : "null");
}

void text_digits_or_null(context *ctx, text_buffer *b, double value, int digits)
{
    char number[NUMBER_TEXT_SIZE];
    real_to_digits(value, digits, number);
    text_add(ctx, b, isfinite(value) ? number : "null");
}

void text_quoted(context *ctx, text_buffer *b, const char *text)
{
    text_add(ctx, b, "\"");
    for (const char *end = text + strlen(text), *next = text; text < end; text = next) {
        int32_t code = utf8_next(&next, end);
        if (code < 0) {
            text_format(ctx, b, "\\u%04x", UTF8_REPLACEMENT);
            next = text + 1;
        } else if (code == '"' || code == '\\') {
            text_format(ctx, b, "\\%c", (int)code);
        } else if (code < 0x20) {
            text_format(ctx, b, "\\u%04x", (unsigned)code);
        } else {
            text_add_bytes(ctx, b, text, (size_t)(next - text));
        }
    }
    text_add(ctx, b, "\"");
}

void text_free(context *ctx, text_buffer *b)
{
    array_free(ctx, b);
    b->failed = false;
}

void text_units(context *ctx, text_buffer *b, const json_unit *units, int32_t count)
{
    text_add(ctx, b, ", \"units\": {");
    for (int32_t i = 0; i < count; i++)
        text_format(ctx, b, "%s\"%s\": \"%s\"", i > 0 ? ", " : "", units[i].name, units[i].unit);
    text_add(ctx, b, "}");
}
