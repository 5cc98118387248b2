/* Philox and the distributions. */
#include "base/random.h"
#include "base/transcendental.h"
#include "testing.h"

enum { DRAWS = 200000 };

/* The known answers that Salmon et al. publish with Random123 (kat_vectors, philox4x32 10). */
START_TEST(philox_known_answers)
{
    static const struct {
        uint32_t counter[4], key[2], out[4];
    } cases[] = {
        {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
        {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
         {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
        {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
         {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint32_t out[4];
        random_philox(cases[i].counter, cases[i].key, out);
        for (int k = 0; k < 4; k++)
            ck_assert_uint_eq(out[k], cases[i].out[k]);
    }
    /* The same through a stream: counter, id and stream are the counter's words, the seed is the key. */
    random_stream r = random_begin(0x299f31d0a4093822, 0x03707344, 0x13198a2e);
    r.counter = 0x85a308d3243f6a88;
    ck_assert_uint_eq(random_bits(&r), 0x94fdccebd16cfe09);
}
END_TEST

START_TEST(a_draw_is_a_function_of_its_key_and_counter)
{
    random_stream a = random_begin(1, 2, 3);
    uint64_t first[10];
    for (int i = 0; i < 10; i++)
        first[i] = random_bits(&a);
    ck_assert_uint_eq(a.counter, 10);
    for (int i = 9; i >= 0; i--) { /* any order */
        random_stream b = random_begin(1, 2, 3);
        b.counter = (uint64_t)i;
        ck_assert_uint_eq(random_bits(&b), first[i]);
    }
    random_stream others[] = {random_begin(2, 2, 3), random_begin(1, 3, 3), random_begin(1, 2, 4),
                              random_begin(1 | (uint64_t)1 << 32, 2, 3)};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        ck_assert_uint_ne(random_bits(&others[i]), first[0]);
}
END_TEST

START_TEST(every_draw_is_one_step)
{
    random_stream r = random_begin(1, 0, 0);
    random_unit(&r);
    random_uniform(&r, 1, 2);
    random_normal(&r);
    random_lognormal(&r, 1, 0.5);
    random_bits(&r);
    ck_assert_uint_eq(r.counter, 5);
}
END_TEST

START_TEST(unit_is_uniform)
{
    random_stream r = random_begin(7, 0, 0);
    int bins[20] = {0};
    double sum = 0, previous = 0.5, product = 0;
    for (int i = 0; i < DRAWS; i++) {
        double u = random_unit(&r);
        if (u < 0 || u >= 1)
            ck_abort_msg("%a is not in [0, 1)", u);
        bins[(int)(u * 20)]++;
        sum += u;
        product += (u - 0.5) * (previous - 0.5);
        previous = u;
    }
    double chi = 0, expected = DRAWS / 20.0;
    for (int i = 0; i < 20; i++)
        chi += (bins[i] - expected) * (bins[i] - expected) / expected;
    ck_assert_double_lt(chi, 43.8); /* 19 degrees of freedom: 0.1 % */
    ck_assert_double_gt(chi, 5.4);
    assert_absolute(sum / DRAWS, 0.5, 4 * sqrt(1 / 12.0 / DRAWS));
    assert_absolute(product / DRAWS, 0, 4 / 12.0 / sqrt(DRAWS));
}
END_TEST

START_TEST(uniform_never_reaches_its_end)
{
    random_stream r = random_begin(8, 0, 0);
    double next = 1 + 0x1p-52;
    for (int i = 0; i < 1000; i++) {
        ck_assert(random_uniform(&r, 1, next) == 1); /* half of the sums round up */
        double x = random_uniform(&r, -3, 5);
        ck_assert(x >= -3 && x < 5);
        ck_assert(random_uniform(&r, 2, 2) == 2);
    }
}
END_TEST

START_TEST(normal_has_its_moments)
{
    random_stream r = random_begin(9, 0, 0);
    double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
    int beyond = 0;
    for (int i = 0; i < DRAWS; i++) {
        double x = random_normal(&r);
        m1 += x;
        m2 += x * x;
        m3 += x * x * x;
        m4 += x * x * x * x;
        beyond += fabs(x) > 1.959963984540054;
    }
    assert_absolute(m1 / DRAWS, 0, 4 * sqrt(1.0 / DRAWS));
    assert_absolute(m2 / DRAWS, 1, 4 * sqrt(2.0 / DRAWS));
    assert_absolute(m3 / DRAWS, 0, 4 * sqrt(15.0 / DRAWS));
    assert_absolute(m4 / DRAWS, 3, 4 * sqrt(96.0 / DRAWS));
    assert_absolute(beyond / (double)DRAWS, 0.05, 4 * sqrt(0.05 * 0.95 / DRAWS));
}
END_TEST

START_TEST(lognormal_has_the_mean_and_deviation_asked_for)
{
    random_stream r = random_begin(10, 0, 0);
    double mean = 40, deviation = 15, sum = 0, squares = 0, least = mean;
    for (int i = 0; i < DRAWS; i++) {
        double x = random_lognormal(&r, mean, deviation);
        least = fmin(least, x);
        sum += x;
        squares += (x - mean) * (x - mean);
    }
    ck_assert_double_gt(least, 0);
    assert_absolute(sum / DRAWS, mean, 4 * deviation / sqrt(DRAWS));
    assert_relative(sqrt(squares / DRAWS), deviation, 0.02);
    assert_bits(random_lognormal(&r, 3, 0), 3);
}
END_TEST

/* Ice fields stand on this: a change here is a change of every generated field. */
START_TEST(draws_are_the_same_everywhere)
{
    random_stream r = random_begin(2014, 1, 1);
    assert_bits(random_unit(&r), 0x1.216873d29b282p-2);
    assert_bits(random_normal(&r), 0x1.d17edd585bc11p+0);
    assert_bits(random_lognormal(&r, 40, 15), 0x1.47dca68165cd1p+5);
}
END_TEST

TEST_MAIN("random", philox_known_answers, a_draw_is_a_function_of_its_key_and_counter, every_draw_is_one_step,
          unit_is_uniform, uniform_never_reaches_its_end, normal_has_its_moments,
          lognormal_has_the_mean_and_deviation_asked_for, draws_are_the_same_everywhere)
