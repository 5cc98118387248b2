#include "study/extremes.h"

#include "base/channel_statistics.h"
#include "base/random.h"
#include "base/transcendental.h"
#include "study/averaged.h"
#include "study/extremes_notes.h"
#include "study/extremes_spread.h"
#include "study/pivot.h"

#include <math.h>
#include <string.h>

/* Stream of random numbers of this file: draws of a sample from itself. */
enum { STREAM_SAMPLES = 905 };
/* Defaults: blocks of the data; time scales of a block, between clusters and of a batch. */
enum { BLOCKS = 50, SCALES_OF_BLOCK = 20, SCALES_APART = 4, SCALES_OF_BATCH = 20, BATCHES = 200 };
/* Thresholds of peaks that are tried, and the part of clusters that may merge with the one before by chance: separation
   over the mean distance of clusters.  Greatest values of merged clusters follow no Pareto law at the threshold. */
static const double peaks_quantile[] = {0.95, 0.97, 0.98, 0.99, 0.995, 0.998};
enum { PEAKS_QUANTILES = sizeof peaks_quantile / sizeof *peaks_quantile };
#define MERGED_MOST 0.1
#define TAIL_QUANTILE 0.90

static const char *const names[EXTREME_METHODS] = {"acer", "upcrossing", "gumbel", "gev", "pot", "weibull"};

const char *extreme_method_name(extreme_method m) { return names[m]; }

extreme_method extreme_method_find(const char *name)
{
    int m = 0;
    while (m < EXTREME_METHODS && strcmp(names[m], name) != 0)
        m++;
    return (extreme_method)m;
}

void extreme_request_default(extreme_request *r)
{
    *r = (extreme_request){
        .duration = 10800, .confidence = 0.95, .threshold = (double)NAN, .levels = 3, .stability = true};
    const double usual[3] = {0.5, 0.9, 0.99};
    memcpy(r->probability, usual, sizeof usual);
}

/* ---- one sample, one law ---- */

/* A sample of maxima or peaks, ascending, and what it stands for. */
typedef struct extreme_sample {
    law_kind kind;
    double_array value;
    double location;                    /* threshold of peaks */
    double exposure;                    /* blocks in the duration; of peaks: the duration over the time of the sample */
    const weibull_jackknife *jackknife; /* of Weibull's law */
    const series_set *series;           /* that the values are of; NULL: the values are all there is */
    double survival;                    /* the part of the series over the law's location; 0: not known */
    extreme_law any;                    /* the generalized law of a series' maxima; scale 0: none */
    double weight;                      /* of Gumbel's law beside it */
    extreme_law values;                 /* of peaks of a series: of all values over the location; scale 0: none */
} extreme_sample;

static double law_level(const extreme_law *law, const extreme_sample *s, double exponent)
{
    if (law->kind == LAW_GUMBEL || law->kind == LAW_GEV)
        return extreme_law_level(law, exponent / s->exposure);
    return extreme_law_level(law, real_log(fmax(s->exposure * s->value.count / exponent, 1)));
}

/* Percentiles of the level over samples drawn from the sample. */
static fram_status bootstrap(context *ctx, const extreme_sample *s, const extreme_request *ask, double exponent,
                             const extreme_law *law, level_interval *out, fram_error *error)
{
    double_array drawn = {0}, level = {0};
    fram_status status = array_resize(ctx, &drawn, s->value.count) ? FRAM_OK : error_memory(error);
    for (uint32_t i = 0; status == FRAM_OK && i < BOOTSTRAP_REPLICATES; i++) {
        random_stream random = random_begin(1, STREAM_SAMPLES, i);
        for (int32_t k = 0; k < drawn.count; k++)
            drawn.data[k] = s->value.data[(int32_t)(random_unit(&random) * s->value.count)];
        values_sort(&drawn);
        extreme_law again;
        if (extreme_law_fit(s->kind, ask->fit, drawn.data, drawn.count, s->location, &again) &&
            !array_push(ctx, &level, law_level(&again, s, exponent)))
            status = error_memory(error);
        else
            status = work_continue(ctx, "drawing bootstrap samples", i + 1, BOOTSTRAP_REPLICATES, error);
    }
    *out = (level_interval){law_level(law, s, exponent), (double)NAN, (double)NAN};
    if (status == FRAM_OK && level.count > BOOTSTRAP_REPLICATES / 2) {
        values_sort(&level);
        out->low = sorted_quantile(level.data, level.count, 0.5 - 0.5 * ask->confidence);
        out->high = sorted_quantile(level.data, level.count, 0.5 + 0.5 * ask->confidence);
    }
    array_free(ctx, &drawn);
    array_free(ctx, &level);
    return status;
}

