#include "results/manage.h"

#include "base/sort.h"
#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/fill.h"
#include "model/scenario_vessel.h"
#include "results/manage_parts.h"
#include "results/run_channels.h"

#include <stdio.h>
#include <string.h>

double manage_alarm(const manage_moment *at, bool largest)
{
    double way = largest ? at->threat.largest : at->threat.nearest;
    return at->speed > 0 ? way / at->speed : HUGE_VAL;
}

/* ---- sums ---- */

static bool counts(const manage_run *m, const manage_moment *at, int place)
{
    return at->looked[place] >= 0 && time_is_after(at->time, m->d.s.run.transient);
}

/* Means over the windows of a place; a place that no window came to has no numbers. */
static void sum_place(const manage_run *m, int place, manage_summary *out)
{
    double ice = 0, managed = 0, sheet = 0, floes = 0, area[MANAGE_CLASSES + 1] = {0};
    int32_t n = 0;
    for (int32_t i = 0; i < m->moments.count; i++) {
        const manage_moment *at = &m->moments.data[i];
        const manage_cover *c = &at->cover[place];
        if (!counts(m, at, place))
            continue;
        n++;
        ice += c->ice;
        managed += c->managed;
        sheet += c->sheet;
        floes += c->size_area;
        for (int k = 0; k <= MANAGE_CLASSES; k++)
            area[k] += c->of_class[k];
        if (c->largest > out->place[place].largest) {
            out->place[place].largest = c->largest;
            if (place == MANAGE_AT)
                out->largest_time = at->time;
        }
    }
    out->place[place].windows = n;
    out->place[place].concentration = n > 0 ? ice / n : (double)NAN;
    out->place[place].managed = ice > 0 ? managed / ice : (double)NAN;
    out->place[place].sheet = ice > 0 ? sheet / ice : (double)NAN;
    out->place[place].mean = ice > sheet ? floes / (ice - sheet) : (double)NAN;
    for (int k = 0; k <= MANAGE_CLASSES; k++)
        out->place[place].share[k] = ice > 0 ? area[k] / ice : (double)NAN;
}

/* Until when no ice was before the vessel: means after the transient count such windows too. */
static void sum_wait(const manage_run *m, manage_summary *out)
{
    out->first_time = (double)NAN;
    for (int32_t i = 0; i < m->moments.count; i++) {
        const manage_moment *at = &m->moments.data[i];
        if (!counts(m, at, MANAGE_AT))
            continue;
        if (at->cover[MANAGE_AT].ice > 0) {
            out->first_time = at->time;
            return;
        }
        out->empty++;
    }
}

/* false: no memory. */
static bool sum_alarms(const manage_run *m, bool largest, double *least, double *median)
{
    double_array times = {0};
    bool good = true;
    *least = *median = (double)NAN;
    for (int32_t i = 0; i < m->moments.count && good; i++) {
        if (counts(m, &m->moments.data[i], MANAGE_AT))
            good = array_push(m->ctx, &times, manage_alarm(&m->moments.data[i], largest));
    }
    if (good && times.count > 0) {
        numbers_sort(times.data, times.count);
        *least = times.data[0];
        *median = numbers_median(times.data, times.count);
    }
    array_free(m->ctx, &times);
    return good;
}

static bool size_statistics(const manage_run *m, const char *x, const char *y, channel_statistics *out)
{
    return run_size_statistics(m->ctx, &m->d, m->vessel, x, y, out);
}

/* The line with the greatest damage, NaN without lines; false: no memory. */
static bool sum_fatigue(const manage_run *m, int32_t lines, manage_summary *out)
{
    out->tension_range = (double)NAN;
    for (int32_t line = 1; line <= lines; line++) {
        char name[40];
        double range;
        snprintf(name, sizeof name, "line_%d_tension", (int)line);
        if (!run_equivalent_range(m->ctx, &m->d, run_vessel_channel(&m->d, m->vessel, name), &range))
            return false;
        if (isnan(range) || (out->tension_line > 0 && range <= out->tension_range))
            continue;
        out->tension_range = range;
        out->tension_line = line;
    }
    return true;
}

int32_t manage_line_count(const scenario_vessel *keys)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < keys->mooring.lines.count; i++)
        sum += (int32_t)keys->mooring.lines.data[i].count;
    return sum;
}

