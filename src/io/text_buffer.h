/* Text that grows. */
#ifndef IO_TEXT_BUFFER_H
#define IO_TEXT_BUFFER_H

#include "base/array.h"

/* data holds count bytes and a NUL after them (NULL while nothing was added).  failed: an addition found no memory; all
   later ones are ignored, so that it is enough to look at the end. */
typedef struct text_buffer {
    char *data;
    int32_t count, capacity;
    bool failed;
} text_buffer;

void text_add(context *ctx, text_buffer *b, const char *text);
void text_add_bytes(context *ctx, text_buffer *b, const char *data, size_t size);
void text_format(context *ctx, text_buffer *b, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* A number of JSON: the fewest digits that read back as the same, or so many, and null for what is no finite number. */
void text_real_or_null(context *ctx, text_buffer *b, double value);
void text_digits_or_null(context *ctx, text_buffer *b, double value, int digits);
/* The last member of a JSON object, whose names of numbers have no unit in them: ", "units": {"load": "N", ...}", by
   the name that the number, or what it is a part of, has anywhere in the object.  Pure numbers and counts have none. */
typedef struct json_unit {
    const char *name, *unit;
} json_unit;
void text_units(context *ctx, text_buffer *b, const json_unit *units, int32_t count);
/* Bytes that are not UTF-8, as names of files may have, become U+FFFD each. */
void text_add_utf8(context *ctx, text_buffer *b, const char *text);
/* The same as HTML and XML write it: escaped, and what cannot be shown (utf8_shown) is U+FFFD too. */
void text_add_escaped(context *ctx, text_buffer *b, const char *text);
/* A JSON string, in quotes; with the same of such bytes. */
void text_quoted(context *ctx, text_buffer *b, const char *text);
void text_free(context *ctx, text_buffer *b);

#endif
