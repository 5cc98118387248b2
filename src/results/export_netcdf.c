/* The floes' part is written frame by frame from a second reading of the record: the first tells how many frames and
   floes there are. */
#include "results/export.h"

#include "base/transcendental.h"
#include "fram/version.h"
#include "io/csv_read.h"
#include "io/file.h"
#include "io/netcdf_file.h"
#include "results/replay.h"
#include "results/run_data.h"
#include "results/run_record.h"

#include <stdio.h>
#include <string.h>

/* ---- columns of CSV files ---- */

/* Columns over a dimension, which is the column of the same name where there is one.  All of them are there before any
   has values: NetCDF ends its definitions at the first value, and writes the list of a dimension's variables anew at
   each end, which of thousands of columns makes the most of the file. */
static bool put_table(context *ctx, netcdf_file *f, const csv_table *t, const char *dimension, const char *prefix)
{
    int over = netcdf_dimension(f, dimension, (size_t)t->rows);
    int *variable = memory_array(ctx, (size_t)t->columns.count + 1, sizeof *variable);
    for (int32_t k = 0; k < t->columns.count && variable; k++) {
        const csv_table_column *c = &t->columns.data[k];
        char name[COLUMN_NAME_SIZE + 16];
        snprintf(name, sizeof name, "%.15s%s", prefix, c->name);
        variable[k] = netcdf_variable(f, name, NETCDF_F64, &over, 1, c->unit, "");
    }
    for (int32_t k = 0; k < t->columns.count && variable && t->rows > 0; k++)
        netcdf_put_f64(f, variable[k], t->columns.data[k].value.data);
    bool good = variable != NULL;
    memory_free(ctx, variable);
    return good;
}

static fram_status put_csv(context *ctx, netcdf_file *f, const char *folder, const char *file, const char *dimension,
                           const char *prefix, fram_error *error)
{
    char path[PATH_ROOM];
    csv_table t;
    fram_status status = path_join(folder, file, path, error);
    if (status == FRAM_OK)
        status = csv_table_read(ctx, path, NULL, &t, error);
    if (status != FRAM_OK)
        return status;
    if (!*prefix) /* the one over time */
        status = run_series_check(&t, path, error);
    if (status == FRAM_OK && !put_table(ctx, f, &t, dimension, prefix))
        status = error_memory(error);
    csv_table_free(ctx, &t);
    return status;
}

/* Read as a run they are warned of where rows are missing; alone where what is beside them cannot be read. */
static fram_status put_tables(context *ctx, netcdf_file *f, const char *folder, fram_error *error)
{
    run_data d;
    fram_status status = run_data_read(ctx, folder, false, NULL, &d, error);
    if (status == FRAM_OK) {
        bool good =
            put_table(ctx, f, &d.series, "time", "") && put_table(ctx, f, &d.fractures, "fracture", "fracture_");
        run_data_free(ctx, &d);
        return good ? FRAM_OK : error_memory(error);
    }
    if (status == FRAM_ERROR_MEMORY || status == FRAM_INTERRUPTED)
        return status;
    status = put_csv(ctx, f, folder, "series.csv", "time", "", error);
    return status == FRAM_OK ? put_csv(ctx, f, folder, "fractures.csv", "fracture", "fracture_", error) : status;
}

/* ---- floes over frames ---- */

/* Floats, but where one far from 0 would have no millimetres. */
static const struct {
    const char *name, *unit, *meaning;
    netcdf_type type;
} columns[] = {
    {"floe_x", "m", "centre of mass, global frame", NETCDF_F64},
    {"floe_y", "m", "centre of mass, global frame", NETCDF_F64},
    {"floe_z", "m", "centre of mass over still water", NETCDF_F32},
    {"floe_heading", "deg",
     "yaw of the axes of the floe's outline, counter-clockwise; a piece begins with its parent's", NETCDF_F32},
    {"floe_roll", "deg", "tilt about the floe's x axis", NETCDF_F32},
    {"floe_pitch", "deg", "tilt about the floe's y axis", NETCDF_F32},
    {"floe_velocity_x", "m/s", "way to the next frame over its time", NETCDF_F32},
    {"floe_velocity_y", "m/s", "way to the next frame over its time", NETCDF_F32},
    {"floe_contact_force", "N", "sum of the magnitudes at the floe's contacts in the step of the frame", NETCDF_F32},
};
enum { TRACK_COLUMNS = sizeof columns / sizeof *columns };

