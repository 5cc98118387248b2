/* Points and lines of probability plots: plotting positions, and the law where its levels are. */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/extremes.h"

enum { VALUES = 20000 };

/* A correlated Gaussian series. */
static void draw_series(double *value)
{
    random_stream r = random_begin(4, 77, 0);
    double x = 0;
    for (int i = 0; i < VALUES; i++) {
        double sum = 0;
        for (int k = 0; k < 12; k++)
            sum += random_unit(&r);
        x = 0.7 * x + sum - 6;
        value[i] = x;
    }
}

/* Every method's line goes through its most probable maximum, and its points rise to the greatest value. */
START_TEST(lines_go_through_the_answer)
{
    static double value[VALUES];
    draw_series(value);
    const series_part part = {value, VALUES};
    const series_set set = {&part, 1, 2.0};
    context ctx;
    fram_error error = {0};
    extreme_request ask;
    context_init(&ctx);
    extreme_request_default(&ask);
    for (int m = 0; m < EXTREME_METHODS; m++) {
        extreme_result r;
        assert_ok(extremes_of_series(&ctx, &set, (extreme_method)m, &ask, &r, &error), error);
        ck_assert_msg(r.answered, "%s: %s", extreme_method_name((extreme_method)m), r.note);
        assert_relative(extreme_level_of_period(&r, ask.duration), r.most_probable.level, 1e-9);
        ck_assert_int_ge(r.points, 10);
        for (int32_t i = 1; i < r.points; i++)
            ck_assert(r.point[i].level >= r.point[i - 1].level && r.point[i].period >= r.point[i - 1].period);
        assert_absolute(r.time, 2.0 * VALUES, 1e-9);
        /* The greatest value is exceeded about once in the time of the data. */
        double last = r.point[r.points - 1].period / r.time;
        ck_assert_msg(last > 0.3 && last < 3, "%s: %g", extreme_method_name((extreme_method)m), last);
    }
}
END_TEST

typedef struct stopper {
    const char *work;
    int told, stop;
} stopper;

static void stop_at_the_third(void *user, const char *what, double done, double total)
{
    stopper *s = user;
    ck_assert_str_eq(what, s->work);
    ck_assert(done > 0 && done < total);
    s->stop = ++s->told == 3;
}

/* Who asks to stop is heard from one sample of a bootstrap to the next, and from one fit of many. */
START_TEST(bootstraps_and_fits_are_stopped)
{
    static double value[VALUES];
    draw_series(value);
    const series_part part = {value, VALUES};
    const series_set set = {&part, 1, 2.0};
    static const struct {
        extreme_method method;
        bool stability;
        const char *work;
    } cases[] = {{EXTREME_ACER, true, "drawing bootstrap samples"},
                 {EXTREME_UPCROSSING, true, "drawing bootstrap samples"},
                 {EXTREME_POT, false, "drawing bootstrap samples"},
                 {EXTREME_POT, true, "trying thresholds"},
                 {EXTREME_WEIBULL, true, "leaving out groups"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        stopper s = {.work = cases[i].work};
        context ctx;
        fram_error error = {0};
        extreme_request ask;
        extreme_result r;
        context_init(&ctx);
        ctx.work = stop_at_the_third;
        ctx.work_user = &s;
        ctx.stop = &s.stop;
        extreme_request_default(&ask);
        ask.fit = FIT_MOMENTS;
        ask.stability = cases[i].stability;
        assert_fails(extremes_of_series(&ctx, &set, cases[i].method, &ask, &r, &error), error, FRAM_INTERRUPTED,
                     cases[i].work);
        ck_assert_int_eq(s.told, 3);
        ck_assert(!r.answered);
    }
}
END_TEST

/* Of n values the i-th has i/(n + 1) below it; more than there is room for are thinned from below. */
START_TEST(plotting_positions)
{
    context ctx;
    fram_error error = {0};
    extreme_request ask;
    extreme_result r;
    double value[500];
    context_init(&ctx);
    extreme_request_default(&ask);
    for (int n = 20; n <= 500; n += 480) {
        for (int i = 0; i < n; i++)
            value[i] = -real_log(-real_log((i + 1) / (n + 1.0)));
        assert_ok(extremes_of_maxima(&ctx, value, n, 600, EXTREME_GUMBEL, &ask, &r, &error), error);
        ck_assert_int_eq(r.points, n < EXTREME_POINTS_MOST ? n : EXTREME_POINTS_MOST);
        /* Gumbel's own law: the mean time between exceedances of x is block e^x. */
        for (int32_t i = 0; i < r.points; i++)
            assert_relative(r.point[i].period, 600 * real_exp(r.point[i].level), 1e-9);
        assert_bits(r.point[0].level, value[0]);
        assert_bits(r.point[r.points - 1].level, value[n - 1]);
        assert_bits(r.point[r.points - 2].level, value[n - 2]);
    }
}
END_TEST

TEST_MAIN("extremes_points", lines_go_through_the_answer, bootstraps_and_fits_are_stopped, plotting_positions)
