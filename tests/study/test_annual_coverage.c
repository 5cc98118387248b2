/* How often intervals of the levels of a year hold the true value: a scatter diagram of conditions with known laws,
   again and again.  12 trials; with FRAM_TEST_LONG 1,000 of all, and a table of them (`make extremes-coverage`,
   bench/results/extremes.md). */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/pivot.h"
#include "study/study_extremes.h"

#include <stdio.h>

enum { CONDITIONS_MOST = 6, RUNS_MOST = 200, LEVELS = 2 };
static const double probability[LEVELS] = {1e-2, 1e-4};
#define BLOCK 1800.0

typedef struct diagram {
    const char *name;
    bool gev;
    int32_t runs, conditions;
    double hours[CONDITIONS_MOST];
    extreme_law law[CONDITIONS_MOST];
    bool measured; /* with FRAM_TEST_LONG alone */
} diagram;

/* One that decides all, one of which each adds as much, and one whose rarest ice is the worst. */
#define GUMBEL(location, scale)        \
    {                                  \
        LAW_GUMBEL, location, scale, 0 \
    }
#define GEV(location, scale, shape)     \
    {                                   \
        LAW_GEV, location, scale, shape \
    }
static const diagram diagrams[] = {
    {"one condition", false, 20, 1, {2000}, {GUMBEL(10, 2)}, false},
    {"three alike", false, 20, 3, {500, 500, 500}, {GUMBEL(10, 2), GUMBEL(10, 2), GUMBEL(10, 2)}, true},
    {"rare and worse", false, 20, 3, {3000, 300, 30}, {GUMBEL(6, 1), GUMBEL(9, 1.6), GUMBEL(12, 2.5)}, false},
    {"rare and worse", false, 10, 3, {3000, 300, 30}, {GUMBEL(6, 1), GUMBEL(9, 1.6), GUMBEL(12, 2.5)}, true},
    {"rare and worse", false, 100, 3, {3000, 300, 30}, {GUMBEL(6, 1), GUMBEL(9, 1.6), GUMBEL(12, 2.5)}, true},
    {"one condition", true, 100, 1, {2000}, {GEV(10, 2, -0.1)}, true},
    {"one condition", true, 200, 1, {2000}, {GEV(10, 2, -0.1)}, true},
    {"rare and worse", true, 200, 3, {3000, 300, 30}, {GEV(6, 1, -0.1), GEV(9, 1.6, 0), GEV(12, 2.5, 0.1)}, true},
    {"six alike",
     false,
     10,
     6,
     {500, 500, 500, 500, 500, 500},
     {GUMBEL(10, 2), GUMBEL(10, 2), GUMBEL(10, 2), GUMBEL(10, 2), GUMBEL(10, 2), GUMBEL(10, 2)},
     true},
};

static double exceedances(const diagram *d, double x)
{
    double sum = 0;
    for (int32_t c = 0; c < d->conditions; c++)
        sum += d->hours[c] * 3600 / BLOCK * extreme_law_exponent(&d->law[c], x);
    return sum;
}

static double truth_of(const diagram *d, double p)
{
    double lo = 0, hi = 1e6;
    while (hi - lo > 1e-10 * hi) {
        double mid = 0.5 * (lo + hi);
        if (exceedances(d, mid) > -real_log(1 - p))
            lo = mid;
        else
            hi = mid;
    }
    return hi;
}

static int trials(void)
{
    const char *asked = getenv("FRAM_TEST_LONG");
    int number = asked ? atoi(asked) : 12;
    return number == 1 ? 1000 : number;
}

static void draw(const diagram *d, int trial, condition_maxima *of)
{
    for (int32_t c = 0; c < d->conditions; c++) {
        random_stream r = random_begin(31, (uint32_t)c, (uint32_t)trial);
        for (int32_t i = 0; i < d->runs; i++)
            of[c].value.data[i] = extreme_law_level(&d->law[c], -real_log(1 - random_unit(&r)));
    }
}

