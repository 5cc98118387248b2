/* study.html: what a study says, for people: conditions with intervals, charts, seeds, the worst runs. */
#include "io/atomic_file.h"
#include "io/csv_read.h"
#include "io/html_page.h"
#include "model/mechanism.h"
#include "study/seeds.h"
#include "study/study_answers.h"
#include "study/study_worst.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Figures of the page, in its units. */
typedef struct page_figure {
    run_figure figure;
    const char *name, *unit;
    double factor;
} page_figure;
static const page_figure shown[] = {{ROW_load_mean, "Mean load", "kN", 1e-3},
                                    {ROW_load_significant, "Significant load", "kN", 1e-3},
                                    {ROW_load_largest, "Largest load", "kN", 1e-3},
                                    {ROW_offset_largest, "Largest offset", "m", 1},
                                    {ROW_line_tension_largest, "Largest line tension", "kN", 1e-3},
                                    {ROW_line_tension_range_equivalent, "Equivalent tension range", "kN", 1e-3},
                                    {ROW_thruster_power_mean, "Mean thruster power", "kW", 1e-3}};
enum { SHOWN = sizeof shown / sizeof *shown, WORST = 10, CONDITIONS_OF_TABLE = 500 };
/* More dots than that nobody tells apart, and the page grows by hundreds of bytes with each. */
enum { DOTS_MOST = 2000 };
/* An interval wider than this part of the mean calls for more seeds. */
#define WIDE 0.1

typedef struct study_page {
    const study_folder *f;
    const condition_rows *conditions;
    html_page page;
    double_array x, mean, low, high, seed_x, seed_y; /* of the chart in hand */
} study_page;

/* ---- numbers ---- */

static seed_interval interval_of(const study_page *p, int32_t condition, const page_figure *figure)
{
    const condition_rows *of = &p->conditions[condition];
    seed_interval out = {(double)NAN, (double)NAN};
    double *value = memory_array(p->f->ctx, (size_t)of->rows.count + 1, sizeof *value);
    for (int32_t i = 0; value && i < of->rows.count; i++)
        value[i] = of->rows.data[i].figure[figure->figure] * figure->factor;
    if (value)
        out = seed_interval_of(value, of->rows.count, p->f->s->seeds.confidence);
    memory_free(p->f->ctx, value);
    return out;
}

static bool has_figure(const study_page *p, const page_figure *figure)
{
    for (int32_t c = 0; c < p->f->s->conditions; c++) {
        double mean = interval_of(p, c, figure).mean;
        /* Vessels without thrusters have no power. */
        if (isfinite(mean) && (figure->figure != ROW_thruster_power_mean || mean > 0))
            return true;
    }
    return false;
}

/* Tables of many columns keep numbers in one piece, and are moved sideways where the window is narrow. */
static void wide_begin(study_page *p) { text_add(p->f->ctx, &p->page.text, "<div class=\"wide\">"); }
static void wide_end(study_page *p) { text_add(p->f->ctx, &p->page.text, "</div>\n"); }

/* ---- head and table ---- */

static void count_runs(const study_page *p, int64_t *runs, int64_t *failed)
{
    *runs = *failed = 0;
    for (int32_t c = 0; c < p->f->s->conditions; c++) {
        *runs += p->conditions[c].rows.count;
        for (int32_t i = 0; i < p->conditions[c].rows.count; i++)
            *failed += p->conditions[c].rows.data[i].failed;
    }
}

static void add_head(study_page *p)
{
    char text[64];
    int64_t runs, failed;
    count_runs(p, &runs, &failed);
    const char *slash = strrchr(p->f->s->scenario, '/');
    html_begin(&p->page, "Study", slash ? slash + 1 : p->f->s->scenario);
    html_figures_begin(&p->page);
    snprintf(text, sizeof text, "%d", (int)p->f->s->conditions);
    html_figure(&p->page, "conditions", text, "");
    snprintf(text, sizeof text, "%lld", (long long)runs);
    html_figure(&p->page, "runs", text, "");
    snprintf(text, sizeof text, "%lld", (long long)failed);
    html_figure(&p->page, "of them failed", text, "");
    snprintf(text, sizeof text, "%g", 100 * p->f->s->seeds.confidence);
    html_figure(&p->page, "confidence of the intervals", text, "%");
    html_figures_end(&p->page);
    html_paragraph(&p->page,
                   "Loads are the horizontal ice force on the vessel, averaged over output.averaging_window, after the "
                   "transient. A mean over seeds stands with half the width of its interval (Student's t).");
}

