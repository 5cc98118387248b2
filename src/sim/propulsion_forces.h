/* Vessels that drive themselves in a step (vessel/propulsion.h): what they know of water and ice. */
#ifndef SIM_PROPULSION_FORCES_H
#define SIM_PROPULSION_FORCES_H

#include "model/world.h"

/* After the water's forces are known: steers, and adds thrust to the loads. */
fram_status propulsion_forces(context *ctx, const model *m, world *w, fram_error *error);

#endif
