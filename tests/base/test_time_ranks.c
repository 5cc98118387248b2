/* Ranks of durations against those of the sorted list. */
#include "base/random.h"
#include "base/time_ranks.h"
#include "testing.h"

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

START_TEST(ranks_are_those_of_the_sorted_list)
{
    enum { MOST = 5000 };
    static double value[MOST];
    random_stream draw = random_begin(3, 0, 0);
    const int counts[] = {1, 2, 10, 999, 1000, 1001, MOST}, shares[] = {1, 500, 990, 999, 1000};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        time_ranks t = {0};
        for (int i = 0; i < counts[c]; i++) {
            value[i] = 1e-6 * pow(10, 7 * random_uniform(&draw, 0, 1));
            time_ranks_add(&t, value[i]);
        }
        qsort(value, (size_t)counts[c], sizeof *value, ascending);
        for (size_t s = 0; s < sizeof shares / sizeof *shares; s++) {
            int rank = (counts[c] * shares[s] + 999) / 1000;
            double true_value = value[rank - 1], told = time_ranks_at(&t, shares[s]);
            ck_assert(told >= true_value && told <= true_value * (1 + 1.0 / TIME_OCTAVE_BINS));
        }
        assert_bits(time_ranks_at(&t, 1000), value[counts[c] - 1]);
    }
}
END_TEST

START_TEST(durations_out_of_range_count)
{
    time_ranks t = {0};
    assert_bits(time_ranks_at(&t, 500), 0);
    time_ranks_add(&t, 0);
    assert_bits(time_ranks_at(&t, 500), 0);
    time_ranks_add(&t, 1e-12);
    time_ranks_add(&t, 1e5);
    ck_assert(time_ranks_at(&t, 500) < 1e-7);
    ck_assert(time_ranks_at(&t, 999) > 4000);
    assert_bits(t.longest, 1e5);
}
END_TEST

TEST_MAIN("time_ranks", ranks_are_those_of_the_sorted_list, durations_out_of_range_count)
