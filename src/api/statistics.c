/* Extremes and fatigue of the public API. */
#include "fram/statistics.h"

#include "api/arguments.h"
#include "api/handles.h"
#include "base/load_unit.h"
#include "base/number_text.h"
#include "io/atomic_file.h"
#include "io/path.h"
#include "io/text_buffer.h"
#include "results/rainflow.h"
#include "study/extremes.h"
#include "study/extremes_chart.h"
#include "study/extremes_notes.h"
#include "study/series_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

_Static_assert((int)FRAM_SERIES_FILES == (int)SERIES_FILES_MOST, "one number of files");
_Static_assert((int)FRAM_EXTREME_LEVELS == (int)EXTREME_LEVELS_MOST, "one number of levels");
_Static_assert((int)FRAM_EXTREME_METHODS == (int)EXTREME_METHODS, "one number of methods");
_Static_assert((int)FRAM_EXTREME_STABILITY == (int)STABILITY_MOST, "one number of thresholds");
_Static_assert(sizeof(((fram_extreme *)0)->note) == EXTREME_NOTE, "one room of notes");

/* Times that may be asked, far beyond every use [s]; confidences. */
#define DURATION_MOST 1e12
#define CONFIDENCE_LEAST 0.01
#define CONFIDENCE_MOST 0.9999

/* ---- times ---- */

fram_status fram_time_read(const char *text, double *seconds, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"text", text}, {"seconds", seconds});
    if (status != FRAM_OK || time_from_text(text, seconds) == NUMBER_GOOD)
        return status;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "text",
                     "expected a time, as 3h, 90min or 10800 (seconds), found \"%.60s\"", text);
}

fram_status fram_number_read(const char *text, double *value, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"text", text}, {"value", value});
    number_fault fault = status == FRAM_OK ? real_from_text(text, value) : NUMBER_GOOD;
    if (fault == NUMBER_GOOD)
        return status;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "text",
                     "expected a decimal number, as 0.5 or 1e3, found %s\"%.60s\"",
                     fault == NUMBER_TOO_LARGE ? "one that is too large, " : "", text);
}

void fram_duration_text(double seconds, char *text, size_t size)
{
    if (text && size > 0)
        snprintf(text, size, "%s", duration_text_of(seconds).text);
}

enum { LOAD_TOLD = 4 }; /* digits */

void fram_load_text(double newton, double half, double largest, char *text, size_t size)
{
    if (text && size > 0)
        snprintf(text, size, "%s", load_range_text_of(newton, half, largest, LOAD_TOLD).text);
}

int fram_digits_beside(double size, double part, int digits, int least)
{
    return digits_beside(size, part, digits, least);
}

/* ---- the series ---- */

static fram_status check_source(const fram_series_source *s, fram_error *error)
{
    if (!s->files || s->file_count < 1 || s->file_count > SERIES_FILES_MOST)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "files", "expected 1 to %d files, found %d",
                         SERIES_FILES_MOST, s->file_count);
    for (int i = 0; i < s->file_count; i++)
        if (!s->files[i])
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "files", "name %d is NULL", i + 1);
    fram_status status = number_check("step", s->step, 0, DURATION_MOST, error);
    if (status == FRAM_OK && !isnan(s->from))
        status = number_check("from", s->from, -DURATION_MOST, DURATION_MOST, error);
    return status;
}

/* An output that is none of what is read. */
static fram_status check_output(const fram_series_source *s, const char *output, const char *key, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int i = 0; output && i < s->file_count && status == FRAM_OK; i++)
        status = path_refuse_read(s->files[i], output, key, error);
    return status;
}

static fram_status read_source(fram_context *c, const fram_series_source *s, bool maxima, series_data *out,
                               fram_error *error)
{
    const series_source inner = {s->files, s->file_count, s->channel, s->from, s->step, s->minima, maxima};
    return series_read(&c->inner, &inner, out, error);
}

static fram_series_facts facts_of(const series_data *d)
{
    series_nature n = series_nature_of(&d->set);
    fram_series_facts f = {.values = n.values,
                           .time = (double)n.values * d->set.step,
                           .step = d->set.step,
                           .mean = n.mean,
                           .deviation = n.deviation,
                           .least = n.least,
                           .greatest = n.greatest,
                           .time_scale = n.time_scale};
    memcpy(f.unit, d->unit, sizeof f.unit);
    return f;
}

/* ---- extremes ---- */

