/* exp, log, pow, cbrt and tanh of transcendental.h.

   All series are Taylor's, cut where the next term is below 2^-58 of the result (2^-70 for the logarithm, whose error
   a power multiplies by up to 745): their error is seen, not fitted. */
#include "base/transcendental.h"
#include "base/wide.h"
#include <math.h>

/* exp overflows above and is zero below (log of the largest double is 709.78, of half the smallest -745.13). */
#define EXP_MOST 710.0
#define EXP_LEAST (-746.0)

/* exp(x + low) = 2^n (1 + q), EXP_LEAST <= x <= EXP_MOST, low tiny against 1; |q| < 0.42 with an error under
   2^-57. */
static wide exp_reduced(double x, double low, int *n)
{
    /* (exp(r) - 1 - r) / r^2 */
    static const double series[] = {1.0 / 2,         1.0 / 6,          1.0 / 24,         1.0 / 120,     1.0 / 720,
                                    1.0 / 5040,      1.0 / 40320,      1.0 / 362880,     1.0 / 3628800, 1.0 / 39916800,
                                    1.0 / 479001600, 1.0 / 6227020800, 1.0 / 87178291200};
    double count = floor(x * LN2_INVERSE + 0.5);
    *n = (int)count;
    wide r = wide_sum(x - count * LN2_HI, low - count * LN2_LO);
    return wide_sum_ordered(r.hi, r.hi * r.hi * POLYNOMIAL(r.hi, series) + (r.lo + r.lo * r.hi));
}

static double exp_wide(wide x)
{
    if (x.hi > EXP_MOST)
        return HUGE_VAL;
    if (x.hi < EXP_LEAST)
        return 0;
    int n;
    wide q = exp_reduced(x.hi, x.lo, &n);
    wide y = wide_sum_ordered(1, q.hi);
    return scale_by_power(y.hi + (y.lo + q.lo), n);
}

double real_exp(double x) { return x != x ? x : exp_wide((wide){x, 0}); }

/* log x for positive finite x, relative error under 2^-67. */
static wide log_wide(double x)
{
    static const wide third = {0x1.5555555555555p-2, 0x1.5555555555555p-56};
    static const wide fifth = {0x1.999999999999ap-3, -0x1.999999999999ap-57};
    /* (atanh(s)/s - 1 - t/3 - t^2/5) / t^3 with t = s^2 */
    static const double series[] = {1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13, 1.0 / 15,
                                    1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23, 1.0 / 25};
    static const uint64_t sqrt_half = 0x3fe6a09e667f3bcd;
    int n = 0;
    if (x < 0x1p-1022) { /* subnormal */
        x *= 0x1p54;
        n = -54;
    }
    /* x = 2^n m, m in [sqrt(1/2), sqrt(2)); then log m = 2 atanh((m - 1) / (m + 1)), |s| < 0.172 */
    uint64_t above = double_bits(x) - sqrt_half;
    n += (int)((int64_t)above >> 52);
    double m = double_from_bits((above & 0xfffffffffffff) + sqrt_half);
    wide s = wide_divide((wide){m - 1, 0}, wide_sum(m, 1));
    wide t = wide_multiply(s, s);
    wide rest = wide_add(fifth, (wide){t.hi * POLYNOMIAL(t.hi, series), 0});
    rest = wide_add(third, wide_multiply(t, rest));
    wide half = wide_add(s, wide_multiply(s, wide_multiply(t, rest)));
    return wide_add((wide){n * LN2_HI, n * LN2_LO}, (wide){2 * half.hi, 2 * half.lo});
}

double real_log(double x)
{
    if (!(x > 0))
        return x == 0 ? -HUGE_VAL : (double)NAN;
    if (x == HUGE_VAL)
        return x;
    wide l = log_wide(x);
    return l.hi + l.lo;
}

double real_pow(double base, double exponent)
{
    if (exponent == 0 || base == 1)
        return 1;
    if (exponent == 1)
        return base;
    if (base != base || exponent != exponent || base < 0)
        return (double)NAN;
    if (base == 0 || base == HUGE_VAL)
        return (base == 0) == (exponent > 0) ? 0 : HUGE_VAL;
    /* |log base| > 2^-54: beyond this exponent the result is 0 or infinite, and the product below could overflow. */
    if (fabs(exponent) > 0x1p65)
        return (base > 1) == (exponent > 0) ? HUGE_VAL : 0;
    wide l = log_wide(base), product = wide_product(exponent, l.hi);
    return exp_wide((wide){product.hi, product.lo + exponent * l.lo});
}

double real_cbrt(double x)
{
    double size = fabs(x);
    if (!(size > 0) || size == HUGE_VAL)
        return x; /* zeros, infinities and NaN */
    int shift = 0;
    if (size < 0x1p-1022) { /* subnormal */
        size *= 0x1p54;
        shift = -18;
    }
    /* size = m 8^k, m in [1, 8); the offset 1200 keeps the division of negative exponents rounding down */
    uint64_t bits = double_bits(size);
    int k = ((int)(bits >> 52) - 1023 + 1200) / 3 - 400;
    double m = double_from_bits(bits - ((uint64_t)(int64_t)(3 * k) << 52));
    /* A third of the exponent (682 = 1023 - 1023/3) is within 7 %, two steps of Halley's iteration make it 1e-11. */
    double y = double_from_bits(double_bits(m) / 3 + (UINT64_C(682) << 52));
    for (int i = 0; i < 2; i++) {
        double cube = y * y * y;
        y = y * ((cube + 2 * m) / (2 * cube + m));
    }
    /* One of Newton's with the exact rest. */
    wide square = wide_product(y, y), cube = wide_product(square.hi, y);
    double rest = ((m - cube.hi) - cube.lo) - square.lo * y;
    y += rest / (3 * square.hi);
    y = scale_by_power(y, k + shift);
    return x < 0 ? -y : y;
}
