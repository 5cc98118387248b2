/* UTF-8, one code point at a time. */
#ifndef IO_UTF8_H
#define IO_UTF8_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The code point at *at, which moves behind it; -1 when the bytes are not UTF-8 (also overlong forms, surrogates and
   values over 0x10ffff), *at is then not moved.  *at < end. */
int32_t utf8_next(const char **at, const char *end);
/* The bytes of a code point that utf8_next can give, without a NUL; returns how many. */
enum { UTF8_MOST = 4 };
int utf8_put(int32_t code, char out[UTF8_MOST]);
/* Bytes of the byte order mark that some programs begin a text with: 3, or 0 where there is none. */
size_t utf8_mark(const char *text, size_t size);
/* What stands for what cannot be shown. */
#define UTF8_REPLACEMENT 0xfffd
#define UTF8_REPLACEMENT_TEXT "\xef\xbf\xbd"
/* The same for text that people see, as names of files, which are any bytes: what is not UTF-8, a byte of it,
   control characters other than tabs and line ends, and what turns the direction of writing are UTF8_REPLACEMENT. */
int32_t utf8_shown(const char **at, const char *end);
/* Neither a control character nor a line break, byte order mark or non-character. */
bool utf8_is_printable(int32_t code);

#endif
