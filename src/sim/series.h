/* The time series of a run: which channels there are, and their values now. */
#ifndef SIM_SERIES_H
#define SIM_SERIES_H

#include "io/csv.h"
#include "model/world.h"

/* The columns, always all of them; channels of a vessel are 0 without one. */
const csv_column *series_columns(int32_t *count);
enum { SERIES_ROOM = 128 };
/* One row.  wall: time that the step took [s]. */
void series_row(const world *w, double wall, double out[SERIES_ROOM]);

#endif
