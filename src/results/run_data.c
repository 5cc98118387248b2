#include "results/run_data.h"

#include "base/channel_statistics.h"
#include "base/sort.h"
#include "io/scenario_file.h"
#include "model/scenario_vessel.h"
#include "results/manage_ice.h"
#include "results/replay_moment.h"
#include "results/run_record.h"

#include <math.h>
#include <string.h>

/* ---- the field ---- */

/* Adds the area that a floe has in the domain: as large a part of its own as of its plan. */
static fram_status add_inside(context *ctx, const replay_body *b, polygon plan, const scenario_domain *d,
                              field_state *f, fram_error *error)
{
    const manage_floe floe = {.outline = plan, .box = polygon_bounds(plan), .area = b->area};
    double whole = fabs(polygon_area(plan));
    if (floe.box.lo.x >= d->x_min && floe.box.hi.x <= d->x_max && floe.box.lo.y >= d->y_min &&
        floe.box.hi.y <= d->y_max) {
        f->inside += b->area;
        return FRAM_OK;
    }
    const manage_window window = {.centre = {0.5 * (d->x_min + d->x_max), 0.5 * (d->y_min + d->y_max)},
                                  .along = {1, 0},
                                  .length = d->x_max - d->x_min,
                                  .width = d->y_max - d->y_min};
    manage_cover cover;
    fram_status status = manage_measure(ctx, &floe, 1, &window, 0, 1, &cover, NULL, error);
    if (status == FRAM_OK && whole > 0)
        f->inside += b->area * fmin(cover.ice * window.length * window.width / whole, 1);
    return status;
}

static fram_status add_floes(context *ctx, const replay *r, const replay_moment *m, const scenario_domain *d,
                             field_state *f, fram_error *error)
{
    double volume = 0;
    for (int32_t i = 0; i < m->poses.count; i++) {
        const replay_body *b = &r->bodies.data[m->poses.data[i].body];
        if (b->material != MATERIAL_ICE)
            continue;
        f->area += b->area;
        f->mass += b->area * b->thickness * b->density;
        volume += b->area * b->thickness;
        f->thinnest = fmin(f->thinnest, b->thickness);
        f->thickest = fmax(f->thickest, b->thickness);
        f->fixed += !b->moves;
        if (!array_push(ctx, &f->areas, b->area))
            return error_memory(error);
        fram_status status = add_inside(ctx, b, polygon_list_get(&m->outlines, i), d, f, error);
        if (status != FRAM_OK)
            return status;
    }
    f->thickness = f->area > 0 ? volume / f->area : 0;
    return FRAM_OK;
}

static fram_status note_field(context *ctx, replay *r, const scenario_domain *d, field_state *f, fram_error *error)
{
    replay_moment m = {0};
    array_clear(&f->areas);
    *f = (field_state){.time = r->frame.time, .areas = f->areas, .thinnest = HUGE_VAL, .thickest = -HUGE_VAL};
    fram_status status = replay_moment_now(r, &m, error);
    if (status == FRAM_OK)
        status = add_floes(ctx, r, &m, d, f, error);
    replay_moment_free(ctx, &m);
    int32_t n = f->areas.count;
    if (status != FRAM_OK || n == 0)
        return status;
    numbers_sort(f->areas.data, n);
    f->mean = f->area / n;
    f->median = numbers_median(f->areas.data, n);
    f->greatest = f->areas.data[n - 1];
    return FRAM_OK;
}

static fram_status read_fields(context *ctx, run_data *d, fram_error *error)
{
    replay r;
    bool found = true;
    if (d->s.output.frame_interval <= 0)
        return FRAM_OK;
    d->lacks_record = run_lacks_record(d->folder);
    if (d->lacks_record) {
        log_write(ctx, LOG_WARNING, "%s: " RUN_WITHOUT_RECORD ": nothing is told of its ice field", d->folder);
        return FRAM_OK;
    }
    /* A recording that met no frame's time has a record without any. */
    fram_status status = replay_open_any(ctx, d->folder, &r, error);
    if (status != FRAM_OK)
        return status;
    while (status == FRAM_OK) {
        status = replay_next(&r, &found, error);
        if (status != FRAM_OK || !found)
            break;
        if (d->frames++ == 0)
            status = note_field(ctx, &r, &d->s.domain, &d->before, error);
        /* The last frame is the one that no other follows. */
        if (status == FRAM_OK && !r.has_next)
            status = note_field(ctx, &r, &d->s.domain, &d->after, error);
    }
    replay_close(&r);
    return status;
}

/* ---- a run without an end ---- */

/* run.json of a run that goes on, or was killed, is of where it began or was resumed.  How far it has come its series
   tells; what else is of the end (hash, tracks) is not known. */
static void note_progress(run_data *d)
{
    const double *time = run_channel(d, "time");
    if (!run_is_open(d))
        return;
    if (time && d->series.rows > 0)
        d->note.time = fmax(d->note.time, time[d->series.rows - 1]);
    d->note.steps = floor(d->note.time / d->s.run.time_step + 0.5);
    d->note.state_hash[0] = '\0';
    array_clear(&d->note.tracks);
}

/* ---- all ---- */

