/* fram extremes, fram fatigue: what series say of rare and of many loads. */
#include "cli/cli.h"

#include "fram/statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- words ---- */

/* An option that is a time; NULL stays what it was.  -1 to go on. */
static int take_time(const common_options *common, const char *option, const char *text, double *out)
{
    fram_error error = {0};
    if (!text || fram_time_read(text, out, &error) == FRAM_OK)
        return -1;
    return answer_usage(common, option, error.message);
}

/* The same of a length of time, of which zero is none. */
static int take_period(const common_options *common, const char *option, const char *text, double *out)
{
    int code = take_time(common, option, text, out);
    return code >= 0 || !text || *out > 0 ? code : answer_usage(common, option, "needs a time above zero");
}

/* Numbers divided by commas, from any number of options.  -1 to go on. */
static int take_numbers(const common_options *common, const char *option, const option_list *list, double *out,
                        int room, int *count)
{
    for (int i = 0; i < list->count; i++) {
        if (i == 0)
            *count = 0;
        for (const char *c = list->value[i];; c++) {
            double value;
            if (!take_number(&c, ",", &value, NULL))
                return answer_usage(common, option, "expected numbers, separated by commas: 0.5,1e3");
            if (*count == room)
                return answer_usage(common, option, "has too many numbers");
            out[(*count)++] = value;
            if (!*c)
                break;
        }
    }
    return -1;
}

/* Options that both commands share. */
typedef struct series_words {
    const char *channel, *from, *step;
    bool minima;
} series_words;

enum { SERIES_ROWS = 4 };
static void series_rows(series_words *w, option_row rows[SERIES_ROWS])
{
    rows[0] = (option_row){"--channel", NULL,   OPTION_TEXT,
                           &w->channel, "NAME", "channel of a run or column of a CSV file (load, or NAME.load)"};
    rows[1] =
        (option_row){"--from", NULL, OPTION_TEXT, &w->from, "T", "ignore values up to then (a run: its transient)"};
    rows[2] = (option_row){"--step", NULL, OPTION_TEXT, &w->step, "T", "time step of a file without a time column"};
    rows[3] = (option_row){"--minima", NULL, OPTION_FLAG,
                           &w->minima, NULL, "minima instead of maxima: results are those of the negated series"};
}

static int take_source(const common_options *common, const series_words *w, const char *const *files,
                       fram_series_source *out)
{
    out->files = files;
    while (out->file_count < FRAM_SERIES_FILES && files[out->file_count])
        out->file_count++;
    out->channel = w->channel;
    out->minima = w->minima;
    int code = take_time(common, "--from", w->from, &out->from);
    return code >= 0 ? code : take_time(common, "--step", w->step, &out->step);
}

/* No file or run that is read is written over. */
static int refuse_over_source(const common_options *common, const fram_series_source *source, output_file output)
{
    int code = -1;
    for (int i = 0; i < source->file_count && code < 0; i++) {
        const char *file = source->files[i];
        code = refuse_outputs(common, &(command_files){.inputs = {file}, .runs = {file}, .outputs = {output}});
    }
    return code;
}

/* ---- facts ---- */

/* Digits of a value beside the spread of those it is one of. */
static int digits_of(double value, double spread)
{
    enum { OF_SPREAD = 3, LEAST = 5 };
    return fram_digits_beside(value, spread, OF_SPREAD, LEAST);
}

static void print_facts(const fram_series_source *source, const fram_series_facts *f, bool maxima)
{
    tell(stdout, "%s of %d %s: %lld %s", source->channel ? source->channel : "load", source->file_count,
         source->file_count == 1 ? "file" : "files", (long long)f->values, maxima ? "maxima" : "values");
    if (!maxima)
        printf(", %.6g s at a step of %.4g s, correlation time %.4g s", f->time, f->step, f->time_scale);
    int digits = digits_of(fmax(fabs(f->least), fabs(f->greatest)), f->deviation);
    tell(stdout, "\nmean %.*g, standard deviation %.5g, minimum %.*g, maximum %.*g %s\n", digits, f->mean, f->deviation,
         digits, f->least, digits, f->greatest, f->unit);
}

static void json_facts(json *j, const fram_series_facts *f)
{
    json_open(j, "series");
    json_integer(j, "values", f->values);
    json_text(j, "unit", f->unit);
    json_real(j, "time_s", f->time);
    json_real(j, "step_s", f->step);
    json_real(j, "mean", f->mean);
    json_real(j, "deviation", f->deviation);
    json_real(j, "least", f->least);
    json_real(j, "greatest", f->greatest);
    json_real(j, "time_scale_s", f->time_scale);
    json_close(j);
}

/* ---- fram extremes ---- */

/* 1/e: of no exceedance where one is expected. */
#define ONCE 0.36787944117144233

