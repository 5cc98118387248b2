#include "study/study_extremes.h"

#include "base/random.h"
#include "base/transcendental.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Stream of random numbers of this file: draws of runs. */
enum { STREAM_RUNS = 921 };
#define HOUR 3600.0
#define HOURS_OF_YEAR 8784.0

/* ---- reading ---- */

static fram_status read_method(const study_source *r, const yaml_node *k)
{
    const char *text = k->kind == YAML_SCALAR ? yaml_text(r->tree, k->value) : "";
    extreme_method m = extreme_method_find(text);
    if (m != EXTREME_GUMBEL && m != EXTREME_GEV)
        return study_refuse(r, k,
                            m < EXTREME_METHODS ? "expected gumbel or gev, of the largest values of runs; %s takes the "
                                                  "series: keep: series, and `fram extremes DIR/runs/ID/*`"
                                                : "expected gumbel or gev, found %s",
                            *text ? text : "none");
    r->out->extremes.gev = m == EXTREME_GEV;
    return FRAM_OK;
}

static fram_status read_numbers(const study_source *r, const yaml_node *k, double lo, double hi, double *out, int room,
                                int *count)
{
    if (k->kind != YAML_SEQUENCE || k->count == 0 || k->count > room)
        return study_refuse(r, k, "expected a list of 1 to %d numbers", room);
    fram_status status = FRAM_OK;
    *count = 0;
    for (const yaml_node *e = study_child(r, k); e && status == FRAM_OK; e = study_next(r, e))
        status = study_number(r, e, lo, hi, &out[(*count)++]);
    return status;
}

static fram_status read_hours(const study_source *r, const yaml_node *k)
{
    double sum = 0;
    if (k->kind != YAML_SEQUENCE || k->count == 0)
        return study_refuse(r, k, "expected a list: the hours a year that each condition lasts");
    r->out->extremes.hours_line = k->line;
    for (const yaml_node *e = study_child(r, k); e; e = study_next(r, e)) {
        double hours = 0;
        fram_status status = study_number(r, e, 0, HOURS_OF_YEAR, &hours);
        if (status != FRAM_OK)
            return status;
        if (!array_push(r->ctx, &r->out->extremes.hours, hours))
            return error_memory(r->error);
        sum += hours;
    }
    if (!(sum > 0 && sum <= HOURS_OF_YEAR))
        return study_refuse(r, k, "expected hours that add up to more than 0 and at most %g, found %g", HOURS_OF_YEAR,
                            sum);
    return FRAM_OK;
}

fram_status study_extremes_read(const study_source *r, const yaml_node *node)
{
    static const char *const names[] = {"duration", "method", "levels", "confidence", "hours", "annual"};
    study_extremes *x = &r->out->extremes;
    array_free(r->ctx, &x->hours);
    *x = (study_extremes){.asked = true, .duration = 3 * HOUR, .confidence = 0.95, .level = {0.5, 0.9}, .levels = 2};
    if (node->kind != YAML_MAPPING)
        return study_refuse(r, node, "expected duration, method, levels, confidence, hours or annual");
    fram_status status = FRAM_OK;
    for (const yaml_node *k = study_child(r, node); k && status == FRAM_OK; k = study_next(r, k)) {
        const char *name = study_key(r, k);
        if (strcmp(name, "duration") == 0)
            status = study_time(r, k, 1, 1e10, &x->duration);
        else if (strcmp(name, "method") == 0)
            status = read_method(r, k);
        else if (strcmp(name, "levels") == 0)
            status = read_numbers(r, k, 1e-6, 1 - 1e-9, x->level, STUDY_LEVELS_MOST, &x->levels);
        else if (strcmp(name, "confidence") == 0)
            status = study_number(r, k, 0.01, 0.9999, &x->confidence);
        else if (strcmp(name, "hours") == 0)
            status = read_hours(r, k);
        else if (strcmp(name, "annual") == 0)
            status = read_numbers(r, k, 1e-9, 0.999, x->annual, STUDY_LEVELS_MOST, &x->annuals);
        else
            status = study_unknown(r, k, names, sizeof names / sizeof *names);
    }
    if (status == FRAM_OK && (x->annuals > 0) != (x->hours.count > 0))
        return study_refuse(r, node,
                            x->annuals > 0 ? "annual levels take `hours`: how long a year each condition lasts"
                                           : "hours take `annual`: probabilities in a year, as [1e-2, 1e-4]");
    return status;
}

