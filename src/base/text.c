/* The locale is left by the calling thread alone, and for the length of one call of the C library: other threads of the
   program, and functions that it lends, see nothing of it. */
#include "base/text.h"
#include <langinfo.h>
#include <locale.h>
#include <string.h>

/* The locale to come back to; 0 when there is nothing to leave, as mostly. */
static locale_t leave_locale(void)
{
    if (strcmp(nl_langinfo(RADIXCHAR), ".") == 0)
        return (locale_t)0;
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0); /* always there: nothing is read or allocated */
    return plain ? uselocale(plain) : (locale_t)0;
}

static void come_back(locale_t before)
{
    if (before)
        freelocale(uselocale(before));
}

int text_set_list(char *out, size_t size, const char *format, va_list arguments)
{
    locale_t before = leave_locale();
    int length = (vsnprintf)(out, size, format, arguments);
    come_back(before);
    return length;
}

int text_set(char *out, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = text_set_list(out, size, format, arguments);
    va_end(arguments);
    return length;
}

double text_real(const char *text, char **end)
{
    locale_t before = leave_locale();
    double value = (strtod)(text, end);
    come_back(before);
    return value;
}