/* Percent of the trials whose interval holds the truth, of each level; and the mean of level/truth. */
static void cover(const diagram *d, double held[LEVELS], double bias[LEVELS])
{
    double value[CONDITIONS_MOST][RUNS_MOST], hours[CONDITIONS_MOST];
    condition_maxima of[CONDITIONS_MOST];
    context ctx;
    context_init(&ctx);
    for (int32_t c = 0; c < d->conditions; c++) {
        of[c] = (condition_maxima){.value = {.data = value[c], .count = d->runs}, .block = BLOCK};
        hours[c] = d->hours[c];
    }
    study_extremes ask = {.gev = d->gev,
                          .confidence = 0.95,
                          .annual = {probability[0], probability[1]},
                          .annuals = LEVELS,
                          .hours = {.data = hours, .count = d->conditions}};
    for (int l = 0; l < LEVELS; l++)
        held[l] = bias[l] = 0;
    for (int k = 0; k < trials(); k++) {
        draw(d, k, of);
        level_interval got[LEVELS];
        annual_lack lack[LEVELS];
        fram_error error = {0};
        assert_ok(annual_levels(&ctx, &ask, of, d->conditions, got, lack, &error), error);
        for (int l = 0; l < LEVELS; l++) {
            if (lack[l].condition >= 0) {
                held[l] = bias[l] = (double)NAN;
                continue;
            }
            double truth = truth_of(d, probability[l]);
            held[l] += (got[l].low <= truth && truth <= got[l].high) * 100.0 / trials();
            bias[l] += got[l].level / truth / trials();
        }
    }
    printf("| %s | %s | %d x %d | %.1f | %.1f | %.4f | %.4f |\n", d->name, d->gev ? "gev" : "gumbel",
           (int)d->conditions, (int)d->runs, held[0], held[1], bias[0], bias[1]);
    fflush(stdout);
}

START_TEST(levels_of_a_year_are_held_as_often_as_they_say)
{
    printf("| conditions | law | runs | holds 1e-2, %% | holds 1e-4, %% | level/truth 1e-2 | 1e-4 |\n");
    for (size_t i = 0; i < sizeof diagrams / sizeof *diagrams; i++) {
        double held[LEVELS], bias[LEVELS];
        const char *only = getenv("FRAM_TEST_CASE");
        if ((only && atoi(only) != (int)i + 1) || (diagrams[i].measured && !getenv("FRAM_TEST_LONG")))
            continue;
        cover(&diagrams[i], held, bias);
        /* Of 12 trials fewer than 9 once in 450 times where 95 % hold. */
        ck_assert_msg(diagrams[i].measured || (held[0] >= 75 && held[1] >= 75), "%s: %g %% and %g %%", diagrams[i].name,
                      held[0], held[1]);
    }
}
END_TEST

/* Of one condition the interval is the exact one. */
START_TEST(one_condition_has_the_exact_interval)
{
    const diagram *d = &diagrams[0];
    double value[RUNS_MOST], hours = d->hours[0];
    condition_maxima of = {.value = {.data = value, .count = d->runs}, .block = BLOCK};
    study_extremes ask = {.confidence = 0.95, .annual = {0.05}, .annuals = 1, .hours = {.data = &hours, .count = 1}};
    for (int k = 0; k < 5; k++) {
        level_interval got;
        annual_lack lack;
        fram_error error = {0};
        extreme_law law;
        gumbel_pivot pivot;
        context ctx;
        context_init(&ctx);
        draw(d, k, &of);
        assert_ok(annual_levels(&ctx, &ask, &of, 1, &got, &lack, &error), error);
        ck_assert(extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, value, d->runs, 0, &law));
        gumbel_pivot_make(value, d->runs, &law, &pivot);
        const level_interval exact =
            gumbel_pivot_interval(&pivot, -real_log(1 - ask.annual[0]) / (hours * 3600 / BLOCK), ask.confidence);
        assert_relative(got.level, exact.level, 1e-9);
        assert_relative(got.low, exact.low, 1e-9);
        assert_relative(got.high, exact.high, 1e-9);
    }
}
END_TEST

