/* Laws of extremes against scipy 1.10.1 (committed numbers), closed forms, and each other. */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/profile.h"
#include "study/series_set.h"
#include "study/special.h"

/* Plotting positions of a Gumbel law, perturbed; ascending. */
static const double sample[] = {6.015,  6.918,  7.339,  7.489,  7.53,   7.619,  7.865,  8.281,  8.789,  9.254,
                                9.553,  9.559,  9.598,  9.62,   9.664,  9.835,  10.247, 10.734, 11.159, 11.412,
                                11.416, 11.439, 11.485, 11.531, 11.856, 12.349, 12.897, 13.365, 13.666, 13.805,
                                13.879, 14.031, 14.385, 14.99,  15.805, 16.734, 17.703, 18.757, 20.24,  24.048};
enum { SAMPLE = sizeof sample / sizeof *sample };

START_TEST(gamma_is_scipys)
{
    assert_relative(gamma_function(0.1), 9.513507698668732, 1e-13);
    assert_relative(gamma_function(0.5), 1.7724538509055159, 1e-13);
    assert_relative(gamma_function(1.3), 0.8974706963062772, 1e-13);
    assert_relative(gamma_function(7.7), 2769.830362327315, 1e-13);
}
END_TEST

/* scipy's own search for the greatest likelihood, continued to 1e-13 by its Nelder-Mead. */
START_TEST(likelihood_fits_are_scipys)
{
    extreme_law law;
    ck_assert(extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, sample, SAMPLE, 0, &law));
    assert_relative(law.location, 10.096589224401924, 1e-9);
    assert_relative(law.scale, 2.91100388275995, 1e-9);
    assert_relative(extreme_law_cost(&law, sample, SAMPLE), 106.44220060082847, 1e-12);
    ck_assert(extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, sample, SAMPLE, 0, &law));
    assert_relative(law.location, 10.010653399459219, 1e-6);
    assert_relative(law.scale, 2.8486892912327493, 1e-6);
    assert_absolute(law.shape, 0.055004657867806485, 1e-6);
    assert_relative(extreme_law_cost(&law, sample, SAMPLE), 106.35263566380961, 1e-11);
    ck_assert(extreme_law_fit(LAW_PARETO, FIT_LIKELIHOOD, sample + 25, SAMPLE - 25, 12, &law));
    assert_relative(law.scale, 4.751700484552113, 1e-6);
    assert_absolute(law.shape, -0.25317007824056137, 1e-6);
    assert_relative(extreme_law_cost(&law, sample + 25, SAMPLE - 25), 34.5799869196278, 1e-11);
    ck_assert(extreme_law_fit(LAW_WEIBULL, FIT_LIKELIHOOD, sample, SAMPLE, 0, &law));
    assert_relative(law.shape, 3.1657855681232854, 1e-7);
    assert_relative(law.scale, 13.18255994083532, 1e-7);
    assert_relative(extreme_law_cost(&law, sample, SAMPLE), 110.71452283762807, 1e-12);
}
END_TEST

/* The 0.9 quantile of the greatest of ten, by scipy's likelihoods, minimisers and t. */
START_TEST(profile_intervals_are_scipys)
{
    static const struct {
        law_kind kind;
        double level, low, high;
    } expected[] = {{LAW_GUMBEL, 23.350251327184008, 20.109861589057136, 27.93044783161611},
                    {LAW_GEV, 24.74915948761145, 19.67134873742186, 46.61056588866778}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        extreme_law law;
        ck_assert(extreme_law_fit(expected[i].kind, FIT_LIKELIHOOD, sample, SAMPLE, 0, &law));
        const profile_question q = {&law, sample, SAMPLE, 10, -real_log(0.9), 0.95, 0, NULL};
        level_interval got = profile_interval(&q);
        assert_relative(got.level, expected[i].level, 2e-5);
        assert_relative(got.low, expected[i].low, 2e-5);
        assert_relative(got.high, expected[i].high, 2e-5);
    }
}
END_TEST

