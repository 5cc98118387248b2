/* The transcendental functions: how far from the truth, at the edges, and the same bits everywhere.

   The truth is the C library's long double, which on every machine where Linux runs in earnest has at least 11 bits
   more than a double. */
#include "base/near.h"
#include "base/random.h"
#include "base/transcendental.h"
#include "base/wide.h"
#include "testing.h"
#include <float.h>

#if LDBL_MANT_DIG >= 64

enum { POINTS = 100000 };
#define ULP_LIMIT 1.0 /* what transcendental.h promises */

/* Distance in units of the last place that a double next to the truth has. */
static double ulp_distance(double found, long double truth)
{
    double near = (double)truth;
    if (isnan(found) || isnan(near))
        return isnan(found) && isnan(near) ? 0 : HUGE_VAL;
    if (isinf(found) || isinf(near))
        return found == near ? 0 : HUGE_VAL;
    int exponent;
    frexp(near, &exponent);
    if (near == 0 || exponent < -1021)
        exponent = -1021; /* subnormal */
    return (double)(fabsl((long double)found - truth) / ldexpl(1, exponent - 53));
}

/* x = near + sign * magnitude; magnitudes equally likely between lo and hi, or between their logarithms. */
typedef struct range {
    const char *name;
    double (*function)(double);
    long double (*truth)(long double);
    double near, lo, hi;
    bool by_logarithm;
} range;

static double range_draw(const range *g, random_stream *r)
{
    double magnitude = random_uniform(r, g->lo, g->hi);
    if (g->by_logarithm)
        magnitude = g->lo * exp2(random_uniform(r, 0, log2(g->hi) - log2(g->lo)));
    bool one_sided = g->lo < 0 || (g->near == 0 && g->function == real_log);
    return !one_sided && random_bits(r) & 1 ? g->near - magnitude : g->near + magnitude;
}

/* The worst of many distances and where it was: one assertion for all, since each costs check a message. */
typedef struct extreme {
    double distance, x, y;
} extreme;

static void extreme_note(extreme *e, double distance, double x, double y)
{
    if (!(distance <= e->distance))
        *e = (extreme){distance, x, y};
}

static void extreme_check_limit(const extreme *e, const char *name, double limit)
{
    ck_assert_msg(e->distance <= limit, "%s at %a, %a is off by %g ulp", name, e->x, e->y, e->distance);
}

static void extreme_check(const extreme *e, const char *name) { extreme_check_limit(e, name, ULP_LIMIT); }

static const range ranges[] = {
    {"sin", real_sin, sinl, 0, 0, 7, false},
    {"sin to 1e6", real_sin, sinl, 0, 0, 1e6, false},
    {"sin huge", real_sin, sinl, 0, 1e6, 1e308, true},
    {"sin tiny", real_sin, sinl, 0, 1e-300, 1, true},
    {"cos", real_cos, cosl, 0, 0, 7, false},
    {"cos to 1e6", real_cos, cosl, 0, 0, 1e6, false},
    {"cos huge", real_cos, cosl, 0, 1e6, 1e308, true},
    {"cos tiny", real_cos, cosl, 0, 1e-300, 1, true},
    {"tan", real_tan, tanl, 0, 0, 7, false},
    {"tan to 1e6", real_tan, tanl, 0, 0, 1e6, false},
    {"tan huge", real_tan, tanl, 0, 1e6, 1e308, true},
    {"tan tiny", real_tan, tanl, 0, 1e-300, 1, true},
    {"exp", real_exp, expl, 0, 0, 1, false},
    {"exp wide", real_exp, expl, 0, 0, 750, false},
    {"exp tiny", real_exp, expl, 0, 1e-300, 1, true},
    {"exp subnormal", real_exp, expl, -727, 0, 19, false},
    {"log", real_log, logl, 0, 0x1p-1070, 1e308, true},
    {"log near 1", real_log, logl, 1, 0, 0.5, false},
    {"log nearer 1", real_log, logl, 1, 1e-15, 0.1, true},
    {"acos", real_acos, acosl, 0, 0, 1, false},
    {"acos near 1", real_acos, acosl, 1, -0x1p-10, 0, false},
    {"acos near -1", real_acos, acosl, -1, 0, 0x1p-10, false},
    {"cbrt", real_cbrt, cbrtl, 0, 0x1p-1070, 1e308, true},
};

/* Those that are quick, within 3 ulp. */
static const range near_ranges[] = {
    {"near exp", near_exp, expl, 0, 0, 1, false},          {"near exp wide", near_exp, expl, 0, 0, 750, false},
    {"near exp tiny", near_exp, expl, 0, 1e-300, 1, true}, {"near log", near_log, logl, 1e-300, 0x1p-1070, 1e308, true},
    {"near log near 1", near_log, logl, 1, 0, 0.5, false}, {"near log nearer 1", near_log, logl, 1, 1e-15, 0.1, true},
};

