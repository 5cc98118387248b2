/* Halves of series that are of one process are told apart no more often than by chance, however long they remember;
   steps and drifts are found. */
#include "base/random.h"
#include "base/transcendental.h"
#include "study/steadiness.h"
#include "testing.h"

#include <stdio.h>

enum { VALUES = 2000, SEEDS = 200, RUNS = 12 };
static const double scales[] = {0.5, 12, 62, 125, 250, 500};
static double series[RUNS * VALUES];

/* AR(1) of variance 1 and an integral time scale [values], which is that of its 1/2 and all powers of what it keeps. */
static void fill(double scale, uint32_t seed, double *value, int32_t count)
{
    random_stream r = random_begin(77, 5, seed);
    double kept = (scale - 0.5) / (scale + 0.5), new = sqrt(1 - kept * kept), x = random_normal(&r);
    for (int32_t i = 0; i < count; i++)
        value[i] = x = kept * x + new *random_normal(&r);
}

static double differ(int32_t runs, int32_t count)
{
    context ctx;
    fram_error error;
    double deviations = -1;
    series_part parts[RUNS];
    const series_set s = {parts, runs, 0.5};
    context_init(&ctx);
    for (int32_t p = 0; p < runs; p++)
        parts[p] = (series_part){series + p * count, count};
    assert_ok(halves_differ(&ctx, &s, &deviations, &error), error);
    return deviations;
}

/* Of one run, and of a dozen that are as long together: at most 2 of 200 each, where one in 700 is meant. */
START_TEST(one_process_is_one)
{
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        static const int32_t runs[] = {1, RUNS};
        for (int k = 0; k < 2; k++) {
            int alarms = 0;
            for (uint32_t seed = 0; seed < SEEDS; seed++) {
                for (int32_t p = 0; p < runs[k]; p++)
                    fill(scales[i], seed * RUNS + (uint32_t)p, series + p * (VALUES / runs[k]), VALUES / runs[k]);
                alarms += differ(runs[k], VALUES / runs[k]) > 0;
            }
            printf("scale %g, %d runs: %d of %d\n", scales[i], (int)runs[k], alarms, SEEDS);
            ck_assert_int_le(alarms, 2);
        }
    }
}
END_TEST

/* Of one deviation, in white noise and in one that remembers five values. */
START_TEST(changes_are_found)
{
    for (double scale = 0.5; scale <= 5; scale += 4.5) {
        for (uint32_t seed = 0; seed < 20; seed++) {
            fill(scale, seed, series, VALUES);
            for (int i = VALUES / 2; i < VALUES; i++)
                series[i] += 1;
            ck_assert_double_gt(differ(1, VALUES), 4);
            fill(scale, seed, series, VALUES);
            for (int i = 0; i < VALUES; i++)
                series[i] += 4.0 * i / VALUES;
            ck_assert_double_gt(differ(1, VALUES), 4);
        }
    }
}
END_TEST

/* With fewer values than batches, or none that differ, there is nothing to tell. */
START_TEST(nothing_is_judged_of_nothing)
{
    fill(1, 3, series, VALUES);
    for (int32_t count = 1; count < 24; count++)
        ck_assert_double_eq(differ(1, count), 0);
    for (int i = 0; i < VALUES; i++)
        series[i] = 3;
    ck_assert_double_eq(differ(1, VALUES), 0);
    ck_assert_double_eq(differ(0, 0), 0);
}
END_TEST

TEST_MAIN("steadiness", one_process_is_one, changes_are_found, nothing_is_judged_of_nothing)