fram_status manage_sum_up(const manage_run *m, manage_summary *out, fram_error *error)
{
    channel_statistics load, offset, tension;
    *out = (manage_summary){.limit = m->limit, .largest_time = (double)NAN};
    for (int p = 0; p < MANAGE_PLACES; p++)
        sum_place(m, p, out);
    sum_wait(m, out);
    bool good = sum_alarms(m, false, &out->alarm_least, &out->alarm_median) &&
                sum_alarms(m, true, &out->warning_least, &out->warning_median);
    const scenario_vessel *keys = scenario_vessel_entry(&m->d.s, m->vessel).keys;
    good = good && size_statistics(m, "ice_force_averaged_x", "ice_force_averaged_y", &load) &&
           size_statistics(m, "offset_x", "offset_y", &offset) &&
           size_statistics(m, "line_tension_max", NULL, &tension) && sum_fatigue(m, manage_line_count(keys), out);
    if (!good)
        return error_memory(error);
    out->load_mean = load.mean;
    out->load_most = load.greatest;
    out->offset_most = offset.greatest;
    out->tension_most = tension.greatest;
    if (keys->mooring.lines.count == 0)
        out->tension_most = (double)NAN;
    if (keys->mooring.lines.count == 0 && !keys->positioning.active)
        out->offset_most = (double)NAN;
    return FRAM_OK;
}

/* ---- tables ---- */

/* PAGE without its ending, and another one. */
static fram_status beside_page(const char *page, const char *ending, char out[PATH_ROOM], fram_error *error)
{
    const char *slash = strrchr(page, '/'), *dot = strrchr(page, '.');
    size_t stem = dot && (!slash || dot > slash + 1) ? (size_t)(dot - page) : strlen(page);
    if (stem + strlen(ending) >= PATH_ROOM)
        return error_set(error, FRAM_ERROR_INPUT, page, 0, NULL, "the path is too long");
    memcpy(out, page, stem);
    memcpy(out + stem, ending, strlen(ending) + 1);
    return FRAM_OK;
}

#define PLACE_COLUMNS(name)                                                                          \
    {name "_time", "s"}, {name "_concentration", "1"}, {name "_managed", "1"}, {name "_sheet", "1"}, \
    {                                                                                                \
        name "_largest", "m"                                                                         \
    }
enum { PLACE_COLUMN_COUNT = 5, MOMENT_COLUMNS = 4 + PLACE_COLUMN_COUNT * MANAGE_PLACES };

static void moment_row(const manage_run *m, const manage_moment *at, double row[MOMENT_COLUMNS])
{
    bool comes = at->looked[MANAGE_AT] >= 0;
    double alarm = manage_alarm(at, false), warning = manage_alarm(at, true);
    int n = 0;
    row[n++] = at->time;
    for (int p = 0; p < MANAGE_PLACES; p++) {
        bool known = at->looked[p] >= 0;
        const manage_cover *c = &at->cover[p];
        row[n++] = known ? m->moments.data[at->looked[p]].time : (double)NAN;
        row[n++] = known ? c->ice : (double)NAN;
        row[n++] = known && c->ice > 0 ? c->managed / c->ice : (double)NAN;
        row[n++] = known && c->ice > 0 ? c->sheet / c->ice : (double)NAN;
        row[n++] = known ? c->largest : (double)NAN;
    }
    row[n++] = comes && isfinite(alarm) ? alarm : (double)NAN;
    row[n++] = comes && isfinite(warning) ? warning : (double)NAN;
    row[n++] = comes && isfinite(at->threat.size) ? at->threat.size : (double)NAN;
}

static fram_status write_table(context *ctx, const char *path, text_buffer *table, fram_error *error)
{
    fram_status status = text_file_write(ctx, path, table, error);
    text_free(ctx, table);
    return status;
}

static fram_status write_moments(const manage_run *m, const char *path, fram_error *error)
{
    static const csv_column columns[MOMENT_COLUMNS] = {{"time", "s"},
                                                       PLACE_COLUMNS("upstream"),
                                                       PLACE_COLUMNS("behind"),
                                                       PLACE_COLUMNS("at_vessel"),
                                                       {"unmanaged_comes_in", "s"},
                                                       {"largest_unmanaged_comes_in", "s"},
                                                       {"largest_unmanaged", "m"}};
    text_buffer table = {0};
    csv_text_header(m->ctx, columns, MOMENT_COLUMNS, &table);
    for (int32_t i = 0; i < m->moments.count; i++) {
        double row[MOMENT_COLUMNS];
        moment_row(m, &m->moments.data[i], row);
        csv_text_row(m->ctx, row, MOMENT_COLUMNS, &table);
    }
    return write_table(m->ctx, path, &table, error);
}

