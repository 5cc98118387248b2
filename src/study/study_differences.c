/* differences.csv and its part of the page: conditions that are compared, run by run of the same seed. */
#include "study/cells.h"
#include "study/differences.h"
#include "study/study_page_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void figure_values(const condition_rows *of, run_figure figure, int32_t count, double *out)
{
    for (int32_t i = 0; i < count; i++)
        out[i] = of->rows.data[i].figure[figure];
}

/* Values of a figure of both conditions, in room for the seeds of either. */
typedef struct pair_values {
    double *a, *b;
    int32_t a_count, b_count, both;
} pair_values;

static bool take_pair(const study_folder *f, const condition_rows *conditions, const condition_pair *p,
                      run_figure figure, pair_values *out)
{
    const condition_rows *a = &conditions[p->condition], *b = &conditions[p->reference];
    *out = (pair_values){.a_count = a->rows.count, .b_count = b->rows.count};
    out->both = out->a_count < out->b_count ? out->a_count : out->b_count;
    double *room = memory_array(f->ctx, (size_t)out->a_count + (size_t)out->b_count + 1, sizeof *room);
    if (!room)
        return false;
    out->a = room;
    out->b = room + out->a_count;
    figure_values(a, figure, out->a_count, out->a);
    figure_values(b, figure, out->b_count, out->b);
    return true;
}

/* ---- the table ---- */

static bool add_line(const study_folder *f, const condition_rows *conditions, const condition_pair *p,
                     run_figure figure, text_buffer *b)
{
    pair_values v;
    int32_t pairs, freedom;
    if (!take_pair(f, conditions, p, figure, &v))
        return false;
    double confidence = f->s->seeds.confidence;
    seed_interval paired = difference_of_pairs(v.a, v.b, v.both, confidence, &pairs);
    seed_interval means = difference_of_means(v.a, v.a_count, v.b, v.b_count, confidence, &freedom);
    memory_free(f->ctx, v.a);
    if (!isfinite(means.mean))
        return true;
    text_format(f->ctx, b, "%d,%d,%s,%s,%s,%d", (int)p->condition + 1, (int)p->reference + 1,
                p->key >= 0 ? f->s->keys.data[p->key] : "", run_figure_name(figure), run_figure_unit(figure),
                (int)pairs);
    cell_number(f->ctx, b, paired.mean);
    cell_number(f->ctx, b, paired.half);
    cell_number(f->ctx, b, means.mean);
    cell_number(f->ctx, b, means.half);
    text_format(f->ctx, b, ",%d\n", (int)freedom);
    return true;
}

static fram_status write_lines(const study_folder *f, const condition_rows *conditions, const condition_pairs *pairs,
                               fram_error *error)
{
    text_buffer b = {0};
    bool good = true;
    text_add(f->ctx, &b,
             "condition,less,key,figure,unit,pairs,difference,half,means_difference,means_half,"
             "means_freedom\n");
    for (int32_t i = 0; i < pairs->count && good; i++)
        for (int figure = 0; figure < PAGE_FIGURES && good; figure++)
            good = add_line(f, conditions, &pairs->data[i], page_figures[figure].figure, &b);
    fram_status status = good ? study_table_write(f, "differences.csv", &b, error) : error_memory(error);
    text_free(f->ctx, &b);
    return status;
}

fram_status study_differences_write(const study_folder *f, const condition_rows *conditions, fram_error *error)
{
    condition_pairs pairs = {0};
    fram_status status = study_pairs(f->ctx, f->s, &pairs) ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK && pairs.count > 0)
        status = write_lines(f, conditions, &pairs, error);
    else if (status == FRAM_OK)
        study_table_remove(f, "differences.csv");
    array_free(f->ctx, &pairs);
    return status;
}

/* ---- on the page ---- */

/* "-359 ± 292" and "lower" under it: a word where the interval does not hold 0. */
static bool add_cell(study_page *p, const condition_pair *pair, const page_figure *figure)
{
    pair_values v;
    int32_t pairs;
    char text[PAGE_INTERVAL_SIZE];
    if (!take_pair(p->f, p->conditions, pair, figure->figure, &v))
        return false;
    seed_interval of = difference_of_pairs(v.a, v.b, v.both, p->f->s->seeds.confidence, &pairs);
    memory_free(p->f->ctx, v.a);
    of.mean *= figure->factor;
    of.half *= figure->factor;
    page_interval_text(of, text);
    text_format(p->f->ctx, &p->page.text, "<td>%s%s</td>", text,
                of.mean > of.half    ? "<br>higher"
                : of.mean < -of.half ? "<br>lower"
                                     : "");
    return true;
}

static bool add_pair(study_page *p, const condition_pair *pair, const bool *has)
{
    char text[32];
    bool good = true;
    page_row_begin(p, pair->condition);
    snprintf(text, sizeof text, "%d", (int)pair->reference + 1);
    html_cell(&p->page, text);
    char key[PAGE_NAME_SIZE];
    page_breakable(pair->key >= 0 ? p->f->s->keys.data[pair->key] : "several", key);
    page_text_cell(p, key);
    for (int i = 0; i < PAGE_FIGURES && good; i++)
        if (has[i])
            good = add_cell(p, pair, &p->figures[i]);
    html_row_end(&p->page);
    return good;
}

static bool add_difference_table(study_page *p, const condition_pairs *pairs, const bool *has)
{
    const char *heads[PAGE_FIGURES + 2] = {"less no.", "other key"};
    char names[PAGE_FIGURES][64];
    int32_t count = 2;
    bool good = true;
    html_section(&p->page, "Differences");
    for (int i = 0; i < PAGE_FIGURES; i++) {
        snprintf(names[i], sizeof names[i], "%s [%s]", p->figures[i].name, p->figures[i].unit);
        if (has[i])
            heads[count++] = names[i];
    }
    page_table_begin(p, heads, count);
    for (int32_t i = 0; i < pairs->count && i < CONDITIONS_OF_TABLE && good; i++)
        good = add_pair(p, &pairs->data[i], has);
    page_table_end(p);
    double confidence = p->f->s->seeds.confidence;
    html_paragraph(
        &p->page,
        "A condition less, for each key, the first one that differs from it in that key alone, or each one before it "
        "where few conditions differ in several: the mean of the differences of runs of the same seed, with half its "
        "interval (Student's t of pairs). \"higher\" and \"lower\": the interval of %g %% does not hold 0; of %.0f "
        "such intervals of what differs in nothing one does so by chance. differences.csv has them too, and those of "
        "means without pairs (Welch's).",
        100 * confidence, 1 / (1 - confidence));
    if (pairs->count > CONDITIONS_OF_TABLE)
        html_paragraph(&p->page, "The first %d; differences.csv has all.", CONDITIONS_OF_TABLE);
    return good;
}

/* Where conditions that can be compared have two runs. */
static bool has_two_runs(const study_page *p, const condition_pairs *pairs)
{
    for (int32_t i = 0; i < pairs->count; i++)
        if (p->conditions[pairs->data[i].condition].rows.count > 1 &&
            p->conditions[pairs->data[i].reference].rows.count > 1)
            return true;
    return false;
}

fram_status page_add_differences(study_page *p, const bool *has, fram_error *error)
{
    condition_pairs pairs = {0};
    bool good = study_pairs(p->f->ctx, p->f->s, &pairs);
    if (good && has_two_runs(p, &pairs))
        good = add_difference_table(p, &pairs, has);
    array_free(p->f->ctx, &pairs);
    return good ? FRAM_OK : error_memory(error);
}
