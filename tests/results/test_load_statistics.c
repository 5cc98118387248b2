/* Exceedance with its band and the histogram, against series whose distribution is known. */
#include "testing.h"

#include "base/random.h"
#include "results/load_statistics.h"

/* Of LONG values every seventh begins a pair. */
enum { LONG = 130000, SHORT = 500, SERIES = 300 };

/* First-order autoregression of variance 1: its values are worth n (1 - a) / (1 + a) independent ones (Bartlett 1946).
 */
static void fill(double *value, int32_t count, double a, uint32_t id)
{
    random_stream stream = random_begin(11, 1, id);
    double x = random_normal(&stream);
    for (int32_t i = 0; i < count; i++) {
        value[i] = x;
        x = a * x + sqrt(1 - a * a) * random_normal(&stream);
    }
}

START_TEST(a_series_is_worth_its_independent_values)
{
    static double value[LONG];
    context ctx;
    context_init(&ctx);
    for (double a = 0; a < 0.95; a += 0.3) {
        load_distribution d;
        fill(value, LONG, a, 1);
        ck_assert(load_distribution_of(&ctx, value, LONG, 0.1, 0, &d));
        double expected = LONG * (1 - a) / (1 + a);
        ck_assert_msg(fabs(d.independent / expected - 1) < 0.25, "a %g: %g values instead of %g", a, d.independent,
                      expected);
        load_distribution_free(&ctx, &d);
    }
}
END_TEST

/* Where the level 0, the median, lies between the levels, its band must hold one half in 95 of 100 series. */
START_TEST(the_band_holds_the_truth_as_often_as_it_says)
{
    static double value[SHORT];
    context ctx;
    context_init(&ctx);
    int held = 0;
    for (uint32_t k = 0; k < SERIES; k++) {
        load_distribution d;
        fill(value, SHORT, 0.8, 100 + k);
        ck_assert(load_distribution_of(&ctx, value, SHORT, 1, 0, &d));
        int32_t i = 1;
        while (d.level.data[i] < 0)
            i++;
        double t = -d.level.data[i - 1] / (d.level.data[i] - d.level.data[i - 1]);
        double low = d.low.data[i - 1] + t * (d.low.data[i] - d.low.data[i - 1]);
        double high = d.high.data[i - 1] + t * (d.high.data[i] - d.high.data[i - 1]);
        held += low <= 0.5 && 0.5 <= high;
        load_distribution_free(&ctx, &d);
    }
    /* The number of independent values is itself an estimate, so a few per cent are missing from 95. */
    ck_assert_msg(held >= SERIES * 0.88 && held <= SERIES * 0.99, "the truth is held in %d of %d series", held,
                  (int)SERIES);
}
END_TEST

START_TEST(a_distribution_tells_what_it_is_worth)
{
    char text[LOAD_WORTH_SIZE];
    load_distribution_tell(&(load_distribution){.time_scale = 2, .independent = 12.3}, true, text);
    ck_assert_str_eq(text, "12 independent values, one every 4 s");
    /* Held at one: the series ends before the next. */
    load_distribution_tell(&(load_distribution){.time_scale = 40, .independent = 1}, true, text);
    ck_assert_str_eq(text, "1 independent value");
    load_distribution_tell(&(load_distribution){.time_scale = 40, .independent = 1.6}, false, text);
    ck_assert_str_eq(text, "2 independent values");
}
END_TEST

START_TEST(histogram_and_exceedance_count_every_value)
{
    const double value[] = {0, 0, 1, 2, 3, 3, 3, 10};
    context ctx;
    load_distribution d;
    context_init(&ctx);
    ck_assert(load_distribution_of(&ctx, value, 8, 1, 0, &d));
    double sum = 0;
    for (int32_t i = 0; i < d.density.count; i++)
        sum += d.density.data[i];
    ck_assert_double_eq_tol(sum, 1, 1e-12);
    ck_assert_double_eq(d.exceeded.data[0], 0.75); /* two of eight are not above the least */
    ck_assert_double_eq(d.exceeded.data[d.exceeded.count - 1], 0);
    for (int32_t i = 0; i < d.level.count; i++) {
        int above = 0;
        for (int k = 0; k < 8; k++)
            above += value[k] > d.level.data[i];
        ck_assert_double_eq(d.exceeded.data[i], above / 8.0);
        ck_assert(d.low.data[i] <= d.exceeded.data[i] && d.exceeded.data[i] <= d.high.data[i]);
    }
    load_distribution_free(&ctx, &d);
    ck_assert(load_distribution_of(&ctx, value, 0, 1, 0, &d));
    ck_assert_int_eq(d.level.count, 0);
    ck_assert(load_distribution_of(&ctx, value, 2, 1, 0, &d)); /* constant */
    ck_assert_double_eq(d.exceeded.data[0], 0);
    load_distribution_free(&ctx, &d);
    ck_assert(load_distribution_of(&ctx, value, 8, 1, 4, &d)); /* means over half of all */
    ck_assert_double_eq(d.independent, 2);
    load_distribution_free(&ctx, &d);
}
END_TEST

