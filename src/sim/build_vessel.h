/* The vessels of a scenario in a world. */
#ifndef SIM_BUILD_VESSEL_H
#define SIM_BUILD_VESSEL_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* Where a vessel is put, before its lines move it. */
typedef struct vessel_pose {
    vec3 position;
    quat orientation;
} vessel_pose;
typedef ARRAY(vessel_pose) vessel_pose_array;

/* The world's next vessel, which the model knows as that of the same row: body, carriage and joint, path, and what
   keeps it on station.  put: of the vessels before it; its own is added.  Errors name the key at fault. */
fram_status build_vessel(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, world *w,
                         vessel_pose_array *put, fram_error *error);

/* Radii of gyration in roll, pitch, yaw [m]: given, or usual ones for the hull. */
vec3 build_gyration(const scenario_vessel *v, const hull_particulars *p);

#endif
