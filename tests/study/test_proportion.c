/* Exact intervals of shares against published ones, and against the chances that define them. */
#include "testing.h"

#include "study/proportion.h"

#include <math.h>

/* Newcombe (1998), Statistics in Medicine 17, 857, table I, method 5: 95 %, to four digits. */
START_TEST(intervals_are_those_of_the_table)
{
    static const struct {
        int32_t good, count;
        double low, high;
    } table[] = {{81, 263, 0.2527, 0.3676}, {15, 148, 0.0578, 0.1617}, {0, 20, 0, 0.1684}, {1, 29, 0.0009, 0.1776}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        proportion p = proportion_of(table[i].good, table[i].count, 0.95);
        assert_absolute(p.low, table[i].low, 5.1e-5);
        assert_absolute(p.high, table[i].high, 5.1e-5);
        assert_absolute(p.share, (double)table[i].good / table[i].count, 1e-15);
    }
}
END_TEST

/* Chance of `good` or fewer, term by term. */
static double chance_up_to(int good, int count, double p)
{
    double sum = 0;
    for (int k = 0; k <= good; k++) {
        double term = 1;
        for (int i = 0; i < k; i++)
            term *= p * (count - i) / (k - i);
        sum += term * pow(1 - p, count - k);
    }
    return sum;
}

START_TEST(ends_are_as_rare_as_said)
{
    for (int count = 1; count <= 30; count++)
        for (int good = 0; good <= count; good++) {
            proportion p = proportion_of(good, count, 0.9);
            if (good < count)
                assert_relative(chance_up_to(good, count, p.high), 0.05, 1e-11);
            else
                ck_assert_double_eq(p.high, 1);
            if (good > 0)
                assert_relative(1 - chance_up_to(good - 1, count, p.low), 0.05, 1e-11);
            else
                ck_assert_double_eq(p.low, 0);
            proportion other = proportion_of(count - good, count, 0.9);
            assert_absolute(other.low, 1 - p.high, 1e-15);
        }
}
END_TEST

/* Many trials neither overflow nor take long: near the normal interval, and the rule of three. */
START_TEST(many_trials)
{
    proportion half = proportion_of(50000, 100000, 0.95), all = proportion_of(100000, 100000, 0.9);
    assert_absolute(half.low, 0.5 - 1.959964 * 0.5 / sqrt(1e5), 1e-5);
    assert_absolute(half.high, 0.5 + 1.959964 * 0.5 / sqrt(1e5), 1e-5);
    assert_relative(1 - all.low, 3 / 1e5, 2e-3);
    ck_assert(isnan(proportion_of(0, 0, 0.95).low));
}
END_TEST

TEST_MAIN("proportion", intervals_are_those_of_the_table, ends_are_as_rare_as_said, many_trials)