static void print_level(const char *name, const fram_level *l, const char *unit)
{
    int digits = digits_of(l->level, (isfinite(l->high) ? l->high : l->level) - l->low);
    if (isnan(l->level))
        tell(stdout, "  %-16s %11s\n", name, "not told");
    else
        tell(stdout, "  %-16s %11.*g  (%.*g to %.*g) %s\n", name, digits, l->level, digits, l->low, digits, l->high,
             unit);
}

static void print_law(const fram_extreme *e, double deviation)
{
    if (e->tail_c > 0)
        printf(", order %d, exceedance rate per value %.3g exp(-%.3g (x %c %.*g)^%.3g)", e->order, e->tail_q, e->tail_a,
               e->tail_b < 0 ? '+' : '-', digits_of(e->tail_b, deviation), fabs(e->tail_b), e->tail_c);
    else
        printf(", location %.*g, scale %.5g, shape %.3g", digits_of(e->location, e->scale), e->location, e->scale,
               e->shape);
}

static void print_method(const fram_extreme *e, const fram_extremes_definition *d, const fram_series_facts *of)
{
    printf("\n%s: ", e->method);
    if (e->answered) {
        bool rates = e->tail_c > 0;
        printf("%d %s", e->sample, rates ? "exceedances" : e->block > 0 ? "maxima" : "peaks");
        if (e->block > 0)
            printf(" of %.4g s", e->block);
        else
            printf(" over %.*g", digits_of(e->threshold, of->deviation), e->threshold);
        print_law(e, of->deviation);
        tell(stdout, "\n  intervals: %s\n", e->interval);
        print_level("most probable", &e->most_probable, of->unit);
        for (int i = 0; i < d->levels; i++) {
            char name[32];
            snprintf(name, sizeof name, "%.6g quantile", d->probability[i]);
            print_level(name, &e->level[i], of->unit);
        }
    }
    if (e->note[0])
        printf("%s%s\n", e->answered ? "  " : "", e->note);
}

static void json_level(json *j, const char *key, double probability, const fram_level *l)
{
    json_open(j, key);
    json_real(j, "probability", probability);
    json_real(j, "level", l->level);
    json_real(j, "low", l->low);
    json_real(j, "high", l->high);
    json_close(j);
}

static void json_method(json *j, const fram_extreme *e, const fram_extremes_definition *d)
{
    json_open(j, NULL);
    json_text(j, "method", e->method);
    json_boolean(j, "answered", e->answered);
    json_text(j, "interval", e->interval);
    json_integer(j, "sample", e->sample);
    json_real(j, "block_s", e->block);
    json_real(j, "threshold", e->threshold);
    json_real(j, "separation_s", e->separation);
    if (e->tail_c > 0) {
        json_integer(j, "order", e->order);
        json_real(j, "q", e->tail_q);
        json_real(j, "a", e->tail_a);
        json_real(j, "b", e->tail_b);
        json_real(j, "c", e->tail_c);
    } else if (e->answered) {
        json_real(j, "location", e->location);
        json_real(j, "scale", e->scale);
        json_real(j, "shape", e->shape);
    }
    json_level(j, "most_probable", ONCE, &e->most_probable);
    json_open_list(j, "levels");
    for (int i = 0; i < d->levels; i++)
        json_level(j, NULL, d->probability[i], &e->level[i]);
    json_close_list(j);
    json_open_list(j, "thresholds");
    for (int i = 0; i < e->fits; i++) {
        json_open(j, NULL);
        json_real(j, "threshold", e->fit[i].threshold);
        json_integer(j, "peaks", e->fit[i].peaks);
        json_real(j, "shape", e->fit[i].shape);
        json_real(j, "shape_half", e->fit[i].shape_half);
        json_real(j, "scale_star", e->fit[i].scale_star);
        json_close(j);
    }
    json_close_list(j);
    json_text(j, "note", e->note);
    json_close(j);
}

static int answer_extremes(const common_options *common, const fram_extremes_definition *d)
{
    fram_context *context = NULL;
    fram_error error = {0};
    work_view work;
    int code = session_open_for(d->draw, common, &work, &context);
    if (code >= 0)
        return code;
    fram_extremes *e = calloc(1, sizeof *e);
    if (!e) {
        code = answer_memory(common);
    } else if (fram_extremes_find(context, d, e, &error) != FRAM_OK) {
        code = answer_error(common, &error);
    } else if (common->json) {
        json j = json_begin();
        json_facts(&j, &e->series);
        json_real(&j, "duration_s", d->duration);
        json_real(&j, "confidence", d->confidence);
        json_open_list(&j, "methods");
        for (int i = 0; i < e->methods; i++)
            json_method(&j, &e->method[i], d);
        json_close_list(&j);
        json_end(&j);
        code = EXIT_GOOD;
    } else {
        print_facts(&d->source, &e->series, d->maxima);
        printf("extreme value in %.6g s, with %g %% confidence intervals\n", d->duration, 100 * d->confidence);
        for (int i = 0; i < e->methods; i++)
            print_method(&e->method[i], d, &e->series);
        code = EXIT_GOOD;
    }
    free(e);
    fram_context_destroy(context);
    return code;
}

