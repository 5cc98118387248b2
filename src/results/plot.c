#include "results/plot.h"

#include "base/load_unit.h"
#include "io/chart.h"
#include "io/csv_read.h"
#include "results/run_channels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* LABEL: of a channel's name, and its unit in brackets with a prefix. */
enum { WIDTH = 1280, HEIGHT = 460, LABEL = COLUMN_NAME_SIZE + UNIT_SIZE + 4 };

/* A panel: the channels of one unit. */
typedef struct panel {
    const char *unit;
    chart_line lines[PLOT_CHANNELS_MOST];
    int32_t count;
    char label[LABEL];
} panel;

typedef struct plot {
    panel *panels;
    int32_t count;
    const double *time;
    int32_t first, rows;
    ARRAY(double *) kept; /* values in a larger unit, and angles that go on */
} plot;

static panel *panel_of(plot *p, const char *unit)
{
    for (int32_t i = 0; i < p->count; i++) {
        if (strcmp(p->panels[i].unit, unit) == 0)
            return &p->panels[i];
    }
    p->panels[p->count].unit = unit;
    return &p->panels[p->count++];
}

static void choose_rows(plot *p, double from, double to, int32_t rows)
{
    while (p->first < rows && p->time[p->first] < from)
        p->first++;
    int32_t end = p->first;
    while (end < rows && !(p->time[end] > to))
        end++;
    p->rows = end - p->first;
}

/* Of the n-th line of a panel, from 0.  The palette's first is for backgrounds, so it comes last; then all come again,
   dashed. */
static int line_colour(int32_t n) { return 1 + (n + 1) % CHART_COLOURS + n / CHART_COLOURS * CHART_COLOURS; }

/* Room for values of a line, kept with the plot; NULL: no memory. */
static double *keep_values(context *ctx, plot *p, int32_t count)
{
    double *y = memory_array(ctx, (size_t)count, sizeof *y);
    if (y && array_push(ctx, &p->kept, y))
        return y;
    memory_free(ctx, y);
    return NULL;
}

static bool is_heading(const char *name)
{
    const char *dot = strrchr(name, '.'), *own = dot ? dot + 1 : name;
    return strcmp(own, "yaw") == 0 || strcmp(own, "estimated_heading") == 0;
}

/* Of the headings that the panel has, the first value of the first one; NaN without. */
static double first_heading(const panel *at)
{
    for (int32_t i = 0; i < at->count; i++)
        if (is_heading(at->lines[i].name))
            return at->lines[i].y[0];
    return (double)NAN;
}

/* Channels have angles up to half a turn: one that goes on beyond it would jump across the whole panel.  Each is drawn
   next to the one before it, and headings begin next to each other. */
static fram_status go_on_turning(context *ctx, plot *p, const panel *at, chart_line *line, fram_error *error)
{
    double before = is_heading(line->name) ? first_heading(at) : (double)NAN;
    double *y = keep_values(ctx, p, line->count);
    if (!y)
        return error_memory(error);
    for (int32_t k = 0; k < line->count; k++) {
        y[k] = angle_next_to(before, line->y[k]);
        before = isfinite(y[k]) ? y[k] : before;
    }
    line->y = y;
    return FRAM_OK;
}

static fram_status add_channel(context *ctx, plot *p, const run_data *d, const char *name, fram_error *error)
{
    const csv_table_column *c = csv_table_find(&d->series, name);
    if (!c)
        return run_refuse_channel(d, name, NULL, error);
    panel *at = panel_of(p, c->unit);
    chart_line line = chart_line_make(c->name, p->time + p->first, c->value.data + p->first, p->rows, true);
    line.colour = line_colour(at->count);
    if (strcmp(c->unit, "deg") == 0 && p->rows > 0 && go_on_turning(ctx, p, at, &line, error) != FRAM_OK)
        return FRAM_ERROR_MEMORY;
    at->lines[at->count++] = line;
    return FRAM_OK;
}

/* Units that are told in thousands and millions where their numbers are large, as people write them. */
static bool takes_prefix(const char *unit)
{
    static const char *const units[] = {"N", "N m", "J", "W", "Pa"};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strcmp(unit, units[i]) == 0)
            return true;
    return false;
}

static double greatest(const panel *at)
{
    double most = 0;
    for (int32_t i = 0; i < at->count; i++)
        for (int32_t k = 0; k < at->lines[i].count; k++)
            most = fmax(most, fabs(at->lines[i].y[k]));
    return most;
}

