#include "study/extremes_notes.h"

#include "base/load_unit.h"
#include "base/number_text.h"
#include "base/transcendental.h"
#include "study/steadiness.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* From here on a doubt is told: duration over data, half an interval over the level. */
#define FAR 20.0
#define WIDE 0.25
/* Twice the logarithm of a ratio of likelihoods: of chi-squared with one degree of freedom exceeded once in 20 times.
 */
#define RATIO 3.841458820694124

static const level_interval none = {(double)NAN, (double)NAN, (double)NAN};

void extremes_begin(extreme_result *out, extreme_method method, const extreme_request *ask)
{
    memset(out, 0, sizeof *out);
    out->method = method;
    out->interval = "";
    out->most_probable = none;
    out->threshold = ask->threshold;
    for (int i = 0; i < EXTREME_LEVELS_MOST; i++)
        out->level[i] = none;
}

static void say(extreme_result *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(extreme_result *out, const char *format, ...)
{
    size_t used = strlen(out->note);
    va_list arguments;
    if (used > 0 && used + 1 < sizeof out->note)
        out->note[used++] = ' ';
    va_start(arguments, format);
    vsnprintf(out->note + used, sizeof out->note - used, format, arguments);
    va_end(arguments);
}

/* Digits of a value beside the scatter of those it is one of. */
static int digits_of(double value, double scatter)
{
    enum { OF_SCATTER = 3, LEAST = 4 };
    return digits_beside(value, scatter, OF_SCATTER, LEAST);
}

/* Scatter of what the law tells; of a tail of rates its way down by a factor of e. */
static double scale_of(const extreme_result *out)
{
    return out->tail.c > 0 ? real_pow(out->tail.a, -1 / out->tail.c) : out->law.scale;
}

fram_status extremes_refuse(extreme_result *out, const char *why)
{
    out->answered = false;
    say(out, "No answer: %s.", why);
    return FRAM_OK;
}

fram_status extremes_refuse_few(extreme_result *out)
{
    static const char *const what[EXTREME_METHODS] = {
        "exceedances of the first level",       "crossings of the first level",       "block maxima", "block maxima",
        "independent peaks over the threshold", "peaks between crossings of the mean"};
    static const char *const less[EXTREME_METHODS] = {[EXTREME_ACER] = ", or take a lower threshold or order",
                                                      [EXTREME_UPCROSSING] = ", or take a lower threshold",
                                                      [EXTREME_POT] = ", or take a lower threshold"};
    out->answered = false;
    say(out, "No answer: %d %s are too few, at least %d are needed: run longer, or more seeds%s.", (int)out->sample,
        what[out->method], (int)LAW_VALUES_LEAST, less[out->method] ? less[out->method] : "");
    return FRAM_OK;
}

fram_status extremes_refuse_scales(extreme_result *out)
{
    out->too_few_scales = true;
    return extremes_refuse(out, "the data are too short for a bootstrap: fewer than 20 series or batches of 20 time "
                                "scales, of which ones much shorter than the others count as parts");
}

fram_status extremes_refuse_short(extreme_result *out)
{
    char why[120];
    snprintf(why, sizeof why, "no series is as long as a block, %.4g s: run longer, or give shorter blocks",
             out->block);
    return extremes_refuse(out, why);
}

fram_status extremes_refuse_sample(extreme_result *out, const double *sorted, int32_t count, double shape)
{
    int32_t tied = shape > 0 ? extreme_law_tied(sorted, count, shape) : 0;
    char why[160];
    if (sorted[0] == sorted[count - 1]) {
        snprintf(why, sizeof why, "no law fits: all %d values are equal", (int)count);
        return extremes_refuse(out, why);
    }
    if (tied == 0)
        return extremes_refuse(out, "no law fits: the likelihood of the values has no maximum");
    snprintf(why, sizeof why,
             "no law fits: %d of %d maxima are equal, %.*g, the least: they take longer blocks, or runs", (int)tied,
             (int)count, digits_of(sorted[0], sorted[count - 1] - sorted[0]), sorted[0]);
    return extremes_refuse(out, why);
}

void extremes_doubt_alike(extreme_result *out, bool idle)
{
    say(out, "%s",
        idle ? "Nothing is left to chance in these runs, which met no ice."
             : "The seed changes nothing in these runs: vary the ice.");
}

void extremes_cut_low(extreme_result *out, int levels, double least)
{
    bool cut = false;
    for (int i = 0; i < levels; i++) {
        if (out->level[i].level > least)
            continue;
        out->level[i] = none;
        cut = true;
    }
    if (cut)
        say(out, "Levels that are not over %.*g are not told: the law is one of what is over it.",
            digits_of(least, scale_of(out)), least);
}

/* Values are known up to `least` only, in some runs: levels from there on are not told, and `why` is (a sentence). */
static void cut_from(extreme_result *out, int levels, double least, const char *why)
{
    if (out->most_probable.level >= least)
        out->most_probable = none;
    for (int i = 0; i < levels; i++)
        if (out->level[i].level >= least)
            out->level[i] = none;
    out->answered = out->answered && isfinite(out->most_probable.level);
    say(out, "%s", why);
}

/* Under this shape estimates by likelihood depend on the largest values alone, and their profile is none of chi squared
   (Smith 1985). */
#define SHAPE_REGULAR (-0.5)

/* A fit that is at the bound of shapes comes this near to it. */
#define SHAPE_NEAR 1e-3

static void doubt_interval(extreme_result *out, const level_interval *i)
{
    if (!isfinite(i->low) || !isfinite(i->high))
        say(out, "The interval is open: the data do not bound the answer.");
    else if (i->high - i->low > 2 * WIDE * fabs(i->level))
        say(out, "The interval is %.0f %% of the level wide: the data do not carry the answer well.",
            100 * (i->high - i->low) / fabs(i->level));
}

void extremes_doubt(extreme_result *out, const extreme_request *ask, double time)
{
    if (ask->duration > FAR * time)
        say(out, "The duration is %.3g times as long as the data: the answer rests on the law, not on what was seen.",
            ask->duration / time);
    doubt_interval(out, &out->most_probable);
    bool rates = out->method == EXTREME_ACER || out->method == EXTREME_UPCROSSING;
    if (rates && acer_is_at_bound(&out->tail))
        say(out, "The power of the tail, %.2g, is at the bound of what was tried: its form is not determined.",
            out->tail.c);
    if (!rates && (out->law.kind == LAW_GEV || out->law.kind == LAW_PARETO) && ask->fit == FIT_LIKELIHOOD &&
        out->law.shape > FIT_SHAPE_MOST - SHAPE_NEAR)
        say(out, "The shape, %.2g, is at the bound of what was tried: the tail is heavier, and levels are too low.",
            out->law.shape);
    else if (!rates && (out->law.kind == LAW_GEV || out->law.kind == LAW_PARETO) && out->law.shape > 0.5)
        say(out, "The tail is so heavy (shape %.2g) that its variance is infinite.", out->law.shape);
    if (!rates && ask->fit == FIT_LIKELIHOOD && (out->law.kind == LAW_GEV || out->law.kind == LAW_PARETO) &&
        out->law.shape < SHAPE_REGULAR) {
        double end = out->law.location - out->law.scale / out->law.shape;
        say(out,
            "The law ends at %.*g (shape %.2g): under -0.5 likelihood has no interval (Smith 1985), and levels may be "
            "too low.",
            digits_of(end, out->law.scale), end, out->law.shape);
    }
    if (out->sample < 2 * LAW_VALUES_LEAST)
        say(out, "The sample is small (%d): its interval is a guess of the right size.", (int)out->sample);
}

/* any: the generalized law of the sample. */
static bool against_gumbel(const double *sorted, int32_t count, extreme_law *any)
{
    extreme_law gumbel;
    return extreme_law_fit(LAW_GUMBEL, FIT_LIKELIHOOD, sorted, count, 0, &gumbel) &&
           extreme_law_fit(LAW_GEV, FIT_LIKELIHOOD, sorted, count, 0, any) &&
           2 * (extreme_law_cost(&gumbel, sorted, count) - extreme_law_cost(any, sorted, count)) > RATIO;
}

bool extremes_against_gumbel(const double *sorted, int32_t count)
{
    extreme_law any;
    return against_gumbel(sorted, count, &any);
}

void extremes_doubt_gumbel(extreme_result *out, const double *sorted, int32_t count)
{
    extreme_law any;
    if (against_gumbel(sorted, count, &any))
        say(out,
            "The maxima speak against Gumbel's law (shape %.2g by gev, likelihood ratio at 5 %%): its levels are %s.",
            any.shape, any.shape < 0 ? "too high" : "too low");
}

/* Expected numbers of peaks above the largest that was seen: with more it is as low as that once in a thousand samples,
   with less as high. */
#define ABOVE_MOST 6.907755278982137
#define ABOVE_LEAST 1e-3

void extremes_doubt_largest(extreme_result *out, const double *sorted, int32_t count)
{
    double largest = sorted[count - 1], above = count * real_exp(-extreme_law_exponent(&out->law, largest));
    int digits = digits_of(largest, out->law.scale);
    if (above > ABOVE_MOST)
        say(out, "By this law %.3g peaks would lie above the largest that was seen, %.*g: its levels are too high.",
            above, digits, largest);
    else if (above < ABOVE_LEAST)
        say(out,
            "By this law the largest peak that was seen, %.*g, is passed once in %.2g samples as large as this one: "
            "its levels are too low.",
            digits, largest, 1 / above);
}

void extremes_cut_parted(extreme_result *out, int levels, int32_t parted, int32_t runs, bool offset, double least)
{
    char why[240];
    int used = snprintf(why, sizeof why, "Lines parted in %d of %d runs, ", (int)parted, (int)runs);
    char *rest = why + used;
    size_t room = sizeof why - (size_t)used;
    if (parted == 0)
        return;
    if (offset)
        snprintf(rest, room,
                 "and the vessel drifted on from there: levels of its offset are not told. Lines without breaking_load "
                 "tell them.");
    else if (least < HUGE_VAL)
        snprintf(rest, room,
                 "whose tensions from there on are those of a mooring with fewer lines: levels from %s on are not "
                 "told. Lines without breaking_load tell them.",
                 load_text_of(least, digits_of(least, scale_of(out))).text);
    else
        snprintf(rest, room, "whose tensions from there on are those of a mooring with fewer lines.");
    cut_from(out, levels, offset ? -HUGE_VAL : least, why);
}

/* So many of the draws of a bootstrap must have a fit. */
#define FITTED_LEAST 0.9

void extremes_doubt_tail(extreme_result *out, const acer_doubt *doubt)
{
    if (doubt->fitted < FITTED_LEAST)
        say(out, "No law of the tail fits %.0f %% of the draws of the bootstrap: the data do not carry the answer.",
            100 * (1 - doubt->fitted));
    if (doubt->upper_differs)
        say(out,
            "The upper half of the levels alone gives %.*g: the tail does not go on as it begins, and the data do not "
            "carry the answer.",
            digits_of(doubt->upper, scale_of(out)), doubt->upper);
}

/* Whether what stands in the way of an answer may come of the time scale, by which goes what is not asked for: not
   where a threshold that was asked for has too few values over it for any. */
static bool goes_by_scale(const extreme_result *out, const extreme_request *ask, const series_set *s)
{
    const bool reached = isnan(ask->threshold) || series_values_over(s, ask->threshold) >= LAW_VALUES_LEAST;
    switch (out->method) {
    case EXTREME_GUMBEL:
    case EXTREME_GEV:
        return !(ask->block > 0);
    case EXTREME_POT:
        return !(ask->separation > 0) && reached;
    case EXTREME_ACER:
        return out->too_few_scales || (ask->order == 0 && reached);
    case EXTREME_UPCROSSING:
        return out->too_few_scales;
    default:
        return false;
    }
}

fram_status extremes_doubt_series(context *ctx, extreme_result *out, const extreme_request *ask, const series_set *s,
                                  fram_error *error)
{
    double deviations = 0;
    if (!out->answered && !goes_by_scale(out, ask, s))
        return FRAM_OK;
    fram_status status = halves_differ(ctx, s, &deviations, error);
    if (status != FRAM_OK || !(deviations > 0))
        return status;
    char refusal[sizeof out->note];
    memcpy(refusal, out->note, sizeof refusal);
    if (!out->answered)
        out->note[0] = '\0';
    say(out,
        "The means of the two halves differ by %.2g times what their batches scatter: the series is not stationary "
        "(leave its start out?).",
        deviations);
    if (!out->answered)
        say(out, "Its time scale, by which blocks and batches go, may be that of this change. %s", refusal);
    return FRAM_OK;
}
