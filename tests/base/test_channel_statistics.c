/* Statistics of a channel whose peaks are known. */
#include "testing.h"

#include "base/channel_statistics.h"
#include "base/transcendental.h"

#include <math.h>

START_TEST(statistics_of_a_channel)
{
    enum { N = 2000 };
    double time[N], value[N];
    for (int i = 0; i < N; i++) {
        time[i] = 0.01 * i;
        double tooth = i % 100 < 50 ? 1 : 0;
        /* Peaks of 1, 2 and 3; the row at the end of the transient is the last of it. */
        value[i] = i < 500 ? 1e9 : tooth * (1 + i / 100 % 3);
    }
    channel_statistics s = channel_statistics_of(time, value, N, 4.99);
    ck_assert_int_eq(s.peaks, 10); /* those of 1 do not exceed the mean */
    assert_relative(s.mean, 1, 1e-12);
    assert_relative(s.significant, 3, 1e-12);
    assert_absolute(s.greatest, 3, 0);
    assert_absolute(s.least, 0, 0);
    assert_relative(s.deviation, sqrt(0.5 * 14 / 3 - 1), 1e-12);
    ck_assert(s.peak == s.greatest && s.significant_above == s.significant);
}
END_TEST

/* A file has rounded its times; nothing is before 0. */
START_TEST(rows_after_a_time)
{
    ck_assert(time_is_after(5.05, 5) && !time_is_after(5, 5) && !time_is_after(5 * (1 + 1e-12), 5));
    ck_assert(time_is_after(1.7e9 + 0.1, 1.7e9) && !time_is_after(1.7e9 * (1 + 5e-12), 1.7e9));
    ck_assert(time_is_after(0, 0) && !time_is_after(-1, 0) && !time_is_after(-5, -5) && time_is_after(-4, -5));
    ck_assert(time_is_after(-1e9, -HUGE_VAL) && !time_is_after(1e9, HUGE_VAL));
}
END_TEST

/* Equal values scatter by nothing and have no peaks, though the mean that a sum makes of them is a rounding off; what
   is significant of them is the value. */
START_TEST(equal_values_scatter_by_nothing)
{
    enum { N = 3000 };
    double time[N], value[N];
    for (int i = 0; i < N; i++) {
        time[i] = i;
        value[i] = 0.1;
    }
    channel_statistics s = channel_statistics_of(time, value, N, 0);
    ck_assert(s.mean == 0.1 && s.deviation == 0 && s.peaks == 0);
    ck_assert(s.significant == 0.1 && s.significant_above == 0.1);
}
END_TEST

/* What was not measured is no number. */
START_TEST(nothing_is_measured)
{
    const double time[] = {0, 1}, value[] = {3, 4};
    for (int32_t count = 0; count <= 2; count += 2) {
        channel_statistics s = channel_statistics_of(time, value, count, 1.5);
        ck_assert(isnan(s.mean) && isnan(s.deviation) && isnan(s.least) && isnan(s.greatest) && isnan(s.peak));
        ck_assert(isnan(s.significant) && isnan(s.significant_above) && s.peaks == 0);
    }
}
END_TEST

/* The peak is what is largest in size, with its sign; the significant one is on its side, wherever the mean is. */
START_TEST(peaks_have_a_side)
{
    const double time[] = {0, 1, 2, 3, 4, 5, 6, 7, 8}, value[] = {2, -5, 3, -1, 3, -4, 3, 3, 3};
    double turned[9];
    channel_statistics s = channel_statistics_of(time, value, 9, 0);
    ck_assert(s.mean > 0 && s.least == -5 && s.greatest == 3 && s.peak == -5);
    ck_assert_int_eq(s.peaks, 3); /* -5, -1 and -4 */
    assert_absolute(s.significant, -5, 1e-12);
    assert_absolute(s.significant_above, 3, 1e-12);
    for (int i = 0; i < 9; i++)
        turned[i] = -value[i];
    s = channel_statistics_of(time, turned, 9, 0);
    ck_assert(s.mean < 0 && s.peak == 5 && s.peaks == 3);
    assert_absolute(s.significant, 5, 1e-12);
}
END_TEST

/* Peaks of a day are all counted, and the highest of them are taken whenever they come. */
START_TEST(peaks_may_be_many)
{
    enum { PEAKS = 30000, N = 2 * PEAKS };
    static double time[N], value[N];
    for (int i = 0; i < N; i++) {
        time[i] = i;
        value[i] = i % 2 ? 0 : -1e6 - i / 2 - 1; /* from -1000001 to -1030000 */
    }
    channel_statistics s = channel_statistics_of(time, value, N, 0);
    ck_assert_int_eq(s.peaks, PEAKS);
    assert_relative(s.significant, -1025000.5, 1e-12); /* of the last 10000 */
    assert_absolute(s.significant_above, 0, 1e-12);    /* between them: the outermost is 0 each time */
    for (int i = 0; i < N; i += 2)
        value[i] = i % 4 ? 3 : 7; /* half of them each: the third is of one value */
    s = channel_statistics_of(time, value, N, 0);
    ck_assert_int_eq(s.peaks, PEAKS);
    assert_relative(s.significant, 7, 1e-12);
}
END_TEST

/* exp(-lag / scale), up to an end. */
typedef struct decay {
    double scale;
    int32_t end, looks;
} decay;

static double decay_covariance(const void *of, int32_t lag)
{
    decay *d = *(decay *const *)of;
    d->looks++;
    return lag < d->end ? 3 * real_exp(-lag / d->scale) : -1;
}

/* The sum of a geometric series, by all lags; and with fewer looks within 0.1 %. */
START_TEST(correlations_are_summed_over_every_lag)
{
    for (int32_t scale = 1; scale < 100000; scale *= 7)
        for (int sparse = 0; sparse < 2; sparse++) {
            decay d = {scale, 1000000, 0}, *of = &d;
            double r = real_exp(-1.0 / scale), found = correlation_integral(decay_covariance, &of, 900000, sparse);
            assert_relative(found, 0.5 * (1 + r) / (1 - r), sparse ? 1e-3 : 1e-9);
            ck_assert_int_le(d.looks, sparse ? 5000 : 900000);
        }
    decay cut = {1e9, 4, 0}, *of = &cut;
    assert_relative(correlation_integral(decay_covariance, &of, 100, true), 3.5, 1e-8);
    assert_relative(correlation_integral(decay_covariance, &of, 3, true), 2.5, 1e-8);
    cut.end = 0;
    ck_assert(correlation_integral(decay_covariance, &of, 100, false) == 0.5);
}
END_TEST

TEST_MAIN("channel_statistics", correlations_are_summed_over_every_lag, statistics_of_a_channel, rows_after_a_time,
          equal_values_scatter_by_nothing, nothing_is_measured, peaks_have_a_side, peaks_may_be_many)
