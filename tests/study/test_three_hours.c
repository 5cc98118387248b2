/* A hundred runs of three hours, and what twenty runs of twenty minutes say of them.  The load is a stationary
   surrogate: lognormal, correlated over ten seconds, a value a second.  Truth are the 100 greatest values of the long
   runs: their quantile 1/e, which is the most probable maximum, and 0.9.  Four sets of twenty short runs; with
   FRAM_TEST_LONG 100 sets and a table (`make extremes-hours`, bench/results/extremes.md). */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/extremes.h"

#include <stdio.h>

enum { LONG_RUNS = 100, LONG = 10800, SHORT_RUNS = 20, SHORT = 1200, SETS = 4, SETS_LONG = 100, LEVELS = 2 };

static void draw(double *value, int32_t count, uint32_t stream, uint32_t run)
{
    random_stream r = random_begin(31, stream, run);
    double x = random_normal(&r), kept = real_exp(-0.1), new = sqrt(1 - kept * kept);
    for (int32_t i = 0; i < count; i++) {
        value[i] = 1e6 * real_exp(0.4 * x);
        x = kept * x + new *random_normal(&r);
    }
}

static double greatest_of(const double *value, int32_t count)
{
    double greatest = value[0];
    for (int32_t i = 1; i < count; i++)
        greatest = fmax(greatest, value[i]);
    return greatest;
}

/* Quantiles of the greatest values of the long runs. */
static void find_truth(double *room, double truth[LEVELS])
{
    double greatest[LONG_RUNS];
    double_array all = {.data = greatest, .count = LONG_RUNS};
    for (uint32_t i = 0; i < LONG_RUNS; i++) {
        draw(room, LONG, 1, i);
        greatest[i] = greatest_of(room, LONG);
    }
    values_sort(&all);
    truth[0] = sorted_quantile(greatest, LONG_RUNS, real_exp(-1));
    truth[1] = sorted_quantile(greatest, LONG_RUNS, 0.9);
}

/* What a set of short runs says: of their greatest values, or of their series. */
static void predict(context *ctx, double *room, uint32_t set, extreme_method method, extreme_result *out)
{
    double greatest[SHORT_RUNS];
    series_part part[SHORT_RUNS];
    extreme_request ask;
    fram_error error = {0};
    extreme_request_default(&ask);
    ask.levels = 1;
    ask.probability[0] = 0.9;
    ask.stability = false;
    for (uint32_t i = 0; i < SHORT_RUNS; i++) {
        double *value = room + i * SHORT;
        draw(value, SHORT, 2, set * SHORT_RUNS + i);
        part[i] = (series_part){value, SHORT};
        greatest[i] = greatest_of(value, SHORT);
    }
    const series_set series = {part, SHORT_RUNS, 1};
    bool maxima = method == EXTREME_GUMBEL || method == EXTREME_GEV;
    fram_status status = maxima ? extremes_of_maxima(ctx, greatest, SHORT_RUNS, SHORT, method, &ask, out, &error)
                                : extremes_of_series(ctx, &series, method, &ask, out, &error);
    assert_ok(status, error);
    ck_assert_msg(out->answered, "%s", out->note);
}

START_TEST(short_runs_tell_the_long_ones)
{
    static const extreme_method methods[] = {EXTREME_GUMBEL, EXTREME_GEV, EXTREME_ACER, EXTREME_POT};
    int sets = getenv("FRAM_TEST_LONG") ? SETS_LONG : SETS;
    double *room = calloc(SHORT_RUNS * SHORT, sizeof *room), truth[LEVELS];
    extreme_result *r = calloc(1, sizeof *r);
    context ctx;
    context_init(&ctx);
    find_truth(room, truth);
    printf("100 runs of 3 h: once %.3f MN, 0.9 %.3f MN\n", truth[0] * 1e-6, truth[1] * 1e-6);
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        double ratio[LEVELS] = {0}, width = 0;
        int held[LEVELS] = {0};
        for (int k = 0; k < sets; k++) {
            predict(&ctx, room, (uint32_t)k, methods[m], r);
            const level_interval *got[LEVELS] = {&r->most_probable, &r->level[0]};
            for (int l = 0; l < LEVELS; l++) {
                ratio[l] += got[l]->level / truth[l] / sets;
                held[l] += got[l]->low <= truth[l] && truth[l] <= got[l]->high;
            }
            width += (r->most_probable.high - r->most_probable.low) / truth[0] / sets;
        }
        printf("| %s | %d | %d | %d | %.3f | %.3f | %.0f %% |\n", extreme_method_name(methods[m]), sets, held[0],
               held[1], ratio[0], ratio[1], 100 * width);
        fflush(stdout);
        ck_assert_msg(held[0] >= sets * 3 / 4 && held[1] >= sets * 3 / 4, "%s: %d and %d of %d",
                      extreme_method_name(methods[m]), held[0], held[1], sets);
        ck_assert_msg(ratio[0] > 0.85 && ratio[0] < 1.2, "%s: %g", extreme_method_name(methods[m]), ratio[0]);
    }
    free(r);
    free(room);
}
END_TEST

TEST_MAIN("three_hours", short_runs_tell_the_long_ones)
