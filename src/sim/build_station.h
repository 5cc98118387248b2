/* From a scenario to what keeps its vessel on station: lines, thrusters, controller. */
#ifndef SIM_BUILD_STATION_H
#define SIM_BUILD_STATION_H

#include "sim/step.h"

/* Lines, thrusters, way points and the station of the first vessel; a moored vessel is moved to where its lines balance
   current and wind.  Errors name the key at fault. */
fram_status build_station(context *ctx, const scenario *s, const step_settings *settings, world *w, fram_error *error);

#endif
