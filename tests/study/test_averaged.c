/* Intervals that Gumbel's law and the generalized one share. */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/averaged.h"
#include "study/extremes.h"

enum { COUNT = 30 };
/* Three times thirty blocks, exceeded once. */
static const double exposure = 90, exponent = 1;

typedef struct sample {
    double value[COUNT];
    extreme_law gumbel, any;
    gumbel_pivot pivot;
    profile_question q;
} sample;

/* Maxima of a bounded law, or of Gumbel's, from an origin, in a unit. */
static void make_from(sample *s, double shape, double origin, double unit)
{
    random_stream r = random_begin(5, 3, 0);
    for (int i = 0; i < COUNT; i++) {
        double y = -real_log(-real_log(1 - random_unit(&r)));
        s->value[i] = origin + unit * (10 + 2 * (shape == 0 ? y : (real_exp(shape * y) - 1) / shape));
    }
    values_sort(&(double_array){.data = s->value, .count = COUNT});
    ck_assert(extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, s->value, COUNT, 0, &s->gumbel));
    ck_assert(extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, s->value, COUNT, 0, &s->any));
    gumbel_pivot_make(s->value, COUNT, &s->gumbel, &s->pivot);
    s->q = (profile_question){.law = &s->any,
                              .sorted = s->value,
                              .count = COUNT,
                              .exposure = exposure,
                              .exponent = exponent,
                              .confidence = 0.95};
}
static void make(sample *s, double shape) { make_from(s, shape, 0, 1); }

START_TEST(with_all_the_weight_it_is_the_interval_of_that_law)
{
    sample s;
    make(&s, -0.15);
    level_interval exact = gumbel_pivot_interval(&s.pivot, exponent / exposure, 0.95);
    level_interval one = averaged_interval(&s.pivot, exact, &s.q, 1), any = profile_interval(&s.q);
    assert_absolute(one.level, exact.level, 0);
    assert_absolute(one.low, exact.low, 1e-6);
    assert_absolute(one.high, exact.high, 1e-6);
    one = averaged_interval(&s.pivot, exact, &s.q, 0);
    assert_absolute(one.level, exact.level, 0);
    assert_absolute(one.low, any.low, 1e-3);
    assert_absolute(one.high, any.high, 1e-3);
}
END_TEST

/* Each tail of an interval of another confidence is known: of the exact one by its pivot, of the profile's by the
   confidence at which it ends there. */
static double profile_confidence(sample *s, double end, bool high)
{
    double lo = 0, hi = 0.9999;
    for (int i = 0; i < 60; i++) {
        s->q.confidence = 0.5 * (lo + hi);
        level_interval at = profile_interval(&s->q);
        bool outside = high ? at.high > end : at.low < end;
        *(outside ? &hi : &lo) = s->q.confidence;
    }
    s->q.confidence = 0.95;
    return lo;
}

START_TEST(tails_of_both_laws_add_up_to_what_the_confidence_leaves)
{
    sample s;
    make(&s, -0.15);
    double weight = 0.6;
    level_interval exact = gumbel_pivot_interval(&s.pivot, exponent / exposure, 0.95);
    level_interval one = averaged_interval(&s.pivot, exact, &s.q, weight);
    double low = weight * gumbel_pivot_below(&s.pivot, exponent / exposure, one.low) +
                 (1 - weight) * (0.5 - 0.5 * profile_confidence(&s, one.low, false));
    double high = weight * (1 - gumbel_pivot_below(&s.pivot, exponent / exposure, one.high)) +
                  (1 - weight) * (0.5 - 0.5 * profile_confidence(&s, one.high, true));
    assert_absolute(low, 0.025, 1e-4);
    assert_absolute(high, 0.025, 1e-4);
}
END_TEST

START_TEST(the_weight_goes_with_what_the_sample_says)
{
    sample near, far;
    make(&near, 0);
    make(&far, -0.5);
    double here = averaged_weight(&near.gumbel, &near.any, near.value, COUNT);
    /* Of equal fits the one without the shape is better by the price of a parameter (Hurvich and Tsai 1989). */
    double price = (2 * 3 + 2 * 3 * 4 / (COUNT - 4.0) - 2 * 2 - 2 * 2 * 3 / (COUNT - 3.0)) / 2;
    assert_absolute(averaged_weight(&near.gumbel, &near.gumbel, near.value, COUNT), 1 / (1 + real_exp(-price)), 1e-12);
    ck_assert_double_gt(here, 0.5);
    ck_assert_double_lt(averaged_weight(&far.gumbel, &far.any, far.value, COUNT), 0.05);
}
END_TEST

