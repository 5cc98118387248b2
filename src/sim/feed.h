/* The endless field in a step (ice/feeding.h): how fast it drifts, and who is fed. */
#ifndef SIM_FEED_H
#define SIM_FEED_H

#include "model/world.h"

/* The parts of a world that feeding reads and changes. */
feeding_world feed_world(world *w);
/* Velocity of the far field at a time: what was told from outside, its own history, what the scenario gives, or the
   current at the surface [m/s]. */
vec2 feed_drift(const model *m, const input_table *inputs, double time);
/* Before the solve of the step that ends at `time`. */
void feed_drive(const model *m, world *w, double time);
/* At the end of the step. */
fram_status feed_step(context *ctx, const model *m, world *w, fram_error *error);

#endif
