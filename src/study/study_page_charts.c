/* Charts of the page of a study: runs as dots, means with their intervals. */
#include "study/key_names.h"
#include "study/study_page_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* More dots than that nobody tells apart, and the page grows by hundreds of bytes with each. */
enum { DOTS_MOST = 2000, BARS_MOST = 500 };

/* Of one group of conditions, or of all where they are no series. */
typedef struct chart_group {
    double_array x, mean, low, high, seed_x, seed_y, bar_x, bar_y;
    char name[PAGE_GROUP_SIZE];
    bool intervals; /* any */
} chart_group;

typedef struct study_charts {
    study_page *p;
    bool is_series, dots;
    study_series series;
    int32_t groups;
    chart_group group[SERIES_MOST];
} study_charts;

static void groups_free(study_charts *w)
{
    for (int32_t g = 0; g < w->groups; g++) {
        chart_group *of = &w->group[g];
        double_array *all[] = {&of->x,      &of->mean,   &of->low,   &of->high,
                               &of->seed_x, &of->seed_y, &of->bar_x, &of->bar_y};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++)
            array_free(w->p->f->ctx, all[i]);
    }
}

void page_group_name(study_page *p, const study_series *of, int32_t group, bool brief, char out[PAGE_GROUP_SIZE])
{
    const study *s = p->f->s;
    size_t used = 0;
    out[0] = '\0';
    for (int32_t k = 0; k < s->keys.count && used < PAGE_GROUP_SIZE; k++) {
        char value[PAGE_KEY_SIZE];
        const char *key = s->keys.data[k], *unit = key_unit(key), *dot = brief ? strrchr(key, '.') : NULL;
        if (k == of->key || !study_series_is_group_key(s, of, k))
            continue;
        page_key_text(p, group * of->length, k, value);
        used += (size_t)snprintf(out + used, PAGE_GROUP_SIZE - used, "%s%s %s%s%s", used > 0 ? ", " : "",
                                 dot ? dot + 1 : key, value, *unit ? " " : "", unit);
    }
}

static void name_group(study_charts *w, int32_t g)
{
    char *name = w->group[g].name;
    name[0] = '\0';
    if (w->is_series)
        page_group_name(w->p, &w->series, g, true, name);
    if (!name[0])
        snprintf(name, PAGE_GROUP_SIZE, "mean over seeds");
}

/* A condition at x: its mean, its interval as a band's rows and as an upright bar, and its runs. */
static bool add_condition(study_charts *w, chart_group *g, int32_t condition, double x, const page_figure *figure)
{
    context *ctx = w->p->f->ctx;
    const condition_rows *of = &w->p->conditions[condition];
    seed_interval i = page_interval(w->p, condition, figure);
    double half = isfinite(i.half) ? i.half : 0, none = (double)NAN;
    /* Of sizes, whose means are none below 0; none where all runs failed. */
    double low = isfinite(i.mean) ? fmax(i.mean - half, fmin(i.mean, 0)) : none;
    const double bar_x[3] = {x, x, x}, bar_y[3] = {low, i.mean + half, none};
    bool good = array_push(ctx, &g->x, x) && array_push(ctx, &g->mean, i.mean) && array_push(ctx, &g->low, low) &&
                array_push(ctx, &g->high, i.mean + half);
    for (int k = 0; k < 3 && good && half > 0 && w->p->f->s->conditions <= BARS_MOST; k++)
        good = array_push(ctx, &g->bar_x, bar_x[k]) && array_push(ctx, &g->bar_y, bar_y[k]);
    g->intervals = g->intervals || half > 0;
    /* A single run is its mean. */
    for (int32_t k = 0; k < of->rows.count && good && w->dots && of->rows.count > 1; k++) {
        double y = of->rows.data[k].figure[figure->figure] * figure->factor;
        if (isfinite(y))
            good = array_push(ctx, &g->seed_x, x) && array_push(ctx, &g->seed_y, y);
    }
    return good;
}