static void check_range(const range *g, uint32_t stream, double limit)
{
    random_stream r = random_begin(1, stream, 0);
    extreme e = {0};
    for (int i = 0; i < POINTS; i++) {
        double x = range_draw(g, &r);
        extreme_note(&e, ulp_distance(g->function(x), g->truth((long double)x)), x, 0);
    }
    extreme_check_limit(&e, g->name, limit);
}

START_TEST(functions_are_within_their_limit)
{
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++)
        check_range(&ranges[k], (uint32_t)k, ULP_LIMIT);
    for (size_t k = 0; k < sizeof near_ranges / sizeof *near_ranges; k++)
        check_range(&near_ranges[k], 100 + (uint32_t)k, 3);
    ck_assert(near_log(0) == -HUGE_VAL && isnan(near_log(-1)) && near_exp(-HUGE_VAL) == 0 && isnan(near_exp(NAN)));
}
END_TEST

/* Multiples of pi/2, where reduction loses most. */
START_TEST(quadrants_are_exact)
{
    extreme sine = {0}, cosine = {0}, tangent = {0};
    for (int n = 1; n < POINTS; n++) {
        double x = n * 6.0 * (PI / 2), y = x + PI / 2;
        extreme_note(&sine, ulp_distance(real_sin(x), sinl((long double)x)), x, 0);
        extreme_note(&cosine, ulp_distance(real_cos(y), cosl((long double)y)), y, 0);
        extreme_note(&tangent, ulp_distance(real_tan(y), tanl((long double)y)), y, 0);
    }
    extreme_check(&sine, "sin");
    extreme_check(&cosine, "cos");
    extreme_check(&tangent, "tan");
    assert_bits(real_sin(PI), 0x1.1a62633145c07p-53);
    assert_bits(real_cos(PI / 2), 0x1.1a62633145c07p-54);
    /* The double nearest of all to a multiple of pi/2 (Muller, Elementary Functions, 2006). */
    double x = 6381956970095103.0 * 0x1p797;
    ck_assert_double_le(ulp_distance(real_cos(x), -4.68716592425462761112e-19L), ULP_LIMIT);
    /* Both reductions meet at 2^20. */
    for (int i = -200; i <= 200; i++) {
        x = 0x1p20 + i * 0x1p-30;
        ck_assert_double_le(ulp_distance(real_sin(x), sinl((long double)x)), ULP_LIMIT);
    }
}
END_TEST

START_TEST(powers_are_within_their_limit)
{
    random_stream r = random_begin(2, 0, 0);
    extreme e = {0};
    for (int i = 0; i < 5 * POINTS; i++) {
        double base = exp2(random_uniform(&r, -20, 20)), exponent = random_uniform(&r, -12, 12);
        if (i % 5 == 1) /* the whole range of results, subnormal ones included */
            exponent = random_uniform(&r, -1080, 1030) / log2(base);
        if (i % 5 == 2) { /* bases next to 1 with large exponents */
            base = 1 + random_uniform(&r, -1e-3, 1e-3);
            exponent = random_uniform(&r, -6e5, 6e5);
        }
        if (i % 5 == 3)
            base = exp2(random_uniform(&r, -1074, 1024));
        long double truth = powl((long double)base, (long double)exponent);
        extreme_note(&e, ulp_distance(real_pow(base, exponent), truth), base, exponent);
    }
    extreme_check(&e, "pow");
}
END_TEST

START_TEST(angles_of_points_are_within_their_limit)
{
    random_stream r = random_begin(3, 0, 0);
    extreme e = {0};
    for (int i = 0; i < 5 * POINTS; i++) {
        double span = i % 3 == 0 ? 2 : i % 3 == 1 ? 100 : 1070;
        double y = exp2(random_uniform(&r, -span, fmin(span, 1023))),
               x = exp2(random_uniform(&r, -span, fmin(span, 1023)));
        uint64_t signs = random_bits(&r);
        y = signs & 1 ? -y : y;
        x = signs & 2 ? -x : x;
        extreme_note(&e, ulp_distance(real_atan2(y, x), atan2l((long double)y, (long double)x)), y, x);
    }
    extreme_check(&e, "atan2");
}
END_TEST

#define ACCURACY_TESTS                                                                    \
    functions_are_within_their_limit, quadrants_are_exact, powers_are_within_their_limit, \
        angles_of_points_are_within_their_limit,
#else
#define ACCURACY_TESTS
#endif

static bool is_nan(double x) { return x != x; }