/* 0, 1, ..., 299 in thirty bars: ten values each, from where the bar begins. */
START_TEST(bars_hold_their_own_values)
{
    enum { COUNT = 300, ALL_BARS = 30 };
    double value[COUNT];
    context ctx;
    load_distribution d;
    context_init(&ctx);
    for (int32_t i = 0; i < COUNT; i++)
        value[i] = (i * 7) % COUNT;
    ck_assert(load_distribution_of(&ctx, value, COUNT, 0.1, 0, &d));
    for (int32_t i = 0; i < ALL_BARS; i++) {
        double begin = d.bar.data[i], end = i + 1 < ALL_BARS ? d.bar.data[i + 1] : HUGE_VAL;
        int32_t own = 0;
        for (int32_t k = 0; k < COUNT; k++)
            own += value[k] >= begin && value[k] < end;
        assert_absolute(d.density.data[i], (double)own / COUNT, 1e-12);
    }
    load_distribution_free(&ctx, &d);
}
END_TEST

/* The axis shows the averaged loads and a tenth of their range beyond, with the chart's margin of 5 %: spikes beyond go
   on out of the frame, and the largest is told. */
START_TEST(spikes)
{
    double raw[4] = {0, -700, 90, 400};
    const double x[4] = {0, -100, -50, 0}, y[4] = {0, 40, 100, (double)NAN};
    const double *const averaged[] = {x, y};
    load_cut cut = LOAD_CUT_NONE;
    double axis[2];
    assert_absolute(load_spikes_cut(raw, averaged, 2, 4, &cut, axis), -700, 0);
    ck_assert_int_eq(cut, LOAD_CUT_LARGEST);
    assert_absolute(axis[0], -132, 1e-12);
    assert_absolute(axis[1], 132, 1e-12);
    assert_absolute(raw[0], 0, 0);
    assert_absolute(raw[1], -144, 1e-12);
    assert_absolute(raw[2], 90, 0);
    assert_absolute(raw[3], 144, 1e-12);
    raw[1] = -131, raw[3] = 130;
    assert_absolute(load_spikes_cut(raw, averaged, 2, 4, &cut, axis), -131, 0);
    ck_assert_int_eq(cut, LOAD_CUT_NONE);
    ck_assert(axis[0] == 0 && axis[1] == 0);
}
END_TEST

/* Zero is on the axis, and the chart has a margin of its own: 5 % of -120 to 120 here. */
START_TEST(spikes_on_the_axis)
{
    const double down[2] = {-100, -80}, both[2] = {-100, 100};
    const double *const one[] = {down}, *const two[] = {both};
    const struct {
        const double *const *averaged;
        double raw[2], drawn[2], largest;
        load_cut cut;
    } cases[] = {{one, {-100, -10}, {-100, -10}, -100, LOAD_CUT_NONE},
                 {one, {-110, 0}, {-110, 0}, -110, LOAD_CUT_NONE},
                 {two, {-131, 130}, {-131, 130}, -131, LOAD_CUT_NONE},
                 {two, {-134, 130}, {-134, 130}, -134, LOAD_CUT_LARGEST},
                 {one, {-100, 30}, {-100, 21}, -100, LOAD_CUT_SOME},
                 {one, {-100, (double)NAN}, {-100, (double)NAN}, -100, LOAD_CUT_NONE}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double raw[2] = {cases[i].raw[0], cases[i].raw[1]};
        double axis[2];
        load_cut cut;
        assert_absolute(load_spikes_cut(raw, cases[i].averaged, 1, 2, &cut, axis), cases[i].largest, 0);
        ck_assert_msg(cut == cases[i].cut, "case %zu: %d", i, (int)cut);
        for (int k = 0; k < 2; k++)
            ck_assert_msg(raw[k] == cases[i].drawn[k] || isnan(cases[i].drawn[k]), "case %zu: %g", i, raw[k]);
    }
}
END_TEST

TEST_MAIN("load statistics", spikes, spikes_on_the_axis, bars_hold_their_own_values,
          a_series_is_worth_its_independent_values, the_band_holds_the_truth_as_often_as_it_says,
          histogram_and_exceedance_count_every_value, a_distribution_tells_what_it_is_worth)