/* Rises from one level to the next, and lies where the root of the deviance is the bound: half of 5 % lie beyond it. */
static void check_upper_ends(const profile_question *ask, const char *of)
{
    static const double probability[] = {0.5, 0.9, 0.99, 0.999};
    double last = -HUGE_VAL;
    for (int i = 0; i < 4; i++) {
        profile_question q = *ask;
        q.exponent = -real_log(probability[i]);
        level_interval got = profile_interval(&q);
        ck_assert_msg(got.high > last && got.high > got.level, "%s, shape %g: %g (%g, %g) behind %g", of, q.law->shape,
                      got.level, got.low, got.high, last);
        ck_assert_msg(isinf(got.high) || fabs(profile_beyond(&q, profile_least(&q), got.high, true) - 0.025) < 1e-5,
                      "%s, shape %g: %g (%g, %g)", of, q.law->shape, got.level, got.low, got.high);
        last = got.high;
    }
}

/* Far out, where the law of the last look is none, or lies in another valley. */
START_TEST(upper_ends_rise_with_their_levels)
{
    enum { FEW = 20 };
    static const double maxima[FEW] = {385.061744, 413.438498, 445.659326, 453.62115,  453.873307,
                                       456.0548,   468.034759, 468.724192, 469.181396, 475.243346,
                                       488.214095, 524.222094, 535.02674,  539.276393, 555.282234,
                                       609.243633, 615.259418, 639.88569,  756.34073,  875.875646};
    extreme_law law;
    ck_assert(extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, maxima, FEW, 0, &law));
    profile_question q = {&law, maxima, FEW, 180, -real_log(0.99), 0.95, 0, NULL};
    /* By a grid over location and shape. */
    assert_relative(profile_interval(&q).high, 105900, 5e-3);
    check_upper_ends(&q, "maxima");
    /* Maxima that end soon: their fit stops at the least shape, beyond which profiles would lead to no law. */
    static const double ending[] = {-0.8454, -0.7048, -0.5582, 0.8624, 0.8908, 1.1995,
                                    1.4330,  1.9451,  2.1480,  2.7552, 2.9644, 3.0527};
    ck_assert(extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, ending, 12, 0, &law));
    assert_absolute(law.shape, SHAPE_LEAST, 1e-3);
    check_upper_ends(&(profile_question){&law, ending, 12, 18, 1, 0.95, 0, NULL}, "ending");
    /* Peaks that end soon, many of them: rare levels lie at the end of the law. */
    enum { MANY = 365 };
    double peaks[MANY];
    for (int i = 0; i < MANY; i++)
        peaks[i] = 10 + 2 * (i + 0.5) / MANY;
    ck_assert(extreme_law_fit(LAW_PARETO, FIT_LIKELIHOOD, peaks, MANY, 10, &law));
    check_upper_ends(&(profile_question){&law, peaks, MANY, 3, 1, 0.95, 0, NULL}, "ending peaks");
    for (int heavy = 0; heavy < 2; heavy++) {
        double value[FEW];
        for (int i = 0; i < FEW; i++) {
            double p = (i + 0.5) / FEW;
            const extreme_law of = heavy ? (extreme_law){LAW_GEV, 10, 2, 1.2} : (extreme_law){LAW_PARETO, 10, 2, -0.6};
            value[i] = extreme_law_level(&of, -real_log(heavy ? p : 1 - p));
        }
        ck_assert(extreme_law_fit(heavy ? LAW_GEV : LAW_PARETO, FIT_LIKELIHOOD, value, FEW, 10, &law));
        check_upper_ends(&(profile_question){&law, value, FEW, 3, 1, 0.95, 0, NULL}, heavy ? "heavy" : "short");
    }
}
END_TEST

/* A step of the search that goes beyond the threshold has passed an end on its way: there lie only ends of levels that
   the peaks allow to be there. */
