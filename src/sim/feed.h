/* The endless field (ice/feeding.h) or the drifting sheet (ice/drift.h) in a step: how fast it drifts, and who is fed.
 */
#ifndef SIM_FEED_H
#define SIM_FEED_H

#include "model/world.h"
#include "vessel/track.h"

/* The parts of a world that feeding reads and changes. */
feeding_world feed_world(world *w);
drift_world feed_sheet(const model *m, world *w);
/* The grid of level ice as it stands. */
tile_grid feed_grid(const model *m, const world *w);
/* Velocity of the far field at a time: what was told from outside, its own history, what the scenario gives, or the
   current at the surface [m/s]. */
vec2 feed_drift(const model *m, const input_table *inputs, double time);
/* From a place to the ice that is going to come there and is this distance [m] away from it at a time, global frame:
   with a forecast as the drift is known to go on, else as if it stayed; and the way through the ice that comes there,
   outward.  Where the ice
   does not come from so far, as far as it comes within four times as long as at the drift of now; at (0, 0): there is
   no drift. */
track_place feed_origin(const model *m, const input_table *inputs, double time, double distance, bool forecast);
/* Before the solve of the step that ends at `time`. */
void feed_drive(const model *m, world *w, double time);
/* After the solve: what the sheet met. */
void feed_load(const model *m, world *w);
/* At the end of the step. */
fram_status feed_step(context *ctx, const model *m, world *w, fram_error *error);

#endif
