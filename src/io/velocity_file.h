/* Files of velocities: histories of wind, current and drift, and a current over depth.  Must not know what they move.
 */
#ifndef IO_VELOCITY_FILE_H
#define IO_VELOCITY_FILE_H

#include "fluid/media.h"
#include "io/csv_read.h"
#include "model/scenario.h"

enum { VELOCITY_AT, VELOCITY_X, VELOCITY_Y, VELOCITY_COLUMNS };
typedef struct velocity_rows {
    double_array column[VELOCITY_COLUMNS];
} velocity_rows;

/* Columns `first` ("time[s]"), x[m/s], y[m/s] of a CSV that a scenario names; at least one row, the first column
   ascending, finite speeds within 200 m/s.  FRAM_ERROR_INPUT with file and line. */
fram_status velocity_rows_read(context *ctx, const scenario *s, const char *file, const char *first,
                               velocity_rows *rows, fram_error *error);
void velocity_rows_free(context *ctx, velocity_rows *rows);
/* A history; "": none.  What was read until an error is in `out`, to be freed by the caller. */
fram_status velocity_file_read(context *ctx, const scenario *s, const char *file, velocity_series *out,
                               fram_error *error);

#endif
