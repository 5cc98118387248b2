/* Numbers as text and back, the same in every locale and to the bit. */
#ifndef BASE_NUMBER_TEXT_H
#define BASE_NUMBER_TEXT_H

#include <stdbool.h>
#include <stdint.h>

enum { NUMBER_TEXT_SIZE = 32 };
/* A longer number in a file is no number that anybody wrote. */
enum { NUMBER_LENGTH_MOST = 400 };

/* The shortest decimal text that reads back as the same double, "0.1", "1e+300", "-0" (below 2^-1022 it may have more
   digits than needed); "nan", "inf", "-inf" otherwise. Returns its length. */
int real_to_text(double value, char out[NUMBER_TEXT_SIZE]);

/* The same with a point in any number that has an exponent, "1.0e-06": without one it is text to readers of YAML 1.1.
 */
int real_to_pointed_text(double value, char out[NUMBER_TEXT_SIZE]);

/* The text of %.*g with that many significant digits, without a locale; up to twelve digits of numbers from 1e-280 to
   1e280 take a tenth of printf's time.  Returns its length. */
int real_to_digits(double value, int digits, char out[NUMBER_TEXT_SIZE]);

/* Digits behind the point with which times of a clock that are `step` apart are told apart [s]; one at least. */
int clock_digits(double step);

/* Significant digits with which a number of this size tells so small a part of it to `digits` digits, as one far from
   zero needs, from `least` to 15. */
int digits_beside(double size, double part, int digits, int least);

/* A number for people: 0 where it is what rounding leaves of one, which is less than `least` or than the last digits of
   the largest number beside it, with which it is read.  least: LEAST_TOLD of what is a sum of parts that cancel, in N,
   m or degrees and times the factor of its unit; 0 of what is small by itself, as a residual. */
#define LEAST_TOLD 1e-9
double told_beside(double value, double largest, double least);

/* A coordinate [m] for people: five digits near 0, to the decimetre where that is more, as on a map: "12.346",
   "-1400000", "2000000.3". */
typedef struct coordinate_text {
    char text[NUMBER_TEXT_SIZE];
} coordinate_text;
coordinate_text coordinate_text_of(double metres);

/* A place [m] for people: "-0.121, 7.982, -0.687", all three to the fourth digit of the largest, from the decimetre to
   a tenth of a millimetre. */
typedef struct place_text {
    char text[3 * NUMBER_TEXT_SIZE];
} place_text;
place_text place_text_of(double x, double y, double z);

/* A number for people with so many significant digits, as by %g, but whole and without an exponent where more of them
   stand before the point: 26105.3 as "26105" and 999.6 as "1000" to three digits.  Under 1e-4 and from 1e15 on it has
   one; a zero has no sign. */
typedef struct plain_text {
    char text[NUMBER_TEXT_SIZE];
} plain_text;
plain_text plain_text_of(double value, int digits);

/* A duration for people, to about a hundredth of it: "0.123 s", "85.7 s", "2 min 05 s", "3 h", "3 h 12 min", from
   two days on "4 days 07 h"; what is no number as by %g, in s. */
typedef struct duration_text {
    char text[2 * NUMBER_TEXT_SIZE];
} duration_text;
duration_text duration_text_of(double seconds);

/* The end of a range that is worked out, for who is to give a number within it: with so many digits, up to 17, and
   rounded into the range, so that what is told is itself taken. */
typedef struct bound_text {
    char text[NUMBER_TEXT_SIZE];
} bound_text;
bound_text least_text_of(double least, int digits);
bound_text most_text_of(double most, int digits);
/* Both ends; with more digits where so many leave nothing between them. */
typedef struct range_text {
    bound_text least, most;
} range_text;
range_text range_text_of(double least, double most, int digits);

typedef enum number_fault {
    NUMBER_GOOD = 0,
    NUMBER_NOT_A_NUMBER, /* not of the form [+-]digits[.digits][e[+-]digits]; also nan, inf, hexadecimal */
    NUMBER_TOO_LARGE     /* overflows */
} number_fault;
/* The nearest double of a decimal number that fills the whole text. */
number_fault real_from_text(const char *text, double *value);
/* A decimal number with a unit of time behind it, in seconds: s, min, h, d, a or y (a year of 365.25 days); without one
   of seconds. */
number_fault time_from_text(const char *text, double *seconds);
/* What strtod reads from the beginning of a text and where it ends, to the bit; up to 15 digits that a comma or the
   text's end follows take a fifth of its time. */
double real_read(const char *text, char **end);
/* A decimal integer that fills the whole text: [+-]digits. */
number_fault integer_from_text(const char *text, int64_t *value);
/* The same, or with a point and zeros alone behind it, as programs write the integers of a column of numbers: 3.0. */
number_fault whole_from_text(const char *text, int64_t *value);

#endif
