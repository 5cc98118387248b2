/* Levels of a year over all conditions, as far as their runs carry them. */
#include "base/load_unit.h"
#include "base/number_text.h"
#include "study/extremes_notes.h"
#include "study/study_answers.h"
#include "study/study_extremes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The first condition that occurs in which lines part, of tensions below the level, and how; -1 without. */
static int32_t find_parting(const study *s, const condition_rows *conditions, double level, parted_lines *parted)
{
    for (int32_t c = 0; c < s->conditions; c++) {
        if (!(s->extremes.hours.data[c] > 0))
            continue;
        *parted = study_parted_lines(&conditions[c]);
        if (parted->runs > 0 && level >= parted->least)
            return c;
    }
    return -1;
}

static void say_lack(const annual_lack *lack, const condition_rows *conditions, annual_answer *out)
{
    const condition_rows *of = &conditions[lack->condition];
    if (lack->runs > 0)
        snprintf(
            out->why, sizeof out->why,
            "No answer: the data do not carry this level by gev: it is so rare that %d runs of condition %d, which "
            "has %d, would tell the shape of its tail; more seeds, or gumbel.",
            (int)lack->runs, (int)lack->condition + 1, (int)lack->there);
    else if (lack->same && !run_rows_alike(of->rows.data, of->rows.count))
        snprintf(out->why, sizeof out->why,
                 "No answer: condition %d occurs and has no fit: all its %d values are equal.",
                 (int)lack->condition + 1, (int)lack->there);
    else if (lack->same)
        snprintf(out->why, sizeof out->why,
                 "No answer: condition %d occurs and has no fit: its %d runs are the same; the seed changes nothing in "
                 "it: vary the ice.",
                 (int)lack->condition + 1, (int)lack->there);
    else if (lack->tied > 0)
        snprintf(out->why, sizeof out->why,
                 "No answer: condition %d occurs and has no fit: %d of %d largest values are equal, the least; longer "
                 "runs.",
                 (int)lack->condition + 1, (int)lack->tied, (int)lack->there);
    else
        snprintf(out->why, sizeof out->why, "No answer: condition %d occurs and has no fit: more seeds.",
                 (int)lack->condition + 1);
}

/* Where lines part, tensions go on as those of a mooring with fewer lines, and offsets depend on when a run ends. */
static void check_parting(const study *s, const condition_rows *conditions, run_figure figure, annual_answer *out)
{
    bool tension = figure == ROW_line_tension_largest;
    parted_lines parted;
    if (figure == ROW_load_largest)
        return;
    int32_t at = find_parting(s, conditions, tension ? out->level.level : HUGE_VAL, &parted);
    if (at < 0)
        return;
    out->level = (level_interval){(double)NAN, (double)NAN, (double)NAN};
    int used = snprintf(out->why, sizeof out->why, "No answer: lines parted in %d runs of condition %d, ",
                        (int)parted.runs, (int)at + 1);
    if (tension)
        snprintf(out->why + used, sizeof out->why - (size_t)used,
                 "whose tensions from there on are those of a mooring with fewer lines: none from %s on is told; "
                 "lines without breaking_load tell it.",
                 load_text_of(parted.least, 3).text);
    else
        snprintf(out->why + used, sizeof out->why - (size_t)used,
                 "and the vessel drifted on from there; lines without breaking_load tell it.");
}

/* Whether a run of a condition that occurs saw any: where none did, the level is not zero but unknown. */
static bool any_seen(const study_extremes *x, const condition_maxima *of, int32_t count)
{
    for (int32_t c = 0; c < count; c++)
        for (int32_t i = 0; x->hours.data[c] > 0 && i < of[c].value.count; i++)
            if (of[c].value.data[i] > 0)
                return true;
    return false;
}

/* Levels of a year know no more than the fits of their conditions, and most of all that of the one that carries them:
   what would be told of it as one of that condition alone. */
static void doubt_carrier(const study_extremes *x, const condition_maxima *of, const annual_lack *by,
                          annual_answer *out)
{
    const condition_maxima *own = &of[by->carrier];
    const extreme_request ask = {.duration = by->duration, .confidence = x->confidence, .fit = FIT_LIKELIHOOD};
    extreme_result r;
    extremes_begin(&r, x->gev ? EXTREME_GEV : EXTREME_GUMBEL, &ask);
    r.sample = own->value.count;
    r.law = by->law;
    r.most_probable = out->level;
    extremes_doubt(&r, &ask, own->block * own->value.count);
    if (!x->gev)
        extremes_doubt_gumbel(&r, own->value.data, own->value.count);
    if (r.note[0])
        snprintf(out->why, sizeof out->why,
                 "%.0f %% of what exceeds it is of condition %d, in which it is one of %s h. %s", 100 * by->share,
                 (int)by->carrier + 1, plain_text_of(by->duration / EXTREME_HOUR, 3).text, r.note);
}

static void doubt_gumbel(const study_extremes *x, const condition_maxima *of, int32_t count, annual_answer *out)
{
    int32_t against = 0, occur = 0;
    for (int32_t c = 0; c < count; c++) {
        bool occurs = x->hours.data[c] > 0;
        occur += occurs;
        against += occurs && extremes_against_gumbel(of[c].value.data, of[c].value.count);
    }
    size_t used = strlen(out->why);
    if (against > 0)
        snprintf(out->why + used, sizeof out->why - used,
                 "%sThe largest values of %d of %d conditions speak against Gumbel's law (extremes.csv tells which).",
                 used > 0 ? " " : "", (int)against, (int)occur);
}

fram_status study_annual(const study_folder *f, const condition_rows *conditions, run_figure figure,
                         const double *block, annual_answer out[STUDY_LEVELS_MOST], fram_error *error)
{
    const study_extremes *x = &f->s->extremes;
    int32_t count = f->s->conditions;
    level_interval level[STUDY_LEVELS_MOST];
    annual_lack lack[STUDY_LEVELS_MOST];
    condition_maxima *of = memory_array(f->ctx, (size_t)count, sizeof *of);
    fram_status status = of ? FRAM_OK : error_memory(error);
    for (int32_t c = 0; c < count && status == FRAM_OK; c++) {
        of[c].block = block[c];
        of[c].idle = study_met_no_ice(&conditions[c]);
        status = study_values(f, conditions, c, figure, &of[c].value, error);
    }
    if (status == FRAM_OK)
        status = annual_levels(f->ctx, x, of, count, level, lack, error);
    for (int i = 0; i < x->annuals && status == FRAM_OK; i++) {
        out[i] = (annual_answer){.level = level[i]};
        if (lack[i].condition >= 0) {
            say_lack(&lack[i], conditions, &out[i]);
        } else if (!any_seen(x, of, count)) {
            out[i].level = (level_interval){(double)NAN, (double)NAN, (double)NAN};
            snprintf(out[i].why, sizeof out[i].why, "No answer: all runs saw none; longer runs, or more seeds.");
        } else if (isnan(level[i].level)) {
            snprintf(out[i].why, sizeof out[i].why,
                     "No answer: no condition that occurs met ice, and the runs of each are the same: nothing is left "
                     "to chance.");
        } else {
            if (lack[i].carrier >= 0)
                doubt_carrier(x, of, &lack[i], &out[i]);
            if (!x->gev)
                doubt_gumbel(x, of, count, &out[i]);
        }
        check_parting(f->s, conditions, figure, &out[i]);
    }
    for (int32_t c = 0; of && c < count; c++)
        array_free(f->ctx, &of[c].value);
    memory_free(f->ctx, of);
    return status;
}
