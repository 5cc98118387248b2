/* Conversion by the C library, whose printf and strtod are correctly rounded.  What a series is made of, twelve digits
   of a number of everyday size, is converted here, ten times faster, to the same text and the same bits; whatever could
   come out otherwise goes to the library. */
#include "base/number_text.h"
#include "base/text.h"
#include <errno.h>
#include <math.h>
#include <string.h>

/* Longer than any decimal that a person or %.17g writes; longer text is refused rather than rounded twice. */
enum { LONGEST_NUMBER = 400 };

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

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
        int length = snprintf(out, NUMBER_TEXT_SIZE, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            return length;
    }
    return snprintf(out, NUMBER_TEXT_SIZE, "%.17g", value);
}

int real_to_pointed_text(double value, char out[NUMBER_TEXT_SIZE])
{
    int length = real_to_text(value, out);
    char *exponent = strchr(out, 'e');
    if (!exponent || strchr(out, '.'))
        return length;
    memmove(exponent + 2, exponent, strlen(exponent) + 1); /* a digit and an exponent are far from filling it */
    memcpy(exponent, ".0", 2);
    return length + 2;
}

/* ---- fast ways ---- */

/* Powers of ten that are doubles; room for digits of which twelve are copied from any of them on. */
enum { EXACT_TENS = 22, FAST_DIGITS = 12, DIGITS_ROOM = 2 * FAST_DIGITS };
static const double tens[EXACT_TENS + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                            1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* size * 10^power, rounded once and for every 22 powers. */
static double times_ten(double size, int power)
{
    for (; power > EXACT_TENS; power -= EXACT_TENS)
        size *= tens[EXACT_TENS];
    for (; power < -EXACT_TENS; power += EXACT_TENS)
        size /= tens[EXACT_TENS];
    return power < 0 ? size / tens[-power] : size * tens[power];
}

/* How many roundings that are. */
static int roundings_of(int power) { return 1 + ((power < 0 ? -power : power) - 1) / EXACT_TENS; }

/* floor() of a small number, which the baseline's instructions would call the library for. */
static int whole_below(double value)
{
    int whole = (int)value;
    return whole - ((double)whole > value);
}

/* The integer of so many digits, and the exponent of its first one, that size > 0 rounds to; false where it is not
   certain.  A number is scaled to less than 1e12, wrong by no more than 2^-13 for each rounding; one that lies within
   twice that of the middle between two integers is left alone, ties among them. */
static bool round_to_digits(double size, int digits, uint64_t *integer, int *exponent)
{
    if (!(size >= 1e-280 && size <= 1e280))
        return false;
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    int power_of_two = (int)(bits >> 52) - 1023, k = whole_below(power_of_two * 0.30102999566398120);
    double scaled = times_ten(size, digits - 1 - k);
    if (scaled >= tens[digits])
        scaled = times_ten(size, digits - 1 - ++k);
    double whole = (double)(int64_t)scaled, part = scaled - whole;
    if (fabs(part - 0.5) < roundings_of(digits - 1 - k) / 4096.0)
        return false;
    whole += part > 0.5;
    bool carried = whole >= tens[digits];
    *integer = (uint64_t)(carried ? whole / 10 : whole);
    *exponent = carried ? k + 1 : k;
    return true;
}

/* Two digits each. */
static const char pairs[] =
    "00010203040506070809101112131415161718192021222324252627282930313233343536373839404142434445464748"
    "49505152535455565758596061626364656667686970717273747576777879808182838485868788899091929394959697"
    "9899";

/* Six digits of a number below a million. */
static void put_six(uint32_t value, char out[6])
{
    uint32_t upper = value / 10000, lower = value % 10000;
    memcpy(out, pairs + 2 * (size_t)upper, 2);
    memcpy(out + 2, pairs + 2 * (size_t)(lower / 100), 2);
    memcpy(out + 4, pairs + 2 * (size_t)(lower % 100), 2);
}

/* An integer's digits, without zeros at the end; how many there are. */
static int list_digits(uint64_t integer, char out[DIGITS_ROOM])
{
    char all[DIGITS_ROOM] = {0};
    put_six((uint32_t)(integer / 1000000), all);
    put_six((uint32_t)(integer % 1000000), all + 6);
    int first = 0, end = FAST_DIGITS;
    while (first < end - 1 && all[first] == '0')
        first++;
    while (end > first + 1 && all[end - 1] == '0')
        end--;
    memcpy(out, all + first, FAST_DIGITS);
    return end - first;
}

/* By the rules of %g: out has room for a sign, twelve digits, four zeros and a point, or for an exponent.  All twelve
   are copied, which takes one instruction; those beyond count are written over or not looked at. */
static char *put_digits(const char digit[DIGITS_ROOM], int count, int exponent, int most, char *out)
{
    if (exponent < -4 || exponent >= most) {
        *out++ = *digit;
        if (count > 1)
            *out++ = '.';
        memcpy(out, digit + 1, FAST_DIGITS - 1);
        out += count - 1;
        int size = exponent < 0 ? -exponent : exponent;
        *out++ = 'e';
        *out++ = exponent < 0 ? '-' : '+';
        if (size > 99)
            *out++ = (char)('0' + size / 100);
        memcpy(out, pairs + 2 * (size_t)(size % 100), 2);
        return out + 2;
    }
    int whole = exponent + 1; /* digits before the point */
    if (whole <= 0) {
        *out++ = '0';
        *out++ = '.';
        memset(out, '0', 3);
        out += -whole;
        memcpy(out, digit, FAST_DIGITS);
        return out + count;
    }
    memcpy(out, digit, FAST_DIGITS);
    if (count > whole) {
        memcpy(out + whole + 1, digit + whole, FAST_DIGITS);
        out[whole] = '.';
        return out + count + 1;
    }
    for (int i = count; i < whole; i++)
        out[i] = '0';
    return out + whole;
}

int real_to_digits(double value, int digits, char out[NUMBER_TEXT_SIZE])
{
    uint64_t integer = 0;
    int exponent = 0;
    char digit[DIGITS_ROOM] = {'0'}, *at = out;
    bool fast = digits >= 1 && digits <= FAST_DIGITS && round_to_digits(fabs(value), digits, &integer, &exponent);
    if (value == 0 || fast) {
        if (signbit(value))
            *at++ = '-';
        if (fast)
            at = put_digits(digit, list_digits(integer, digit), exponent, digits, at);
        else
            *at++ = '0';
        *at = '\0';
        return (int)(at - out);
    }
    if (!isfinite(value))
        return not_finite(value, out);
    return snprintf(out, NUMBER_TEXT_SIZE, "%.*g", digits, value);
}

int clock_digits(double step)
{
    enum { FEWEST = 1, MOST = 6 };
    int digits = FEWEST;
    for (double unit = 0.1; digits < MOST && step > 0 && unit > step * (1 + 1e-9); unit /= 10)
        digits++;
    return digits;
}

int digits_beside(double size, double part, int digits, int least)
{
    enum { MOST = 15 }; /* what a double has */
    for (; part > 0 && digits < MOST && 10 * part <= fabs(size); part *= 10)
        digits++;
    return digits > least ? digits : least;
}

double told_beside(double value, double largest, double least)
{
    const double last_digits = 1e-12; /* of a row of series.csv, io/csv.h */
    return fabs(value) < fmax(least, last_digits * fabs(largest)) ? 0 : value;
}

coordinate_text coordinate_text_of(double metres)
{
    enum { NEAR_ZERO = 5 };
    coordinate_text out;
    int digits = NEAR_ZERO;
    for (double size = 1e4; fabs(metres) >= size && digits < FAST_DIGITS; size *= 10)
        digits++;
    real_to_digits(metres, digits, out.text);
    return out;
}

place_text place_text_of(double x, double y, double z)
{
    enum { FEWEST = 1, MOST = 4 };
    place_text out;
    const double at[3] = {x, y, z};
    int decimals = FEWEST;
    double last = 0.1;
    for (double size = 100; size > fmax(fmax(fabs(x), fabs(y)), fabs(z)) && decimals < MOST; size /= 10, last /= 10)
        decimals++;
    int length = 0;
    for (int i = 0; i < 3; i++)
        length += snprintf(out.text + length, sizeof out.text - (size_t)length, i > 0 ? ", %.*f" : "%.*f", decimals,
                           fabs(at[i]) < 0.5 * last ? 0 : at[i]); /* not -0 */
    return out;
}

plain_text plain_text_of(double value, int digits)
{
    static const double most = 1e15; /* beyond it a double has no digit for each place */
    plain_text out;
    real_to_digits(value, digits, out.text);
    double told = fabs(strtod(out.text, NULL));
    if (told == 0)
        snprintf(out.text, sizeof out.text, "0"); /* not -0 */
    else if (told >= 1 && told < most && strchr(out.text, 'e'))
        snprintf(out.text, sizeof out.text, "%.0f", value);
    return out;
}

/* Two parts of a duration that was rounded to the smaller one, which is left out where it is none. */
static void two_parts(double count, int per, const char *large, const char *small, duration_text *out)
{
    double whole = floor(count / per);
    int rest = (int)(count - whole * per), length = snprintf(out->text, sizeof out->text, "%.0f %s", whole, large);
    if (rest > 0)
        snprintf(out->text + length, sizeof out->text - (size_t)length, " %02d %s", rest, small);
}

duration_text duration_text_of(double seconds)
{
    enum { MINUTE = 60, HOUR = 3600, DAY = 24 };
    static const double least = 99.95, most = 1e15; /* three digits tell less as "99.9 s" at most */
    duration_text out;
    /* What is rounded up to the next unit is told in it. */
    double s = floor(seconds + 0.5), min = floor(seconds / MINUTE + 0.5), h = floor(seconds / HOUR + 0.5);
    if (!(seconds >= least && seconds < most))
        snprintf(out.text, sizeof out.text, "%.3g s", seconds + 0.0); /* 0, not -0 */
    else if (s < HOUR)
        two_parts(s, MINUTE, "min", "s", &out);
    else if (h < 2 * DAY)
        two_parts(min, MINUTE, "h", "min", &out);
    else
        two_parts(h, DAY, "days", "h", &out);
    return out;
}

/* ---- bounds ---- */

enum { ALL_DIGITS = 17 };

/* integer * 10^power, the nearest double. */
static double decimal(int64_t integer, int power)
{
    char text[2 * NUMBER_TEXT_SIZE];
    snprintf(text, sizeof text, "%llde%d", (long long)integer, power);
    return strtod(text, NULL);
}

/* The first digits of a number > 0, one more in the last of them where it is to be no less. */
static double cut_to_digits(double size, int digits, bool more)
{
    char all[2 * NUMBER_TEXT_SIZE];
    snprintf(all, sizeof all, "%.*e", ALL_DIGITS - 1, size);
    int64_t integer = all[0] - '0';
    for (int i = 1; i < digits; i++)
        integer = integer * 10 + (all[i + 1] - '0');
    int power = (int)strtol(strchr(all, 'e') + 1, NULL, 10) - (digits - 1);
    return decimal(integer + more, power);
}

static bound_text bound_of(double value, int digits, bool least)
{
    bound_text out;
    real_to_digits(value, digits, out.text);
    double told = strtod(out.text, NULL);
    if (!isfinite(value) || (least ? told >= value : told <= value))
        return out;
    double size = cut_to_digits(fabs(value), digits, least == (value > 0));
    real_to_digits(value > 0 ? size : -size, digits, out.text);
    return out;
}

bound_text least_text_of(double least, int digits) { return bound_of(least, digits, true); }

bound_text most_text_of(double most, int digits) { return bound_of(most, digits, false); }

range_text range_text_of(double least, double most, int digits)
{
    range_text out = {least_text_of(least, digits), most_text_of(most, digits)};
    while (digits < ALL_DIGITS && strtod(out.least.text, NULL) > strtod(out.most.text, NULL)) {
        digits++;
        out = (range_text){least_text_of(least, digits), most_text_of(most, digits)};
    }
    return out;
}

/* ---- reading ---- */

double real_read(const char *text, char **end)
{
    const char *at = text + (*text == '-'), *first = at;
    uint64_t integer = 0;
    int power = 0, count = 0;
    for (; is_digit(*at); at++, count++)
        integer = integer * 10 + (uint64_t)(*at - '0');
    if (*at == '.') {
        const char *point = at++;
        for (; is_digit(*at); at++, count++)
            integer = integer * 10 + (uint64_t)(*at - '0');
        power = (int)(point - at) + 1;
    }
    if (*at == 'e' && (at[1] == '+' || at[1] == '-') && is_digit(at[2])) {
        bool down = at[1] == '-';
        int shift = at[2] - '0';
        for (at += 3; is_digit(*at) && shift < 1000; at++)
            shift = shift * 10 + (*at - '0');
        power += down ? -shift : shift;
    }
    /* Both the integer and the power of ten are doubles, so that one rounding is all there is (Clinger 1990). */
    bool plain = is_digit(*first) && count <= 15 && (*at == ',' || *at == '\0');
    if (!plain || power < -EXACT_TENS || power > EXACT_TENS)
        return strtod(text, end);
    *end = (char *)(uintptr_t)at;
    double size = power < 0 ? (double)integer / tens[-power] : (double)integer * tens[power];
    return first > text ? -size : size;
}

/* Length of a run of digits. */
static size_t digits_of(const char *text)
{
    size_t n = 0;
    while (is_digit(text[n]))
        n++;
    return n;
}

static bool is_decimal(const char *text)
{
    size_t at = (text[0] == '+' || text[0] == '-') ? 1 : 0;
    size_t whole = digits_of(text + at), part = 0;
    at += whole;
    if (text[at] == '.') {
        part = digits_of(text + at + 1);
        at += 1 + part;
    }
    if (whole + part == 0)
        return false;
    if (text[at] == 'e' || text[at] == 'E') {
        at++;
        if (text[at] == '+' || text[at] == '-')
            at++;
        size_t exponent = digits_of(text + at);
        if (exponent == 0)
            return false;
        at += exponent;
    }
    return text[at] == '\0';
}

number_fault real_from_text(const char *text, double *value)
{
    if (!is_decimal(text) || strlen(text) > LONGEST_NUMBER)
        return NUMBER_NOT_A_NUMBER;
    double read = strtod(text, NULL);
    if (!isfinite(read))
        return NUMBER_TOO_LARGE;
    *value = read;
    return NUMBER_GOOD;
}

number_fault time_from_text(const char *text, double *seconds)
{
    static const struct {
        const char *name;
        double seconds;
    } units[] = {{"", 1}, {"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}, {"a", 31557600}, {"y", 31557600}};
    char number[LONGEST_NUMBER + 1];
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] >= 'a' && text[length - 1] <= 'z')
        length--;
    if (length > LONGEST_NUMBER)
        return NUMBER_NOT_A_NUMBER;
    memcpy(number, text, length);
    number[length] = '\0';
    double value = 0;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(text + length, units[i].name) != 0)
            continue;
        number_fault fault = real_from_text(number, &value);
        value *= units[i].seconds;
        if (fault == NUMBER_GOOD && !isfinite(value))
            fault = NUMBER_TOO_LARGE;
        *seconds = fault == NUMBER_GOOD ? value : *seconds;
        return fault;
    }
    return NUMBER_NOT_A_NUMBER;
}

/* zeros: may stand behind a point. */
static number_fault read_integer(const char *text, bool zeros, int64_t *value)
{
    size_t sign = (text[0] == '+' || text[0] == '-') ? 1 : 0, digits = digits_of(text + sign);
    const char *rest = text + sign + digits;
    if (zeros && *rest == '.')
        rest += 1 + strspn(rest + 1, "0");
    if (digits == 0 || *rest)
        return NUMBER_NOT_A_NUMBER;
    errno = 0;
    long long read = strtoll(text, NULL, 10);
    if (errno == ERANGE)
        return NUMBER_TOO_LARGE;
    *value = (int64_t)read;
    return NUMBER_GOOD;
}

number_fault integer_from_text(const char *text, int64_t *value) { return read_integer(text, false, value); }

number_fault whole_from_text(const char *text, int64_t *value) { return read_integer(text, true, value); }