static void fram_extremes_fill(fram_extremes_definition *definition)
{
    extreme_request r;
    extreme_request_default(&r);
    *definition = (fram_extremes_definition){.size = sizeof *definition,
                                             .source = {.from = (double)NAN},
                                             .duration = r.duration,
                                             .confidence = r.confidence,
                                             .threshold = r.threshold,
                                             .levels = r.levels};
    memcpy(definition->probability, r.probability, sizeof r.probability);
}
DEFINITION_DEFAULT(fram_extremes, fram_extremes_definition)

static fram_status take_extremes(const fram_extremes_definition *given, fram_extremes_definition *d, fram_error *error)
{
    fram_extremes_fill(d);
    fram_status status = definition_take(d, given, sizeof *d, DEFINITION_LEAST, "fram_extremes", error);
    if (status == FRAM_OK)
        status = check_source(&d->source, error);
    if (status == FRAM_OK)
        status = number_check("duration", d->duration, 1e-6, DURATION_MOST, error);
    if (status == FRAM_OK)
        status = number_check("confidence", d->confidence, CONFIDENCE_LEAST, CONFIDENCE_MOST, error);
    if (status == FRAM_OK)
        status = number_check("block", d->block, d->maxima ? 1e-6 : 0, DURATION_MOST, error);
    if (status == FRAM_OK)
        status = number_check("separation", d->separation, 0, DURATION_MOST, error);
    if (status == FRAM_OK)
        status = number_check("order", d->order, 0, 1e6, error);
    if (status == FRAM_OK && !isnan(d->threshold))
        status = number_check("threshold", d->threshold, -1e300, 1e300, error);
    if (status == FRAM_OK)
        status = number_check("levels", d->levels, 0, FRAM_EXTREME_LEVELS, error);
    for (int i = 0; status == FRAM_OK && i < d->levels; i++)
        if (!(d->probability[i] >= 1e-6 && d->probability[i] <= 1 - 1e-9))
            status = error_set(error, FRAM_ERROR_INPUT, NULL, 0, "probability",
                               "expected probabilities above 0 and below 1, from 1e-6 to 1 - 1e-9, found %.12g",
                               d->probability[i]);
    return status;
}

static extreme_request request_of(const fram_extremes_definition *d)
{
    extreme_request r = {.duration = d->duration,
                         .confidence = d->confidence,
                         .block = d->block,
                         .threshold = d->threshold,
                         .separation = d->separation,
                         .order = d->order,
                         .fit = d->moments ? FIT_MOMENTS : FIT_LIKELIHOOD,
                         .stability = true,
                         .levels = d->levels};
    memcpy(r.probability, d->probability, sizeof r.probability);
    return r;
}

static fram_level level_of(const level_interval *i) { return (fram_level){i->level, i->low, i->high}; }

static void give_extreme(const extreme_result *r, fram_extreme *out)
{
    *out = (fram_extreme){.method = extreme_method_name(r->method),
                          .interval = r->interval,
                          .answered = r->answered,
                          .sample = r->sample,
                          .order = r->order,
                          .block = r->block,
                          .threshold = r->threshold,
                          .separation = r->separation,
                          .location = r->law.location,
                          .scale = r->law.scale,
                          .shape = r->law.shape,
                          .tail_q = r->tail.q,
                          .tail_a = r->tail.a,
                          .tail_b = r->tail.b,
                          .tail_c = r->tail.c,
                          .most_probable = level_of(&r->most_probable),
                          .fits = r->stability_rows};
    for (int i = 0; i < FRAM_EXTREME_LEVELS; i++)
        out->level[i] = level_of(&r->level[i]);
    for (int i = 0; i < r->stability_rows; i++) {
        const threshold_row *row = &r->stability[i];
        out->fit[i] = (fram_threshold_fit){row->threshold, row->shape, row->shape_half, row->scale_star, row->peaks};
    }
    memcpy(out->note, r->note, sizeof out->note);
}

/* The methods that are asked, as numbers; returns their count, 0 with the error set. */
static int methods_of(const fram_extremes_definition *d, extreme_method out[EXTREME_METHODS], fram_error *error)
{
    int count = 0;
    extreme_method one = d->method ? extreme_method_find(d->method) : EXTREME_METHODS;
    bool all = !d->method || strcmp(d->method, "all") == 0;
    for (int m = 0; m < EXTREME_METHODS; m++) {
        bool possible = !d->maxima || m == EXTREME_GUMBEL || m == EXTREME_GEV;
        if (all ? possible : m == (int)one)
            out[count++] = (extreme_method)m;
    }
    if (count == 0)
        error_set(error, FRAM_ERROR_USAGE, NULL, 0, "method",
                  "expected acer, upcrossing, gumbel, gev, pot, weibull or all, found %.60s", d->method);
    return count;
}

