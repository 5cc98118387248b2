/* What the rows of a run's series are of, and what is refused where they are damaged, where it has none, or not the
   channel; what a program told it.  One module with run_data. */
#include "results/run_data.h"

#include "base/channel_statistics.h"
#include "base/name_search.h"
#include "ice/fracture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Of a row from 0: no line of such a table is empty. */
#define ROW_LINE(row) ((int)(row) + 2)

int32_t run_first_row(const run_data *d)
{
    const double *time = run_channel(d, "time");
    return time ? first_time_after(time, d->series.rows, d->s.run.transient) : 0;
}

double run_recorded_from(const run_data *d)
{
    if (d->note.recorded_from >= 0)
        return d->note.recorded_from;
    /* An earlier version tells it by what was recorded first. */
    const double *time = run_channel(d, "time");
    double step = d->s.run.time_step, first = time && d->series.rows > 0 ? time[0] : 0;
    /* Recorded from its start a run has a frame of that.  Later ones come at multiples of their interval, as rows do.
     */
    if (d->frames > 0 && !(d->before.time > 1.5 * step))
        return 0;
    if (d->frames > 0)
        return first > 0 ? fmin(first, d->before.time) : d->before.time;
    return first > fmax(step, d->s.output.csv_interval) + 0.5 * step ? first : 0;
}

double run_ends_after_row(const run_data *d)
{
    const double *time = run_channel(d, "time");
    double last = time && d->series.rows > 0 ? time[d->series.rows - 1] : HUGE_VAL;
    return d->note.time > last + 0.5 * d->s.run.time_step ? last : HUGE_VAL;
}

double scenario_steps_of_row(const scenario *s)
{
    return (double)scenario_steps_of(s->output.csv_interval, s->run.time_step);
}

bool run_leaves_out_steps(const run_data *d) { return scenario_steps_of_row(&d->s) > 1; }

/* ---- rows that were moved, doubled or lost ---- */

fram_status run_series_check(const csv_table *series, const char *path, fram_error *error)
{
    const csv_table_column *time = csv_table_find(series, "time");
    if (!time)
        return error_set(error, FRAM_ERROR_INPUT, path, 1, NULL,
                         "expected the series of a run, found a table without the column time[s]: something else was "
                         "written over it");
    for (int32_t i = 1; i < series->rows; i++) {
        double before = time->value.data[i - 1], at = time->value.data[i];
        if (!(at > before))
            return error_set(error, FRAM_ERROR_INPUT, path, ROW_LINE(i), "time",
                             "expected rising times, found %.12g after %.12g: rows were moved or doubled; run the "
                             "scenario again",
                             at, before);
    }
    return FRAM_OK;
}

/* The first of the gaps, and how many there are. */
typedef struct row_gaps {
    double from, to; /* [s] */
    int32_t row;     /* behind it */
    int32_t count;
} row_gaps;

static void add_gap(row_gaps *g, double from, double to, int32_t row)
{
    if (g->count++ > 0)
        return;
    g->from = from;
    g->to = to;
    g->row = row;
}

/* Rows come after each whole interval, so that two are never farther apart, and one that is due by the end of a run
   that tells its end is there. */
static row_gaps find_gaps(const run_data *d, const double *time)
{
    row_gaps g = {0};
    int32_t rows = d->series.rows;
    double steps = scenario_steps_of_row(&d->s), interval = steps * d->s.run.time_step, most = 1.5 * interval;
    for (int32_t i = 1; i < rows; i++)
        if (time[i] - time[i - 1] > most)
            add_gap(&g, time[i - 1], time[i], i);
    double due = floor(d->note.steps / steps) * interval;
    if (!run_is_open(d) && strcmp(d->note.status, "failed") != 0 && due - time[rows - 1] > 0.5 * interval)
        add_gap(&g, time[rows - 1], due, rows - 1);
    return g;
}

void run_warn_gaps(context *ctx, const run_data *d)
{
    const double *time = run_channel(d, "time");
    char more[48] = "";
    if (run_is_cut_off(d))
        log_write(ctx, LOG_WARNING, "%s: " RUN_IS_CUT_OFF "; run the scenario again", d->folder, d->note.steps);
    /* Those of another scenario may be farther apart. */
    if (!time || d->series.rows == 0 || d->is_changed || !d->note.scenario_hash[0])
        return;
    row_gaps g = find_gaps(d, time);
    if (g.count > 1)
        snprintf(more, sizeof more, ", nor in %d more gap%s", (int)g.count - 1, g.count > 2 ? "s" : "");
    if (g.count > 0)
        log_write(ctx, LOG_WARNING,
                  "%s/series.csv:%d: time: there are no rows from %.9g to %.9g s%s, and one every %.6g s was written: "
                  "what is told leaves that time out; run the scenario again",
                  d->folder, ROW_LINE(g.row), g.from, g.to, more, scenario_steps_of_row(&d->s) * d->s.run.time_step);
}