static void add_interval(study_page *p, seed_interval i)
{
    char mean[HTML_NUMBER_SIZE], half[HTML_NUMBER_SIZE], text[80];
    html_number_text(i.mean, mean);
    html_number_text(i.half, half);
    snprintf(text, sizeof text, "%s ± %s", mean, half);
    html_cell(&p->page, isfinite(i.half) ? text : isfinite(i.mean) ? mean : "–");
}

/* Half the interval of the mean load is a large part of it. */
static bool wants_seeds(const study_page *p, int32_t condition)
{
    seed_interval of = interval_of(p, condition, &shown[0]);
    return isfinite(of.mean) && of.mean != 0 && !(of.half <= WIDE * fabs(of.mean));
}

static void add_row(study_page *p, int32_t condition, const bool *has)
{
    char text[48];
    html_row_begin(&p->page);
    snprintf(text, sizeof text, "%d", (int)condition + 1);
    html_cell(&p->page, text);
    for (int32_t k = 0; k < p->f->s->keys.count; k++)
        html_cell(&p->page, study_value(p->f->s, condition, k));
    snprintf(text, sizeof text, "%d%s", (int)p->conditions[condition].rows.count,
             wants_seeds(p, condition) ? ", more" : "");
    html_cell(&p->page, text);
    for (int i = 0; i < SHOWN; i++)
        if (has[i])
            add_interval(p, interval_of(p, condition, &shown[i]));
    html_row_end(&p->page);
}

static void add_table(study_page *p, const bool *has)
{
    const char *heads[128] = {"no."};
    char names[SHOWN][64];
    int32_t count = 1;
    html_section(&p->page, "Conditions");
    text_add(p->f->ctx, &p->page.text,
             "<style>.wide{overflow-x:auto}.wide td,.wide code{overflow-wrap:normal;white-space:nowrap}</style>\n");
    wide_begin(p);
    for (int32_t k = 0; k < p->f->s->keys.count && count < 100; k++)
        heads[count++] = p->f->s->keys.data[k];
    heads[count++] = "seeds";
    for (int i = 0; i < SHOWN; i++) {
        snprintf(names[i], sizeof names[i], "%s [%s]", shown[i].name, shown[i].unit);
        if (has[i])
            heads[count++] = names[i];
    }
    html_table_begin(&p->page, heads, count);
    for (int32_t c = 0; c < p->f->s->conditions && c < CONDITIONS_OF_TABLE; c++)
        add_row(p, c, has);
    html_table_end(&p->page);
    wide_end(p);
    html_paragraph(&p->page, "Seeds with \"more\": half the interval of the mean load is wider than %g %% of the mean.",
                   100 * WIDE);
    if (p->f->s->conditions > CONDITIONS_OF_TABLE)
        html_paragraph(&p->page, "The first %d conditions; conditions.csv has all.", CONDITIONS_OF_TABLE);
}

/* ---- mechanisms ---- */

#define SHARE_FIGURE(id, name, text) {ROW_share_splitting + (int)MECHANISM_##id, name, "%", 100},
static const page_figure shares[MECHANISM_COUNT] = {ICE_MECHANISMS(SHARE_FIGURE)};
#undef SHARE_FIGURE

