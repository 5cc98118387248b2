#include "study/study_extremes.h"

#include "base/near.h"
#include "base/random.h"
#include "base/transcendental.h"
#include "study/pivot.h"
#include "study/special.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Stream of random numbers of this file: draws of runs. */
enum { STREAM_RUNS = 921, STREAM_DRAWS = 922, ANNUAL_REPLICATES = 999 };
#define HOURS_OF_YEAR 8784.0
/* Part of a year that a sum of hours may be over it: rounding alone, of which the most conditions have less. */
#define HOURS_NEAR 1e-9

/* ---- reading ---- */

static fram_status read_method(const study_source *r, const yaml_node *k)
{
    const char *text = k->kind == YAML_SCALAR ? yaml_text(r->tree, k->value) : "";
    extreme_method m = extreme_method_find(text);
    if (m != EXTREME_GUMBEL && m != EXTREME_GEV)
        return study_refuse(r, k,
                            m < EXTREME_METHODS ? "expected gumbel or gev, of the largest values of runs; %s takes the "
                                                  "series: keep: series, and `fram extremes DIR/runs/ID/*/`"
                                                : "expected gumbel or gev, found %s",
                            m < EXTREME_METHODS ? text : study_found(r, k).text);
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
    }
    return FRAM_OK;
}

fram_status study_extremes_read(const study_source *r, const yaml_node *node)
{
    static const char *const names[] = {"duration", "method", "levels", "confidence", "hours", "annual"};
    study_extremes *x = &r->out->extremes;
    array_free(r->ctx, &x->hours);
    *x = (study_extremes){.asked = true,
                          .line = node->line,
                          .duration = 3 * EXTREME_HOUR,
                          .confidence = 0.95,
                          .level = {0.5, 0.9},
                          .levels = 2};
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
    return status;
}

static fram_status refuse_hours(const study *s, int line, const char *message, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, s->file, line, "hours", "%s", message);
}

/* Those of a table of conditions are taken where annual levels are asked for. */
static fram_status check_hours(context *ctx, study *s, fram_error *error)
{
    study_extremes *x = &s->extremes;
    int line = x->hours_line > 0 ? x->hours_line : x->line;
    double sum = 0;
    if (x->hours.count > 0 && s->table_hours.count > 0)
        return refuse_hours(s, line, "stand here and in a column of the table of conditions: remove one", error);
    for (int32_t c = 0; x->annuals > 0 && c < s->table_hours.count; c++)
        if (!array_push(ctx, &x->hours, s->table_hours.data[c]))
            return error_memory(error);
    if (x->annuals > 0 && x->hours.count == 0)
        return refuse_hours(s, line,
                            "annual levels take `hours`: how long a year each condition lasts, as a list or as "
                            "a column of the table of conditions",
                            error);
    if (x->annuals == 0 && x->hours.count > 0)
        return refuse_hours(s, line, "hours take `annual`: probabilities in a year, as [1e-2, 1e-4]", error);
    if (x->hours.count > 0 && x->hours.count != s->conditions)
        return error_set(error, FRAM_ERROR_INPUT, s->file, line, "hours",
                         "expected a number for each of the %d conditions, found %d", (int)s->conditions,
                         (int)x->hours.count);
    for (int32_t c = 0; c < x->hours.count; c++)
        sum += x->hours.data[c];
    if (x->hours.count > 0 && !(sum > 0 && sum <= HOURS_OF_YEAR * (1 + HOURS_NEAR)))
        return error_set(error, FRAM_ERROR_INPUT, s->file, line, "hours",
                         "expected hours that add up to more than 0 and at most %g, found %.10g", HOURS_OF_YEAR, sum);
    return FRAM_OK;
}