/* Options that say how a method works, each with a bit. */
enum { BY_BLOCK = 1, BY_THRESHOLD = 2, BY_SEPARATION = 4, BY_ORDER = 8, BY_FIT = 16 };
static const char *const by_names[] = {"--block", "--threshold", "--separation", "--order", "--fit"};
static const struct {
    const char *method;
    unsigned by;
} methods_by[] = {{"acer", BY_THRESHOLD | BY_SEPARATION | BY_ORDER},
                  {"upcrossing", BY_THRESHOLD},
                  {"gumbel", BY_BLOCK | BY_FIT},
                  {"gev", BY_BLOCK | BY_FIT},
                  {"pot", BY_THRESHOLD | BY_SEPARATION | BY_FIT},
                  {"weibull", 0}};

/* One that the method has no use for would be passed over.  All methods together have one for each. */
static int refuse_unused(const common_options *common, const fram_extremes_definition *d, unsigned given)
{
    unsigned by = given;
    for (size_t i = 0; d->method && i < sizeof methods_by / sizeof *methods_by; i++)
        by = strcmp(d->method, methods_by[i].method) == 0 ? methods_by[i].by : by;
    if (d->maxima)
        by = BY_BLOCK | BY_FIT;
    /* An order is a separation in values. */
    bool ordered = by & BY_ORDER && given & BY_ORDER && d->method && strcmp(d->method, "acer") == 0;
    if (ordered)
        by &= ~(unsigned)BY_SEPARATION;
    for (size_t i = 0; i < sizeof by_names / sizeof *by_names; i++) {
        char text[80];
        if (!(given & ~by & 1u << i))
            continue;
        snprintf(text, sizeof text, "has no effect on %s%s; leave it out", d->maxima ? "maxima" : d->method,
                 ordered && by_names[i] == by_names[2] ? " with --order" : "");
        return answer_usage(common, by_names[i], text);
    }
    return -1;
}

int command_extremes(const command_row *self, int argc, char **argv)
{
    common_options common;
    fram_extremes_definition d;
    series_words words = {0};
    option_list levels = {0};
    const char *duration = NULL, *block = NULL, *separation = NULL, *fit = NULL;
    const char *files[FRAM_SERIES_FILES] = {0};
    fram_extremes_default(&d);
    option_row rows[] = {
        {0},
        {0},
        {0},
        {0},
        {"--duration", NULL, OPTION_TEXT, &duration, "T", "duration of the extreme value (3h)"},
        {"--method", NULL, OPTION_TEXT, &d.method, "NAME", "acer, upcrossing, gumbel, gev, pot, weibull or all (all)"},
        {"--level", NULL, OPTION_LIST, &levels, "P,P...", "probabilities of non-exceedance (0.5,0.9,0.99)"},
        {"--confidence", NULL, OPTION_REAL, &d.confidence, "P", "confidence level of the intervals (0.95)"},
        {"--block", NULL, OPTION_TEXT, &block, "T", "block length for block maxima (a fiftieth of the data)"},
        {"--threshold", NULL, OPTION_REAL, &d.threshold, "X", "threshold of peaks and crossing rates (from quantiles)"},
        {"--separation", NULL, OPTION_TEXT, &separation, "T", "least time between independent peaks (4 time scales)"},
        {"--order", NULL, OPTION_COUNT, &d.order, "K",
         "ACER: order of conditioning, in values (as many as the separation holds)"},
        {"--fit", NULL, OPTION_TEXT, &fit, "NAME", "likelihood, or moments: L-moments with bootstrap (likelihood)"},
        {"--maxima", NULL, OPTION_FLAG, &d.maxima, NULL,
         "the values are maxima of blocks of length --block, not a series"},
        {"--draw", NULL, OPTION_TEXT, &d.draw, "FILE", "a probability plot of each method, .png or .svg"},
    };
    series_rows(&words, rows);
    int code =
        options_read_some(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, files, 1, FRAM_SERIES_FILES);
    if (code < 0)
        code = take_source(&common, &words, files, &d.source);
    if (code < 0)
        code = take_period(&common, "--duration", duration, &d.duration);
    if (code < 0)
        code = take_period(&common, "--block", block, &d.block);
    if (code < 0)
        code = take_period(&common, "--separation", separation, &d.separation);
    if (code < 0)
        code = take_numbers(&common, "--level", &levels, d.probability, FRAM_EXTREME_LEVELS, &d.levels);
    if (code < 0 && fit && strcmp(fit, "likelihood") != 0 && strcmp(fit, "moments") != 0)
        code = answer_usage(&common, "--fit", "expected likelihood or moments");
    if (code < 0 && d.maxima && (words.from || words.step))
        code = answer_usage(&common, words.from ? "--from" : "--step", "is for a series; maxima have no times");
    if (code < 0 && d.maxima && !block)
        code = answer_usage(&common, "--block", "is missing: the length of the blocks that the maxima are of");
    if (code < 0)
        code =
            refuse_unused(&common, &d,
                          (block ? BY_BLOCK : 0u) | (isnan(d.threshold) ? 0u : BY_THRESHOLD) |
                              (separation ? BY_SEPARATION : 0u) | (d.order > 0 ? BY_ORDER : 0u) | (fit ? BY_FIT : 0u));
    d.moments = fit && strcmp(fit, "moments") == 0;
    if (code < 0)
        code = refuse_over_source(&common, &d.source, (output_file){"--draw", d.draw, PICTURE_ENDINGS});
    return code >= 0 ? code : answer_extremes(&common, &d);
}