/* The probability plots of what was found. */
static fram_status draw_extremes(context *ctx, const fram_extremes_definition *d, const char *unit,
                                 const extreme_result *results, int count, fram_error *error)
{
    char quantity[200];
    snprintf(quantity, sizeof quantity, *unit ? "%.100s [%s]" : "%.100s%s",
             d->source.channel ? d->source.channel : "load", unit);
    fram_status status = work_continue(ctx, "drawing", 1, 1, error);
    return status == FRAM_OK ? extremes_chart_write(ctx, results, count, quantity, d->duration, d->draw, error)
                             : status;
}

fram_status(fram_extremes_find)(fram_context *c, const fram_extremes_definition *definition, fram_extremes *result,
                                fram_error *error, size_t size)
{
    fram_extremes full = {.methods = 0}, *out = &full;
    fram_extremes_definition taken, *d = &taken;
    series_data data;
    extreme_method methods[EXTREME_METHODS];
    fram_status status = REFUSE_NULL(error, {"context", c}, {"result", result});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_extremes, error);
    if (status == FRAM_OK)
        status = take_extremes(definition, d, error);
    if (status == FRAM_OK)
        status = check_output(&d->source, d->draw, "draw", error);
    int count = status == FRAM_OK ? methods_of(d, methods, error) : 0;
    if (status != FRAM_OK || count == 0)
        return status == FRAM_OK ? FRAM_ERROR_USAGE : status;
    status = read_source(c, &d->source, d->maxima, &data, error);
    if (status != FRAM_OK)
        return status;
    if (d->maxima)
        data.set.step = d->block;
    out->series = facts_of(&data);
    extreme_request ask = request_of(d);
    double_array all = {0};
    for (int32_t i = 0; d->maxima && status == FRAM_OK && i < data.count; i++)
        for (int32_t k = 0; k < data.values[i].count && status == FRAM_OK; k++)
            status = array_push(&c->inner, &all, data.values[i].data[k]) ? FRAM_OK : error_memory(error);
    extreme_result *r = memory_array(&c->inner, EXTREME_METHODS, sizeof *r);
    if (!r && status == FRAM_OK)
        status = error_memory(error);
    for (int i = 0; i < count && status == FRAM_OK; i++) {
        status = d->maxima
                     ? extremes_of_maxima(&c->inner, all.data, all.count, d->block, methods[i], &ask, &r[i], error)
                     : extremes_of_series(&c->inner, &data.set, methods[i], &ask, &r[i], error);
        if (status == FRAM_OK)
            extremes_cut_parted(&r[i], ask.levels, data.parted, data.count, data.offset, data.held);
        if (status == FRAM_OK)
            give_extreme(&r[i], &out->method[out->methods++]);
    }
    if (status == FRAM_OK && d->draw)
        status = draw_extremes(&c->inner, d, data.unit, r, out->methods, error);
    memory_free(&c->inner, r);
    array_free(&c->inner, &all);
    series_free(&c->inner, &data);
    if (status == FRAM_OK)
        result_give(result, size, out);
    return status;
}

/* ---- fatigue ---- */

static void fram_fatigue_fill(fram_fatigue_definition *definition)
{
    *definition = (fram_fatigue_definition){
        .size = sizeof *definition, .source = {.from = (double)NAN}, .slope = {3, 5}, .slopes = 2, .frequency = 1};
}
DEFINITION_DEFAULT(fram_fatigue, fram_fatigue_definition)

static fram_status take_fatigue(const fram_fatigue_definition *given, fram_fatigue_definition *d, fram_error *error)
{
    fram_fatigue_fill(d);
    fram_status status = definition_take(d, given, sizeof *d, DEFINITION_LEAST, "fram_fatigue", error);
    if (status == FRAM_OK)
        status = check_source(&d->source, error);
    if (status == FRAM_OK)
        status = number_check("slopes", d->slopes, 1, FRAM_SLOPES, error);
    if (status == FRAM_OK)
        status = number_check("frequency", d->frequency, 1e-9, 1e9, error);
    for (int i = 0; status == FRAM_OK && i < d->slopes; i++)
        status = number_check("slope", d->slope[i], 1, 30, error);
    return status;
}

