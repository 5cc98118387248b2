#include "io/velocity_file.h"

#include "io/csv_read.h"

#include <math.h>

enum { VELOCITY_AT, VELOCITY_X, VELOCITY_Y, VELOCITY_COLUMNS };
typedef struct velocity_rows {
    double_array column[VELOCITY_COLUMNS];
} velocity_rows;

static const char depth_name[] = "depth[m]";

/* As environment.wind_speed: more is a mistake in the units. */
enum { SPEED_MOST = 200 };

static void velocity_rows_free(context *ctx, velocity_rows *rows)
{
    for (int i = 0; i < VELOCITY_COLUMNS; i++)
        array_free(ctx, &rows->column[i]);
}

/* Row i of one column. */
static fram_status check_number(context *ctx, const velocity_rows *rows, int column, int32_t i, const char *path,
                                const char *name, fram_error *error)
{
    double found = rows->column[column].data[i];
    if (!isfinite(found))
        return error_set(error, FRAM_ERROR_INPUT, path, csv_line_of(ctx, path, i), name, "expected a finite number");
    if (column != VELOCITY_AT && fabs(found) > SPEED_MOST)
        return error_set(error, FRAM_ERROR_INPUT, path, csv_line_of(ctx, path, i), name,
                         "expected at most %d m/s, found %g", (int)SPEED_MOST, found);
    return FRAM_OK;
}

static fram_status check_rows(context *ctx, const velocity_rows *rows, const char *path, const char *const *names,
                              fram_error *error)
{
    const double *at = rows->column[VELOCITY_AT].data;
    int32_t count = rows->column[VELOCITY_AT].count;
    if (count == 0)
        return error_set(error, FRAM_ERROR_INPUT, path, 2, names[VELOCITY_AT],
                         "expected at least one row of numbers, found none");
    for (int32_t i = 0; i < count; i++) {
        for (int c = 0; c < VELOCITY_COLUMNS; c++) {
            fram_status status = check_number(ctx, rows, c, i, path, names[c], error);
            if (status != FRAM_OK)
                return status;
        }
        if (i > 0 && !(at[i] > at[i - 1]))
            return error_set(error, FRAM_ERROR_INPUT, path, csv_line_of(ctx, path, i), names[VELOCITY_AT],
                             "expected more than %g, that of the row before, found %g", at[i - 1], at[i]);
    }
    return FRAM_OK;
}

/* path: becomes where the file is. */
static fram_status velocity_rows_read(context *ctx, const scenario *s, const char *file, const char *first,
                                      char path[SCENARIO_PATH_ROOM], velocity_rows *rows, fram_error *error)
{
    const char *const names[VELOCITY_COLUMNS] = {first, "x[m/s]", "y[m/s]"};
    fram_status status = scenario_file_path(s, NULL, file, path, error);
    if (status == FRAM_OK)
        status = csv_read(ctx, path, names, VELOCITY_COLUMNS, rows->column, error);
    return status == FRAM_OK ? check_rows(ctx, rows, path, names, error) : status;
}

fram_status velocity_file_read(context *ctx, const scenario *s, const char *file, velocity_series *out,
                               fram_error *error)
{
    if (!*file)
        return FRAM_OK;
    velocity_rows rows = {0};
    char path[SCENARIO_PATH_ROOM];
    fram_status status = velocity_rows_read(ctx, s, file, "time[s]", path, &rows, error);
    if (status == FRAM_OK) {
        int32_t count = rows.column[VELOCITY_AT].count;
        out->time = memory_array(ctx, (size_t)count, sizeof *out->time);
        out->velocity = memory_array(ctx, (size_t)count, sizeof *out->velocity);
        status = out->time && out->velocity ? FRAM_OK : error_memory(error);
        for (int32_t i = 0; i < count && status == FRAM_OK; i++) {
            out->time[i] = rows.column[VELOCITY_AT].data[i];
            out->velocity[i] = vec3_make(rows.column[VELOCITY_X].data[i], rows.column[VELOCITY_Y].data[i], 0);
            out->count = count;
        }
    }
    velocity_rows_free(ctx, &rows);
    return status;
}

/* Rising depths, of which there is one at least. */
static fram_status check_depths(context *ctx, const char *path, const double_array *depth, fram_error *error)
{
    if (depth->data[0] < 0)
        return error_set(error, FRAM_ERROR_INPUT, path, csv_line_of(ctx, path, 0), depth_name,
                         "expected a depth below the surface, 0 or more, found %g", depth->data[0]);
    if (depth->count > CURRENT_LEVELS)
        return error_set(error, FRAM_ERROR_INPUT, path, csv_line_of(ctx, path, CURRENT_LEVELS), depth_name,
                         "expected at most %d depths, found %d", (int)CURRENT_LEVELS, (int)depth->count);
    return FRAM_OK;
}

fram_status velocity_profile_read(context *ctx, const scenario *s, const char *file, current_profile *out,
                                  fram_error *error)
{
    if (!*file)
        return FRAM_OK;
    velocity_rows rows = {0};
    char path[SCENARIO_PATH_ROOM];
    fram_status status = velocity_rows_read(ctx, s, file, depth_name, path, &rows, error);
    int32_t count = rows.column[VELOCITY_AT].count;
    if (status == FRAM_OK)
        status = check_depths(ctx, path, &rows.column[VELOCITY_AT], error);
    for (int32_t i = 0; i < count && status == FRAM_OK; i++) {
        out->depth[i] = rows.column[VELOCITY_AT].data[i];
        out->velocity[i] = vec3_make(rows.column[VELOCITY_X].data[i], rows.column[VELOCITY_Y].data[i], 0);
        out->count = count;
    }
    velocity_rows_free(ctx, &rows);
    return status;
}
