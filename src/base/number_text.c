/* Conversion by the C library, whose printf and strtod are correctly rounded, with its locale worked around: the
   decimal point of the locale in force is found by printing 0.5, so that no global locale is read or set. */
#include "base/number_text.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Longer than any decimal that a person or %.17g writes; longer text is refused rather than rounded twice. */
enum { LONGEST_NUMBER = 400 };

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static bool is_number_character(char c) { return is_digit(c) || c == '+' || c == '-' || c == 'e'; }

/* Whatever stands for the decimal point becomes '.'. */
static int put_point(char *text)
{
    size_t from = 0, to = 0;
    bool pointed = false;
    for (; text[from]; from++) {
        if (is_number_character(text[from]))
            text[to++] = text[from];
        else if (!pointed) {
            text[to++] = '.';
            pointed = true;
        }
    }
    text[to] = '\0';
    return (int)to;
}

static int not_finite(double value, char out[NUMBER_TEXT_SIZE])
{
    return snprintf(out, NUMBER_TEXT_SIZE, "%s", isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
}

int real_to_text(double value, char out[NUMBER_TEXT_SIZE])
{
    if (!isfinite(value))
        return not_finite(value, out);
    /* 15 digits always survive text -> double -> text, 17 always double -> text -> double. */
    for (int digits = 15; digits < 17; digits++) {
        snprintf(out, NUMBER_TEXT_SIZE, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            return put_point(out);
    }
    snprintf(out, NUMBER_TEXT_SIZE, "%.17g", value);
    return put_point(out);
}

int real_to_digits(double value, int digits, char out[NUMBER_TEXT_SIZE])
{
    if (!isfinite(value))
        return not_finite(value, out);
    snprintf(out, NUMBER_TEXT_SIZE, "%.*g", digits, value);
    return put_point(out);
}

/* Length of a run of digits. */
static size_t digits_of(const char *text)
{
    size_t n = 0;
    while (is_digit(text[n]))
        n++;
    return n;
}

/* Place of the decimal point, or of where it would stand; SIZE_MAX when the text is not a decimal number. */
static size_t decimal_point(const char *text)
{
    size_t at = (text[0] == '+' || text[0] == '-') ? 1 : 0;
    size_t whole = digits_of(text + at), part = 0;
    size_t point = at + whole;
    at = point;
    if (text[at] == '.') {
        part = digits_of(text + at + 1);
        at += 1 + part;
    }
    if (whole + part == 0)
        return SIZE_MAX;
    if (text[at] == 'e' || text[at] == 'E') {
        at++;
        if (text[at] == '+' || text[at] == '-')
            at++;
        size_t exponent = digits_of(text + at);
        if (exponent == 0)
            return SIZE_MAX;
        at += exponent;
    }
    return text[at] == '\0' ? point : SIZE_MAX;
}

number_fault real_from_text(const char *text, double *value)
{
    size_t point = decimal_point(text), length = strlen(text);
    if (point == SIZE_MAX || length > LONGEST_NUMBER)
        return NUMBER_NOT_A_NUMBER;
    char local[LONGEST_NUMBER + 16], half[16]; /* half: "0.5" with the point of the locale */
    int at = (int)point, size = snprintf(half, sizeof half, "%.1f", 0.5) - 2;
    if (text[point] == '.')
        snprintf(local, sizeof local, "%.*s%.*s%s", at, text, size, half + 1, text + point + 1);
    else
        snprintf(local, sizeof local, "%s", text);
    double read = strtod(local, NULL);
    if (!isfinite(read))
        return NUMBER_TOO_LARGE;
    *value = read;
    return NUMBER_GOOD;
}

number_fault integer_from_text(const char *text, int64_t *value)
{
    size_t sign = (text[0] == '+' || text[0] == '-') ? 1 : 0, digits = digits_of(text + sign);
    if (digits == 0 || text[sign + digits] != '\0')
        return NUMBER_NOT_A_NUMBER;
    errno = 0;
    long long read = strtoll(text, NULL, 10);
    if (errno == ERANGE)
        return NUMBER_TOO_LARGE;
    *value = (int64_t)read;
    return NUMBER_GOOD;
}
