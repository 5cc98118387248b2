/* What the ice does to the vessels in a step: sums of the solved contact impulses. */
#ifndef SIM_ICE_LOADS_H
#define SIM_ICE_LOADS_H

#include "model/world.h"

/* Fills scratch.ice_loads, one per vessel, keeps what hulls and walls did for the next step, books the energy
   dissipated at the crushing limit, and writes the load window's rows of this step. */
fram_status sum_ice_loads(context *ctx, const model *m, world *w, fram_error *error);

/* Load of the ice on a vessel in the step before: the window's row of that step. */
wrench last_ice_load(const world *w, int32_t vessel);
/* The same with that of other hulls and of walls. */
wrench last_contact_load(const world *w, int32_t vessel);

/* Average of a vessel's load window [N], [N m] over its whole length; before the first step there was no load.  Zero
   for a vessel that is not there. */
wrench load_window_average(const world *w, int32_t vessel);

#endif
