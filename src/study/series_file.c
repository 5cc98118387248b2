#include "study/series_csv.h"
#include "study/series_runs.h"

#include "base/sort.h"
#include "io/path.h"
#include "model/scenario_vessel.h"
#include "results/run_channels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* Times may miss their places by this part of a step: files have few digits. */
#define STEP_TOLERANCE 0.05
/* And by this part of themselves: the last of the 12 digits of a series. */
#define LAST_DIGIT 1e-11

/* ---- runs ---- */

/* The vessel whose `load` this is: NAME.load in a list of vessels; -1: no vessel's. */
static int32_t load_of(const run_data *d, const char *name)
{
    for (int32_t v = 0; v < scenario_vessel_count(&d->s); v++)
        if (strcmp(vessel_channel_name(&d->s, v, "load").text, name) == 0)
            return v;
    return -1;
}

static fram_status no_channel(const run_data *d, const char *name, fram_error *error)
{
    bool vessels = scenario_vessel_count(&d->s) > 0;
    const vessel_channel of_first = vessel_channel_name(&d->s, 0, "load");
    if (load_of(d, name) >= 0)
        return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, name,
                         "the load is made of ice_force_averaged_x and ice_force_averaged_y, of which the run's series "
                         "lacks one");
    /* In a list of vessels nothing is nearer to `load` than the load of one. */
    if (vessels && strcmp(name, "load") == 0 && strcmp(of_first.text, name) != 0)
        return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, name, "each vessel has its own; did you mean %s?",
                         of_first.text);
    return run_refuse_channel(d, name, vessels ? of_first.text : NULL, error);
}

static fram_status take_channel(context *ctx, const run_data *d, const char *name, double_array *value,
                                char unit[UNIT_SIZE], fram_error *error)
{
    const csv_table_column *c = csv_table_find(&d->series, name);
    int32_t vessel = c ? -1 : load_of(d, name);
    const char *x = "ice_force_averaged_x", *y = "ice_force_averaged_y";
    bool load = vessel >= 0 && run_vessel_channel(d, vessel, x) && run_vessel_channel(d, vessel, y);
    if (!c && !load)
        return no_channel(d, name, error);
    snprintf(unit, UNIT_SIZE, "%s", load ? "N" : c->unit);
    bool good = load ? run_size_channel(ctx, d, vessel, x, y, value) : array_resize(ctx, value, d->series.rows);
    for (int32_t i = 0; good && !load && i < value->count; i++)
        value->data[i] = c->value.data[i];
    return good ? FRAM_OK : error_memory(error);
}

static bool is_channel_of(const run_data *d, int32_t vessel, const char *begin, const char *name)
{
    const vessel_channel own = vessel_channel_name(&d->s, vessel, begin);
    return strncmp(name, own.text, strlen(own.text)) == 0;
}

/* Whether a line was let go while rows went on that count: by an event, whose time is that of the row before, in which
   the line has its tension still; or by the channel, where there may be events that nothing tells. */
static bool lines_were_let_go(const run_data *d, int32_t vessel, double from)
{
    const double *time = run_channel(d, "time"), *gone = run_vessel_channel(d, vessel, "lines_parted");
    int32_t last = d->series.rows - 1, first = time ? first_time_after(time, last + 1, from) : 0;
    if (!time || first > last)
        return false;
    double begin = time[first] - 0.5 * d->s.run.time_step;
    return run_event_from(d, vessel, EVENT_LINE_RELEASE, begin) < HUGE_VAL ||
           (run_lacks_events(d) && gone && gone[last] > gone[first]);
}

/* Notes lines that parted, where the channel is one of a vessel's line tensions or its offset, and that were let go
   after what is left out. */
static void note_lines(const run_data *d, const series_source *source, series_data *out)
{
    double from = isnan(source->from) ? d->s.run.transient : source->from;
    for (int32_t v = 0; source->channel && v < scenario_vessel_count(&d->s); v++) {
        out->offset = is_channel_of(d, v, "offset_", source->channel);
        bool tension = is_channel_of(d, v, "line_", source->channel) && strstr(source->channel, "tension");
        if (!out->offset && !tension)
            continue;
        bool parted = run_lines_broken(d, v) > 0;
        out->parted += parted;
        out->fewer += parted || lines_were_let_go(d, v, from);
        return;
    }
}

