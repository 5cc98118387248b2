/* Vessels that watch for others that are going to pass too close (vessel/approach.h). */
#ifndef SIM_APPROACH_WATCH_H
#define SIM_APPROACH_WATCH_H

#include "model/world.h"

/* What is fixed of a vessel's watch, once its hull is made: limit, and the outline that it has for others. */
fram_status approach_watch_model(context *ctx, const scenario *s, const vessel_entry *entry, const model *m,
                                 vessel_model *out, fram_error *error);
/* The outline of a vessel's hull, upright, with its centre of mass at a place and its bow along a unit vector.  false:
   no memory. */
bool approach_outline(context *ctx, const model *m, int32_t vessel, vec2 at, vec2 ahead, vec2_array *out);
/* A row for each vessel that watches and each other one, once all are there. */
fram_status approach_watch_begin(context *ctx, const model *m, world *w, fram_error *error);
/* At the step's beginning, where a look is due: what is predicted becomes events. */
fram_status approach_watch(context *ctx, const model *m, world *w, fram_error *error);

#endif