static void add_share_row(study_page *p, int32_t condition)
{
    char text[32];
    html_row_begin(&p->page);
    snprintf(text, sizeof text, "%d", (int)condition + 1);
    html_cell(&p->page, text);
    for (int32_t k = 0; k < p->f->s->keys.count; k++)
        html_cell(&p->page, study_value(p->f->s, condition, k));
    for (int m = 0; m < (int)MECHANISM_COUNT; m++) {
        seed_interval of = interval_of(p, condition, &shares[m]);
        if (isfinite(of.half))
            snprintf(text, sizeof text, "%.1f ± %.1f", of.mean, of.half);
        else
            snprintf(text, sizeof text, "%.1f", of.mean);
        html_cell(&p->page, isfinite(of.mean) ? text : "–");
    }
    html_row_end(&p->page);
}

/* Which mechanism makes how much of the load, of studies whose runs met ice. */
static void add_shares(study_page *p)
{
    const char *heads[128] = {"no."};
    int32_t count = 1, rows = p->f->s->conditions < CONDITIONS_OF_TABLE ? p->f->s->conditions : CONDITIONS_OF_TABLE;
    if (!has_figure(p, &shares[0]))
        return;
    html_section(&p->page, "Mechanisms of the load");
    for (int32_t k = 0; k < p->f->s->keys.count && count < 100; k++)
        heads[count++] = p->f->s->keys.data[k];
    for (int m = 0; m < (int)MECHANISM_COUNT; m++)
        heads[count++] = shares[m].name;
    wide_begin(p);
    html_table_begin(&p->page, heads, count);
    for (int32_t c = 0; c < rows; c++)
        add_share_row(p, c);
    html_table_end(&p->page);
    wide_end(p);
    html_paragraph(&p->page,
                   "Parts of the mean load vector along it [%%], mean over the seeds: those of a condition add "
                   "up to 100. A part may be negative, and says nothing where loads from all sides cancel.");
}

/* ---- charts: seeds as points, means with their bands ---- */

static bool collect(study_page *p, const page_figure *figure)
{
    int64_t runs, failed;
    count_runs(p, &runs, &failed);
    context *ctx = p->f->ctx;
    double_array *all[] = {&p->x, &p->mean, &p->low, &p->high, &p->seed_x, &p->seed_y};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        array_clear(all[i]);
    for (int32_t c = 0; c < p->f->s->conditions; c++) {
        seed_interval of = interval_of(p, c, figure);
        double half = isfinite(of.half) ? of.half : 0;
        if (!array_push(ctx, &p->x, c + 1.0) || !array_push(ctx, &p->mean, of.mean) ||
            !array_push(ctx, &p->low, of.mean - half) || !array_push(ctx, &p->high, of.mean + half))
            return false;
        for (int32_t i = 0; i < p->conditions[c].rows.count; i++) {
            double y = p->conditions[c].rows.data[i].figure[figure->figure] * figure->factor;
            if (runs <= DOTS_MOST && isfinite(y) &&
                (!array_push(ctx, &p->seed_x, c + 1.0) || !array_push(ctx, &p->seed_y, y)))
                return false;
        }
    }
    return true;
}

static fram_status add_chart(study_page *p, const page_figure *figure, fram_error *error)
{
    char label[64];
    if (!collect(p, figure))
        return error_memory(error);
    chart_line lines[3] = {chart_line_make("interval", p->x.data, p->low.data, p->x.count, false),
                           chart_line_make("seeds", p->seed_x.data, p->seed_y.data, p->seed_x.count, false),
                           chart_line_make("mean over seeds", p->x.data, p->mean.data, p->x.count, true)};
    lines[0].style = CHART_BAND;
    lines[0].y2 = p->high.data;
    lines[1].style = CHART_POINTS;
    snprintf(label, sizeof label, "%s [%s]", figure->name, figure->unit);
    chart c = chart_make(figure->name, p->seed_x.count > 0 ? "a dot is a run" : "too many runs for dots", "condition",
                         label, lines, 3);
    return html_chart(&p->page, &c, false, error);
}

static fram_status add_charts(study_page *p, const bool *has, fram_error *error)
{
    fram_status status = FRAM_OK;
    html_section(&p->page, "Seeds and means");
    html_grid_begin(&p->page);
    for (int i = 0; i < SHOWN && status == FRAM_OK; i++)
        if (has[i])
            status = add_chart(p, &shown[i], error);
    html_grid_end(&p->page);
    return status;
}