START_TEST(ends_rise_with_the_level)
{
    /* The less often it is exceeded the higher; from far inside, where a law with this end cannot be. */
    for (int k = 0; k < 4; k++) {
        sample s;
        make(&s, -0.2 - 0.2 * k);
        double weight = averaged_weight(&s.gumbel, &s.any, s.value, COUNT);
        level_interval before = {0};
        for (int i = 0; i < 40; i++) {
            s.q.exponent = real_exp(4 - 0.25 * i);
            level_interval exact = gumbel_pivot_interval(&s.pivot, s.q.exponent / exposure, 0.95);
            level_interval now = averaged_interval(&s.pivot, exact, &s.q, weight);
            ck_assert_msg(i == 0 || (now.low > before.low - 1e-5 && now.high > before.high - 1e-5),
                          "shape %g, exponent %g: %.9g to %.9g after %.9g to %.9g", s.any.shape, s.q.exponent, now.low,
                          now.high, before.low, before.high);
            before = now;
        }
    }
}
END_TEST

/* Where neighbouring numbers lie farther apart than an end is looked for: it is found to some of them. */
START_TEST(ends_far_from_zero_are_found)
{
    sample near, far;
    make(&near, -0.15);
    make_from(&far, -0.15, 1e9, 0.01);
    level_interval by[2];
    for (int i = 0; i < 2; i++) {
        const sample *s = i ? &far : &near;
        by[i] = averaged_interval(&s->pivot, gumbel_pivot_interval(&s->pivot, exponent / exposure, 0.95), &s->q, 0.6);
    }
    assert_absolute((by[1].low - 1e9) / 0.01, by[0].low, 1e-3);
    assert_absolute((by[1].high - 1e9) / 0.01, by[0].high, 1e-3);
}
END_TEST

/* Weights are those of fits by likelihood, and the exact interval is that of either fit. */
START_TEST(the_interval_does_not_depend_on_how_the_level_is_fitted)
{
    static double value[4000];
    static extreme_result by[2];
    const series_part part = {value, sizeof value / sizeof *value};
    const series_set set = {&part, 1, 1};
    random_stream r = random_begin(5, 4, 0);
    context ctx;
    fram_error error = {0};
    extreme_request ask;
    context_init(&ctx);
    extreme_request_default(&ask);
    ask.levels = 0;
    for (int32_t i = 0; i < part.count; i++)
        value[i] = real_exp(random_normal(&r));
    for (int fit = 0; fit < 2; fit++) {
        ask.fit = fit == 0 ? FIT_LIKELIHOOD : FIT_MOMENTS;
        assert_ok(extremes_of_series(&ctx, &set, EXTREME_GUMBEL, &ask, &by[fit], &error), error);
        ck_assert_msg(by[fit].answered, "%s", by[fit].note);
    }
    ck_assert_double_gt(fabs(by[1].most_probable.level / by[0].most_probable.level - 1), 0.01);
    assert_relative(by[1].most_probable.low, by[0].most_probable.low, 1e-5);
    assert_relative(by[1].most_probable.high, by[0].most_probable.high, 1e-5);
    /* A wish to stop ends the search. */
    const int stop = 1;
    sample s;
    make(&s, 0);
    ctx.stop = &stop;
    s.q.ctx = &ctx;
    ck_assert_double_eq(profile_least(&s.q), 0);
    assert_fails(extremes_of_series(&ctx, &set, EXTREME_GUMBEL, &ask, &by[0], &error), error, FRAM_INTERRUPTED,
                 "intervals");
}
END_TEST

TEST_MAIN("averaged", with_all_the_weight_it_is_the_interval_of_that_law,
          tails_of_both_laws_add_up_to_what_the_confidence_leaves, the_weight_goes_with_what_the_sample_says,
          ends_rise_with_the_level, ends_far_from_zero_are_found,
          the_interval_does_not_depend_on_how_the_level_is_fitted)
