/* The time series of a run: which channels there are, and their values now. */
#ifndef SIM_SERIES_H
#define SIM_SERIES_H

#include "io/csv.h"
#include "model/scenario.h"
#include "model/world.h"

/* Name of a column. */
typedef struct series_name {
    char text[80];
    const char *unit;
    bool of_mechanism; /* a part of the load by its mechanism: what contacts are counted as, which no motion hangs on */
} series_name;

/* The columns of a run, the same for all scenarios with one vessel but for those of each mooring line and thruster at
   the end.  With a list of vessels: what is the world's, then each vessel's, its name and a point before theirs. */
typedef struct series_layout {
    ARRAY(series_name) names;
    ARRAY(csv_column) columns; /* refer to the names */
    bool named;                /* vessels have names */
} series_layout;

/* Columns of a vessel that is not there are 0. */
fram_status series_columns(context *ctx, const scenario *s, series_layout *out, fram_error *error);
/* How many there are. */
double series_column_number(const scenario *s);
void series_layout_free(context *ctx, series_layout *l);
/* One row, of as many values as there are columns.  wall_time: what the step took [s]. */
void series_row(const context *ctx, const series_layout *l, const world *w, double wall_time, double *out);

/* Columns of the table of broken floes, at most. */
enum { FRACTURE_ROOM = 64 };
/* The same for the table of broken floes; time: the end of the step in which it broke [s]. */
const csv_column *fracture_columns(int32_t *count);
void fracture_row(double time, const fracture_event *e, double out[FRACTURE_ROOM]);

#endif