fram_status study_extremes_check(const study *s, fram_error *error)
{
    if (s->extremes.hours.count == 0 || s->extremes.hours.count == s->conditions)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, s->file, s->extremes.hours_line, "hours",
                     "expected a number for each of the %d conditions, found %d", (int)s->conditions,
                     (int)s->extremes.hours.count);
}

/* ---- levels of a year ---- */

typedef struct year_part {
    extreme_law law;
    double blocks; /* in a year */
} year_part;

/* Expected exceedances of x in a year. */
static double exceedances(const year_part *part, int32_t count, double x)
{
    double sum = 0;
    for (int32_t i = 0; i < count; i++)
        sum += part[i].blocks > 0 ? part[i].blocks * extreme_law_exponent(&part[i].law, x) : 0;
    return sum;
}

static double solve_year(const year_part *part, int32_t count, double exponent)
{
    double lo = (double)INFINITY, hi = -(double)INFINITY;
    /* Each condition alone is exceeded less often than all of them: the highest of their levels is below the answer. */
    for (int32_t i = 0; i < count; i++) {
        if (!(part[i].blocks > 0))
            continue;
        double own = extreme_law_level(&part[i].law, exponent / part[i].blocks);
        hi = fmax(hi, own);
        lo = hi;
    }
    if (!isfinite(hi))
        return 0;
    double step = fmax(fabs(hi) * 1e-3, 1e-9);
    for (int i = 0; i < 200 && exceedances(part, count, hi) > exponent; i++, step *= 2)
        hi += step;
    for (double mid = 0.5 * (lo + hi); mid > lo && mid < hi; mid = 0.5 * (lo + hi)) {
        if (exceedances(part, count, mid) > exponent)
            lo = mid;
        else
            hi = mid;
    }
    return hi;
}

/* Laws of the conditions, of draws of their runs with replicate >= 0.  The first that has none, or -1; -2: no memory.
 */
static int32_t fit_year(context *ctx, const study_extremes *ask, const condition_maxima *of, int32_t conditions,
                        int32_t replicate, year_part *part)
{
    law_kind kind = ask->gev ? LAW_GEV : LAW_GUMBEL;
    double_array drawn = {0};
    int32_t missing = -1;
    for (int32_t c = 0; c < conditions && missing == -1; c++) {
        part[c].blocks = ask->hours.data[c] * HOUR / of[c].block;
        if (!(part[c].blocks > 0))
            continue;
        int32_t n = of[c].value.count;
        random_stream random = random_begin((uint64_t)c, STREAM_RUNS, (uint32_t)replicate);
        if (n < LAW_VALUES_LEAST || !array_resize(ctx, &drawn, n)) {
            missing = n < LAW_VALUES_LEAST ? c : -2;
            break;
        }
        for (int32_t i = 0; i < n; i++)
            drawn.data[i] = of[c].value.data[replicate < 0 ? i : (int32_t)(random_unit(&random) * n)];
        values_sort(&drawn);
        /* Runs without any load: nothing to exceed. */
        if (drawn.data[0] == 0 && drawn.data[n - 1] == 0)
            part[c].blocks = 0;
        else if (!extreme_law_fit(kind, FIT_LIKELIHOOD, drawn.data, n, 0, &part[c].law))
            missing = c;
    }
    array_free(ctx, &drawn);
    return missing;
}

fram_status annual_level(context *ctx, const study_extremes *ask, const condition_maxima *of, int32_t conditions,
                         double probability, level_interval *out, int32_t *missing, fram_error *error)
{
    double exponent = -real_log(1 - probability);
    double_array level = {0};
    year_part *part = memory_array(ctx, (size_t)conditions, sizeof *part);
    *out = (level_interval){(double)NAN, (double)NAN, (double)NAN};
    *missing = part ? fit_year(ctx, ask, of, conditions, -1, part) : -2;
    if (*missing == -1)
        out->level = solve_year(part, conditions, exponent);
    for (int32_t i = 0; *missing == -1 && i < BOOTSTRAP_REPLICATES; i++) {
        int32_t failed = fit_year(ctx, ask, of, conditions, i, part);
        if (failed == -2 || (failed == -1 && !array_push(ctx, &level, solve_year(part, conditions, exponent))))
            *missing = -2;
    }
    if (*missing == -1 && level.count > BOOTSTRAP_REPLICATES / 2) {
        values_sort(&level);
        out->low = sorted_quantile(level.data, level.count, 0.5 - 0.5 * ask->confidence);
        out->high = sorted_quantile(level.data, level.count, 0.5 + 0.5 * ask->confidence);
    }
    array_free(ctx, &level);
    memory_free(ctx, part);
    return *missing == -2 ? error_memory(error) : FRAM_OK;
}
