/* Rare loads on the page of a study: levels of the duration that is asked, and probability plots. */
#include "base/number_text.h"
#include "study/extremes_chart.h"
#include "study/study_page_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Probability plots on a page. */
enum { PLOTS_MOST = 24 };

static void level_cell(study_page *p, const level_interval *i, double factor)
{
    char level[HTML_NUMBER_SIZE], low[HTML_NUMBER_SIZE], high[HTML_NUMBER_SIZE], text[120] = "–";
    html_number_text(page_three_digits(i->level * factor), level);
    html_number_text(page_three_digits(i->low * factor), low);
    html_number_text(page_three_digits(i->high * factor), high);
    if (isfinite(i->level))
        snprintf(text, sizeof text, "%s (%s to %s)", level, isinf(i->low) ? "no end" : low,
                 isinf(i->high) ? "no end" : high);
    html_cell(&p->page, text);
}

/* The figure that a reader asks for first: tension of a vessel on lines, else the load. */
static int most_wanted(const bool *has) { return has[STUDY_RARE - 1] ? STUDY_RARE - 1 : 0; }

static fram_status add_levels(study_page *p, const page_figure *figure, const double *block, fram_error *error)
{
    const study_extremes *x = &p->f->s->extremes;
    const char *heads[STUDY_LEVELS_MOST + 3] = {"runs", "most probable"};
    char names[STUDY_LEVELS_MOST][48];
    int32_t count = 2;
    for (int i = 0; i < x->levels; i++, count++) {
        snprintf(names[i], sizeof names[i], "not exceeded by %.6g", x->level[i]);
        heads[count] = names[i];
    }
    heads[count++] = "";
    html_paragraph(&p->page, "%s [%s]", figure->name, figure->unit);
    page_table_begin(p, heads, count);
    fram_status status = FRAM_OK;
    for (int32_t c = 0; c < p->f->s->conditions && c < CONDITIONS_OF_TABLE && status == FRAM_OK; c++) {
        extreme_result r;
        char text[16];
        status = study_extreme(p->f, p->conditions, c, figure->figure, block[c], &r, error);
        page_row_begin(p, c);
        snprintf(text, sizeof text, "%d", (int)r.sample);
        html_cell(&p->page, text);
        level_cell(p, &r.most_probable, figure->factor);
        for (int i = 0; i < x->levels; i++)
            level_cell(p, &r.level[i], figure->factor);
        page_text_cell(p, r.note);
        html_row_end(&p->page);
    }
    page_table_end(p);
    return status;
}

static fram_status add_plots(study_page *p, const page_figure *figure, const double *block, fram_error *error)
{
    fram_status status = FRAM_OK;
    char quantity[64];
    int32_t drawn = 0;
    snprintf(quantity, sizeof quantity, "%s [%s]", figure->name, figure->unit);
    for (int32_t c = 0; c < p->f->s->conditions && drawn < PLOTS_MOST && status == FRAM_OK; c++) {
        extreme_result r;
        extremes_plot room;
        status = study_extreme(p->f, p->conditions, c, figure->figure, block[c], &r, error);
        if (status != FRAM_OK || !r.answered)
            continue;
        if (drawn++ == 0) {
            html_paragraph(&p->page,
                           "Probability plots of %s: values that lie on the line speak for the law; the bar is the "
                           "most probable largest value with its interval.%s",
                           figure->name, p->f->s->conditions > PLOTS_MOST ? " Of the first conditions." : "");
            html_grid_begin(&p->page);
        }
        chart plot = extremes_chart_make(&r, quantity, figure->factor, p->f->s->extremes.duration, &room);
        snprintf(room.title, sizeof room.title, "Condition %d, %s", (int)c + 1, extreme_method_name(r.method));
        status = html_chart(&p->page, &plot, false, error);
    }
    if (drawn > 0)
        html_grid_end(&p->page);
    return status;
}

static bool has_rare(const study_page *p, run_figure figure)
{
    for (int32_t c = 0; c < p->f->s->conditions; c++)
        for (int32_t i = 0; i < p->conditions[c].rows.count; i++)
            if (isfinite(p->conditions[c].rows.data[i].figure[figure]))
                return true;
    return false;
}

/* Levels of a year over all conditions. */
static fram_status add_annual(study_page *p, const bool *has, const double *block, fram_error *error)
{
    const study_extremes *x = &p->f->s->extremes;
    double hours = 0;
    fram_status status = FRAM_OK;
    for (int32_t c = 0; c < x->hours.count; c++)
        hours += x->hours.data[c];
    html_paragraph(
        &p->page,
        "Levels that are exceeded with a probability in a year, over all conditions with the hours that each "
        "lasts (%g in all; effective.yaml has them), with %g %% intervals; annual.csv has them too.",
        hours, 100 * x->confidence);
    const char *heads[] = {"", "unit", "probability in a year", "level", ""};
    html_table_begin(&p->page, heads, 5);
    for (int f = 0; f < STUDY_RARE && status == FRAM_OK; f++) {
        annual_answer answer[STUDY_LEVELS_MOST];
        page_figure figure = page_figure_of(p, study_rare[f]);
        if (!has[f])
            continue;
        status = study_annual(p->f, p->conditions, figure.figure, block, answer, error);
        for (int i = 0; i < x->annuals && status == FRAM_OK; i++) {
            char text[32];
            html_row_begin(&p->page);
            html_row_name(&p->page, figure.name);
            html_cell(&p->page, figure.unit);
            snprintf(text, sizeof text, "%.6g", x->annual[i]);
            html_cell(&p->page, text);
            level_cell(p, &answer[i].level, figure.factor);
            page_text_cell(p, answer[i].why);
            html_row_end(&p->page);
        }
    }
    html_table_end(&p->page);
    return status;
}

fram_status page_add_extremes(study_page *p, fram_error *error)
{
    const study_extremes *x = &p->f->s->extremes;
    bool has[STUDY_RARE];
    double *block = NULL;
    if (!x->asked)
        return FRAM_OK;
    fram_status status = study_blocks(p->f, &block, error);
    html_section(&p->page, "Rare loads");
    html_paragraph(&p->page,
                   "Levels of %s by %s law, fitted to the largest values of the runs of each condition, with %g %% "
                   "intervals: the most probable largest value, which is exceeded once on the average, and values that "
                   "are not exceeded with a probability.  They know of the scatter of seeds alone.",
                   duration_text_of(x->duration).text, x->gev ? "the generalized extreme value" : "Gumbel's",
                   100 * x->confidence);
    for (int i = 0; i < STUDY_RARE && status == FRAM_OK; i++) {
        page_figure figure = page_figure_of(p, study_rare[i]);
        has[i] = has_rare(p, study_rare[i]);
        if (has[i])
            status = add_levels(p, &figure, block, error);
    }
    if (status == FRAM_OK) {
        page_figure figure = page_figure_of(p, study_rare[most_wanted(has)]);
        status = add_plots(p, &figure, block, error);
    }
    if (status == FRAM_OK && x->annuals > 0)
        status = add_annual(p, has, block, error);
    memory_free(p->f->ctx, block);
    return status;
}