/* Three conditions of the same values are one of three times the hours. */
START_TEST(hours_of_conditions_add_up)
{
    const diagram *d = &diagrams[1];
    double value[CONDITIONS_MOST][RUNS_MOST], hours[CONDITIONS_MOST] = {500, 300, 100, 200, 100, 300}, all = 1500;
    condition_maxima of[CONDITIONS_MOST];
    for (int32_t c = 0; c < CONDITIONS_MOST; c++)
        of[c] = (condition_maxima){.value = {.data = value[c], .count = d->runs}, .block = BLOCK};
    draw(d, 0, of);
    for (int32_t c = 1; c < CONDITIONS_MOST; c++)
        memcpy(value[c], value[0], sizeof value[0]);
    study_extremes ask = {.confidence = 0.95,
                          .annual = {probability[0], probability[1]},
                          .annuals = LEVELS,
                          .hours = {.data = hours, .count = CONDITIONS_MOST}};
    level_interval apart[LEVELS], together[LEVELS];
    annual_lack lack[LEVELS];
    fram_error error = {0};
    context ctx;
    context_init(&ctx);
    assert_ok(annual_levels(&ctx, &ask, of, CONDITIONS_MOST, apart, lack, &error), error);
    ask.hours.data = &all;
    ask.hours.count = 1;
    assert_ok(annual_levels(&ctx, &ask, of, 1, together, lack, &error), error);
    for (int l = 0; l < LEVELS; l++) {
        assert_relative(apart[l].level, together[l].level, 1e-9);
        assert_relative(apart[l].low, together[l].low, 1e-9);
        assert_relative(apart[l].high, together[l].high, 1e-9);
    }
}
END_TEST

/* Their tail takes as many runs as that of the one, 0.4767 log(2000/0.01005)^2 = 71.0; of 1,000 blocks alone 63.1. */
START_TEST(hours_of_conditions_add_up_for_the_shape_of_a_tail)
{
    const diagram two = {"", true, 70, 2, {500, 500}, {GEV(10, 2, -0.1), GEV(10, 2, -0.1)}, true};
    double value[2][RUNS_MOST], hours[2] = {500, 500};
    condition_maxima of[2];
    for (int32_t c = 0; c < 2; c++)
        of[c] = (condition_maxima){.value = {.data = value[c], .count = two.runs}, .block = BLOCK};
    draw(&two, 0, of);
    memcpy(value[1], value[0], sizeof value[0]);
    study_extremes ask = {.gev = true,
                          .confidence = 0.95,
                          .annual = {probability[0]},
                          .annuals = 1,
                          .hours = {.data = hours, .count = 2}};
    level_interval got;
    annual_lack lack;
    fram_error error = {0};
    context ctx;
    context_init(&ctx);
    assert_ok(annual_levels(&ctx, &ask, of, 2, &got, &lack, &error), error);
    ck_assert_int_eq(lack.condition, 0);
    ck_assert_int_eq(lack.runs, 71);
}
END_TEST

