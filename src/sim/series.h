/* The time series of a run: which channels there are, and their values now. */
#ifndef SIM_SERIES_H
#define SIM_SERIES_H

#include "io/csv.h"
#include "model/scenario.h"
#include "model/world.h"

enum { SERIES_ROOM = 384 };
/* The columns of a run: the same for all but for those of each mooring line and thruster at the end. */
typedef struct series_layout {
    int32_t count;
    csv_column column[SERIES_ROOM];
    char name[SERIES_ROOM][32]; /* of the numbered ones; a layout must not be moved */
} series_layout;

/* The columns; channels of a vessel are 0 without one. */
void series_columns(const scenario *s, series_layout *out);
/* One row.  wall: time that the step took [s]. */
void series_row(const world *w, double wall, double out[SERIES_ROOM]);

/* The same for the table of broken floes; time: the end of the step in which it broke [s]. */
const csv_column *fracture_columns(int32_t *count);
void fracture_row(double time, const fracture_event *e, double out[SERIES_ROOM]);

#endif