START_TEST(edges_of_functions_of_one_number)
{
    const double inf = HUGE_VAL, none = (double)NAN, least = 0x1p-1074, most = DBL_MAX;
    double (*const odd[])(double) = {real_sin, real_tan, real_cbrt};
    for (int i = 0; i < 3; i++) {
        assert_bits(odd[i](0.0), 0.0);
        assert_bits(odd[i](-0.0), -0.0);
        for (double x = 0.01; x < 1; x += 0.01)
            assert_bits(odd[i](-x), -odd[i](x));
        if (odd[i] != real_cbrt)
            assert_bits(odd[i](-least), -least);
        ck_assert(is_nan(odd[i](none)));
    }
    double (*const others[])(double) = {real_cos, real_exp, real_log, real_acos};
    for (int i = 0; i < 4; i++)
        ck_assert(is_nan(others[i](none)));
    ck_assert(is_nan(real_sin(inf)) && is_nan(real_cos(-inf)) && is_nan(real_tan(inf)));
    assert_bits(real_cos(0), 1);
    assert_bits(real_cos(least), 1);
    assert_bits(real_exp(0), 1);
    assert_bits(real_exp(-0.0), 1);
    assert_bits(real_exp(least), 1);
    assert_bits(real_exp(inf), inf);
    assert_bits(real_exp(-inf), 0);
    assert_bits(real_exp(most), inf);
    assert_bits(real_exp(-most), 0);
    assert_bits(real_exp(0x1.62e42fefa39fp+9), inf); /* just above log(DBL_MAX), just below, and the least result */
    ck_assert(real_exp(0x1.62e42fefa39efp+9) < inf);
    assert_bits(real_exp(-745.1), least);
    assert_bits(real_exp(-745.2), 0);
    assert_bits(real_log(0), -inf);
    assert_bits(real_log(-0.0), -inf);
    assert_bits(real_log(inf), inf);
    assert_bits(real_log(1), 0);
    ck_assert(is_nan(real_log(-1)) && is_nan(real_log(-least)) && is_nan(real_log(-inf)));
    assert_bits(real_log(least), -0x1.74385446d71c3p+9);
    assert_bits(real_acos(1), 0);
    assert_bits(real_acos(-1), PI);
    assert_bits(real_acos(0), PI / 2);
    ck_assert(is_nan(real_acos(-1.5)) && is_nan(real_acos(inf)));
    assert_bits(real_cbrt(inf), inf);
    assert_bits(real_cbrt(-inf), -inf);
    for (int i = -200; i <= 200; i++) {
        double cube = (double)i * i * i;
        assert_bits(real_cbrt(cube), i);
    }
    assert_bits(real_cbrt(0x1p-1074), 0x1p-358);
}
END_TEST

START_TEST(edges_of_powers)
{
    const double inf = HUGE_VAL, none = (double)NAN, most = DBL_MAX, above = 1 + 0x1p-52, below = 1 - 0x1p-53;
    const double any[] = {0, 0x1p-1074, 0.3, 1, 2.5, 1e300, HUGE_VAL, -2, (double)NAN};
    for (size_t i = 0; i < sizeof any / sizeof *any; i++) {
        assert_bits(real_pow(any[i], 0), 1);
        assert_bits(real_pow(any[i], -0.0), 1);
        assert_bits(real_pow(1, any[i]), 1);
        assert_bits(real_pow(any[i], 1), any[i]);
    }
    assert_bits(real_pow(0, 2.5), 0);
    assert_bits(real_pow(0, -2.5), inf);
    assert_bits(real_pow(-0.0, 2), 0);
    assert_bits(real_pow(inf, 0.5), inf);
    assert_bits(real_pow(inf, -0.5), 0);
    assert_bits(real_pow(2, inf), inf);
    assert_bits(real_pow(2, -inf), 0);
    assert_bits(real_pow(0.5, inf), 0);
    assert_bits(real_pow(0.5, -inf), inf);
    assert_bits(real_pow(above, most), inf);
    assert_bits(real_pow(above, -most), 0);
    assert_bits(real_pow(below, most), 0);
    assert_bits(real_pow(below, -most), inf);
    assert_bits(real_pow(1e200, 2), inf);
    assert_bits(real_pow(1e-200, 2), 0);
    ck_assert(is_nan(real_pow(none, 2)) && is_nan(real_pow(2, none)) && is_nan(real_pow(-2, 2)));
    for (int n = -1074; n <= 1023; n++)
        assert_bits(real_pow(2, n), ldexp(1, n));
    for (int i = 1; i <= 300; i++) { /* exact whenever the result is a double */
        double square = (double)i * i, fifth = square * square * i;
        assert_bits(real_pow(i, 2), square);
        assert_bits(real_pow(i, 5), fifth);
        assert_bits(real_pow(square, 0.5), i);
    }
}
END_TEST

