/* printf and strtod as in the locale "C", whichever the program that calls has set: its decimal comma would spoil every
   file that is written, and end what is read at the point.  Under their usual names, so that nobody has to think of it;
   tools/check_objects.py finds who has not included this. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

int text_set(char *out, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
int text_set_list(char *out, size_t size, const char *format, va_list arguments) __attribute__((format(printf, 3, 0)));
double text_real(const char *text, char **end);
#define snprintf(...) text_set(__VA_ARGS__)
#define vsnprintf(...) text_set_list(__VA_ARGS__)
#define strtod(...) text_real(__VA_ARGS__)

#endif
