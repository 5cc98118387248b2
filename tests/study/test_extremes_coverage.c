/* How often intervals of extremes hold the true value: samples of known laws, again and again.  12 trials of eleven
   cases; with FRAM_TEST_LONG 1,000 of all, and a table of them (`make extremes-coverage`, bench/results/extremes.md).
 */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/extremes.h"

#include <stdio.h>

enum { VALUES = 20000, LEVELS = 2 };
/* The greatest value in three times the data is asked: the level it reaches once on the average, and the one it stays
   below by 0.9. */
static const double exponents[LEVELS] = {1, 0.10536051565782628};

/* ---- samples ---- */

typedef struct trial {
    double value[VALUES];
    int32_t count;
    random_stream random;
} trial;

static double exponential(random_stream *r) { return -real_log(1 - random_unit(r)); }

/* Maxima of Gumbel's law with location 10 and scale 2. */
static void draw_gumbel(trial *t, int32_t count)
{
    t->count = count;
    for (int32_t i = 0; i < count; i++)
        t->value[i] = 10 - 2 * real_log(exponential(&t->random));
}

/* Independent values of Weibull's law with shape 1.5. */
static void draw_weibull(trial *t, int32_t count)
{
    t->count = count;
    for (int32_t i = 0; i < count; i++)
        t->value[i] = real_pow(exponential(&t->random), 1 / 1.5);
}

/* Gaussian, each value 0.8 of the one before and something new. */
static void draw_regression(trial *t, int32_t count)
{
    double x = random_normal(&t->random);
    t->count = count;
    for (int32_t i = 0; i < count; i++) {
        t->value[i] = x;
        x = 0.8 * x + 0.6 * random_normal(&t->random);
    }
}

/* Peaks and troughs of Rayleigh's law about 0, in turn, as those of narrow-banded waves. */
static void draw_rayleigh(trial *t, int32_t count)
{
    t->count = count;
    for (int32_t i = 0; i < count; i++)
        t->value[i] = (i % 2 ? -1 : 1) * sqrt(2 * exponential(&t->random));
}

/* ---- the truth, for the greatest of `times` values ---- */

static double gumbel_truth(double times, double exponent) { return 10 + 2 * real_log(times / exponent); }
static double weibull_truth(double times, double exponent)
{
    return real_pow(-real_log(1 - real_exp(-exponent / times)), 1 / 1.5);
}
static double rayleigh_truth(double times, double exponent)
{
    return sqrt(-2 * real_log(1 - real_exp(-exponent / (0.5 * times))));
}
/* Of 60,000 values: from the greatest eigenvalue of the kernel of the regression on (-inf, x], by 500 Gauss points
   (numpy), as by 300 to nine digits. */
static double regression_truth(double times, double exponent)
{
    (void)times;
    return exponent > 0.5 ? 4.105956482508463 : 4.611475569249452;
}

/* ---- trials ---- */

typedef struct coverage_case {
    const char *name;
    void (*draw)(trial *t, int32_t count);
    double (*truth)(double times, double exponent);
    int32_t count;
    bool maxima;
    extreme_method method;
    law_fit fit;
    double threshold; /* NaN: its default */
    int order;
    bool measured; /* with FRAM_TEST_LONG alone: what is known to fall short, and what only adds cases */
    double
        widest[LEVELS]; /* the mean width over the truth: a quarter above that of 12 and of 60 trials; 0: not known */
} coverage_case;

/* FRAM_TEST_LONG may be another number of trials. */
static int trials(void)
{
    const char *asked = getenv("FRAM_TEST_LONG");
    int number = asked ? atoi(asked) : 12;
    return number == 1 ? 1000 : number;
}

static bool answer(context *ctx, const coverage_case *c, const trial *t, extreme_result *out)
{
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = 3.0 * c->count;
    ask.levels = 1;
    ask.stability = false;
    ask.probability[0] = real_exp(-exponents[1]);
    ask.fit = c->fit;
    ask.threshold = c->threshold;
    ask.order = c->order;
    const series_part part = {t->value, t->count};
    const series_set set = {&part, 1, 1};
    fram_status status = c->maxima ? extremes_of_maxima(ctx, t->value, t->count, 1, c->method, &ask, out, NULL)
                                   : extremes_of_series(ctx, &set, c->method, &ask, out, NULL);
    return status == FRAM_OK && out->answered;
}

/* Percent of the trials whose interval holds the truth, of each level; the mean of level/truth, and of width/truth. */
static void cover(const coverage_case *c, double held[LEVELS], double bias[LEVELS], double width[LEVELS])
{
    context ctx;
    context_init(&ctx);
    trial *t = calloc(1, sizeof *t);
    extreme_result *r = calloc(1, sizeof *r);
    for (int l = 0; l < LEVELS; l++)
        held[l] = bias[l] = width[l] = 0;
    for (int k = 0; k < trials(); k++) {
        t->random = random_begin(11, 7, (uint32_t)k);
        c->draw(t, c->count);
        ck_assert(answer(&ctx, c, t, r));
        const level_interval *got[LEVELS] = {&r->most_probable, &r->level[0]};
        for (int l = 0; l < LEVELS; l++) {
            double truth = c->truth(3.0 * c->count, exponents[l]);
            held[l] += (got[l]->low <= truth && truth <= got[l]->high) * 100.0 / trials();
            bias[l] += got[l]->level / truth / trials();
            width[l] += (got[l]->high - got[l]->low) / truth / trials();
        }
    }
    printf("| %s | %s | %d | %.1f | %.1f | %.4f | %.4f | %.3f | %.3f |\n", c->name, extreme_method_name(c->method),
           (int)c->count, held[0], held[1], bias[0], bias[1], width[0], width[1]);
    fflush(stdout);
    free(t);
    free(r);
}