START_TEST(edges_of_angles_of_points)
{
    const double inf = HUGE_VAL, none = (double)NAN;
    assert_bits(real_atan2(0.0, 0.0), 0.0);
    assert_bits(real_atan2(-0.0, 0.0), -0.0);
    assert_bits(real_atan2(0.0, -0.0), PI);
    assert_bits(real_atan2(-0.0, -0.0), -PI);
    assert_bits(real_atan2(0.0, 5), 0.0);
    assert_bits(real_atan2(-0.0, -5), -PI);
    assert_bits(real_atan2(5, 0.0), PI / 2);
    assert_bits(real_atan2(-5, -0.0), -PI / 2);
    assert_bits(real_atan2(1, 1), PI / 4);
    assert_bits(real_atan2(1, -1), 3 * PI / 4);
    assert_bits(real_atan2(inf, inf), PI / 4);
    assert_bits(real_atan2(-inf, -inf), -3 * PI / 4);
    assert_bits(real_atan2(inf, -3), PI / 2);
    assert_bits(real_atan2(3, inf), 0.0);
    assert_bits(real_atan2(-3, inf), -0.0);
    assert_bits(real_atan2(3, -inf), PI);
    assert_bits(real_atan2(0x1p-1074, 0x1p-1074), PI / 4);
    assert_bits(real_atan2(DBL_MAX, DBL_MAX), PI / 4);
    assert_bits(real_atan2(0x1p-1074, 1), 0x1p-1074);
    assert_bits(real_atan2(0x1p-1074, DBL_MAX), 0.0);
    assert_bits(real_atan2(0x1p-1074, -DBL_MAX), PI);
    assert_bits(real_atan2(DBL_MAX, 0x1p-1074), PI / 2);
    ck_assert(is_nan(real_atan2(none, 1)) && is_nan(real_atan2(1, none)));
    assert_bits(radians(180), PI);
    assert_bits(degrees(PI / 2), 90);
}
END_TEST

/* Sums and products as pairs lose nothing: known ones, whose low half is not zero. */
START_TEST(wide_operations_are_exact)
{
    wide p = wide_product(0x1.0000001p0, 0x1.0000001p0); /* (1 + 2^-28)^2 = 1 + 2^-27 + 2^-56 */
    assert_bits(p.hi, 0x1.0000002p0);
    assert_bits(p.lo, 0x1p-56);
    wide s = wide_sum(0x1p-70, 1);
    assert_bits(s.hi, 1);
    assert_bits(s.lo, 0x1p-70);
    s = wide_sum_ordered(1, -0x1p-60);
    assert_bits(s.hi, 1);
    assert_bits(s.lo, -0x1p-60);
    wide third = wide_divide((wide){1, 0}, (wide){3, 0});
    assert_bits(third.hi, 0x1.5555555555555p-2);
    assert_bits(third.lo, 0x1.5555555555555p-56);
    wide one = wide_multiply(third, (wide){3, 0});
    assert_bits(one.hi, 1);
    assert_absolute(one.lo, 0, 0x1p-104);
    wide rest = wide_subtract(wide_add((wide){1, 0x1p-80}, (wide){-1, 0}), (wide){0x1p-80, 0});
    assert_bits(rest.hi, 0);
    assert_bits(rest.lo, 0);
}
END_TEST

/* A fused multiply-add would leave the product's rounding error here instead of zero. */
START_TEST(multiplication_and_addition_round_apart)
{
    volatile double a = 0x1.0000001p0, b = 0x1.0000002p0;
    ck_assert_msg(a * a - b == 0, "the compiler fuses a * b + c: -ffp-contract=off is missing");
}
END_TEST

/* One number that stands for all bits of all functions on a fixed grid, on any machine and compiler. */
START_TEST(bits_are_the_same_everywhere)
{
    random_stream r = random_begin(4, 0, 0);
    uint64_t hash = 0;
    for (int i = 0; i < 20000; i++) {
        double unit = random_uniform(&r, -1, 1), x = random_uniform(&r, -700, 700), size = fabs(x) + 0x1p-30;
        double y[] = {real_sin(x),    real_cos(x * 1e10),        real_tan(x),         real_exp(x),
                      real_log(size), real_pow(size, unit * 40), real_atan2(unit, x), real_acos(unit),
                      real_cbrt(x),   real_sin(x * 1e250)};
        for (size_t k = 0; k < sizeof y / sizeof *y; k++)
            hash = (hash ^ double_bits(y[k])) * 0x9e3779b97f4a7c15u + (hash >> 29);
    }
    ck_assert_msg(hash == 0x5d8ce38064faa5e6u, "hash is 0x%llx", (unsigned long long)hash);
}
END_TEST

TEST_MAIN("transcendental", ACCURACY_TESTS edges_of_functions_of_one_number, edges_of_powers, edges_of_angles_of_points,
          wide_operations_are_exact, multiplication_and_addition_round_apart, bits_are_the_same_everywhere)