/* The ends towards which the limit of the tail may lie are moved by what the fit leaves out.  The theory of that limit
   is one of the law of the values, to which that of cluster maxima tends (Leadbetter 1991); under the limit they have
   another one, since more values find together in a cluster over a low threshold than over a high one (Eastoe and Tawn
   2012).  What either tail tells is allowed. */
static void add_penultimate(const extreme_sample *s, const extreme_law *law, double exponent, level_interval *i)
{
    if (!(s->survival > 0))
        return;
    /* The logarithm of how much rarer the level is than the location: of peaks that is every one's threshold, of
       maxima the level that a block reaches once on the average. */
    double times = s->kind == LAW_GEV ? s->exposure : s->exposure * s->value.count;
    double shift = penultimate_shift(law, s->survival, real_log(fmax(times / exponent, 1)));
    double other = shift;
    if (s->values.scale > 0)
        other = penultimate_level(&s->values, s->survival, real_log(fmax(times / exponent, 1))) - i->level;
    /* Of heavy tails the shift may be more than the way: what is under the location the fit knows nothing of. */
    i->low = fmax(i->low + fmin(fmin(shift, other), 0), fmin(i->low, law->location));
    i->high += fmax(fmax(shift, other), 0);
}

static fram_status sample_level(context *ctx, const extreme_sample *s, const extreme_request *ask,
                                const extreme_law *law, const gumbel_pivot *pivot, double probability,
                                level_interval *out, fram_error *error)
{
    double exponent = -real_log(probability);
    profile_question q = {.law = law,
                          .sorted = s->value.data,
                          .count = s->value.count,
                          .exposure = s->exposure,
                          .exponent = exponent,
                          .confidence = ask->confidence,
                          .ctx = ctx};
    if (s->jackknife)
        q.bound = jackknife_bound(s->jackknife, law, s->value.count, exponent, ask->confidence);
    if (pivot) {
        *out = gumbel_pivot_interval(pivot, exponent / s->exposure, ask->confidence);
        q.law = &s->any;
        if (s->any.scale > 0)
            *out = averaged_interval(pivot, *out, &q, s->weight);
    } else if (ask->fit == FIT_MOMENTS && s->kind != LAW_WEIBULL)
        return bootstrap(ctx, s, ask, exponent, law, out, error);
    else
        *out = profile_interval(&q);
    add_penultimate(s, law, exponent, out);
    return work_continue(ctx, "finding intervals", 1, 1, error);
}

static fram_status sample_levels(context *ctx, const extreme_sample *s, const extreme_request *ask, extreme_result *out,
                                 fram_error *error)
{
    gumbel_pivot pivot, *exact = s->kind == LAW_GUMBEL ? &pivot : NULL;
    if (exact)
        gumbel_pivot_make(s->value.data, s->value.count, &out->law, exact);
    fram_status status = sample_level(ctx, s, ask, &out->law, exact, real_exp(-1), &out->most_probable, error);
    for (int i = 0; status == FRAM_OK && i < ask->levels; i++)
        status = sample_level(ctx, s, ask, &out->law, exact, ask->probability[i], &out->level[i], error);
    out->interval = s->any.scale > 0 ? "averaged over Gumbel's and the generalized law by their weights"
                    : exact          ? "exact, conditional on the sample"
                    : ask->fit == FIT_MOMENTS && s->kind != LAW_WEIBULL ? "bootstrap of the sample, percentiles"
                    : s->jackknife    ? "profile likelihood, scaled by a jackknife over groups"
                    : s->survival > 0 ? "profile likelihood, widened by the slow limit of the tail"
                                      : "profile likelihood";
    return status;
}

