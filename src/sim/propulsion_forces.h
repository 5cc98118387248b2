/* Vessels that drive themselves in a step (vessel/propulsion.h): what they know of water and ice. */
#ifndef SIM_PROPULSION_FORCES_H
#define SIM_PROPULSION_FORCES_H

#include "model/world.h"

/* After the water's forces are known: steers, and adds thrust to the loads. */
/* What the water takes of a vessel's thrust along its bow [N], its velocity at the surface being `water`: drag on the
   hull, and the linear damping of surge. */
double propulsion_resistance(const model *m, const world *w, int32_t vessel, vec2 water);
fram_status propulsion_forces(context *ctx, const model *m, world *w, fram_error *error);

#endif