/* ---- heat maps, of grids over two keys ---- */

/* Number of the value among those that came before, in the order in which they appear. */
static int32_t place_of(const study *s, int32_t key, int32_t condition)
{
    int32_t place = 0;
    for (int32_t c = 0; c <= condition; c++) {
        bool fresh = true;
        for (int32_t d = 0; d < c && fresh; d++)
            fresh = strcmp(study_value(s, d, key), study_value(s, c, key)) != 0;
        if (strcmp(study_value(s, c, key), study_value(s, condition, key)) == 0)
            return place;
        place += fresh;
    }
    return place;
}

static int32_t values_of(const study *s, int32_t key)
{
    int32_t most = 0;
    for (int32_t c = 0; c < s->conditions; c++) {
        int32_t place = place_of(s, key, c);
        most = place > most ? place : most;
    }
    return most + 1;
}

static void add_heat_cell(study_page *p, double value, double greatest)
{
    char text[HTML_NUMBER_SIZE];
    int part = greatest > 0 && value > 0 ? (int)(value / greatest * 100) : 0;
    html_number_text(value, text);
    text_format(p->f->ctx, &p->page.text,
                "<td style=\"text-align:center;background:color-mix(in srgb,#d1603d %d%%,#fff)\">%s</td>", part, text);
}

enum { HEAT_MOST = 12 };

static void add_heat(study_page *p, const page_figure *figure, int32_t rows, int32_t columns)
{
    const study *s = p->f->s;
    double greatest = 0;
    for (int32_t c = 0; c < s->conditions; c++)
        greatest = fmax(greatest, interval_of(p, c, figure).mean);
    html_paragraph(&p->page, "%s [%s]: %s downwards, %s across", figure->name, figure->unit, s->keys.data[0],
                   s->keys.data[1]);
    text_add(p->f->ctx, &p->page.text, "<table><tr><th></th>");
    for (int32_t c = 0; c < columns; c++)
        text_format(p->f->ctx, &p->page.text, "<th style=\"text-align:center\">%s</th>", study_value(s, c, 1));
    text_add(p->f->ctx, &p->page.text, "</tr>\n");
    for (int32_t r = 0; r < rows; r++) {
        text_format(p->f->ctx, &p->page.text, "<tr><th>%s</th>", study_value(s, r * columns, 0));
        for (int32_t c = 0; c < columns; c++)
            add_heat_cell(p, interval_of(p, r * columns + c, figure).mean, greatest);
        text_add(p->f->ctx, &p->page.text, "</tr>\n");
    }
    text_add(p->f->ctx, &p->page.text, "</table>\n");
}

/* Only of a grid over two keys, whose conditions are in its order; its values are numbers or plain words. */
static void add_heats(study_page *p, const bool *has)
{
    const study *s = p->f->s;
    if (s->keys.count != 2 || s->conditions < 4 || s->conditions > HEAT_MOST * HEAT_MOST)
        return;
    int32_t rows = values_of(s, 0), columns = values_of(s, 1);
    if (rows < 2 || columns < 2 || rows > HEAT_MOST || columns > HEAT_MOST || rows * columns != s->conditions)
        return;
    for (int32_t c = 0; c < s->conditions; c++)
        if (place_of(s, 0, c) != c / columns || place_of(s, 1, c) != c % columns ||
            strpbrk(study_value(s, c, 0), "<>&") || strpbrk(study_value(s, c, 1), "<>&"))
            return;
    html_section(&p->page, "Heat maps");
    for (int i = 0; i < SHOWN; i++)
        if (has[i])
            add_heat(p, &shown[i], rows, columns);
}

/* ---- the worst runs ---- */

/* A figure in the unit of the page, or as in summary.csv. */
static page_figure figure_of(run_figure figure)
{
    for (int i = 0; i < SHOWN; i++)
        if (shown[i].figure == figure)
            return shown[i];
    return (page_figure){figure, run_figure_name(figure), run_figure_unit(figure), 1};
}