static fram_status read_run(context *ctx, const char *folder, const series_source *source, series_runs *runs,
                            double_array *time, double_array *value, series_data *out, char unit[UNIT_SIZE],
                            double *from, fram_error *error)
{
    run_data d;
    if (source->step > 0)
        return series_refuse_step(folder, error);
    /* The channel, or what a load is made of, and what tells of lines that parted. */
    const char *const kept[] = {"time", "lines_parted", "ice_force_averaged_x", "ice_force_averaged_y",
                                source->channel ? source->channel : "time"};
    const csv_wish wish = {kept, sizeof kept / sizeof *kept};
    fram_status status = run_data_read(ctx, folder, false, &wish, &d, error);
    if (status != FRAM_OK)
        return status;
    if (d.is_changed && runs->changed++ == 0)
        runs->first_changed = folder;
    const double *t = run_channel(&d, "time");
    int32_t vessel;
    if (d.series.rows == 0)
        status = run_data_refuse_empty(&d, error);
    else if (!source->channel) /* the load is a vessel's */
        status = scenario_choose_vessel(&d.s, folder, NULL, &vessel, error);
    if (status == FRAM_OK)
        status = take_channel(ctx, &d, source->channel ? source->channel : "load", value, unit, error);
    if (status == FRAM_OK && (!t || !array_resize(ctx, time, d.series.rows)))
        status = error_memory(error);
    for (int32_t i = 0; status == FRAM_OK && i < time->count; i++)
        time->data[i] = t[i];
    if (status == FRAM_OK && strcmp(d.note.status, "failed") == 0)
        log_write(ctx, LOG_WARNING, "%s: the run failed at %.6g s of %.6g s; its series up to there counts", folder,
                  d.note.time, d.s.run.duration);
    *from = d.s.run.transient;
    if (status == FRAM_OK)
        note_lines(&d, source, out);
    if (status == FRAM_OK)
        status = series_runs_add(ctx, runs, &d, folder, error);
    run_data_free(ctx, &d);
    return status;
}

/* ---- all files ---- */

/* The middle one of the steps between rows, of two rows and more; 0: no memory. */
static double usual_step(context *ctx, const double_array *time)
{
    int32_t count = time->count - 1;
    double *step = memory_array(ctx, (size_t)count, sizeof *step), middle = 0;
    for (int32_t i = 0; step && i < count; i++)
        step[i] = time->data[i + 1] - time->data[i];
    if (step) {
        numbers_sort(step, count);
        middle = step[count / 2];
    }
    memory_free(ctx, step);
    return middle;
}

/* The first step that is another than the usual one; else, of times that do not rise on the whole, the first that does
   not; else what has gone wrong by row i. */
static fram_status refuse_times(context *ctx, const char *path, const series_rows *rows, int32_t i, double own,
                                fram_error *error)
{
    const double_array *time = &rows->time;
    double usual = usual_step(ctx, time);
    for (int32_t k = 1; k < time->count && usual > 0; k++) {
        double step = time->data[k] - time->data[k - 1];
        if (fabs(step - usual) > STEP_TOLERANCE * usual)
            return error_set(error, FRAM_ERROR_INPUT, path, series_line(rows, k), "time",
                             "expected times at equal distances, %.6g s as most are, found one of %.6g s, to %.9g: "
                             "interpolate the series first",
                             usual, step, time->data[k]);
    }
    for (int32_t k = 1; k < time->count && !(own > 0); k++) {
        if (!(time->data[k] > time->data[k - 1]))
            return error_set(error, FRAM_ERROR_INPUT, path, series_line(rows, k), "time",
                             "expected rising times, in seconds, found %.9g after %.9g", time->data[k],
                             time->data[k - 1]);
    }
    return error_set(error, FRAM_ERROR_INPUT, path, series_line(rows, i), "time",
                     "expected times at equal distances, %.6g s on the average; found %.9g where %.9g was due: "
                     "interpolate the series first",
                     own, time->data[i], time->data[0] + i * own);
}

/* The step between rows, the same within a file and in all of them. */
static fram_status check_times(context *ctx, const char *path, const series_rows *rows, double *step, fram_error *error)
{
    const double_array *time = &rows->time;
    int32_t n = time->count;
    if (n < 2)
        return FRAM_OK;
    double own = (time->data[n - 1] - time->data[0]) / (n - 1);
    if (!(own > 0))
        return refuse_times(ctx, path, rows, n - 1, own, error);
    for (int32_t i = 0; i < n; i++) {
        if (fabs(time->data[i] - time->data[0] - i * own) <= STEP_TOLERANCE * own + LAST_DIGIT * fabs(time->data[i]))
            continue;
        return refuse_times(ctx, path, rows, i, own, error);
    }
    if (*step > 0 && fabs(own - *step) > 1e-3 * own)
        return error_set(error, FRAM_ERROR_INPUT, path, 2, "time",
                         "expected the step of the other files, %.6g s, found %.6g s", *step, own);
    *step = *step > 0 ? *step : own;
    return FRAM_OK;
}

static bool is_folder(const char *path)
{
    struct stat state;
    return stat(path, &state) == 0 && S_ISDIR(state.st_mode);
}

/* Leaves out what is not after `from`, and turns the sign for minima. */
static void trim(double_array *value, const double_array *time, double step, double from, bool minima)
{
    int32_t first = 0;
    while (first < value->count && !time_is_after(time->count > 0 ? time->data[first] : first * step, from))
        first++;
    for (int32_t i = first; i < value->count; i++)
        value->data[i - first] = minima ? 0 - value->data[i] : value->data[i]; /* 0, not -0 */
    value->count -= first;
}

