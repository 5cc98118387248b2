/* The vessels of a scenario in a world. */
#ifndef SIM_BUILD_VESSEL_H
#define SIM_BUILD_VESSEL_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* The world's next vessel, which the model knows as that of the same row: body, carriage and joint, path, and what
   keeps it on station.  Errors name the key at fault. */
fram_status build_vessel(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, world *w,
                         fram_error *error);

/* Radii of gyration in roll, pitch, yaw [m]: given, or usual ones for the hull. */
vec3 build_gyration(const scenario_vessel *v, const hull_particulars *p);

#endif
