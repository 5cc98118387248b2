/* The synthetic example of Naess, Gaidai and Karpa (2013, Journal of Probability and Statistics, article 797014,
   section on synthetic data, table 1): twenty years of a peak every 3.65 days, each of the law exp(-10 exp(-x^2/2)), so
   that the level of 100 years is sqrt(2 log 1e5) = 4.80.  The authors' averages over 100 samples, with the averages of
   the ends of their intervals: ACER 4.82 (4.48, 5.18) by bootstrap, Gumbel's law of yearly maxima 4.84 (4.37, 5.40),
   peaks over a threshold 4.72 (4.27, 5.23). Here: the mean level of 100 samples, and intervals of eight; with
   FRAM_TEST_LONG those of all 100 and a table
   (`make acer-example`, bench/results/extremes.md). */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/extremes.h"

#include <stdio.h>

enum { YEARS = 20, PEAKS = 100, VALUES = YEARS * PEAKS, SAMPLES = 100, SHORT_INTERVALS = 8 };
#define DAY 86400.0
#define STEP (3.65 * DAY)
#define CENTURY (36500 * DAY)
/* Their tail begins where half of the peaks lie below, about. */
#define TAIL 2.3

static double peak(random_stream *r) { return sqrt(-2 * real_log(-real_log(1 - random_unit(r)) / 10)); }

static void draw(double *value, int32_t count, uint32_t sample)
{
    random_stream r = random_begin(2013, 7, sample);
    for (int32_t i = 0; i < count; i++)
        value[i] = peak(&r);
}

static double truth(void) { return sqrt(2 * real_log(1e5)); }

static double rates_level(context *ctx, const double *value)
{
    const series_part part = {value, VALUES};
    const series_set set = {&part, 1, STEP};
    acer_rates rates;
    acer_tail tail;
    ck_assert(acer_count(ctx, &set, 1, TAIL, 10, &rates));
    ck_assert(acer_fit(&rates, &tail));
    acer_free(ctx, &rates);
    return acer_level(&tail, STEP, CENTURY, 1);
}

/* The deviation of one sample is 0.18 in their table; of the mean of a hundred 0.018. */
START_TEST(the_mean_level_is_the_exact_one)
{
    static double value[VALUES];
    context ctx;
    context_init(&ctx);
    double mean = 0, square = 0;
    for (uint32_t i = 0; i < SAMPLES; i++) {
        draw(value, VALUES, i);
        double level = rates_level(&ctx, value);
        mean += level / SAMPLES;
        square += level * level / SAMPLES;
    }
    double deviation = sqrt(square - mean * mean);
    printf("exact %.3f, mean of 100 samples %.3f, deviation of one %.3f\n", truth(), mean, deviation);
    assert_absolute(truth(), 4.80, 5e-3);
    assert_absolute(mean, 4.80, 0.06);
    ck_assert_msg(deviation > 0.1 && deviation < 0.3, "%g", deviation);
}
END_TEST

static bool interval_of(context *ctx, const double *value, extreme_method method, level_interval *out)
{
    static extreme_result r;
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = CENTURY;
    ask.levels = 0;
    ask.order = 1;
    ask.block = PEAKS * STEP;
    if (method == EXTREME_ACER)
        ask.threshold = TAIL;
    const series_part part = {value, VALUES};
    const series_set set = {&part, 1, STEP};
    ck_assert(extremes_of_series(ctx, &set, method, &ask, &r, NULL) == FRAM_OK);
    *out = r.most_probable;
    return r.answered;
}

static void table_row(extreme_method method, int32_t samples, int32_t *held, level_interval *mean)
{
    static double value[VALUES];
    context ctx;
    context_init(&ctx);
    *mean = (level_interval){0, 0, 0};
    *held = 0;
    for (int32_t i = 0; i < samples; i++) {
        level_interval got;
        draw(value, VALUES, (uint32_t)i);
        ck_assert(interval_of(&ctx, value, method, &got));
        mean->level += got.level / samples;
        mean->low += got.low / samples;
        mean->high += got.high / samples;
        *held += got.low <= truth() && truth() <= got.high;
    }
    printf("| %s | %.2f | %.2f | %.2f | %d of %d |\n", extreme_method_name(method), mean->level, mean->low, mean->high,
           (int)*held, (int)samples);
    fflush(stdout);
}

START_TEST(intervals_are_about_those_of_the_authors)
{
    level_interval mean;
    int32_t held, samples = getenv("FRAM_TEST_LONG") ? SAMPLES : SHORT_INTERVALS;
    table_row(EXTREME_ACER, samples, &held, &mean);
    /* Their ends, and what eight samples of deviation 0.18 scatter. */
    assert_absolute(mean.low, 4.48, 0.2);
    assert_absolute(mean.high, 5.18, 0.2);
    ck_assert_int_ge(held, samples * 3 / 4);
    if (samples < SAMPLES)
        return;
    table_row(EXTREME_GUMBEL, samples, &held, &mean);
    table_row(EXTREME_GEV, samples, &held, &mean);
    table_row(EXTREME_POT, samples, &held, &mean);
}
END_TEST

TEST_MAIN("acer_example", the_mean_level_is_the_exact_one, intervals_are_about_those_of_the_authors)
