/* From a scenario to what keeps its vessels on station: lines, thrusters, controllers. */
#ifndef SIM_BUILD_STATION_H
#define SIM_BUILD_STATION_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* Of both ways that it pushes [N]. */
double thruster_largest_thrust(const scenario_thruster *t);
/* Lines, thrusters, way points and the station of a vessel of the world that floats freely; nothing for others.  A
   moored vessel is moved to where its lines balance current and wind.  Errors name the key at fault. */
fram_status build_station(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, int32_t vessel,
                          world *w, fram_error *error);

#endif
