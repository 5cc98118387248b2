#include "sim/build_media.h"

#include "io/csv_read.h"

#include <string.h>

enum { AT, ALONG_X, ALONG_Y, COLUMNS };

/* As environment.wind_speed: more is a mistake in the units. */
enum { SPEED_MOST = 200 };

typedef struct velocity_rows {
    double_array column[COLUMNS];
} velocity_rows;

static void rows_free(context *ctx, velocity_rows *rows)
{
    for (int i = 0; i < COLUMNS; i++)
        array_free(ctx, &rows->column[i]);
}

/* Line 1 is the header. */
static fram_status check_rows(const velocity_rows *rows, const char *path, const char *first, fram_error *error)
{
    const double *at = rows->column[AT].data;
    int32_t count = rows->column[AT].count;
    if (count == 0)
        return error_set(error, FRAM_ERROR_INPUT, path, 2, first, "expected at least one row of numbers, found none");
    for (int32_t i = 0; i < count; i++) {
        double x = rows->column[ALONG_X].data[i], y = rows->column[ALONG_Y].data[i];
        if (!isfinite(at[i]) || !isfinite(x) || !isfinite(y))
            return error_set(error, FRAM_ERROR_INPUT, path, i + 2, first, "expected finite numbers");
        if (!(fabs(x) <= SPEED_MOST && fabs(y) <= SPEED_MOST))
            return error_set(error, FRAM_ERROR_INPUT, path, i + 2, first, "expected at most %d m/s, found %g and %g",
                             (int)SPEED_MOST, x, y);
        if (i > 0 && !(at[i] > at[i - 1]))
            return error_set(error, FRAM_ERROR_INPUT, path, i + 2, first,
                             "expected more than %g, that of the row before, found %g", at[i - 1], at[i]);
    }
    return FRAM_OK;
}

/* A file of velocities; first: name of its first column. */
static fram_status read_rows(context *ctx, const scenario *s, const char *file, const char *first, velocity_rows *rows,
                             fram_error *error)
{
    const char *const names[COLUMNS] = {first, "x[m/s]", "y[m/s]"};
    char path[2 * SCENARIO_TEXT_SIZE];
    if (!scenario_resolve_path(s, file, path, sizeof path))
        return error_set(error, FRAM_ERROR_INPUT, file, 0, NULL, "the path is too long");
    fram_status status = csv_read(ctx, path, names, COLUMNS, rows->column, error);
    return status == FRAM_OK ? check_rows(rows, path, first, error) : status;
}

fram_status velocity_file_read(context *ctx, const scenario *s, const char *file, velocity_series *out,
                               fram_error *error)
{
    if (!*file)
        return FRAM_OK;
    velocity_rows rows = {0};
    fram_status status = read_rows(ctx, s, file, "time[s]", &rows, error);
    if (status == FRAM_OK) {
        int32_t count = rows.column[AT].count;
        out->time = memory_array(ctx, (size_t)count, sizeof *out->time);
        out->velocity = memory_array(ctx, (size_t)count, sizeof *out->velocity);
        status = out->time && out->velocity ? FRAM_OK : error_memory(error);
        for (int32_t i = 0; i < count && status == FRAM_OK; i++) {
            out->time[i] = rows.column[AT].data[i];
            out->velocity[i] = vec3_make(rows.column[ALONG_X].data[i], rows.column[ALONG_Y].data[i], 0);
            out->count = count;
        }
    }
    rows_free(ctx, &rows);
    return status;
}

static fram_status read_profile(context *ctx, const scenario *s, const char *file, current_profile *out,
                                fram_error *error)
{
    if (!*file)
        return FRAM_OK;
    velocity_rows rows = {0};
    fram_status status = read_rows(ctx, s, file, "depth[m]", &rows, error);
    int32_t count = rows.column[AT].count;
    if (status == FRAM_OK && (count < 1 || count > CURRENT_LEVELS || rows.column[AT].data[0] < 0))
        status = error_set(error, FRAM_ERROR_INPUT, file, 0, "depth[m]",
                           "expected 1 to %d depths, from 0 on, found %d, from %g on", (int)CURRENT_LEVELS, (int)count,
                           count < 1 ? 0 : rows.column[AT].data[0]);
    for (int32_t i = 0; i < count && status == FRAM_OK; i++) {
        out->depth[i] = rows.column[AT].data[i];
        out->velocity[i] = vec3_make(rows.column[ALONG_X].data[i], rows.column[ALONG_Y].data[i], 0);
        out->count = count;
    }
    rows_free(ctx, &rows);
    return status;
}

fram_status build_media(context *ctx, const scenario *s, media_history *out, fram_error *error)
{
    const scenario_environment *e = &s->environment;
    fram_status status = velocity_file_read(ctx, s, e->current_file, &out->current, error);
    if (status == FRAM_OK)
        status = velocity_file_read(ctx, s, e->wind_file, &out->wind, error);
    if (status == FRAM_OK)
        status = velocity_file_read(ctx, s, s->domain.drift_file, &out->drift, error);
    if (status == FRAM_OK)
        status = read_profile(ctx, s, e->current_profile_file, &out->profile, error);
    return status;
}
