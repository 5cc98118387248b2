/* sin, cos, tan, atan, atan2, asin and acos of transcendental.h.

   All series are Taylor's, cut where the next term is below 2^-58 of the result: their error is seen, not fitted. */
#include "base/transcendental.h"
#include "base/wide.h"
#include <math.h>
#include <stdbool.h>

/* Below this size sin x, tan x, asin x are x, and cos x is 1, to a tenth of a unit. */
#define TINY 0x1p-28
/* Up to here an angle is reduced by three exact products, above by the bits of 2/pi. */
#define MODERATE 0x1p20

static const wide half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
static const wide whole_pi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

/* An angle as quadrant pi/2 + rest, |rest| <= pi/4 and a little. */
typedef struct angle {
    wide rest;
    unsigned quadrant; /* 0..3 */
} angle;

/* |x| <= MODERATE: Cody and Waite 1980.  pi/2 in pieces of 33 bits, whose products with a count below 2^20 are
   exact; the fourth makes 150 bits, and no double comes nearer to a multiple of pi/2 than 2^-61. */
static angle angle_reduce_moderate(double x)
{
    double count = floor(x * 0x1.45f306dc9c883p-1 + 0.5);
    wide a = wide_sum(x - count * 0x1.921fb544p+0, -(count * 0x1.0b4611a6p-34));
    wide b = wide_sum(a.hi, -(count * 0x1.3198a2ep-69));
    double low = (a.lo + b.lo) - count * 0x1.b839a252049c1p-104;
    return (angle){wide_sum(b.hi, low), (unsigned)((int64_t)count & 3)};
}

/* The bits of 2/pi after the point, behind 64 zero bits. */
static const uint32_t two_over_pi[] = {
    0x00000000, 0x00000000, 0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041,
    0xfe5163ab, 0xdebbc561, 0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e,
    0xe88235f5, 0x2ebb4484, 0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b,
    0x1ff897ff, 0xde05980f, 0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d,
    0x7527bac7, 0xebe5f17b, 0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab};

enum { WINDOW = 6 }; /* words of 32 bits: 2 bits of quadrant, 53 lost to truncation, 61 to cancellation, 76 remain */

/* x > MODERATE, finite: Payne and Hanek 1983.  x = mantissa 2^exponent; the bits of 2/pi whose product with x is a
   multiple of 4 are left out, the next 192 multiplied with the mantissa modulo 4. */
static angle angle_reduce_large(double x)
{
    uint64_t bits = double_bits(x), mantissa = (bits & 0xfffffffffffff) | 0x10000000000000;
    int exponent = (int)(bits >> 52) - 1075;
    /* The first bit used has weight 2^(1 - exponent), hence the place exponent - 2 after the point, from 0. */
    unsigned first = (unsigned)(exponent - 2 + 64), word = first / 32, shift = first % 32;
    uint32_t window[WINDOW], product[WINDOW]; /* least significant word first */
    for (unsigned i = 0; i < WINDOW; i++) {
        uint64_t pair = (uint64_t)two_over_pi[word + i] << 32 | two_over_pi[word + i + 1];
        window[WINDOW - 1 - i] = (uint32_t)(pair << shift >> 32);
    }
    uint64_t low = mantissa & 0xffffffff, high = mantissa >> 32, carry = 0;
    for (int i = 0; i < WINDOW; i++) { /* by the low word */
        carry += low * window[i];
        product[i] = (uint32_t)carry;
        carry >>= 32;
    }
    carry = 0;
    for (int i = 1; i < WINDOW; i++) { /* and by the high one */
        carry += high * window[i - 1] + product[i];
        product[i] = (uint32_t)carry;
        carry >>= 32;
    }
    unsigned quadrant = product[WINDOW - 1] >> 30;
    product[WINDOW - 1] &= 0x3fffffff;
    /* A rest of a half or more becomes negative: subtract it from 1. */
    bool negative = product[WINDOW - 1] >> 29;
    if (negative) {
        uint64_t borrow = 1;
        for (int i = 0; i < WINDOW; i++) {
            borrow += (uint32_t)~product[i];
            product[i] = (uint32_t)borrow;
            borrow >>= 32;
        }
        product[WINDOW - 1] &= 0x3fffffff;
        quadrant = (quadrant + 1) & 3;
    }
    wide part = {0, 0};
    double weight = 0x1p-30;
    for (int i = WINDOW - 1; i >= 0; i--, weight *= 0x1p-32)
        part = wide_add(part, (wide){product[i] * weight, 0});
    wide rest = wide_multiply(part, half_pi);
    return (angle){negative ? (wide){-rest.hi, -rest.lo} : rest, quadrant};
}

static angle angle_reduce(double x)
{
    if (fabs(x) <= MODERATE)
        return angle_reduce_moderate(x);
    if (x > 0)
        return angle_reduce_large(x);
    angle a = angle_reduce_large(-x);
    return (angle){{-a.rest.hi, -a.rest.lo}, (4 - a.quadrant) & 3};
}

/* sin of |r| <= pi/4 and a little */
static wide sin_wide(wide r)
{
    /* (sin(r)/r - 1) / z with z = r^2 */
    static const double series[] = {-1.0 / 6,
                                    1.0 / 120,
                                    -1.0 / 5040,
                                    1.0 / 362880,
                                    -1.0 / 39916800,
                                    1.0 / 6227020800,
                                    -1.0 / 1307674368000,
                                    1.0 / 355687428096000,
                                    -1.0 / 121645100408832000};
    double z = r.hi * r.hi;
    return wide_sum_ordered(r.hi, r.hi * z * POLYNOMIAL(z, series) + (r.lo - 0.5 * z * r.lo));
}