/* A row a class of size, the last two without an upper end: floes beyond the last class, and unbroken ice. */
static fram_status write_sizes(const manage_run *m, const manage_summary *s, const char *path, fram_error *error)
{
    static const csv_column columns[] = {{"size_over", "m"}, {"size_up_to", "m"}, {"upstream", "1"},
                                         {"behind", "1"},    {"at_vessel", "1"},  {"sheet", "1"}};
    text_buffer table = {0};
    csv_text_header(m->ctx, columns, 6, &table);
    for (int k = 0; k <= MANAGE_CLASSES + 1; k++) {
        bool sheet = k > MANAGE_CLASSES;
        double row[6] = {k > 0 && !sheet ? m->unit * manage_class_size[k - 1] : 0,
                         k < MANAGE_CLASSES ? m->unit * manage_class_size[k] : HUGE_VAL};
        for (int p = 0; p < MANAGE_PLACES; p++)
            row[2 + p] = sheet ? s->place[p].sheet : s->place[p].share[k];
        row[5] = sheet;
        csv_text_row(m->ctx, row, 6, &table);
    }
    return write_table(m->ctx, path, &table, error);
}

/* The tables' names are made of the page's: none of them is one of what the runs are made of.  Empty: no tables. */
static fram_status find_paths(context *ctx, const manage_options *options, const char *folder, manage_summary *s,
                              fram_error *error)
{
    char *paths[] = {s->page, s->moments, s->sizes};
    fram_status status = path_given_or(options->output, folder, "manage.html", s->page, error);
    if (status == FRAM_OK && fill_is_stream(s->page)) {
        log_write(ctx, LOG_WARNING, "%s: a page that goes into a stream has no tables beside it: none are written",
                  s->page);
        return FRAM_OK;
    }
    if (status == FRAM_OK)
        status = beside_page(s->page, ".csv", s->moments, error);
    if (status == FRAM_OK)
        status = beside_page(s->page, "-sizes.csv", s->sizes, error);
    if (status == FRAM_OK && strcmp(s->page, s->moments) == 0)
        status = error_set(error, FRAM_ERROR_USAGE, s->page, 0, "output",
                           "expected the name of a page, as manage.html: its tables are named after it, with .csv");
    for (size_t i = 0; i < sizeof paths / sizeof *paths && status == FRAM_OK; i++) {
        status = path_refuse_long(s->page, paths[i], error);
        if (status == FRAM_OK)
            status = path_take(folder, paths[i], error);
        if (status == FRAM_OK && options->beside)
            status = path_take(options->beside, paths[i], error);
    }
    return status;
}

static fram_status write_tables(const manage_run *m, const manage_summary *s, fram_error *error)
{
    fram_status status = s->moments[0] ? write_moments(m, s->moments, error) : FRAM_OK;
    return status == FRAM_OK && s->sizes[0] ? write_sizes(m, s, s->sizes, error) : status;
}

/* ---- all ---- */

fram_status manage_write(context *ctx, const char *folder, const manage_options *options, manage_summary *summary,
                         manage_summary *beside, fram_error *error)
{
    manage_run run, other;
    manage_summary other_summary = {.limit = 0}, named = {.limit = 0};
    fram_status status = find_paths(ctx, options, folder, &named, error);
    if (status == FRAM_OK)
        status = manage_read(ctx, folder, options, &run, error);
    if (status != FRAM_OK)
        return status;
    status = manage_sum_up(&run, summary, error);
    memcpy(summary->page, named.page, sizeof named.page);
    memcpy(summary->moments, named.moments, sizeof named.moments);
    memcpy(summary->sizes, named.sizes, sizeof named.sizes);
    bool both = options->beside != NULL && status == FRAM_OK;
    if (both) {
        manage_options same = *options;
        same.limit = run.limit;
        same.unit = run.unit;
        same.compared = true;
        status = manage_read(ctx, options->beside, &same, &other, error);
        both = status == FRAM_OK;
    }
    if (both)
        status = manage_sum_up(&other, &other_summary, error);
    if (status == FRAM_OK)
        status = manage_page(&run, summary, both ? &other : NULL, both ? &other_summary : NULL, error);
    if (status == FRAM_OK)
        status = write_tables(&run, summary, error);
    if (beside)
        *beside = other_summary;
    if (both)
        manage_free(&other);
    manage_free(&run);
    return status;
}