typedef struct floe_tracks {
    context *ctx;
    replay r;
    int32_array row; /* of each body of the record among the floes, -1 */
    int32_t floes;
    int64_t frames;
    double_array time;
    int variable[TRACK_COLUMNS];
    double *values; /* TRACK_COLUMNS x floes */
} floe_tracks;

static fram_status count_floes(floe_tracks *t, const char *folder, fram_error *error)
{
    bool found = true;
    fram_status status = replay_open_any(t->ctx, folder, &t->r, error);
    if (status != FRAM_OK)
        return status;
    while (status == FRAM_OK) {
        status = replay_next(&t->r, &found, error);
        if (status != FRAM_OK || !found)
            break;
        if (!array_push(t->ctx, &t->time, t->r.frame.time))
            status = error_memory(error);
    }
    for (int32_t i = 0; i < t->r.bodies.count && status == FRAM_OK; i++) {
        bool floe = t->r.bodies.data[i].number >= 0;
        if (!array_push(t->ctx, &t->row, floe ? t->floes : -1))
            status = error_memory(error);
        t->floes += floe;
    }
    return status;
}

/* What a floe keeps for life. */
static fram_status put_constants(floe_tracks *t, netcdf_file *f, int floe, fram_error *error)
{
    enum { THICKNESS, AREA, MASS, BIRTH, REALS };
    static const char *const names[REALS] = {"floe_thickness", "floe_area", "floe_mass", "floe_birth"};
    static const char *const units[REALS] = {"m", "m2", "kg", "s"};
    static const char *const meanings[REALS] = {
        [BIRTH] = "time of the break that made the floe; of one that no break made, of its first frame"};
    size_t count = (size_t)t->floes;
    double *real = memory_array(t->ctx, count + 1, REALS * sizeof *real);
    int32_t *whole = memory_array(t->ctx, count + 1, 2 * sizeof *whole);
    fram_status status = real && whole ? FRAM_OK : error_memory(error);
    for (int32_t i = 0; i < t->r.bodies.count && status == FRAM_OK; i++) {
        const replay_body *b = &t->r.bodies.data[i];
        size_t k = t->row.data[i] < 0 ? count : (size_t)t->row.data[i];
        if (k == count)
            continue;
        real[THICKNESS * count + k] = b->thickness;
        real[AREA * count + k] = b->area;
        real[MASS * count + k] = b->area * b->thickness * b->density;
        real[BIRTH * count + k] = b->birth;
        whole[k] = b->number;
        whole[count + k] = b->parent;
    }
    if (status == FRAM_OK && count > 0) {
        for (int k = 0; k < REALS; k++)
            netcdf_put_f64(f,
                           netcdf_variable(f, names[k], NETCDF_F64, &floe, 1, units[k], meanings[k] ? meanings[k] : ""),
                           real + (size_t)k * count);
        netcdf_put_i32(f, netcdf_variable(f, "floe", NETCDF_I32, &floe, 1, "", "running number of the floe"), whole);
        netcdf_put_i32(f, netcdf_variable(f, "floe_parent", NETCDF_I32, &floe, 1, "", "floe it broke from, -1: none"),
                       whole + count);
    }
    memory_free(t->ctx, real);
    memory_free(t->ctx, whole);
    return status;
}

