/* The hull of a scenario: made from its particulars or read from its file, as a solid about the centre of mass. */
#ifndef SIM_BUILD_HULL_H
#define SIM_BUILD_HULL_H

#include "model/model.h"
#include "model/scenario_vessel.h"

/* Appends the hull to the solids, and fills what out tells of it.  Errors name the key at fault, or place and element
   of the mesh file. */
fram_status build_hull(context *ctx, const scenario *s, const vessel_entry *entry, solid_array *solids,
                       vessel_model *out, fram_error *error);

#endif