/* Cycles of all parts, each counted by itself. */
static fram_status count_cycles(fram_context *c, const series_data *data, rain_cycles *all, fram_error *error)
{
    rain_cycles part = {0};
    bool good = true;
    for (int32_t i = 0; i < data->count && good; i++) {
        good = rainflow(&c->inner, data->parts[i].value, data->parts[i].count, &part);
        for (int32_t k = 0; k < part.list.count && good; k++)
            good = array_push(&c->inner, &all->list, part.list.data[k]);
    }
    rainflow_free(&c->inner, &part);
    return good ? FRAM_OK : error_memory(error);
}

/* A row a cycle, with the digits of a series: means may lie far from zero. */
static fram_status write_cycles(context *ctx, const char *path, const rain_cycles *all, const char *unit,
                                fram_error *error)
{
    text_buffer b = {0};
    text_format(ctx, &b, "range[%s],mean[%s],count[1]\n", unit, unit);
    for (int32_t i = 0; i < all->list.count; i++) {
        const rain_cycle *of = &all->list.data[i];
        text_format(ctx, &b, "%.12g,%.12g,%.1f\n", of->range, of->mean, of->count);
    }
    fram_status status = b.failed ? error_memory(error) : work_continue(ctx, "counting cycles", 1, 1, error);
    if (status == FRAM_OK)
        status = atomic_file_write(ctx, path, b.data, (size_t)b.count, error);
    text_free(ctx, &b);
    return status;
}

/* `list` is to be freed: a struct that ends before its count never was. */
static fram_status fatigue_check(const fram_fatigue *result, size_t size, fram_error *error)
{
    size_t least = offsetof(fram_fatigue, count) + sizeof result->count;
    return RESULT_CHECK(result, size < least ? 0 : size, fram_fatigue, error);
}

fram_status(fram_fatigue_find)(fram_context *c, const fram_fatigue_definition *definition, fram_fatigue *result,
                               fram_error *error, size_t size)
{
    fram_fatigue full, *out = &full;
    fram_fatigue_definition taken, *d = &taken;
    series_data data;
    rain_cycles cycles = {0};
    fram_status status = REFUSE_NULL(error, {"context", c}, {"result", result});
    if (status == FRAM_OK)
        status = fatigue_check(result, size, error);
    if (status == FRAM_OK)
        status = take_fatigue(definition, d, error);
    if (status == FRAM_OK)
        status = check_output(&d->source, d->cycles, "cycles", error);
    if (status == FRAM_OK)
        status = read_source(c, &d->source, false, &data, error);
    if (status != FRAM_OK)
        return status;
    *out = (fram_fatigue){.series = facts_of(&data)};
    if (data.fewer > 0)
        log_write(
            &c->inner, LOG_WARNING,
            "lines parted or were let go in %d of %d runs: cycles from there on are those of a mooring with fewer "
            "lines",
            (int)data.fewer, (int)data.count);
    status = count_cycles(c, &data, &cycles, error);
    if (status == FRAM_OK && cycles.list.count > 0) {
        out->list = memory_array(&c->inner, (size_t)cycles.list.count, sizeof *out->list);
        status = out->list ? FRAM_OK : error_memory(error);
    }
    for (int32_t i = 0; status == FRAM_OK && i < cycles.list.count; i++) {
        const rain_cycle *from = &cycles.list.data[i];
        out->list[i] = (fram_cycle){from->range, from->mean, from->count};
        out->greatest = fmax(out->greatest, from->range);
        out->cycles += from->count;
    }
    out->count = status == FRAM_OK ? cycles.list.count : 0;
    for (int i = 0; status == FRAM_OK && i < d->slopes; i++)
        out->equivalent[i] = equivalent_range(&cycles, d->slope[i], d->frequency * out->series.time);
    if (status == FRAM_OK && d->cycles)
        status = write_cycles(&c->inner, d->cycles, &cycles, data.unit, error);
    rainflow_free(&c->inner, &cycles);
    series_free(&c->inner, &data);
    if (status == FRAM_OK)
        result_give(result, size, out);
    else
        memory_free(&c->inner, out->list);
    return status;
}

void(fram_fatigue_free)(fram_context *c, fram_fatigue *result, size_t size)
{
    if (!c || !result || fatigue_check(result, size, NULL) != FRAM_OK)
        return;
    memory_free(&c->inner, result->list);
    memset(result, 0, size);
}