static void put_track_frame(floe_tracks *t, netcdf_file *f)
{
    size_t count = (size_t)t->floes;
    for (size_t i = 0; i < TRACK_COLUMNS * count; i++)
        t->values[i] = (double)NAN;
    for (int32_t i = 0; i < t->r.frame.poses.count; i++) {
        const replay_pose *p = &t->r.frame.poses.data[i];
        if (t->row.data[p->body] < 0)
            continue;
        vec3 rpy = quat_roll_pitch_yaw(p->orientation);
        const double value[TRACK_COLUMNS] = {p->position.x,  p->position.y,  p->position.z,
                                             degrees(rpy.z), degrees(rpy.x), degrees(rpy.y),
                                             p->velocity.x,  p->velocity.y,  p->contact_force};
        for (size_t k = 0; k < TRACK_COLUMNS; k++)
            t->values[k * count + (size_t)t->row.data[p->body]] = value[k];
    }
    for (size_t k = 0; k < TRACK_COLUMNS; k++)
        netcdf_put_row(f, t->variable[k], (size_t)t->r.frame.number, t->values + k * count, count);
}

static fram_status put_frames(floe_tracks *t, netcdf_file *f, const char *folder, fram_error *error)
{
    int over[2] = {netcdf_dimension(f, "frame", (size_t)t->time.count), netcdf_dimension(f, "floe", (size_t)t->floes)};
    int time = netcdf_variable(f, "frame", NETCDF_F64, over, 1, "s", "simulated time of the frame");
    fram_status status = put_constants(t, f, over[1], error);
    netcdf_put_f64(f, time, t->time.data);
    for (int k = 0; k < TRACK_COLUMNS; k++)
        t->variable[k] =
            netcdf_variable(f, columns[k].name, columns[k].type, over, 2, columns[k].unit, columns[k].meaning);
    replay_close(&t->r);
    if (status == FRAM_OK)
        status = replay_open(t->ctx, folder, &t->r, error);
    bool found = true;
    while (status == FRAM_OK) {
        status = replay_next(&t->r, &found, error);
        /* A run that goes on has more frames by now. */
        if (status != FRAM_OK || !found || t->r.frame.number >= t->time.count)
            break;
        put_track_frame(t, f);
    }
    return status;
}

/* Of a run without frames or record nothing. */
static fram_status put_floes(context *ctx, netcdf_file *f, const char *folder, export_report *report, fram_error *error)
{
    floe_tracks t = {.ctx = ctx};
    if (run_lacks_record(folder)) {
        log_write(ctx, LOG_WARNING, "%s: " RUN_WITHOUT_RECORD ": no floes are written", folder);
        return FRAM_OK;
    }
    fram_status status = count_floes(&t, folder, error);
    bool frames = t.time.count > 0;
    if (status == FRAM_OK && frames) {
        report->frames = t.time.count;
        report->time = t.time.data[0];
        t.values = memory_array(ctx, (size_t)t.floes + 1, TRACK_COLUMNS * sizeof *t.values);
        status = t.values ? FRAM_OK : error_memory(error);
    }
    if (status == FRAM_OK && frames && t.floes > 0)
        status = put_frames(&t, f, folder, error);
    memory_free(ctx, t.values);
    array_free(ctx, &t.row);
    array_free(ctx, &t.time);
    replay_close(&t.r);
    return status;
}

/* Before anything is written into a folder that may be none. */
static fram_status check_run(const char *folder, fram_error *error)
{
    char path[PATH_ROOM];
    fram_status status = path_join(folder, "series.csv", path, error);
    return status == FRAM_OK ? file_check(path, error) : status;
}

fram_status export_netcdf(context *ctx, const char *folder, const char *output, export_report *report,
                          fram_error *error)
{
    netcdf_file f;
    *report = (export_report){0};
    fram_status status = path_given_or(output, folder, "run.nc", report->path, error);
    if (status == FRAM_OK)
        status = check_run(folder, error);
    if (status == FRAM_OK)
        status = netcdf_begin(ctx, report->path, &f, error);
    if (status != FRAM_OK)
        return status;
    netcdf_attribute(&f, "title", "Time series of a run of Fram");
    netcdf_attribute(&f, "source", "fram " FRAM_VERSION);
    netcdf_attribute(&f, "frame_of_reference", "X, Y horizontal, Z up, still water at z = 0; forces act on the vessel");
    status = put_tables(ctx, &f, folder, error);
    if (status == FRAM_OK)
        status = put_floes(ctx, &f, folder, report, error);
    if (status == FRAM_OK)
        return netcdf_end(&f, error);
    netcdf_abandon(&f);
    return status;
}
