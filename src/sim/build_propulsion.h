/* From the keys of a vessel that drives itself to its rows (vessel/propulsion.h). */
#ifndef SIM_BUILD_PROPULSION_H
#define SIM_BUILD_PROPULSION_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* Nothing for a vessel without a bollard pull. */
fram_status build_propulsion(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, int32_t vessel,
                             world *w, fram_error *error);

#endif
