/* What is told of how a ship that drives itself turns, before a run: its circle in open water, and tracks that ask
   for more than that, or that lead out of the domain.  One module with vessel_check, which asks. */
#ifndef SIM_TURNING_TELL_H
#define SIM_TURNING_TELL_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* To the log: the radius as a fact, the rest as warnings.  w holds the vessel, row: its row in model and world. */
void turning_tell(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                  int32_t row);

#endif