enum { PREFIX_ROOM = 4 };
/* The prefix of the panel's unit; its lines are given values to go with it. */
static fram_status take_prefix(context *ctx, plot *p, panel *at, char prefix[PREFIX_ROOM], fram_error *error)
{
    const load_unit unit = takes_prefix(at->unit) ? load_unit_for(greatest(at)) : (load_unit){"N", 1};
    snprintf(prefix, PREFIX_ROOM, "%.*s", (int)strlen(unit.name) - 1, unit.name); /* the N is one of many units here */
    if (!*prefix)
        return FRAM_OK;
    for (int32_t i = 0; i < at->count; i++) {
        double *y = keep_values(ctx, p, at->lines[i].count);
        if (!y)
            return error_memory(error);
        for (int32_t k = 0; k < at->lines[i].count; k++)
            y[k] = unit.factor * at->lines[i].y[k];
        at->lines[i].y = y;
    }
    return FRAM_OK;
}

static fram_status draw_channels(context *ctx, const run_data *d, plot *p, const char *output, fram_error *error)
{
    chart charts[PLOT_CHANNELS_MOST];
    const char *title = d->s.title[0] ? d->s.title : "Fram";
    for (int32_t i = 0; i < p->count; i++) {
        panel *at = &p->panels[i];
        bool bare = strcmp(at->unit, "1") == 0 || !at->unit[0];
        char prefix[PREFIX_ROOM];
        if (take_prefix(ctx, p, at, prefix, error) != FRAM_OK)
            return FRAM_ERROR_MEMORY;
        snprintf(at->label, sizeof at->label, "%s%s%s%s%s", at->count == 1 ? at->lines[0].name : "", bare ? "" : " [",
                 prefix, bare ? "" : at->unit, bare ? "" : "]");
        charts[i] =
            chart_make(i == 0 ? title : "", "", i + 1 == p->count ? "time [s]" : "", at->label, at->lines, at->count);
        charts[i].free_y = true;
    }
    fram_status status = work_continue(ctx, "drawing", 1, 1, error);
    return status == FRAM_OK ? chart_stack_write(ctx, charts, p->count, output, WIDTH, HEIGHT, error) : status;
}

fram_status plot_channels(context *ctx, const char *folder, const char *const *channels, int32_t count, double from,
                          double to, const char *output, fram_error *error)
{
    run_data d;
    const char *kept[PLOT_CHANNELS_MOST + 1] = {"time"};
    for (int32_t i = 0; i < count && i < PLOT_CHANNELS_MOST; i++)
        kept[i + 1] = channels[i];
    const csv_wish wish = {kept, count + 1};
    fram_status status = run_data_read(ctx, folder, false, &wish, &d, error);
    if (status != FRAM_OK)
        return status;
    plot p = {.time = run_channel(&d, "time")};
    p.panels = memory_array(ctx, (size_t)count, sizeof *p.panels);
    if (!p.panels)
        status = error_memory(error);
    else if (d.series.rows == 0)
        status = run_data_refuse_empty(&d, error);
    else if (!p.time)
        status = run_refuse_channel(&d, "time", NULL, error);
    if (status == FRAM_OK && p.time)
        choose_rows(&p, from, to, d.series.rows);
    for (int32_t i = 0; i < count && status == FRAM_OK; i++)
        status = add_channel(ctx, &p, &d, channels[i], error);
    if (status == FRAM_OK && p.rows == 0)
        status = error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL, "the run has no row between these times");
    if (status == FRAM_OK)
        status = draw_channels(ctx, &d, &p, output, error);
    for (int32_t i = 0; i < p.kept.count; i++)
        memory_free(ctx, p.kept.data[i]);
    array_free(ctx, &p.kept);
    memory_free(ctx, p.panels);
    run_data_free(ctx, &d);
    return status;
}

fram_status plot_list(context *ctx, const char *folder, text_buffer *out, fram_error *error)
{
    run_data d;
    const csv_wish wish = {(const char *const[]){"time"}, 1};
    fram_status status = run_data_read(ctx, folder, false, &wish, &d, error);
    if (status != FRAM_OK)
        return status;
    for (int32_t i = 0; i < d.series.columns.count; i++)
        text_format(ctx, out, "%s [%s]\n", d.series.columns.data[i].name, d.series.columns.data[i].unit);
    run_data_free(ctx, &d);
    return out->failed ? error_memory(error) : FRAM_OK;
}