fram_status run_data_read(context *ctx, const char *folder, bool with_field, const csv_wish *wish, run_data *d,
                          fram_error *error)
{
    char path[PATH_ROOM];
    *d = (run_data){0};
    run_note_init(&d->note);
    fram_status status = path_given_or(folder, NULL, NULL, d->folder, error);
    if (status == FRAM_OK)
        status = run_note_read(ctx, folder, &d->note, error);
    if (status == FRAM_OK)
        status = run_note_check(&d->note, folder, error);
    if (status == FRAM_OK)
        status = path_join(folder, "scenario.yaml", path, error);
    if (status == FRAM_OK)
        status = scenario_read_alone(ctx, path, NULL, &d->s, error);
    if (status != FRAM_OK) {
        run_note_free(ctx, &d->note);
        return status;
    }
    status = run_find_change(ctx, d, error);
    if (status == FRAM_OK)
        status = path_join(folder, "series.csv", path, error);
    if (status == FRAM_OK)
        status = csv_table_read(ctx, path, wish, &d->series, error);
    if (status == FRAM_OK)
        status = run_series_check(&d->series, path, error);
    if (status == FRAM_OK)
        status = path_join(folder, "fractures.csv", path, error);
    if (status == FRAM_OK)
        status = csv_table_read(ctx, path, wish, &d->fractures, error);
    if (status == FRAM_OK) {
        note_progress(d);
        run_warn_gaps(ctx, d);
    }
    if (status == FRAM_OK && with_field)
        status = read_fields(ctx, d, error);
    if (status != FRAM_OK)
        run_data_free(ctx, d);
    return status;
}

void run_data_free(context *ctx, run_data *d)
{
    scenario_free(ctx, &d->s);
    run_note_free(ctx, &d->note);
    csv_table_free(ctx, &d->series);
    csv_table_free(ctx, &d->fractures);
    array_free(ctx, &d->before.areas);
    array_free(ctx, &d->after.areas);
}

bool run_is_open(const run_data *d) { return strcmp(d->note.status, "running") == 0; }

const double *run_channel(const run_data *d, const char *name)
{
    const csv_table_column *c = csv_table_find(&d->series, name);
    return c ? c->value.data : NULL;
}

_Static_assert(COLUMN_NAME_SIZE >= sizeof((vessel_channel *)0)->text, "columns of any vessel can be read");

const double *run_vessel_channel(const run_data *d, int32_t vessel, const char *name)
{
    const double *own = NULL;
    if (vessel < scenario_vessel_count(&d->s))
        own = run_channel(d, vessel_channel_name(&d->s, vessel, name).text);
    return own ? own : run_channel(d, name);
}

static bool is_event(const run_data *d, const run_event *e, int32_t vessel, station_event kind)
{
    const char *name = scenario_vessel_name(&d->s, vessel);
    return strcmp(e->kind, event_name(kind)) == 0 && strcmp(e->vessel, name ? name : "") == 0;
}

double run_event_from(const run_data *d, int32_t vessel, station_event kind, double from)
{
    double first = HUGE_VAL;
    for (int32_t i = 0; i < d->note.events.count; i++) {
        const run_event *e = &d->note.events.data[i];
        if (time_is_after(e->time, from) && is_event(d, e, vessel, kind))
            first = fmin(first, e->time);
    }
    return first;
}

double run_event_until(const run_data *d, int32_t vessel, station_event kind, double to)
{
    double last = -HUGE_VAL;
    for (int32_t i = 0; i < d->note.events.count; i++) {
        const run_event *e = &d->note.events.data[i];
        if (!time_is_after(e->time, to) && is_event(d, e, vessel, kind))
            last = fmax(last, e->time);
    }
    return last;
}

bool run_event_goes_on(const run_data *d, int32_t vessel, station_event kind, station_event over, double at)
{
    bool on = false;
    for (int32_t i = 0; i < d->note.events.count; i++) {
        const run_event *e = &d->note.events.data[i];
        if (!time_is_after(e->time, at) && is_event(d, e, vessel, on ? over : kind))
            on = !on;
    }
    return on;
}

static int32_t count_events(const run_data *d, int32_t vessel, station_event kind)
{
    int32_t count = 0;
    for (int32_t i = 0; i < d->note.events.count; i++)
        count += is_event(d, &d->note.events.data[i], vessel, kind);
    return count;
}

/* By the channel, which counts lines that were let go until its last row too, by the scenario or by a program: at least
   so many parted.  What is let go in a step was due when that began. */
static int32_t lines_gone_unasked(const run_data *d, int32_t vessel)
{
    const double *parted = run_vessel_channel(d, vessel, "lines_parted"), *time = run_channel(d, "time");
    int32_t last = d->series.rows - 1;
    if (!parted || !time || last < 0 || vessel >= scenario_vessel_count(&d->s))
        return 0;
    double began = (floor(time[last] / d->s.run.time_step + 0.5) - 1) * d->s.run.time_step;
    double due = scenario_released_lines(scenario_vessel_entry(&d->s, vessel).keys, began);
    return (int32_t)fmax(parted[last] - fmax(due, count_events(d, vessel, EVENT_LINE_RELEASE)), 0);
}

bool run_lacks_events(const run_data *d) { return run_is_open(d) || d->note.events_left_out > 0; }

int32_t run_lines_broken(const run_data *d, int32_t vessel)
{
    int32_t broken = count_events(d, vessel, EVENT_LINE_BREAK);
    if (!run_lacks_events(d))
        return broken;
    int32_t gone = lines_gone_unasked(d, vessel);
    return broken > gone ? broken : gone;
}