/* The sample at its plotting positions: of n ascending values the i-th, from 1, has i/(n + 1) of all below it (Gumbel
   1958).  The greatest half of the room is for the greatest values, the rest are thinned. */
static void keep_points(const extreme_sample *s, const extreme_request *ask, extreme_result *out)
{
    int32_t n = s->value.count, most = EXTREME_POINTS_MOST, top = most / 2;
    double unit = ask->duration / s->exposure; /* a block, or all the time of the peaks */
    bool maxima = s->kind == LAW_GUMBEL || s->kind == LAW_GEV;
    out->points = n < most ? n : most;
    for (int32_t k = 0; k < out->points; k++) {
        int32_t i = n <= most ? k : k >= top ? n - most + k : (int32_t)((int64_t)k * (n - top) / top);
        double below = (i + 1) / (n + 1.0);
        out->point[k].level = s->value.data[i];
        out->point[k].period = maxima ? unit / -real_log(below) : unit / (n * (1 - below));
    }
}

double extreme_level_of_period(const extreme_result *r, double period)
{
    if (r->method == EXTREME_ACER || r->method == EXTREME_UPCROSSING)
        return acer_level(&r->tail, r->step, period, 1);
    if (r->law.kind == LAW_GUMBEL || r->law.kind == LAW_GEV)
        return extreme_law_level(&r->law, r->block / period);
    return extreme_law_level(&r->law, real_log(fmax(period * r->sample / r->time, 1)));
}

/* The part of all values over a level. */
static double survival_of(const series_set *s, double level)
{
    int64_t all = 0;
    for (int32_t p = 0; p < s->count; p++)
        all += s->parts[p].count;
    return (double)series_values_over(s, level) / (double)all;
}

/* The law of all values over the location, for the limit of the tail. */
static bool fit_values(context *ctx, extreme_sample *s)
{
    double_array over = {0};
    bool good = true;
    for (int32_t p = 0; p < s->series->count && good; p++)
        for (int32_t i = 0; i < s->series->parts[p].count && good; i++)
            if (s->series->parts[p].value[i] > s->location)
                good = array_push(ctx, &over, s->series->parts[p].value[i]);
    values_sort(&over);
    if (good && !extreme_law_fit(LAW_PARETO, FIT_LIKELIHOOD, over.data, over.count, s->location, &s->values))
        s->values.scale = 0;
    array_free(ctx, &over);
    return good;
}

/* How long blocks of a series must be for Gumbel's law nobody knows: what their maxima say beyond it counts too.  The
   weight is one of fits by likelihood, however the level is fitted. */
static void weigh_laws(extreme_sample *s)
{
    extreme_law gumbel;
    if (extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, s->value.data, s->value.count, 0, &gumbel) &&
        extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, s->value.data, s->value.count, 0, &s->any))
        s->weight = averaged_weight(&gumbel, &s->any, s->value.data, s->value.count);
    else
        s->any.scale = 0;
}