START_TEST(lower_ends_of_peaks_rise_with_their_levels)
{
    enum { FEW = 30 };
    static const double probability[] = {0.5, 0.9, 0.97, 0.99, 0.999, 0.9999};
    const extreme_law of = {LAW_PARETO, 10, 2, 0.4};
    double value[FEW];
    extreme_law law;
    for (int i = 0; i < FEW; i++)
        value[i] = extreme_law_level(&of, -real_log(1 - (i + 0.5) / FEW));
    ck_assert(extreme_law_fit(LAW_PARETO, FIT_LIKELIHOOD, value, FEW, 10, &law));
    for (double exposure = 0.2; exposure < 30; exposure *= 5) {
        double last = 10;
        for (size_t i = 0; i < sizeof probability / sizeof *probability; i++) {
            const profile_question q = {&law, value, FEW, exposure, -real_log(probability[i]), 0.95, 0, NULL};
            level_interval got = profile_interval(&q);
            ck_assert_msg(got.low > last && got.low < got.level, "exposure %g: %g (%g, %g) behind %g", exposure,
                          got.level, got.low, got.high, last);
            ck_assert_msg(fabs(profile_beyond(&q, profile_least(&q), got.low, false) - 0.025) < 1e-5,
                          "exposure %g: %g (%g, %g)", exposure, got.level, got.low, got.high);
            last = got.low;
        }
    }
    const profile_question easy = {&law, value, FEW, 1.1 / FEW, 1, 0.95, 0, NULL};
    ck_assert_double_eq(profile_interval(&easy).low, 10);
}
END_TEST

/* Greatest sea levels of 65 years at Port Pirie [m] (Coles 2001, table 1.1), ascending. */
static const double sea_level[] = {3.57, 3.62, 3.63, 3.65, 3.66, 3.66, 3.71, 3.71, 3.72, 3.73, 3.74, 3.75, 3.75,
                                   3.78, 3.79, 3.80, 3.83, 3.85, 3.85, 3.85, 3.85, 3.86, 3.86, 3.88, 3.88, 3.88,
                                   3.89, 3.90, 3.90, 3.91, 3.93, 3.94, 3.96, 3.96, 3.96, 3.96, 3.97, 3.98, 4.00,
                                   4.01, 4.01, 4.03, 4.05, 4.06, 4.06, 4.08, 4.08, 4.11, 4.11, 4.11, 4.18, 4.18,
                                   4.21, 4.21, 4.22, 4.24, 4.24, 4.25, 4.33, 4.33, 4.36, 4.37, 4.55, 4.55, 4.69};

/* Coles 2001, section 3.4.1, to his digits; the intervals are those of evd 2.3-6.1 for R, by chi-squared where Fram
   takes Student's t, which is 2 % wider for 62 degrees of freedom. */
START_TEST(the_textbook_s_sea_levels)
{
    enum { YEARS = sizeof sea_level / sizeof *sea_level };
    extreme_law law;
    ck_assert(extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, sea_level, YEARS, 0, &law));
    assert_absolute(law.location, 3.87, 5e-3);
    assert_absolute(law.scale, 0.198, 5e-4);
    assert_absolute(law.shape, -0.050, 5e-4);
    assert_absolute(-extreme_law_cost(&law, sea_level, YEARS), 4.34, 5e-3);
    static const struct {
        double probability, level, low, high;
    } of_year[] = {{0.9, 4.2962557798954, 4.20492783443, 4.44506907969},
                   {0.99, 4.6884358335125, 4.49065496728, 5.26070564725}};
    for (size_t i = 0; i < sizeof of_year / sizeof *of_year; i++) {
        const profile_question q = {&law, sea_level, YEARS, 1, -real_log(of_year[i].probability), 0.95, 0, NULL};
        level_interval got = profile_interval(&q);
        assert_relative(got.level, of_year[i].level, 1e-4);
        double low = of_year[i].level - of_year[i].low, high = of_year[i].high - of_year[i].level;
        assert_relative(got.level - got.low, 1.02 * low, 0.02);
        assert_relative(got.high - got.level, 1.02 * high, 0.03);
    }
    ck_assert(extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, sea_level, YEARS, 0, &law));
    assert_absolute(law.location, 3.87, 5e-3);
    assert_absolute(law.scale, 0.195, 5e-4);
    assert_absolute(-extreme_law_cost(&law, sea_level, YEARS), 4.22, 5e-3);
}
END_TEST