/* ---- none, and no channel ---- */

bool run_is_cut_off(const run_data *d)
{
    const run_note *n = &d->note;
    if (d->series.rows > 0 || d->is_changed || n->recorded_from < 0)
        return false;
    double steps = scenario_steps_of_row(&d->s), began = n->recorded_from / d->s.run.time_step;
    double made = n->steps - (strcmp(n->status, "failed") == 0); /* the step that went wrong has no row */
    return floor(made / steps) > floor(began / steps + 1e-6);
}

fram_status run_data_refuse_empty(const run_data *d, fram_error *error)
{
    bool goes_on = strcmp(d->note.status, "finished") != 0 &&
                   d->s.run.duration + 0.5 * d->s.run.time_step >= d->s.output.csv_interval;
    if (run_is_cut_off(d))
        return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, NULL, RUN_IS_CUT_OFF "; run the scenario again",
                         d->note.steps);
    if (strcmp(d->note.status, "failed") == 0)
        return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, NULL,
                         "the run's series has no rows: it failed before the first step that has one");
    if (goes_on)
        return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, NULL,
                         "the run's series has no rows: it has made no step yet that has one; `fram resume %.200s` "
                         "goes on with it",
                         d->folder);
    return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, NULL, "the run's series has no rows%s",
                     run_leaves_out_steps(d) ? "; give the scenario a shorter output.csv_interval"
                                             : ": it made no step");
}

fram_status run_refuse_channel(const run_data *d, const char *name, const char *also, fram_error *error)
{
    name_search near = name_search_begin(name);
    const char *inside = NULL;
    for (int32_t i = 0; i < d->series.columns.count; i++) {
        const char *other = d->series.columns.data[i].name;
        name_try(&near, other);
        if (!inside && strstr(other, name))
            inside = other;
    }
    if (also)
        name_try(&near, also);
    /* A part of a name, as `tension` of line_1_tension, is further from it than a third of its letters. */
    const char *meant = near.found ? near.found : inside;
    return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, name,
                     "the run has no channel of this name; %s%s%s`fram plot %.200s` lists them all",
                     meant ? "did you mean " : "", meant ? meant : "", meant ? "? " : "", d->folder);
}

/* ---- what a program told ---- */

void run_told(const run_data *d, char out[RUN_TOLD_SIZE])
{
    enum { SHOWN = 16, ROOM = VESSEL_NAME_MOST + 50 };
    const char *at = d->note.told.data;
    int count = 0;
    size_t used = 0;
    _Static_assert(SHOWN * ROOM + 32 <= RUN_TOLD_SIZE, "room for the names that are shown");
    out[0] = '\0';
    for (size_t length; at && *at; at += length + 1, count++) {
        length = strcspn(at, "\n");
        if (count < SHOWN && length + 2 < ROOM)
            used +=
                (size_t)snprintf(out + used, RUN_TOLD_SIZE - used, "%s%.*s", count > 0 ? ", " : "", (int)length, at);
    }
    if (count > SHOWN)
        snprintf(out + used, RUN_TOLD_SIZE - used, " and %d more", count - SHOWN);
}

/* ---- what broke ---- */

/* Events of a kind in fractures.csv that are not later than a time. */
static int32_t listed_fractures(const run_data *d, int kind, double until)
{
    const csv_table_column *c = csv_table_find(&d->fractures, "kind"), *when = csv_table_find(&d->fractures, "time");
    int32_t count = 0;
    for (int32_t i = 0; c && i < d->fractures.rows; i++)
        count += c->value.data[i] == kind && !(when && time_is_after(when->value.data[i], until));
    return count;
}

/* The channel counts from where the world began, the table from where the recording did. */
static int32_t counted_fractures(const run_data *d, int kind)
{
    const double *time = run_channel(d, "time"), *so_far = NULL;
    double before = 0;
    if (kind == FRACTURE_SPLIT || kind == FRACTURE_BENDING)
        so_far = run_channel(d, kind == FRACTURE_SPLIT ? "splits" : "bendings");
    if (!so_far || !time || d->series.rows < 1)
        return 0;
    if (run_recorded_from(d) > 0)
        before = so_far[0] - listed_fractures(d, kind, time[0]);
    double counted = so_far[d->series.rows - 1] - before;
    return counted > 0 && counted < INT32_MAX ? (int32_t)counted : 0;
}

int32_t run_fractures(const run_data *d, int kind)
{
    int32_t listed = listed_fractures(d, kind, HUGE_VAL), counted = counted_fractures(d, kind);
    return counted > listed ? counted : listed;
}

int32_t run_fractures_untold(const run_data *d)
{
    static const int kinds[] = {FRACTURE_SPLIT, FRACTURE_BENDING};
    int32_t untold = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        untold += run_fractures(d, kinds[k]) - listed_fractures(d, kinds[k], HUGE_VAL);
    return untold;
}