/* Fit and levels of a sorted sample. */
static fram_status answer_sample(context *ctx, extreme_sample *s, const extreme_request *ask, extreme_result *out,
                                 fram_error *error)
{
    bool peaks = s->kind == LAW_PARETO || s->kind == LAW_WEIBULL;
    out->sample = s->value.count;
    if (s->value.count < LAW_VALUES_LEAST)
        return extremes_refuse_few(out);
    /* Where the profile of the generalized law breaks its interval, and that of the averaged one, would be none. */
    bool tied = !peaks && extreme_law_tied(s->value.data, s->value.count, PROFILE_SHAPE_MOST) > 0;
    if ((s->kind == LAW_GEV && tied) ||
        !extreme_law_fit(s->kind, ask->fit, s->value.data, s->value.count, s->location, &out->law))
        return extremes_refuse_sample(out, s->value.data, s->value.count,
                                      peaks                ? 0
                                      : s->kind == LAW_GEV ? PROFILE_SHAPE_MOST
                                                           : FIT_SHAPE_MOST);
    if (peaks && !(s->exposure * s->value.count > 1))
        return extremes_refuse(out, "fewer than one peak is expected in the duration: ask for a longer one");
    if (s->series && (s->kind == LAW_PARETO || s->kind == LAW_GEV))
        s->survival = survival_of(s->series, out->law.location);
    if (s->series && s->kind == LAW_PARETO && !fit_values(ctx, s))
        return error_memory(error);
    if (s->series && s->kind == LAW_GUMBEL && !tied)
        weigh_laws(s);
    keep_points(s, ask, out);
    fram_status status = sample_levels(ctx, s, ask, out, error);
    if (s->kind == LAW_GUMBEL)
        extremes_doubt_gumbel(out, s->value.data, s->value.count);
    if (s->kind == LAW_WEIBULL)
        extremes_doubt_largest(out, s->value.data, s->value.count);
    out->answered = status == FRAM_OK;
    if (out->answered && peaks)
        extremes_cut_low(out, ask->levels, s->location);
    return status;
}

fram_status extremes_of_maxima(context *ctx, const double *maxima, int32_t count, double block, extreme_method method,
                               const extreme_request *ask, extreme_result *out, fram_error *error)
{
    extreme_sample s = {.kind = method == EXTREME_GEV ? LAW_GEV : LAW_GUMBEL, .exposure = ask->duration / block};
    extremes_begin(out, method, ask);
    out->block = out->step = block;
    out->time = block * count;
    if (method != EXTREME_GEV && method != EXTREME_GUMBEL)
        return extremes_refuse(out, "maxima are answered by gumbel and gev alone: this method takes the series");
    if (!array_resize(ctx, &s.value, count))
        return error_memory(error);
    if (count > 0)
        memcpy(s.value.data, maxima, (size_t)count * sizeof *maxima);
    values_sort(&s.value);
    fram_status status = answer_sample(ctx, &s, ask, out, error);
    if (status == FRAM_OK && out->answered)
        extremes_doubt(out, ask, out->time);
    array_free(ctx, &s.value);
    return status;
}

/* ---- methods of series ---- */

typedef struct series_work {
    context *ctx;
    const series_set *s;
    const extreme_request *ask;
    series_nature nature;
    double time; /* of all values [s] */
    extreme_result *out;
    fram_error *error;
} series_work;

static int32_t steps_of(const series_work *w, double time)
{
    double steps = floor(time / w->s->step + 0.5);
    return steps < 1 ? 1 : steps > INT32_MAX / 2 ? INT32_MAX / 2 : (int32_t)steps;
}

static fram_status answer_blocks(const series_work *w)
{
    extreme_result *out = w->out;
    extreme_sample s = {.kind = out->method == EXTREME_GEV ? LAW_GEV : LAW_GUMBEL, .series = w->s};
    double usual = fmax(w->time / BLOCKS, SCALES_OF_BLOCK * w->nature.time_scale);
    int32_t length = steps_of(w, w->ask->block > 0 ? w->ask->block : usual);
    out->block = length * w->s->step;
    s.exposure = w->ask->duration / out->block;
    fram_status status = block_maxima(w->ctx, w->s, length, &s.value) ? FRAM_OK : error_memory(w->error);
    values_sort(&s.value);
    if (status == FRAM_OK && s.value.count == 0)
        status = extremes_refuse_short(out);
    else if (status == FRAM_OK)
        status = answer_sample(w->ctx, &s, w->ask, out, w->error);
    array_free(w->ctx, &s.value);
    return status;
}

/* The value that a part p of all values lies below. */
static bool series_quantile(const series_work *w, double p, double *out)
{
    double_array all = {0};
    bool good = true;
    for (int32_t part = 0; part < w->s->count && good; part++)
        for (int32_t i = 0; i < w->s->parts[part].count && good; i++)
            good = array_push(w->ctx, &all, w->s->parts[part].value[i]);
    values_sort(&all);
    *out = all.count > 0 ? sorted_quantile(all.data, all.count, p) : (double)NAN;
    array_free(w->ctx, &all);
    return good;
}

