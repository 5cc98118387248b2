/* Numbers as text and back, the same in every locale and to the bit. */
#ifndef BASE_NUMBER_TEXT_H
#define BASE_NUMBER_TEXT_H

#include <stdbool.h>
#include <stdint.h>

enum { NUMBER_TEXT_SIZE = 32 };

/* The shortest decimal text that reads back as the same double, "0.1", "1e+300", "-0" (below 2^-1022 it may have more
   digits than needed); "nan", "inf", "-inf" otherwise. Returns its length. */
int real_to_text(double value, char out[NUMBER_TEXT_SIZE]);

/* The same to that many significant digits at most, in a third of the time.  Returns its length. */
int real_to_digits(double value, int digits, char out[NUMBER_TEXT_SIZE]);

typedef enum number_fault {
    NUMBER_GOOD = 0,
    NUMBER_NOT_A_NUMBER, /* not of the form [+-]digits[.digits][e[+-]digits]; also nan, inf, hexadecimal */
    NUMBER_TOO_LARGE     /* overflows */
} number_fault;
/* The nearest double of a decimal number that fills the whole text. */
number_fault real_from_text(const char *text, double *value);
/* A decimal integer that fills the whole text: [+-]digits. */
number_fault integer_from_text(const char *text, int64_t *value);

#endif
