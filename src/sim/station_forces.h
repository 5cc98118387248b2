/* Stage 1 of a step for vessels on station: controllers, thrusters and mooring lines add to the external forces. */
#ifndef SIM_STATION_FORCES_H
#define SIM_STATION_FORCES_H

#include "model/world.h"

/* Adds to scratch.loads.  What befell a vessel is booked in the table of events. */
fram_status station_forces(context *ctx, const model *m, world *w, fram_error *error);

#endif