static bool peaks_over(const series_work *w, double threshold, extreme_sample *s)
{
    s->location = threshold;
    bool good = cluster_peaks(w->ctx, w->s, threshold, steps_of(w, w->out->separation), &s->value);
    values_sort(&s->value);
    return good;
}

/* Fits over rising thresholds, from half the threshold's way to the greatest value on. */
static fram_status add_stability(const series_work *w, double threshold, extreme_sample *s)
{
    double from = w->nature.mean + 0.5 * (threshold - w->nature.mean), z = NORMAL_95;
    fram_status status = FRAM_OK;
    for (int i = 0; i < STABILITY_MOST && status == FRAM_OK; i++) {
        extreme_law law;
        double u = from + (w->nature.greatest - from) * i / STABILITY_MOST;
        if (!peaks_over(w, u, s))
            return error_memory(w->error);
        status = work_continue(w->ctx, "trying thresholds", i + 1, STABILITY_MOST, w->error);
        if (!extreme_law_fit(LAW_PARETO, FIT_LIKELIHOOD, s->value.data, s->value.count, u, &law))
            continue;
        /* Asymptotic deviation of the shape (Smith 1984). */
        double half = z * (1 + law.shape) / sqrt(s->value.count);
        w->out->stability[w->out->stability_rows++] =
            (threshold_row){u, law.shape, half, law.scale - law.shape * u, s->value.count};
    }
    return status;
}

/* The lowest threshold whose clusters keep apart. */
static bool choose_threshold(const series_work *w, extreme_sample *s, double *out)
{
    for (int i = 0; i < PEAKS_QUANTILES; i++) {
        if (!series_quantile(w, peaks_quantile[i], out) || !peaks_over(w, *out, s))
            return false;
        if (s->value.count * w->out->separation < MERGED_MOST * w->time)
            break;
    }
    return true;
}

static fram_status answer_peaks(const series_work *w)
{
    extreme_sample s = {.kind = LAW_PARETO, .exposure = w->ask->duration / w->time, .series = w->s};
    double threshold = w->ask->threshold;
    bool good = !isnan(threshold) || choose_threshold(w, &s, &threshold);
    fram_status status = good ? FRAM_OK : error_memory(w->error);
    if (status == FRAM_OK && w->ask->stability)
        status = add_stability(w, threshold, &s);
    if (status == FRAM_OK && !peaks_over(w, threshold, &s))
        status = error_memory(w->error);
    w->out->threshold = threshold;
    if (status == FRAM_OK)
        status = answer_sample(w->ctx, &s, w->ask, w->out, w->error);
    array_free(w->ctx, &s.value);
    return status;
}

/* Peaks between crossings of the mean, from there: of a narrow band of Gaussian waves they are Rayleigh's. */
static fram_status answer_weibull(const series_work *w)
{
    extreme_sample s = {.kind = LAW_WEIBULL, .exposure = w->ask->duration / w->time};
    s.location = w->nature.mean;
    weibull_jackknife jackknife;
    fram_status status = cluster_peaks(w->ctx, w->s, w->nature.mean, 1, &s.value) ? FRAM_OK : error_memory(w->error);
    if (status == FRAM_OK)
        status = jackknife_weibull(w->ctx, w->s, &w->nature, w->ask->duration, &jackknife, w->error);
    values_sort(&s.value);
    w->out->threshold = w->nature.mean;
    s.jackknife = status == FRAM_OK && jackknife.groups >= JACKKNIFE_LEAST ? &jackknife : NULL;
    if (status == FRAM_OK)
        status = answer_sample(w->ctx, &s, w->ask, w->out, w->error);
    array_free(w->ctx, &s.value);
    return status;
}

