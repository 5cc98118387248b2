/* What the files of a drifting sheet share; see drift.h. One module with drift, whose inside this is. */
#ifndef ICE_DRIFT_PARTS_H
#define ICE_DRIFT_PARTS_H

#include "ice/drift.h"

/* Mass of the tiles that are there [kg]. */
double drift_tile_mass(const drift_world *w);
/* Cells that are clear of the window leave, and others enter, until the window is covered. */
fram_status drift_shift(context *ctx, overlay *plane, const drift_world *w, fram_error *error);

#endif
