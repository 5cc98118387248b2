#include "study/study_answers.h"

#include "base/number_text.h"
#include "study/cells.h"
#include "study/extremes_notes.h"
#include "study/study_extremes.h"

#include <math.h>
#include <string.h>

/* Figures that have extremes. */
const run_figure study_rare[STUDY_RARE] = {ROW_load_largest, ROW_offset_largest, ROW_line_tension_largest};

static void answer_interval(const study_folder *f, text_buffer *b, const level_interval *i)
{
    cell_end(f->ctx, b, i->level);
    cell_end(f->ctx, b, i->low);
    cell_end(f->ctx, b, i->high);
}

/* ---- extremes ---- */

fram_status study_values(const study_folder *f, const condition_rows *conditions, int32_t condition, run_figure figure,
                         double_array *out, fram_error *error)
{
    array_clear(out);
    for (int32_t i = 0; i < conditions[condition].rows.count; i++) {
        double x = conditions[condition].rows.data[i].figure[figure];
        if (isfinite(x) && !array_push(f->ctx, out, x))
            return error_memory(error);
    }
    return FRAM_OK;
}

static fram_status collect_values(const study_folder *f, const condition_rows *conditions, run_figure figure,
                                  condition_maxima *out, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t c = 0; c < f->s->conditions && status == FRAM_OK; c++)
        status = study_values(f, conditions, c, figure, &out[c].value, error);
    return status;
}

static fram_status ask_extreme(const study_folder *f, const double_array *of, double block, extreme_result *out,
                               fram_error *error)
{
    const study_extremes *x = &f->s->extremes;
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = x->duration;
    ask.confidence = x->confidence;
    ask.levels = x->levels;
    memcpy(ask.probability, x->level, sizeof x->level);
    return extremes_of_maxima(f->ctx, of->data, of->count, block, x->gev ? EXTREME_GEV : EXTREME_GUMBEL, &ask, out,
                              error);
}

/* A line holds no more than its breaking load: what the ice asks for above that is not in the tensions of such runs,
   which tell no holding load either: one that parts in the transient leaves those of the other lines alone.  And a
   vessel whose line has parted is held by the others, or drifts: its offsets are those of the time until a run ends. */
static void cut_at_parting(const condition_rows *of, run_figure figure, int levels, extreme_result *out)
{
    bool tension = figure == ROW_line_tension_largest;
    const parted_lines parted = study_parted_lines(of);
    extremes_cut_parted(out, levels, parted.runs, (int32_t)out->sample, !tension, parted.least);
}

bool study_met_no_ice(const condition_rows *of)
{
    for (int32_t i = 0; i < of->rows.count; i++)
        if (of->rows.data[i].figure[ROW_load_largest] > 0)
            return false;
    return true;
}

/* Runs of a condition that all came out the same, in all that they tell: one figure may be equal by itself, as where
   lines part at the same load whatever the ice does.  Where that figure saw nothing, the ice may be what was missed. */
static void doubt_alike(const condition_rows *of, const double_array *value, extreme_result *out)
{
    bool enough = value->count >= LAW_VALUES_LEAST && value->data[0] > 0;
    if (enough && run_rows_alike(of->rows.data, of->rows.count) && study_parted_lines(of).runs == 0)
        extremes_doubt_alike(out, study_met_no_ice(of));
}

fram_status study_extreme(const study_folder *f, const condition_rows *conditions, int32_t condition, run_figure figure,
                          double block, extreme_result *out, fram_error *error)
{
    double_array value = {0};
    *out = (extreme_result){.answered = false};
    fram_status status = study_values(f, conditions, condition, figure, &value, error);
    if (status == FRAM_OK)
        status = ask_extreme(f, &value, block, out, error);
    if (status == FRAM_OK)
        doubt_alike(&conditions[condition], &value, out);
    if (status == FRAM_OK && value.count > 0 && figure != ROW_load_largest)
        cut_at_parting(&conditions[condition], figure, f->s->extremes.levels, out);
    array_free(f->ctx, &value);
    return status;
}

static bool any_values(const study_folder *f, const condition_maxima *of)
{
    for (int32_t c = 0; c < f->s->conditions; c++)
        if (of[c].value.count > 0)
            return true;
    return false;
}

static void extremes_heads(const study_folder *f, text_buffer *b)
{
    text_add(f->ctx, b, "condition,figure,unit,method,runs,block[s],duration[s],most_probable,low,high");
    for (int i = 0; i < f->s->extremes.levels; i++) {
        char p[NUMBER_TEXT_SIZE];
        real_to_text(f->s->extremes.level[i], p);
        text_format(f->ctx, b, ",below_%s,below_%s_low,below_%s_high", p, p, p);
    }
    text_add(f->ctx, b, ",note\n");
}

