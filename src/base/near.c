#include "base/near.h"

#include "base/transcendental.h"
#include "base/wide.h"

#include <math.h>

/* The bits of sqrt(1/2). */
#define SQRT_HALF UINT64_C(0x3fe6a09e667f3bcd)

double near_exp(double x)
{
    if (!(x > -700 && x < 700))
        return real_exp(x);
    /* (exp(r) - 1 - r) / r^2, |r| < 0.35 */
    static const double series[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                                    1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                                    1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
    double count = floor(x * LN2_INVERSE + 0.5), r = (x - count * LN2_HI) - count * LN2_LO;
    return power_of_two((int)count) * (1 + (r + r * r * POLYNOMIAL(r, series)));
}

double near_log(double x)
{
    if (!(x >= 0x1p-1022 && x < HUGE_VAL))
        return real_log(x);
    /* x = 2^n m, m in [sqrt(1/2), sqrt(2)); then log m = 2 atanh(s), |s| < 0.172 */
    uint64_t above = double_bits(x) - SQRT_HALF;
    int n = (int)((int64_t)above >> 52);
    double m = double_from_bits((above & 0xfffffffffffff) + SQRT_HALF), s = (m - 1) / (m + 1), t = s * s;
    /* (atanh(s)/s - 1) / t */
    static const double series[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                                    1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
    return n * LN2_HI + (2 * (s + s * (t * POLYNOMIAL(t, series))) + n * LN2_LO);
}
