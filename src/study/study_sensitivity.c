/* sensitivity.csv and "Sensitivity" on the page: which key moves which figure, of conditions that are a design for it.
 */
#include "study/cells.h"
#include "study/sensitivity.h"
#include "study/study_page_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Figures that keys move. */
static const run_figure moved[] = {ROW_load_mean, ROW_load_significant, ROW_load_largest, ROW_offset_largest,
                                   ROW_line_tension_largest};
enum { MOVED = sizeof moved / sizeof *moved };

/* What is told of a key: of Sobol's indices first order and total with the ends of their intervals, of Morris' effects
   mu, mu_star and sigma. */
enum { SOBOL_VALUES = 6, MORRIS_VALUES = 3 };
typedef struct sensitivity_row {
    run_figure figure;
    int32_t key;
    int32_t count;              /* rows of the design, or effects, that have values */
    double value[SOBOL_VALUES]; /* NaN without an answer */
    char note[160];             /* why there is none */
} sensitivity_row;
typedef ARRAY(sensitivity_row) sensitivity_rows;

static int index_values(const study_folder *f)
{
    return f->s->design.kind == DESIGN_SOBOL ? SOBOL_VALUES : MORRIS_VALUES;
}

/* ---- rows ---- */

/* Mean over the seeds of each condition, NaN without any; false: of all. */
static bool average(const study_folder *f, const condition_rows *conditions, run_figure figure, double *out)
{
    bool any = false;
    for (int32_t c = 0; c < f->s->conditions; c++) {
        double sum = 0;
        int32_t n = 0;
        for (int32_t i = 0; i < conditions[c].rows.count; i++) {
            double x = conditions[c].rows.data[i].figure[figure];
            sum += isfinite(x) ? x : 0;
            n += isfinite(x);
        }
        out[c] = n > 0 ? sum / n : (double)NAN;
        any = any || n > 0;
    }
    return any;
}

/* Why there are no indices. */
static void note_sobol(const study_folder *f, const sobol_index *of, sensitivity_row *row)
{
    if (isfinite(of->first) && isfinite(of->first_low))
        row->note[0] = '\0';
    else if (isfinite(of->first))
        snprintf(row->note, sizeof row->note, "No interval: too few rows have values that differ: a larger count.");
    else if (row->count < SOBOL_ROWS_LEAST)
        snprintf(
            row->note, sizeof row->note,
            "No answer: %d rows of the design have a value under each of their %d conditions: expected %d or more.",
            (int)row->count, (int)f->s->keys.count + 2, SOBOL_ROWS_LEAST);
    else
        snprintf(row->note, sizeof row->note, "No answer: all values are equal: no key moves them.");
}

static fram_status add_sobol(const study_folder *f, run_figure figure, const double *answer, sensitivity_rows *out,
                             fram_error *error)
{
    sobol_index of[SENSITIVITY_KEYS_MOST];
    int32_t rows = sobol_indices(f->ctx, answer, f->s->design.count, f->s->keys.count, of);
    for (int32_t k = 0; rows >= 0 && k < f->s->keys.count; k++) {
        sensitivity_row row = {
            figure,
            k,
            rows,
            {of[k].first, of[k].first_low, of[k].first_high, of[k].total, of[k].total_low, of[k].total_high},
            ""};
        note_sobol(f, &of[k], &row);
        if (!array_push(f->ctx, out, row))
            return error_memory(error);
    }
    return rows < 0 ? error_memory(error) : FRAM_OK;
}

static fram_status add_morris(const study_folder *f, run_figure figure, const double *answer, sensitivity_rows *out,
                              fram_error *error)
{
    morris_effect of[SENSITIVITY_KEYS_MOST];
    morris_effects(answer, f->s->design.point.data, f->s->design.count, f->s->keys.count, of);
    for (int32_t k = 0; k < f->s->keys.count; k++) {
        sensitivity_row row = {figure, k, of[k].count, {of[k].mu, of[k].mu_star, of[k].sigma}, ""};
        if (of[k].count < 2)
            snprintf(row.note, sizeof row.note, "%s",
                     of[k].count == 0 ? "No answer: no step of this key has values at both of its ends."
                                      : "No sigma: there is one effect, it takes two.");
        if (!array_push(f->ctx, out, row))
            return error_memory(error);
    }
    return FRAM_OK;
}

static fram_status find_rows(const study_folder *f, const condition_rows *conditions, sensitivity_rows *out,
                             fram_error *error)
{
    double *answer = memory_array(f->ctx, (size_t)f->s->conditions, sizeof *answer);
    fram_status status = answer ? FRAM_OK : error_memory(error);
    for (int i = 0; i < MOVED && status == FRAM_OK; i++) {
        if (!average(f, conditions, moved[i], answer))
            continue;
        status = f->s->design.kind == DESIGN_SOBOL ? add_sobol(f, moved[i], answer, out, error)
                                                   : add_morris(f, moved[i], answer, out, error);
    }
    memory_free(f->ctx, answer);
    return status;
}