/* The link to the playback where it is there, or else the command that makes it. */
static void add_playback(study_page *p, const worst_run *run)
{
    const char *id = p->f->id[run->condition];
    long long seed = (long long)p->f->s->seeds.first + run->index;
    text_buffer *text = &p->page.text;
    if (study_worst_has_playback(p->f, run))
        text_format(p->f->ctx, text, "<td><a href=\"worst/%s-%lld/playback.html\">playback</a></td>", id, seed);
    else
        text_format(p->f->ctx, text,
                    "<td><code>fram run conditions/%s.yaml --set run.seed=%lld --set output.frame_interval=1 -o "
                    "worst/%s-%lld &amp;&amp; fram view worst/%s-%lld</code>, then "
                    "<a href=\"worst/%s-%lld/playback.html\">playback</a></td>",
                    id, seed, id, seed, id, seed, id, seed);
}

static void add_worst(study_page *p)
{
    const study *s = p->f->s;
    worst_run worst[STUDY_WORST_MOST];
    char text[32], name[80];
    page_figure by = figure_of((run_figure)s->worst.figure);
    bool load = by.figure == ROW_load_largest;
    int32_t most = s->worst.count > WORST ? s->worst.count : WORST;
    int32_t count = study_worst_find(p->f, p->conditions, by.figure, most, worst);
    snprintf(name, sizeof name, "%s [%s]", by.name, by.unit);
    const char *heads[] = {"condition", "seed", name, load ? "Mean load [kN]" : "Largest load [kN]", "playback"};
    html_section(&p->page, "Worst runs");
    if (s->worst.count < count)
        html_paragraph(
            &p->page,
            "A command, given in the folder of this page, makes a run again with a record and its playback, "
            "which the link then opens; \"keep: {record_of_worst: %d}\" in the study has them made at its end.",
            WORST);
    wide_begin(p);
    html_table_begin(&p->page, heads, sizeof heads / sizeof *heads);
    for (int32_t i = 0; i < count; i++) {
        const run_row *row = &p->conditions[worst[i].condition].rows.data[worst[i].index];
        html_row_begin(&p->page);
        snprintf(text, sizeof text, "%d", (int)worst[i].condition + 1);
        html_cell(&p->page, text);
        snprintf(text, sizeof text, "%lld", (long long)s->seeds.first + worst[i].index);
        html_cell(&p->page, text);
        html_number(&p->page, worst[i].value * by.factor);
        html_number(&p->page, row->figure[load ? ROW_load_mean : ROW_load_largest] * 1e-3);
        add_playback(p, &worst[i]);
        html_row_end(&p->page);
    }
    html_table_end(&p->page);
    wide_end(p);
}

/* ---- all ---- */

static fram_status make_page(study_page *p, fram_error *error)
{
    bool has[SHOWN];
    for (int i = 0; i < SHOWN; i++)
        has[i] = has_figure(p, &shown[i]);
    add_head(p);
    add_table(p, has);
    add_shares(p);
    fram_status status = add_charts(p, has, error);
    if (status == FRAM_OK) {
        add_heats(p, has);
        add_worst(p);
        html_end(&p->page);
    }
    return status;
}

fram_status study_page_write(const study_folder *f, const condition_rows *conditions, fram_error *error)
{
    study_page p = {.f = f, .conditions = conditions, .page = {.ctx = f->ctx}};
    text_buffer path = {0};
    text_format(f->ctx, &path, "%s/study.html", f->path);
    fram_status status = make_page(&p, error);
    if (status == FRAM_OK && (path.failed || p.page.text.failed))
        status = error_memory(error);
    if (status == FRAM_OK)
        status = atomic_file_write(f->ctx, path.data, p.page.text.data, (size_t)p.page.text.count, error);
    double_array *all[] = {&p.x, &p.mean, &p.low, &p.high, &p.seed_x, &p.seed_y};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        array_free(f->ctx, all[i]);
    text_free(f->ctx, &path);
    html_free(&p.page);
    return status;
}