#define USUAL FIT_LIKELIHOOD, (double)NAN, 0
#define FIRST_ORDER FIT_LIKELIHOOD, (double)NAN, 1
#define BY_MOMENTS FIT_MOMENTS, (double)NAN, 0
static const coverage_case cases[] = {
    {"Gumbel maxima", draw_gumbel, gumbel_truth, 50, true, EXTREME_GUMBEL, USUAL, false, {0.32, 0.36}},
    {"Gumbel maxima", draw_gumbel, gumbel_truth, 100, true, EXTREME_GEV, USUAL, false, {0.65, 1.2}},
    {"Weibull parent", draw_weibull, weibull_truth, 5000, false, EXTREME_POT, USUAL, false, {0.6, 1.2}},
    {"Weibull parent", draw_weibull, weibull_truth, 5000, false, EXTREME_ACER, FIRST_ORDER, false, {0.37, 0.52}},
    {"AR(1)", draw_regression, regression_truth, 20000, false, EXTREME_ACER, USUAL, false, {0.27, 0.34}},
    {"AR(1)", draw_regression, regression_truth, 20000, false, EXTREME_UPCROSSING, USUAL, false, {0.28, 0.37}},
    {"AR(1)", draw_regression, regression_truth, 20000, false, EXTREME_POT, USUAL, false, {0.54, 1.05}},
    {"AR(1)", draw_regression, regression_truth, 20000, false, EXTREME_GEV, USUAL, false, {0.53, 1.06}},
    {"Rayleigh peaks", draw_rayleigh, rayleigh_truth, 2000, false, EXTREME_WEIBULL, USUAL, false, {0.155, 0.17}},
    {"Rayleigh peaks", draw_rayleigh, rayleigh_truth, 10000, false, EXTREME_UPCROSSING, USUAL, false, {0.23, 0.31}},
    {"Gumbel maxima", draw_gumbel, gumbel_truth, 20, true, EXTREME_GUMBEL, USUAL, true, {0}},
    {"Gumbel maxima", draw_gumbel, gumbel_truth, 10, true, EXTREME_GUMBEL, USUAL, true, {0}},
    {"Gumbel maxima", draw_gumbel, gumbel_truth, 20, true, EXTREME_GEV, USUAL, true, {0}},
    {"Gumbel maxima, L-moments", draw_gumbel, gumbel_truth, 50, true, EXTREME_GUMBEL, BY_MOMENTS, true, {0}},
    {"Weibull parent", draw_weibull, weibull_truth, 5000, false, EXTREME_GUMBEL, USUAL, true, {0}},
    {"Weibull parent", draw_weibull, weibull_truth, 5000, false, EXTREME_GEV, USUAL, true, {0}},
    {"AR(1)", draw_regression, regression_truth, 20000, false, EXTREME_GUMBEL, USUAL, false, {0.43, 0.74}},
    {"Rayleigh peaks", draw_rayleigh, rayleigh_truth, 10000, false, EXTREME_GUMBEL, USUAL, true, {0}},
    {"Rayleigh peaks", draw_rayleigh, rayleigh_truth, 10000, false, EXTREME_GEV, USUAL, true, {0}},
    {"Rayleigh peaks", draw_rayleigh, rayleigh_truth, 10000, false, EXTREME_POT, USUAL, true, {0}},
    {"Rayleigh peaks", draw_rayleigh, rayleigh_truth, 10000, false, EXTREME_ACER, USUAL, true, {0}},
};

START_TEST(intervals_hold_the_truth_as_often_as_they_say)
{
    puts("| sample | method | values | holds once, % | holds 0.9, % | level/truth once | 0.9 | "
         "width/truth once | 0.9 |");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double held[LEVELS], bias[LEVELS], width[LEVELS];
        /* One case alone, by its number from 1. */
        const char *only = getenv("FRAM_TEST_CASE");
        if ((only && atoi(only) != (int)i + 1) || (cases[i].measured && !getenv("FRAM_TEST_LONG")))
            continue;
        cover(&cases[i], held, bias, width);
        /* Of 12 trials fewer than 9 once in 450 times where 95 % hold.  Wider ones would hold it as well. */
        ck_assert_msg(cases[i].measured || (width[0] <= cases[i].widest[0] && width[1] <= cases[i].widest[1]),
                      "%s by %s: %g and %g of the truth wide", cases[i].name, extreme_method_name(cases[i].method),
                      width[0], width[1]);
        ck_assert_msg(cases[i].measured || (held[0] >= 75 && held[1] >= 75), "%s by %s: %g %% and %g %%", cases[i].name,
                      extreme_method_name(cases[i].method), held[0], held[1]);
    }
}
END_TEST

TEST_MAIN("extremes_coverage", intervals_hold_the_truth_as_often_as_they_say)