/* Without values none. */
static double greatest_of(const double_array *value)
{
    double most = value->count > 0 ? value->data[0] : HUGE_VAL;
    for (int32_t i = 1; i < value->count; i++)
        most = fmax(most, value->data[i]);
    return most;
}

static fram_status read_file(context *ctx, const series_source *source, int32_t i, series_runs *runs, series_data *out,
                             fram_error *error)
{
    const char *path = source->files[i];
    char table[PATH_ROOM] = ""; /* whose lines are told */
    series_rows rows = {0};
    double_array *value = &out->values[i];
    double from = -HUGE_VAL; /* times of a file may begin below zero */
    int32_t parted = out->parted;
    fram_status status = FRAM_OK;
    char unit[UNIT_SIZE];
    if (is_folder(path) && !source->maxima) {
        status = path_join(path, "series.csv", table, error);
        if (status == FRAM_OK)
            status = read_run(ctx, path, source, runs, &rows.time, value, out, unit, &from, error);
        path = table;
    } else {
        status = series_read_csv(ctx, path, source, &rows, value, unit, error);
    }
    if (status == FRAM_OK && i > 0 && strcmp(unit, out->unit) != 0)
        status = error_set(error, FRAM_ERROR_INPUT, path, 1, source->channel,
                           "expected the unit of the other files, [%s], found [%s]", out->unit, unit);
    if (status == FRAM_OK && !source->maxima)
        status = check_times(ctx, path, &rows, &out->set.step, error);
    if (status == FRAM_OK) {
        memcpy(out->unit, unit, sizeof out->unit);
        if (!source->maxima)
            trim(value, &rows.time, out->set.step, isnan(source->from) ? from : source->from, source->minima);
        else
            trim(value, &rows.time, 1, -1, source->minima);
        out->parts[i] = (series_part){value->data, value->count};
        if (out->parted > parted && !source->minima)
            out->held = fmin(out->held, greatest_of(value));
    }
    array_free(ctx, &rows.time);
    array_free(ctx, &rows.line);
    return status;
}

/* One file by two names; copies of a run are found as it is read. */
static fram_status check_different(context *ctx, const series_source *source, fram_error *error)
{
    struct stat *state = memory_array(ctx, (size_t)source->count, sizeof *state);
    fram_status status = state ? FRAM_OK : error_memory(error);
    for (int32_t i = 0; i < source->count && status == FRAM_OK; i++) {
        if (stat(source->files[i], &state[i]) != 0)
            state[i].st_ino = 0;
        for (int32_t k = 0; k < i && state[i].st_ino != 0 && status == FRAM_OK; k++)
            if (state[k].st_ino == state[i].st_ino && state[k].st_dev == state[i].st_dev)
                status = series_refuse_twice(source->files[i], source->files[k], error);
    }
    memory_free(ctx, state);
    return status;
}

fram_status series_read(context *ctx, const series_source *source, series_data *out, fram_error *error)
{
    series_runs runs = {0};
    *out = (series_data){.count = source->count, .held = HUGE_VAL};
    if (source->channel && strcmp(source->channel, "time") == 0 && !source->maxima && !(source->step > 0))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "channel",
                         "`time` tells when the values of the others were taken: name one of those");
    out->parts = memory_array(ctx, (size_t)source->count, sizeof *out->parts);
    out->values = memory_array(ctx, (size_t)source->count, sizeof *out->values);
    fram_status status = out->parts && out->values ? check_different(ctx, source, error) : error_memory(error);
    out->set.step = source->step > 0 ? source->step : 0;
    for (int32_t i = 0; i < source->count && status == FRAM_OK; i++)
        status = read_file(ctx, source, i, &runs, out, error);
    run_warn_changes(ctx, runs.first_changed, runs.changed);
    series_runs_free(ctx, &runs);
    int64_t values = 0;
    for (int32_t i = 0; i < source->count && status == FRAM_OK; i++)
        values += out->values[i].count;
    if (status == FRAM_OK && (values == 0 || (!source->maxima && !(out->set.step > 0))))
        status = error_set(error, FRAM_ERROR_INPUT, source->files[0], 0, source->channel,
                           values > 0 ? "one value alone tells no step in time: expected two or more"
                                      : "no values are left, after what is left out at the start");
    out->set.parts = out->parts;
    out->set.count = source->count;
    if (status != FRAM_OK)
        series_free(ctx, out);
    return status;
}

void series_free(context *ctx, series_data *s)
{
    for (int32_t i = 0; s->values && i < s->count; i++)
        array_free(ctx, &s->values[i]);
    memory_free(ctx, s->values);
    memory_free(ctx, s->parts);
    *s = (series_data){0};
}