fram_status study_extremes_check(context *ctx, study *s, fram_error *error)
{
    if (s->seeds.extreme_within > 0 && !s->extremes.asked)
        return error_set(error, FRAM_ERROR_INPUT, s->file, s->seeds.extreme_line, "extreme_within",
                         "takes `extremes`, which tells of what: as extremes: {duration: 3h}");
    if (s->seeds.extreme_within > 0 && s->seeds.most < LAW_VALUES_LEAST)
        return error_set(error, FRAM_ERROR_INPUT, s->file, s->seeds.extreme_line, "extreme_within",
                         "expected most from %d on, since fewer runs carry no law, found %d", (int)LAW_VALUES_LEAST,
                         (int)s->seeds.most);
    if (s->extremes.asked && s->seeds.most < LAW_VALUES_LEAST)
        log_write(
            ctx, LOG_WARNING,
            "%s:%d: extremes: no condition will have an answer: a law takes %d runs, and of %d seeds come no more; "
            "take seeds: %d or more",
            s->file, s->extremes.line, (int)LAW_VALUES_LEAST, (int)s->seeds.most, (int)LAW_VALUES_LEAST);
    return check_hours(ctx, s, error);
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

/* What is known of a condition that occurs: its values, ascending, its law, and of Gumbel's law how the values speak of
   location and scale. */
typedef struct year_source {
    const double *value;
    int32_t count;
    bool occurs;
    extreme_law law;
    gumbel_pivot pivot;
} year_source;

typedef struct year_work {
    context *ctx;
    const study_extremes *ask;
    int32_t conditions;
    int32_t occur; /* conditions that do, and whose runs did not all come out the same */
    double least;  /* the largest value of those whose runs did, without any ice */
    year_part *part;
    year_source *source;
    double_array drawn, level[STUDY_LEVELS_MOST]; /* level: of all replicates */
    double_array student[STUDY_LEVELS_MOST];      /* of replicates from the fits: error over deviation */
} year_work;

/* Conditions of the very same values met the same ice: as independent samples they would make the interval depend on
   how the table divides hours into rows.  The first one before c that occurs, or -1. */
static int32_t find_same(const year_work *w, const condition_maxima *of, int32_t c)
{
    size_t size = (size_t)of[c].value.count * sizeof *of[c].value.data;
    for (int32_t k = 0; k < c; k++)
        if (w->source[k].occurs && of[k].block == of[c].block && of[k].value.count == of[c].value.count &&
            memcmp(of[k].value.data, of[c].value.data, size) == 0)
            return k;
    return -1;
}

/* The fits.  The first condition that occurs and has none, or -1. */
static int32_t fit_year(year_work *w, const condition_maxima *of)
{
    for (int32_t c = 0; c < w->conditions; c++) {
        int32_t n = of[c].value.count;
        year_source *s = &w->source[c];
        *s = (year_source){.value = of[c].value.data, .count = n};
        w->part[c].blocks = w->ask->hours.data[c] * EXTREME_HOUR / of[c].block;
        if (!(w->part[c].blocks > 0))
            continue;
        if (n < LAW_VALUES_LEAST)
            return c;
        values_sort(&(double_array){.data = of[c].value.data, .count = n});
        int32_t same = find_same(w, of, c);
        if (same >= 0) {
            w->part[same].blocks += w->part[c].blocks;
            w->part[c].blocks = 0;
            continue;
        }
        /* Where no ice is met, as in open water, nothing is left to chance: that is reached and never exceeded.  Runs
           that meet ice and come out the same were of one draw of it. */
        if (of[c].idle && s->value[0] == s->value[n - 1]) {
            w->part[c].blocks = 0;
            w->least = fmax(w->least, s->value[0]);
        } else if ((w->ask->gev && extreme_law_tied(s->value, n, PROFILE_SHAPE_MOST) > 0) ||
                   !extreme_law_fit(w->ask->gev ? LAW_GEV : LAW_GUMBEL, FIT_LIKELIHOOD, s->value, n, 0,
                                    &w->part[c].law)) {
            return c;
        }
        s->occurs = w->part[c].blocks > 0;
        w->occur += s->occurs;
        s->law = w->part[c].law;
        if (s->occurs && !w->ask->gev)
            gumbel_pivot_make(s->value, n, &w->part[c].law, &s->pivot);
    }
    return -1;
}

/* The law of runs drawn from those of a condition. */
static fram_status redraw(year_work *w, const year_source *s, random_stream *random, extreme_law *law, bool *good)
{
    if (!array_resize(w->ctx, &w->drawn, s->count))
        return FRAM_ERROR_MEMORY;
    for (int32_t i = 0; i < s->count; i++)
        w->drawn.data[i] = s->value[(int32_t)(random_unit(random) * s->count)];
    values_sort(&w->drawn);
    *good = extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, w->drawn.data, s->count, 0, law);
    return FRAM_OK;
}

/* Levels of one replicate: laws that the values of each condition may be of, taken together. */
static fram_status replicate_year(year_work *w, int32_t replicate, const double *exponent)
{
    for (int32_t c = 0; c < w->conditions; c++) {
        random_stream random = random_begin((uint64_t)c, STREAM_RUNS, (uint32_t)replicate);
        bool good = true;
        fram_status status = FRAM_OK;
        if (w->source[c].occurs && w->ask->gev)
            status = redraw(w, &w->source[c], &random, &w->part[c].law, &good);
        else if (w->source[c].occurs)
            gumbel_pivot_draw(&w->source[c].pivot, &random, &w->part[c].law);
        if (status != FRAM_OK || !good)
            return status;
    }
    for (int i = 0; i < w->ask->annuals; i++)
        if (!array_push(w->ctx, &w->level[i], solve_year(w->part, w->conditions, exponent[i])))
            return FRAM_ERROR_MEMORY;
    return FRAM_OK;
}

