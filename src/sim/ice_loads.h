/* What the ice does to the vessels in a step: sums of the solved contact impulses. */
#ifndef SIM_ICE_LOADS_H
#define SIM_ICE_LOADS_H

#include "sim/step.h"

/* Fills scratch.ice_loads, one per vessel, books the energy dissipated at the crushing limit, and writes the load
   window's row of this step. */
fram_status sum_ice_loads(context *ctx, const step_settings *settings, world *w, fram_error *error);

/* Load of the contacts on a vessel in the step before, zero for others than the first: the window's row of that step.
 */
wrench last_ice_load(const world *w, int32_t vessel);

/* Average of the load window [N], [N m] over the steps done so far in it, at most its whole length. */
wrench load_window_average(const world *w);

#endif
