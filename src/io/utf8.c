/* Decoding by the table of well-formed sequences (Unicode 15, table 3-7). */
#include "io/utf8.h"
#include <string.h>

int32_t utf8_next(const char **at, const char *end)
{
    const unsigned char *bytes = (const unsigned char *)*at;
    ptrdiff_t left = end - *at;
    int32_t code = bytes[0];
    if (code < 0x80) {
        *at += 1;
        return code;
    }
    int more = code >= 0xf0 ? 3 : code >= 0xe0 ? 2 : 1;
    if (code < 0xc2 || code > 0xf4 || left <= more)
        return -1;
    code &= 0x3f >> more;
    for (int i = 1; i <= more; i++) {
        if ((bytes[i] & 0xc0) != 0x80)
            return -1;
        code = code << 6 | (bytes[i] & 0x3f);
    }
    static const int32_t least[4] = {0, 0x80, 0x800, 0x10000};
    if (code < least[more] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff))
        return -1;
    *at += more + 1;
    return code;
}

int utf8_put(int32_t code, char out[UTF8_MOST])
{
    static const int32_t lead[UTF8_MOST] = {0, 0xc0, 0xe0, 0xf0};
    int more = code >= 0x10000 ? 3 : code >= 0x800 ? 2 : code >= 0x80 ? 1 : 0;
    out[0] = (char)(lead[more] | code >> 6 * more);
    for (int i = 1; i <= more; i++)
        out[i] = (char)(0x80 | (code >> 6 * (more - i) & 0x3f));
    return more + 1;
}

size_t utf8_mark(const char *text, size_t size)
{
    static const char mark[] = "\xef\xbb\xbf";
    size_t length = sizeof mark - 1;
    return size >= length && memcmp(text, mark, length) == 0 ? length : 0;
}

static bool is_control(int32_t code) { return code < 0x20 || (code >= 0x7f && code < 0xa0); }

/* What turns the direction of what is written after it: a name can show as another one. */
static bool turns_writing(int32_t code)
{
    return (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

int32_t utf8_shown(const char **at, const char *end)
{
    int32_t code = utf8_next(at, end);
    if (code < 0)
        *at += 1;
    bool acts = code < 0 || turns_writing(code) || (is_control(code) && code != '\t' && code != '\n');
    return acts ? UTF8_REPLACEMENT : code;
}

bool utf8_is_printable(int32_t code)
{
    if (is_control(code))
        return false;
    return code != 0x2028 && code != 0x2029 && code != 0xfeff && (code & 0xfffe) != 0xfffe;
}