/* Deviation of the level x of a year that the samples of all conditions give it: that of each one's own level at x, of
   Gumbel's law (the inverse of its information, Johnson, Kotz and Balakrishnan 1995, 22.9), by its part in how the rate
   falls there. */
static double deviation_at(const year_work *w, double x)
{
    double variance = 0, fall = 0;
    for (int32_t c = 0; c < w->conditions; c++) {
        if (!w->source[c].occurs)
            continue;
        const extreme_law *law = &w->part[c].law;
        double y = (x - law->location) / law->scale;
        double part = w->part[c].blocks * extreme_law_exponent(law, x) / law->scale, g = 1 - EULER_GAMMA + y;
        variance += part * part * law->scale * law->scale * (1 + 6 / (PI * PI) * g * g) / w->source[c].count;
        fall += part;
    }
    return sqrt(variance) / fall;
}

/* Error over deviation of the level of one replicate, whose samples are of the fitted laws. */
static fram_status replicate_student(year_work *w, int32_t replicate, const double *exponent, const level_interval *of)
{
    for (int32_t c = 0; c < w->conditions; c++) {
        const year_source *s = &w->source[c];
        if (!s->occurs)
            continue;
        random_stream random = random_begin((uint64_t)c, STREAM_DRAWS, (uint32_t)replicate);
        if (!array_resize(w->ctx, &w->drawn, s->count))
            return FRAM_ERROR_MEMORY;
        for (int32_t i = 0; i < s->count; i++)
            w->drawn.data[i] = s->law.location - s->law.scale * near_log(-near_log(1 - random_unit(&random)));
        values_sort(&w->drawn);
        if (!extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, w->drawn.data, s->count, 0, &w->part[c].law))
            return FRAM_OK;
    }
    for (int i = 0; i < w->ask->annuals; i++) {
        double x = solve_year(w->part, w->conditions, exponent[i]);
        if (!array_push(w->ctx, &w->student[i], (x - of[i].level) / deviation_at(w, x)))
            return FRAM_ERROR_MEMORY;
    }
    return FRAM_OK;
}

/* By gev the shape alone, whose deviation is sqrt(0.4767/n) near 0 (Prescott and Walden 1980), moves a level y scales
   of logarithm beyond the location by y^2/2 times that.  Two such deviations must not be more than the way from the
   location to the level: n from 0.4767 y^2 on.  Judged by the question and the number of runs alone: of samples that
   have too few, those with a narrow interval are the ones whose fitted tail ends too early. */
#define SHAPE_VARIANCE 0.4767

static annual_lack lack_of_shape(const year_work *w, double exponent)
{
    annual_lack out = {.condition = -1, .carrier = -1};
    for (int32_t c = 0; c < w->conditions; c++) {
        if (!w->source[c].occurs || !w->ask->gev)
            continue;
        double y = real_log(fmax(w->part[c].blocks / exponent, 1)), runs = ceil(SHAPE_VARIANCE * y * y);
        if (w->source[c].count < runs && runs > out.runs)
            out = (annual_lack){.condition = c, .carrier = -1, .runs = (int32_t)runs, .there = w->source[c].count};
    }
    return out;
}

/* Of a condition without a fit; its values are in order where there are enough of them. */
static annual_lack lack_of_fit(const year_work *w, const condition_maxima *of, int32_t condition)
{
    const double_array *value = &of[condition].value;
    annual_lack out = {.condition = condition, .carrier = -1, .there = value->count};
    if (value->count < LAW_VALUES_LEAST)
        return out;
    out.same = value->data[0] == value->data[value->count - 1];
    if (!out.same)
        out.tied = extreme_law_tied(value->data, value->count, w->ask->gev ? PROFILE_SHAPE_MOST : FIT_SHAPE_MOST);
    return out;
}

static void take_quantiles(const year_work *w, double_array *value, double *low, double *high)
{
    *low = *high = (double)NAN;
    if (value->count <= ANNUAL_REPLICATES / 2)
        return;
    values_sort(value);
    *low = sorted_quantile(value->data, value->count, 0.5 - 0.5 * w->ask->confidence);
    *high = sorted_quantile(value->data, value->count, 0.5 + 0.5 * w->ask->confidence);
}

/* What both ways of asking the samples allow (docs/decisions/0411-levels-of-a-year.md).  part: the fits. */
static void widen_by_student(year_work *w, int level, level_interval *out)
{
    double low, high;
    take_quantiles(w, &w->student[level], &low, &high);
    double deviation = deviation_at(w, out->level);
    out->low = fmin(out->low, out->level - high * deviation);
    out->high = fmax(out->high, out->level - low * deviation);
}