static fram_status answer_extremes(const study_folder *f, const condition_rows *conditions, run_figure figure,
                                   const condition_maxima *of, text_buffer *b, fram_error *error)
{
    const study_extremes *x = &f->s->extremes;
    for (int32_t c = 0; c < f->s->conditions; c++) {
        extreme_result r;
        fram_status status = study_extreme(f, conditions, c, figure, of[c].block, &r, error);
        if (status != FRAM_OK)
            return status;
        text_format(f->ctx, b, "%d,%s,%s,%s,%d", (int)c + 1, run_figure_name(figure), run_figure_unit(figure),
                    extreme_method_name(r.method), (int)of[c].value.count);
        /* A difference of two times, whose last digits are rounding. */
        char block[NUMBER_TEXT_SIZE];
        real_to_digits(of[c].block, 12, block);
        text_format(f->ctx, b, ",%s", block);
        cell_end(f->ctx, b, x->duration);
        answer_interval(f, b, &r.most_probable);
        for (int i = 0; i < x->levels; i++)
            answer_interval(f, b, &r.level[i]);
        cell_quoted(f->ctx, b, r.note);
        text_add(f->ctx, b, "\n");
    }
    return FRAM_OK;
}

static fram_status answer_annual(const study_folder *f, const condition_rows *conditions, run_figure figure,
                                 const double *block, text_buffer *b, fram_error *error)
{
    const study_extremes *x = &f->s->extremes;
    annual_answer answer[STUDY_LEVELS_MOST];
    fram_status status = study_annual(f, conditions, figure, block, answer, error);
    for (int i = 0; i < x->annuals && status == FRAM_OK; i++) {
        text_format(f->ctx, b, "%s,%s,%s", run_figure_name(figure), run_figure_unit(figure), x->gev ? "gev" : "gumbel");
        cell_end(f->ctx, b, x->annual[i]);
        answer_interval(f, b, &answer[i].level);
        if (answer[i].why[0])
            cell_quoted(f->ctx, b, answer[i].why);
        text_add(f->ctx, b, answer[i].why[0] ? "\n" : ",\n");
    }
    return status;
}

static fram_status write_extremes(const study_folder *f, const condition_rows *conditions, fram_error *error)
{
    text_buffer table = {0}, year = {0};
    condition_maxima *of = memory_array(f->ctx, (size_t)f->s->conditions, sizeof *of);
    double *block = NULL;
    fram_status status = of ? study_blocks(f, &block, error) : error_memory(error);
    for (int32_t c = 0; status == FRAM_OK && c < f->s->conditions; c++)
        of[c].block = block[c];
    extremes_heads(f, &table);
    text_add(f->ctx, &year, "figure,unit,method,annual_probability,level,low,high,note\n");
    for (int i = 0; i < STUDY_RARE && status == FRAM_OK; i++) {
        status = collect_values(f, conditions, study_rare[i], of, error);
        if (status != FRAM_OK || !any_values(f, of))
            continue;
        status = answer_extremes(f, conditions, study_rare[i], of, &table, error);
        if (status == FRAM_OK && f->s->extremes.annuals > 0)
            status = answer_annual(f, conditions, study_rare[i], block, &year, error);
    }
    if (status == FRAM_OK)
        status = study_table_write(f, "extremes.csv", &table, error);
    if (status == FRAM_OK && f->s->extremes.annuals > 0)
        status = study_table_write(f, "annual.csv", &year, error);
    for (int32_t c = 0; of && c < f->s->conditions; c++)
        array_free(f->ctx, &of[c].value);
    memory_free(f->ctx, of);
    memory_free(f->ctx, block);
    text_free(f->ctx, &table);
    text_free(f->ctx, &year);
    return status;
}

fram_status study_answers_write(const study_folder *f, const condition_rows *conditions, fram_error *error)
{
    fram_status status = FRAM_OK;
    if (f->s->extremes.asked)
        status = write_extremes(f, conditions, error);
    else
        study_table_remove(f, "extremes.csv");
    if (f->s->extremes.annuals == 0)
        study_table_remove(f, "annual.csv");
    if (f->s->design.kind == DESIGN_NONE)
        study_table_remove(f, "sensitivity.csv");
    else if (status == FRAM_OK)
        status = study_sensitivity_write(f, conditions, error);
    return status;
}
