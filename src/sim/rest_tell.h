/* What a reader is told of a vessel that does not begin at rest: it capsizes, heels or trims, floats at another draught
   than its own, or its lines pull it down or over.  One module with vessel_check, which asks. */
#ifndef SIM_REST_TELL_H
#define SIM_REST_TELL_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* Warnings to the log.  upright: how the hull floats with its own mass, ship coordinates; w holds the vessel where it
   begins, and its lines; row: its row in model and world. */
void rest_tell(context *ctx, const scenario *s, const vessel_entry *entry, const vessel_model *hull,
               const hull_hydrostatics *upright, const world *w, int32_t row);

#endif