static bool collect(study_charts *w, const page_figure *figure)
{
    const study *s = w->p->f->s;
    for (int32_t g = 0; g < w->groups; g++) {
        chart_group *of = &w->group[g];
        double_array *all[] = {&of->x,      &of->mean,   &of->low,   &of->high,
                               &of->seed_x, &of->seed_y, &of->bar_x, &of->bar_y};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++)
            array_clear(all[i]);
        of->intervals = false;
    }
    for (int32_t c = 0; c < s->conditions; c++) {
        double x = c + 1.0;
        if (w->is_series)
            (void)study_series_number(study_value(s, c, w->series.key), &x);
        if (!add_condition(w, &w->group[w->is_series ? c / w->series.length : 0], c, x, figure))
            return false;
    }
    return true;
}

enum { LINES_OF_GROUP = 3 };

/* Of a series the mean is a line in the band of its interval; else dots that nothing joins, with upright bars. */
static int32_t group_lines(const study_charts *w, int32_t g, chart_line *out)
{
    const chart_group *of = &w->group[g];
    bool one = w->groups == 1;
    /* The legend names what is there: single runs have neither intervals nor others beside them. */
    const char *interval = of->intervals ? "interval" : "", *runs = of->seed_x.count > 0 ? "seeds" : "";
    chart_line band = chart_line_make(one ? interval : "", of->x.data, of->low.data, of->x.count, false);
    band.style = CHART_BAND;
    band.y2 = of->high.data;
    chart_line bars = chart_line_make(interval, of->bar_x.data, of->bar_y.data, of->bar_x.count, true);
    chart_line seeds = chart_line_make(one ? runs : "", of->seed_x.data, of->seed_y.data, of->seed_x.count, false);
    seeds.style = CHART_POINTS;
    chart_line mean = chart_line_make(of->name, of->x.data, of->mean.data, of->x.count, true);
    mean.style = w->is_series ? CHART_LINE : CHART_POINTS;
    out[0] = w->is_series ? band : bars;
    out[1] = seeds;
    out[2] = mean;
    /* The first colour of the palette is for what lies behind. */
    for (int i = 0; i < LINES_OF_GROUP; i++)
        out[i].colour = one ? (i == 0 && w->is_series ? 1 : i == 1 ? 2 : 3) : g + 2;
    return LINES_OF_GROUP;
}

static fram_status add_chart(study_charts *w, const page_figure *figure, fram_error *error)
{
    char label[64], across[KEY_TEXT_SIZE] = "condition";
    chart_line lines[SERIES_MOST * LINES_OF_GROUP];
    int32_t count = 0;
    if (!collect(w, figure))
        return error_memory(error);
    for (int32_t g = 0; g < w->groups; g++)
        count += group_lines(w, g, lines + count);
    snprintf(label, sizeof label, "%s [%s]", figure->name, figure->unit);
    const study *s = w->p->f->s;
    if (w->is_series)
        key_with_unit(s->keys.data[w->series.key], across);
    chart c =
        chart_make(figure->name, w->dots ? "a dot is a run" : "too many runs for dots", across, label, lines, count);
    return html_chart(&w->p->page, &c, false, error);
}

fram_status page_add_charts(study_page *p, const bool *has, fram_error *error)
{
    study_charts w = {.p = p};
    int64_t runs, failed;
    fram_status status = FRAM_OK;
    page_count_runs(p, &runs, &failed);
    w.dots = runs <= DOTS_MOST;
    w.is_series = study_series_find(p->f->s, &w.series);
    w.groups = w.is_series ? w.series.groups : 1;
    for (int32_t g = 0; g < w.groups; g++)
        name_group(&w, g);
    int32_t charts = 0;
    for (int i = 0; i < PAGE_FIGURES && status == FRAM_OK; i++) {
        if (!has[i])
            continue;
        if (charts++ == 0) {
            html_section(&p->page, "Seeds and means");
            html_grid_begin(&p->page);
        }
        status = add_chart(&w, &p->figures[i], error);
    }
    if (charts > 0)
        html_grid_end(&p->page);
    groups_free(&w);
    return status;
}