static fram_status answer_tail(const series_work *w, const acer_rates *rates)
{
    extreme_result *out = w->out;
    int64_t exceedances = rates->levels > 0 ? acer_exceedances(rates, 0) : 0;
    out->sample = (int32_t)(exceedances < INT32_MAX ? exceedances : INT32_MAX);
    /* To the nearest: series that are a little shorter than a batch are hardly less. */
    if (floor(acer_effective_batches(rates) + 0.5) < ACER_BATCHES_LEAST)
        return extremes_refuse_scales(out);
    if (out->sample < LAW_VALUES_LEAST)
        return extremes_refuse_few(out);
    if (!acer_fit(rates, &out->tail))
        return extremes_refuse(
            out, "no law of the tail fits: fewer than five levels are exceeded often enough, or their rates "
                 "do not fall");
    if (!(acer_level(&out->tail, w->s->step, w->ask->duration, 1) > rates->level[0]))
        return extremes_refuse(out, "fewer than one exceedance of the first level is expected in the duration: ask for "
                                    "a longer one, or take a lower threshold");
    double counted = (double)acer_values(rates) * w->s->step;
    for (int32_t i = 0; i < rates->levels && out->points < EXTREME_POINTS_MOST; i++) {
        int64_t n = acer_exceedances(rates, i);
        if (n > 0)
            out->point[out->points++] = (extreme_point){counted / (double)n, rates->level[i]};
    }
    double exponent[EXTREME_LEVELS_MOST + 1] = {1};
    level_interval level[EXTREME_LEVELS_MOST + 1];
    for (int i = 0; i < w->ask->levels; i++)
        exponent[i + 1] = -real_log(w->ask->probability[i]);
    acer_doubt doubt;
    fram_status status = acer_intervals(w->ctx, rates, &out->tail, w->ask->duration, exponent, w->ask->levels + 1,
                                        w->ask->confidence, level, &doubt, w->error);
    if (status == FRAM_OK) {
        out->most_probable = level[0];
        memcpy(out->level, level + 1, (size_t)w->ask->levels * sizeof *level);
        extremes_doubt_tail(out, &doubt);
    }
    out->interval = "bootstrap over batches, percentiles";
    out->answered = status == FRAM_OK;
    if (out->answered)
        extremes_cut_low(out, w->ask->levels, rates->level[0]);
    return status;
}

static fram_status answer_rates(const series_work *w)
{
    acer_rates rates = {0};
    double tail = w->ask->threshold;
    if (isnan(tail) && !series_quantile(w, TAIL_QUANTILE, &tail))
        return error_memory(w->error);
    int32_t usual = steps_of(w, w->out->separation) + 1;
    w->out->order = w->out->method == EXTREME_UPCROSSING ? 2 : w->ask->order > 0 ? w->ask->order : usual;
    w->out->threshold = tail;
    double batch = fmax(w->time / BATCHES, SCALES_OF_BATCH * w->nature.time_scale);
    if (!acer_count(w->ctx, w->s, w->out->order, tail, steps_of(w, batch), &rates))
        return error_memory(w->error);
    fram_status status = answer_tail(w, &rates);
    acer_free(w->ctx, &rates);
    return status;
}

fram_status extremes_of_series(context *ctx, const series_set *s, extreme_method method, const extreme_request *ask,
                               extreme_result *out, fram_error *error)
{
    series_work w = {ctx, s, ask, series_nature_of(s), 0, out, error};
    w.time = (double)w.nature.values * s->step;
    extremes_begin(out, method, ask);
    out->time = w.time;
    out->step = s->step;
    out->separation = ask->separation > 0 ? ask->separation : SCALES_APART * w.nature.time_scale;
    if (w.nature.values < LAW_VALUES_LEAST || !(w.nature.greatest > w.nature.least))
        return extremes_refuse(out, "the series is constant, or has fewer than ten values");
    fram_status status = FRAM_OK;
    if (method == EXTREME_ACER || method == EXTREME_UPCROSSING)
        status = answer_rates(&w);
    else if (method == EXTREME_POT)
        status = answer_peaks(&w);
    else if (method == EXTREME_WEIBULL)
        status = answer_weibull(&w);
    else
        status = answer_blocks(&w);
    if (status == FRAM_OK && out->answered)
        extremes_doubt(out, ask, w.time);
    return status == FRAM_OK ? extremes_doubt_series(ctx, out, ask, s, error) : status;
}
