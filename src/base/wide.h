/* Numbers as unevaluated sums of two doubles (about 106 bits), and what else the transcendental functions are made
   of.  Knows nothing of those functions.  Not for use outside base.

   The error-free transformations are Dekker's and Knuth's; they need every operation rounded by itself, which
   -ffp-contract=off guarantees.  Arguments stay between 2^-480 and 2^480, or losing them to zero is harmless. */
#ifndef BASE_WIDE_H
#define BASE_WIDE_H

#include <stdint.h>
#include <string.h>

/* hi + lo, with lo at most about half a unit in the last place of hi. */
typedef struct wide {
    double hi, lo;
} wide;

static inline uint64_t double_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double double_from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* log 2 = LN2_HI + LN2_LO to 97 bits; LN2_HI has 42 bits, so that its product with an exponent is exact. */
#define LN2_HI 0x1.62e42fefa38p-1
#define LN2_LO 0x1.ef35793c7673p-45
#define LN2_INVERSE 0x1.71547652b82fep+0

/* 2^n, -1022 <= n <= 1023 */
static inline double power_of_two(int n) { return double_from_bits((uint64_t)(n + 1023) << 52); }

/* y 2^n for 1/2 < |y| < 2 and |n| < 2000: in two steps, so that only the last one can leave the normal range. */
static inline double scale_by_power(double y, int n) { return y * power_of_two(n / 2) * power_of_two(n - n / 2); }

/* a + b, exactly (Knuth 1969, section 4.2.2, theorem B). */
static inline wide wide_sum(double a, double b)
{
    double sum = a + b, b_part = sum - a;
    return (wide){sum, (a - (sum - b_part)) + (b - b_part)};
}

/* a + b for |a| >= |b|, exactly (Dekker 1971). */
static inline wide wide_sum_ordered(double a, double b)
{
    double sum = a + b;
    return (wide){sum, b - (sum - a)};
}

/* a in two halves of 26 bits, exactly (Veltkamp 1968). */
static inline wide wide_halves(double a)
{
    double c = 0x8000001p0 * a, hi = c - (c - a);
    return (wide){hi, a - hi};
}

/* a b, exactly (Dekker 1971). */
static inline wide wide_product(double a, double b)
{
    wide x = wide_halves(a), y = wide_halves(b);
    double product = a * b;
    return (wide){product, ((x.hi * y.hi - product) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

static inline wide wide_add(wide a, wide b)
{
    wide sum = wide_sum(a.hi, b.hi);
    return wide_sum_ordered(sum.hi, sum.lo + (a.lo + b.lo));
}

static inline wide wide_subtract(wide a, wide b) { return wide_add(a, (wide){-b.hi, -b.lo}); }

static inline wide wide_multiply(wide a, wide b)
{
    wide product = wide_product(a.hi, b.hi);
    return wide_sum_ordered(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline wide wide_divide(wide a, wide b)
{
    double quotient = a.hi / b.hi;
    wide product = wide_product(quotient, b.hi);
    double rest = ((a.hi - product.hi) - product.lo) + (a.lo - quotient * b.lo);
    return wide_sum_ordered(quotient, rest / b.hi);
}

/* c[0] + c[1] x + ... + c[n-1] x^(n-1), n >= 2: odd and even powers in two chains, half as deep as Horner's one. */
static inline double polynomial(double x, const double *c, int n)
{
    double square = x * x, a = c[n - 1], b = c[n - 2];
    int i = n - 3;
    for (; i > 0; i -= 2) {
        a = a * square + c[i];
        b = b * square + c[i - 1];
    }
    return i == 0 ? a * square + c[0] + x * b : b + x * a;
}

#define POLYNOMIAL(x, c) polynomial((x), (c), (int)(sizeof(c) / sizeof *(c)))

#endif