/* 0.4767 y^2 runs, y = log(blocks in a year/exponent): of 4,000 blocks and 1e-2, 1e-4 in a year 79.3 and 146.1. */
START_TEST(the_shape_of_a_tail_takes_enough_runs)
{
    double value[RUNS_MOST], hours = 2000;
    condition_maxima of = {.value = {.data = value}, .block = BLOCK};
    const diagram one = {"", true, RUNS_MOST, 1, {2000}, {GEV(10, 2, -0.1)}, true};
    study_extremes ask = {.gev = true,
                          .confidence = 0.95,
                          .annual = {probability[0], probability[1]},
                          .annuals = LEVELS,
                          .hours = {.data = &hours, .count = 1}};
    const struct {
        int32_t runs;
        bool answered[LEVELS];
    } cases[] = {{20, {false, false}}, {79, {false, false}}, {80, {true, false}}, {147, {true, true}}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        level_interval got[LEVELS];
        annual_lack lack[LEVELS];
        fram_error error = {0};
        context ctx;
        context_init(&ctx);
        draw(&one, 0, &of);
        of.value.count = cases[k].runs;
        assert_ok(annual_levels(&ctx, &ask, &of, 1, got, lack, &error), error);
        for (int l = 0; l < LEVELS; l++) {
            ck_assert_int_eq(lack[l].condition, cases[k].answered[l] ? -1 : 0);
            ck_assert_int_eq(lack[l].runs, cases[k].answered[l] ? 0 : l == 0 ? 80 : 147);
            ck_assert(isfinite(got[l].level) == cases[k].answered[l] && isfinite(got[l].high) == cases[k].answered[l]);
        }
    }
    /* By Gumbel's law there is no shape. */
    ask.gev = false;
    of.value.count = 20;
    level_interval got[LEVELS];
    annual_lack lack[LEVELS];
    context ctx;
    context_init(&ctx);
    ck_assert(annual_levels(&ctx, &ask, &of, 1, got, lack, NULL) == FRAM_OK && lack[1].condition == -1);
    ck_assert(got[1].low < got[1].level && got[1].level < got[1].high);
}
END_TEST

/* One condition in open water, of which all runs come out the same, beside one in ice: no level is under it, and those
   above it are those of the ice. */
START_TEST(a_condition_without_chance_adds_no_rate)
{
    const diagram *d = &diagrams[0];
    double value[2][RUNS_MOST], hours[2] = {500, 4000};
    condition_maxima of[2];
    for (int32_t c = 0; c < 2; c++)
        of[c] = (condition_maxima){.value = {.data = value[c], .count = d->runs}, .block = BLOCK, .idle = c == 1};
    draw(d, 0, of);
    study_extremes ask = {.confidence = 0.95, .annual = {0.01}, .annuals = 1, .hours = {.data = hours, .count = 2}};
    level_interval alone, got;
    annual_lack lack;
    fram_error error = {0};
    context ctx;
    context_init(&ctx);
    assert_ok(annual_levels(&ctx, &ask, of, 1, &alone, &lack, &error), error);
    const double constant[] = {0.5 * alone.low, 0.5 * (alone.level + alone.high), 2 * alone.high};
    for (int k = 0; k < 3; k++) {
        for (int32_t i = 0; i < d->runs; i++)
            value[1][i] = constant[k];
        assert_ok(annual_levels(&ctx, &ask, of, 2, &got, &lack, &error), error);
        ck_assert_int_eq(lack.condition, -1);
        ck_assert(got.level == fmax(alone.level, constant[k]));
        ck_assert(got.low == fmax(alone.low, constant[k]) && got.high == fmax(alone.high, constant[k]));
    }
    /* By itself it leaves nothing to chance, and runs that met ice and are the same carry no fit. */
    ask.hours.data = &hours[1];
    ask.hours.count = 1;
    assert_ok(annual_levels(&ctx, &ask, &of[1], 1, &got, &lack, &error), error);
    ck_assert(lack.condition == -1 && isnan(got.level) && isnan(got.low));
    of[1].idle = false;
    assert_ok(annual_levels(&ctx, &ask, &of[1], 1, &got, &lack, &error), error);
    ck_assert(lack.condition == 0 && lack.same && lack.tied == 0 && isnan(got.level));
    ask.hours.data = hours;
    ask.hours.count = 2;
    /* Where all but one are the same no law fits, however many there are. */
    value[1][d->runs - 1] *= 2;
    assert_ok(annual_levels(&ctx, &ask, of, 2, &got, &lack, &error), error);
    ck_assert_int_eq(lack.condition, 1);
    ck_assert_int_eq(lack.tied, d->runs - 1);
    ck_assert(isnan(got.level));
}
END_TEST

TEST_MAIN("annual_coverage", levels_of_a_year_are_held_as_often_as_they_say, one_condition_has_the_exact_interval,
          hours_of_conditions_add_up, hours_of_conditions_add_up_for_the_shape_of_a_tail,
          the_shape_of_a_tail_takes_enough_runs, a_condition_without_chance_adds_no_rate)