/* cos of |r| <= pi/4 and a little */
static wide cos_wide(wide r)
{
    /* (cos(r) - 1 + z/2) / z^2 with z = r^2 */
    static const double series[] = {1.0 / 24,
                                    -1.0 / 720,
                                    1.0 / 40320,
                                    -1.0 / 3628800,
                                    1.0 / 479001600,
                                    -1.0 / 87178291200,
                                    1.0 / 20922789888000,
                                    -1.0 / 6402373705728000,
                                    1.0 / 2432902008176640000};
    wide z = wide_product(r.hi, r.hi), y = wide_sum_ordered(1, -0.5 * z.hi);
    return wide_sum_ordered(y.hi, z.hi * z.hi * POLYNOMIAL(z.hi, series) + (y.lo - 0.5 * z.lo - r.hi * r.lo));
}

/* sin of an angle: cos when the quadrant is odd, negated in the upper half. */
static double angle_sine(angle a)
{
    wide y = a.quadrant & 1 ? cos_wide(a.rest) : sin_wide(a.rest);
    return a.quadrant & 2 ? -(y.hi + y.lo) : y.hi + y.lo;
}

double real_sin(double x)
{
    if (fabs(x) < TINY)
        return x;
    return fabs(x) < HUGE_VAL ? angle_sine(angle_reduce(x)) : (double)NAN;
}

double real_cos(double x)
{
    if (!(fabs(x) < HUGE_VAL))
        return (double)NAN;
    angle a = angle_reduce(x);
    a.quadrant = (a.quadrant + 1) & 3;
    return angle_sine(a);
}

double real_tan(double x)
{
    if (fabs(x) < TINY)
        return x;
    if (!(fabs(x) < HUGE_VAL))
        return (double)NAN;
    angle a = angle_reduce(x);
    wide sine = sin_wide(a.rest), cosine = cos_wide(a.rest);
    wide y = a.quadrant & 1 ? wide_divide(cosine, (wide){-sine.hi, -sine.lo}) : wide_divide(sine, cosine);
    return y.hi + y.lo;
}

/* atan(y / x) for 0 <= y <= x, both of moderate size: atan c + atan((y - c x) / (x + c y)), c the nearest eighth. */
static wide atan_octant(wide y, wide x)
{
    static const wide eighths[] = {{0, 0},
                                   {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                   {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                   {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                   {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                   {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                   {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                   {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                   {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
    /* (atan(t)/t - 1) / z with z = t^2, |t| <= 1/16 */
    static const double series[] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13};
    int k = (int)floor(8 * (y.hi / x.hi) + 0.5);
    wide c = {k * 0.125, 0};
    wide t = wide_divide(wide_subtract(y, wide_multiply(c, x)), wide_add(x, wide_multiply(c, y)));
    double z = t.hi * t.hi;
    return wide_add(eighths[k], wide_sum_ordered(t.hi, t.lo + t.hi * z * POLYNOMIAL(z, series)));
}

/* The angle of the point (x, y), x and y >= 0 and not both 0. */
static wide atan_quadrant(wide y, wide x)
{
    return y.hi <= x.hi ? atan_octant(y, x) : wide_subtract(half_pi, atan_octant(x, y));
}

/* The angle of (x, y), x and y >= 0, not both 0, finite. */
static wide atan_positive(double y, double x)
{
    if (x * 0x1p-60 > y)
        return (wide){y / x, 0};
    if (y * 0x1p-60 > x)
        return half_pi;
    double most = x > y ? x : y;
    double scale = most > 0x1p400 ? 0x1p-600 : most < 0x1p-400 ? 0x1p600 : 1;
    return atan_quadrant((wide){y * scale, 0}, (wide){x * scale, 0});
}

double real_atan2(double y, double x)
{
    if (x != x || y != y)
        return (double)NAN;
    double ay = fabs(y), ax = fabs(x);
    wide a = {0, 0};
    if (ay == HUGE_VAL || ax == HUGE_VAL) /* only which of them is infinite counts */
        a = atan_positive(ay == HUGE_VAL, ax == HUGE_VAL);
    else if (ay > 0 || ax > 0)
        a = atan_positive(ay, ax);
    if (signbit(x))
        a = wide_subtract(whole_pi, a);
    return signbit(y) ? -(a.hi + a.lo) : a.hi + a.lo;
}

/* sqrt(1 - x^2), 0 <= x <= 1 */
static wide cosine_of_sine(double x)
{
    wide square = wide_product(x, x), rest = wide_subtract((wide){1, 0}, square);
    double root = sqrt(rest.hi);
    if (root == 0)
        return (wide){0, 0};
    wide back = wide_product(root, root);
    return wide_sum_ordered(root, (((rest.hi - back.hi) - back.lo) + rest.lo) / (2 * root));
}

double real_acos(double x)
{
    double size = fabs(x);
    if (!(size <= 1))
        return (double)NAN;
    wide a = atan_quadrant(cosine_of_sine(size), (wide){size, 0});
    if (x < 0)
        a = wide_subtract(whole_pi, a);
    return a.hi + a.lo;
}
