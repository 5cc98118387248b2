/* Exact intervals of levels of Gumbel's law: against the same integral by scipy 1.10.1 (60,001 points, its incomplete
   gamma function), and in repeated samples; and the sentence for maxima that are not Gumbel's. */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/extremes.h"
#include "study/pivot.h"
#include "study/series_set.h"

#include <string.h>

static const double sample[] = {6.015,  6.918,  7.339,  7.489,  7.53,   7.619,  7.865,  8.281,  8.789,  9.254,
                                9.553,  9.559,  9.598,  9.62,   9.664,  9.835,  10.247, 10.734, 11.159, 11.412,
                                11.416, 11.439, 11.485, 11.531, 11.856, 12.349, 12.897, 13.365, 13.666, 13.805,
                                13.879, 14.031, 14.385, 14.99,  15.805, 16.734, 17.703, 18.757, 20.24,  24.048};
enum { SAMPLE = sizeof sample / sizeof *sample };

START_TEST(intervals_are_those_of_the_integral_by_scipy)
{
    static const struct {
        int32_t count;
        double exponent, level, low, high;
    } expected[] = {{SAMPLE, 0.010536051565782628, 23.350251397935445, 20.40279977436996, 28.236006009429126},
                    {10, 1.0 / 9, 9.161306128415404, 8.29563281962374, 11.232199283361712}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        for (int how = FIT_LIKELIHOOD; how <= (int)FIT_MOMENTS; how++) {
            extreme_law law;
            gumbel_pivot pivot;
            ck_assert(extreme_law_fit(LAW_GUMBEL, (law_fit)how, sample, expected[i].count, 0, &law));
            gumbel_pivot_make(sample, expected[i].count, &law, &pivot);
            level_interval got = gumbel_pivot_interval(&pivot, expected[i].exponent, 0.95);
            /* The interval is the sample's, whatever fit it is measured by. */
            assert_relative(got.low, expected[i].low, 1e-6);
            assert_relative(got.high, expected[i].high, 1e-6);
            if (how == (int)FIT_LIKELIHOOD)
                assert_relative(got.level, expected[i].level, 1e-8);
        }
    }
}
END_TEST

static void draw(double *value, int32_t count, uint32_t sample_number, double shape)
{
    random_stream r = random_begin(21, 7, sample_number);
    double_array a = {.data = value, .count = count};
    for (int32_t i = 0; i < count; i++) {
        double exponent = -real_log(1 - random_unit(&r));
        value[i] = shape != 0 ? (real_pow(exponent, -shape) - 1) / shape : -real_log(exponent);
    }
    values_sort(&a);
}

/* Of 500 intervals of 80 % from ten values each, 400 with a deviation of 9 hold the level. */
START_TEST(small_samples_hold_the_level_as_often_as_they_say)
{
    enum { TRIALS = 500, VALUES = 10 };
    double value[VALUES], exponent = 0.01;
    int32_t held = 0, under = 0;
    for (uint32_t i = 0; i < TRIALS; i++) {
        extreme_law law;
        gumbel_pivot pivot;
        draw(value, VALUES, i, 0);
        ck_assert(extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, value, VALUES, 0, &law));
        gumbel_pivot_make(value, VALUES, &law, &pivot);
        level_interval got = gumbel_pivot_interval(&pivot, exponent, 0.8);
        held += got.low <= -real_log(exponent) && -real_log(exponent) <= got.high;
        under += got.high < -real_log(exponent);
    }
    ck_assert_msg(held > 370 && held < 430, "%d of %d", (int)held, (int)TRIALS);
    ck_assert_msg(under > 25 && under < 75, "%d of %d are too low", (int)under, (int)TRIALS);
}
END_TEST

/* Maxima of a light or a heavy tail are told to be no Gumbel's, those of his law are not. */
START_TEST(maxima_of_another_law_are_told)
{
    static const struct {
        double shape;
        const char *said;
    } cases[] = {{-0.4, "too high"}, {0.5, "too low"}, {0, NULL}};
    enum { VALUES = 100 };
    static double value[VALUES];
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static extreme_result r;
        extreme_request ask;
        fram_error error = {0};
        extreme_request_default(&ask);
        draw(value, VALUES, 3, cases[i].shape);
        assert_ok(extremes_of_maxima(&ctx, value, VALUES, 600, EXTREME_GUMBEL, &ask, &r, &error), error);
        ck_assert(r.answered);
        ck_assert_str_eq(r.interval, "exact, conditional on the sample");
        const char *note = strstr(r.note, "speak against Gumbel's law");
        ck_assert_msg((note != NULL) == (cases[i].said != NULL), "%g: %s", cases[i].shape, r.note);
        ck_assert_msg(!note || strstr(note, cases[i].said), "%g: %s", cases[i].shape, r.note);
    }
}
END_TEST

TEST_MAIN("pivot", intervals_are_those_of_the_integral_by_scipy, small_samples_hold_the_level_as_often_as_they_say,
          maxima_of_another_law_are_told)