/* ---- sensitivity.csv ---- */

static void write_row(const study_folder *f, const sensitivity_row *row, text_buffer *b)
{
    text_format(f->ctx, b, "%s,%s,%d", run_figure_name(row->figure), f->s->keys.data[row->key], (int)row->count);
    for (int i = 0; i < index_values(f); i++)
        cell_end(f->ctx, b, row->value[i]);
    if (row->note[0])
        cell_quoted(f->ctx, b, row->note);
    text_add(f->ctx, b, row->note[0] ? "\n" : ",\n");
}

fram_status study_sensitivity_write(const study_folder *f, const condition_rows *conditions, fram_error *error)
{
    text_buffer b = {0};
    sensitivity_rows rows = {0};
    fram_status status = find_rows(f, conditions, &rows, error);
    text_add(f->ctx, &b,
             f->s->design.kind == DESIGN_SOBOL
                 ? "figure,key,rows,first,first_low,first_high,total,total_low,total_high,note\n"
                 : "figure,key,effects,mu,mu_star,sigma,note\n");
    for (int32_t i = 0; i < rows.count; i++)
        write_row(f, &rows.data[i], &b);
    if (status == FRAM_OK)
        status = study_table_write(f, "sensitivity.csv", &b, error);
    array_free(f->ctx, &rows);
    text_free(f->ctx, &b);
    return status;
}

/* ---- the page ---- */

/* "0.52 (0.41 to 0.63)" */
static void add_index(study_page *p, const double *of)
{
    char text[64] = "–";
    if (isfinite(of[0]) && isfinite(of[1]))
        snprintf(text, sizeof text, "%.2f (%.2f to %.2f)", of[0], of[1], of[2]);
    else if (isfinite(of[0]))
        snprintf(text, sizeof text, "%.2f", of[0]);
    html_cell(&p->page, text);
}

static void add_sensitivity_row(study_page *p, const sensitivity_row *row)
{
    page_figure figure = page_figure_of(p, row->figure);
    html_row_begin(&p->page);
    html_row_name(&p->page, figure.name);
    html_cell(&p->page, p->f->s->keys.data[row->key]);
    if (p->f->s->design.kind == DESIGN_SOBOL) {
        add_index(p, &row->value[0]);
        add_index(p, &row->value[3]);
    } else {
        static const int order[MORRIS_VALUES] = {1, 0, 2};
        html_cell(&p->page, figure.unit);
        for (int i = 0; i < MORRIS_VALUES; i++)
            html_number(&p->page, page_three_digits(row->value[order[i]] * figure.factor));
    }
    html_cell(&p->page, row->note);
    html_row_end(&p->page);
}

static void add_sensitivity_table(study_page *p, const sensitivity_rows *rows)
{
    static const char *const of_sobol[] = {"figure", "key", "first order", "total", ""};
    static const char *const of_morris[] = {"figure", "key", "unit", "mu*", "mu", "sigma", ""};
    bool sobol = p->f->s->design.kind == DESIGN_SOBOL;
    html_table_begin(&p->page, sobol ? of_sobol : of_morris,
                     sobol ? sizeof of_sobol / sizeof *of_sobol : sizeof of_morris / sizeof *of_morris);
    for (int32_t i = 0; i < rows->count; i++)
        add_sensitivity_row(p, &rows->data[i]);
    html_table_end(&p->page);
    if (sobol)
        html_paragraph(&p->page,
                       "Sobol's indices, with 95 %% intervals (bootstrap): the part of the variance of a figure over "
                       "the conditions that goes with a key alone, and the part in which it takes any part. They lie "
                       "between 0 and 1, their estimates need not. The scatter between seeds counts as variance of "
                       "every key in the total.");
    else
        html_paragraph(&p->page,
                       "Morris' effects of a key over its whole range: mu* their mean size, mu their mean, and sigma "
                       "their standard deviation: large where the effect depends on the other keys or is no straight "
                       "line, and by the scatter between seeds.");
}

fram_status page_add_sensitivity(study_page *p, fram_error *error)
{
    sensitivity_rows rows = {0};
    if (p->f->s->design.kind == DESIGN_NONE)
        return FRAM_OK;
    fram_status status = find_rows(p->f, p->conditions, &rows, error);
    if (status == FRAM_OK && rows.count > 0) {
        html_section(&p->page, "Sensitivity");
        add_sensitivity_table(p, &rows);
    }
    array_free(p->f->ctx, &rows);
    return status;
}