/* ---- fram fatigue ---- */

/* Counts by classes of the range, an equal width each, with their upper ends. */
enum { CLASSES = 10 };

static double class_end(const fram_fatigue *f, int at) { return f->greatest * (at + 1) / CLASSES; }

static void print_classes(const fram_fatigue *f)
{
    double count[CLASSES] = {0};
    for (int64_t i = 0; i < f->count; i++) {
        int at = 0;
        while (at < CLASSES - 1 && f->list[i].range > class_end(f, at))
            at++;
        count[at] += f->list[i].count;
    }
    printf("ranges            cycles\n");
    for (int i = 0; i < CLASSES; i++)
        printf("  up to %10.4g  %.1f\n", class_end(f, i), count[i]);
}

static void print_fatigue(const fram_fatigue_definition *d, const fram_fatigue *f)
{
    print_facts(&d->source, &f->series, false);
    tell(stdout, "%.1f cycles (rainflow, ASTM E1049-85), largest range %.5g %s\n", f->cycles, f->greatest,
         f->series.unit);
    if (f->greatest > 0)
        print_classes(f);
    for (int i = 0; i < d->slopes; i++)
        tell(stdout, "equivalent range at %g Hz, slope %g: %.6g %s\n", d->frequency, d->slope[i], f->equivalent[i],
             f->series.unit);
}

static void json_fatigue(const fram_fatigue_definition *d, const fram_fatigue *f)
{
    json j = json_begin();
    json_facts(&j, &f->series);
    json_real(&j, "cycles", f->cycles);
    json_real(&j, "greatest_range", f->greatest);
    json_real(&j, "frequency_Hz", d->frequency);
    json_open_list(&j, "equivalent");
    for (int i = 0; i < d->slopes; i++) {
        json_open(&j, NULL);
        json_real(&j, "slope", d->slope[i]);
        json_real(&j, "range", f->equivalent[i]);
        json_close(&j);
    }
    json_close_list(&j);
    json_end(&j);
}

int command_fatigue(const command_row *self, int argc, char **argv)
{
    common_options common;
    fram_fatigue_definition d;
    series_words words = {0};
    option_list slopes = {0};
    const char *files[FRAM_SERIES_FILES] = {0};
    fram_fatigue_default(&d);
    option_row rows[] = {
        {0},
        {0},
        {0},
        {0},
        {"--slope", NULL, OPTION_LIST, &slopes, "M,M...", "slopes m of S-N curves (3,5)"},
        {"--frequency", NULL, OPTION_REAL, &d.frequency, "F", "frequency of the equivalent cycles [Hz] (1)"},
        {"--output", "-o", OPTION_TEXT, &d.cycles, "FILE", "write all cycles as CSV"},
    };
    series_rows(&words, rows);
    int code =
        options_read_some(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, files, 1, FRAM_SERIES_FILES);
    if (code < 0)
        code = take_source(&common, &words, files, &d.source);
    if (code < 0)
        code = take_numbers(&common, "--slope", &slopes, d.slope, FRAM_SLOPES, &d.slopes);
    if (code < 0)
        code = refuse_over_source(&common, &d.source, (output_file){"--output", d.cycles, TABLE_ENDINGS});
    fram_context *context = NULL;
    work_view work;
    if (code < 0)
        code = session_open_for(d.cycles, &common, &work, &context);
    if (code >= 0)
        return code;
    fram_fatigue f;
    fram_error error = {0};
    if (fram_fatigue_find(context, &d, &f, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        if (common.json)
            json_fatigue(&d, &f);
        else
            print_fatigue(&d, &f);
        fram_fatigue_free(context, &f);
    }
    fram_context_destroy(context);
    return code;
}