/* L-moments of an exact law are its own: a sample of its quantiles gives its parameters back, in the limit. */
START_TEST(moments_give_the_law_back)
{
    enum { N = 1000 };
    static const extreme_law laws[] = {{LAW_GUMBEL, 5, 2, 0},   {LAW_GEV, 5, 2, 0.2},     {LAW_GEV, -3, 1, -0.3},
                                       {LAW_GEV, 5, 2, 0},      {LAW_PARETO, 7, 3, 0.15}, {LAW_PARETO, 7, 3, -0.4},
                                       {LAW_WEIBULL, 0, 4, 1.7}};
    double *x = calloc(N, sizeof *x);
    for (size_t k = 0; k < sizeof laws / sizeof *laws; k++) {
        bool peaks = laws[k].kind == LAW_PARETO || laws[k].kind == LAW_WEIBULL;
        for (int i = 0; i < N; i++) {
            double p = (i + 0.5) / N;
            x[i] = extreme_law_level(&laws[k], -real_log(peaks ? 1 - p : p));
        }
        for (int how = 0; how < 2; how++) {
            extreme_law law;
            if (laws[k].kind == LAW_WEIBULL && how == FIT_MOMENTS) {
                ck_assert(!extreme_law_fit(laws[k].kind, FIT_MOMENTS, x, N, laws[k].location, &law));
                continue;
            }
            ck_assert(extreme_law_fit(laws[k].kind, (law_fit)how, x, N, laws[k].location, &law));
            assert_absolute(law.location, laws[k].location, 0.04);
            assert_absolute(law.scale, laws[k].scale, 0.04);
            assert_absolute(law.shape, laws[k].shape, 0.04);
        }
    }
    free(x);
}
END_TEST

START_TEST(levels_invert_exponents)
{
    static const extreme_law laws[] = {{LAW_GUMBEL, 5, 2, 0},    {LAW_GEV, 5, 2, 0.2},     {LAW_GEV, 5, 2, -0.3},
                                       {LAW_PARETO, 7, 3, 0.15}, {LAW_PARETO, 7, 3, -0.4}, {LAW_PARETO, 7, 3, 0},
                                       {LAW_WEIBULL, 0, 4, 1.7}};
    for (size_t k = 0; k < sizeof laws / sizeof *laws; k++)
        for (double e = 1e-6; e < 10; e *= 3)
            assert_relative(extreme_law_exponent(&laws[k], extreme_law_level(&laws[k], e)), e, 1e-9);
}
END_TEST

START_TEST(what_cannot_be_fitted_is_refused)
{
    extreme_law law;
    const double same[12] = {3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3};
    ck_assert(!extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, same, 12, 0, &law));
    ck_assert(!extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, sample, LAW_VALUES_LEAST - 1, 0, &law));
    ck_assert(!extreme_law_fit(LAW_PARETO, FIT_LIKELIHOOD, sample, SAMPLE, 7, &law));
}
END_TEST

/* A law shrinks to the least of the maxima where they are 1/(1 + 1.5) of all: of 50 that are 20. */
START_TEST(maxima_most_of_which_are_equal_are_of_no_law)
{
    enum { ALL = 50 };
    double value[ALL];
    extreme_law law;
    for (int zeros = 19; zeros <= 21; zeros++) {
        for (int i = 0; i < ALL; i++)
            value[i] = i < zeros ? 0 : -real_log(1 - (i - zeros + 0.5) / (ALL - zeros));
        int32_t tied = zeros > 19 ? zeros : 0;
        ck_assert_int_eq(extreme_law_tied(value, ALL, FIT_SHAPE_MOST), tied);
        ck_assert_int_eq(extreme_law_tied(value, ALL, 1.7), zeros);
        ck_assert(extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, value, ALL, 0, &law) == (tied == 0));
        ck_assert(extreme_law_fit(LAW_GEV, FIT_MOMENTS, value, ALL, 0, &law) == (tied == 0));
        ck_assert(extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, value, ALL, 0, &law) == (tied == 0));
        ck_assert(tied > 0 || law.scale > 1e-3);
    }
    ck_assert_int_eq(extreme_law_tied(sample, SAMPLE, PROFILE_SHAPE_MOST), 0);
    /* Peaks over a threshold are of a law that may begin with many. */
    ck_assert(extreme_law_fit(LAW_PARETO, FIT_LIKELIHOOD, value, ALL, -1, &law));
}
END_TEST

TEST_MAIN("extreme_law", upper_ends_rise_with_their_levels, lower_ends_of_peaks_rise_with_their_levels,
          maxima_most_of_which_are_equal_are_of_no_law, gamma_is_scipys, likelihood_fits_are_scipys,
          profile_intervals_are_scipys, the_textbook_s_sea_levels, moments_give_the_law_back, levels_invert_exponents,
          what_cannot_be_fitted_is_refused)