static fram_status answer_many(year_work *w, const double *exponent, level_interval *out)
{
    fram_status status = FRAM_OK;
    for (int32_t i = 0; status == FRAM_OK && i < ANNUAL_REPLICATES; i++)
        status = replicate_year(w, i, exponent);
    for (int32_t i = 0; status == FRAM_OK && !w->ask->gev && i < ANNUAL_REPLICATES; i++)
        status = replicate_student(w, i, exponent, out);
    for (int32_t c = 0; c < w->conditions; c++)
        w->part[c].law = w->source[c].law;
    for (int i = 0; i < w->ask->annuals && status == FRAM_OK; i++) {
        take_quantiles(w, &w->level[i], &out[i].low, &out[i].high);
        if (!w->ask->gev)
            widen_by_student(w, i, &out[i]);
    }
    return status;
}

/* What is not known stays so. */
static level_interval at_least(const level_interval *i, double least)
{
    return (level_interval){i->level < least ? least : i->level, i->low < least ? least : i->low,
                            i->high < least ? least : i->high};
}

/* The condition that most exceedances of a level are of. */
static void find_carrier(const year_work *w, const condition_maxima *of, double level, double exponent,
                         annual_lack *out)
{
    double most = 0, all = 0;
    for (int32_t c = 0; c < w->conditions; c++) {
        double own = w->source[c].occurs ? w->part[c].blocks * extreme_law_exponent(&w->part[c].law, level) : 0;
        all += own;
        if (!(own > most))
            continue;
        most = own;
        out->carrier = c;
        out->law = w->part[c].law;
        out->duration = w->part[c].blocks * of[c].block / exponent;
    }
    out->share = all > 0 ? most / all : 0;
}

static fram_status answer_year(year_work *w, const condition_maxima *of, level_interval *out, annual_lack *lack)
{
    const level_interval none = {(double)NAN, (double)NAN, (double)NAN};
    double exponent[STUDY_LEVELS_MOST] = {0};
    int32_t missing = fit_year(w, of), only = 0;
    for (int i = 0; i < w->ask->annuals; i++) {
        exponent[i] = -real_log(1 - w->ask->annual[i]);
        lack[i] = missing >= 0 ? lack_of_fit(w, of, missing) : lack_of_shape(w, exponent[i]);
        if (missing >= 0 || w->occur == 0)
            continue;
        out[i].level = solve_year(w->part, w->conditions, exponent[i]);
        find_carrier(w, of, out[i].level, exponent[i], &lack[i]);
    }
    if (missing >= 0 || w->occur == 0)
        return FRAM_OK;
    while (only < w->conditions && !w->source[only].occurs)
        only++;
    /* Of one condition the interval is exact. */
    for (int i = 0; i < w->ask->annuals && w->occur == 1 && !w->ask->gev; i++)
        out[i] = gumbel_pivot_interval(&w->source[only].pivot, exponent[i] / w->part[only].blocks, w->ask->confidence);
    bool any = false;
    for (int i = 0; i < w->ask->annuals; i++)
        any = any || lack[i].condition < 0;
    bool many = w->occur > 1 || (w->occur == 1 && w->ask->gev);
    fram_status status = any && many ? answer_many(w, exponent, out) : FRAM_OK;
    for (int i = 0; i < w->ask->annuals; i++)
        out[i] = lack[i].condition >= 0 ? none : at_least(&out[i], w->least);
    return status;
}

fram_status annual_levels(context *ctx, const study_extremes *ask, const condition_maxima *of, int32_t conditions,
                          level_interval *out, annual_lack *lack, fram_error *error)
{
    year_work w = {.ctx = ctx, .ask = ask, .conditions = conditions, .least = -(double)INFINITY};
    for (int i = 0; i < ask->annuals; i++) {
        out[i] = (level_interval){(double)NAN, (double)NAN, (double)NAN};
        lack[i] = (annual_lack){.condition = -1, .carrier = -1};
    }
    if (ask->annuals == 0)
        return FRAM_OK;
    w.part = memory_array(ctx, (size_t)conditions, sizeof *w.part);
    w.source = memory_array(ctx, (size_t)conditions, sizeof *w.source);
    fram_status status = w.part && w.source ? answer_year(&w, of, out, lack) : FRAM_ERROR_MEMORY;
    for (int i = 0; i < STUDY_LEVELS_MOST; i++) {
        array_free(ctx, &w.level[i]);
        array_free(ctx, &w.student[i]);
    }
    array_free(ctx, &w.drawn);
    memory_free(ctx, w.part);
    memory_free(ctx, w.source);
    return status == FRAM_OK ? FRAM_OK : error_memory(error);
}
