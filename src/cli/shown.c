/* What people see in a terminal of texts that others wrote: keys and names in files, names of files, answers of runs.
 */
#include "cli/cli.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char replacement[] = "\xef\xbf\xbd"; /* U+FFFD */

int utf8_sequence(const char *at)
{
    const unsigned char *text = (const unsigned char *)at;
    if (text[0] < 0x80)
        return 1;
    int length = text[0] >= 0xf0 ? 4 : text[0] >= 0xe0 ? 3 : 2;
    if (text[0] < 0xc2 || text[0] > 0xf4)
        return 0;
    for (int i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    }
    bool overlong = (text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && text[1] < 0x90);
    bool surrogate = text[0] == 0xed && text[1] >= 0xa0;
    bool too_large = text[0] == 0xf4 && text[1] >= 0x90;
    return overlong || surrogate || too_large ? 0 : length;
}

int control_code(const char *at)
{
    const unsigned char *c = (const unsigned char *)at;
    if (c[0] < 0x20 || c[0] == 0x7f)
        return c[0];
    if (c[0] == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0)
        return c[1];
    if (c[0] != 0xe2 || c[1] < 0x80 || c[1] > 0x81)
        return 0;
    int code = 0x2000 + 0x40 * (c[1] - 0x80) + (c[2] & 0x3f);
    bool turns = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return turns || code == 0x2028 || code == 0x2029 ? code : 0;
}

/* `ends`: line ends stay, which they do not in what is one line. */
static void put(FILE *file, const char *text, size_t size, bool ends)
{
    for (const char *end = text + size; text < end;) {
        int length = utf8_sequence(text), code = length > 0 ? control_code(text) : -1;
        if (code == 0 || code == '\t' || (ends && code == '\n'))
            fwrite(text, 1, (size_t)length, file);
        else
            fputs(replacement, file);
        text += length > 0 ? length : 1;
    }
}

void put_shown(FILE *file, const char *text) { put(file, text, strlen(text), true); }

void put_given(FILE *file, const char *text)
{
    if (isatty(fileno(file)) == 1)
        put_shown(file, text);
    else
        fputs(text, file);
}

void tell(FILE *file, const char *format, ...)
{
    va_list values, again;
    va_start(values, format);
    va_copy(again, values);
    int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    char *text = length >= 0 ? malloc((size_t)length + 1) : NULL;
    if (text)
        vsnprintf(text, (size_t)length + 1, format, values);
    va_end(values);
    if (!text)
        return; /* a word for people, of which there is no memory to tell */
    size_t end = strlen(format), line = (size_t)length, first = strspn(format, "\n");
    for (; end > first && format[end - 1] == '\n' && line > first; end--)
        line--;
    fwrite(text, 1, first, file);
    put(file, text + first, line - first, false);
    fputs(text + line, file);
    free(text);
}
