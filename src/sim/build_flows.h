/* Coefficients of wind and current of a scenario's vessel, from its tables or their files. */
#ifndef SIM_BUILD_FLOWS_H
#define SIM_BUILD_FLOWS_H

#include "sim/build_hull.h"

/* Into w->flows.  Errors name the row at fault. */
fram_status build_flows(context *ctx, const scenario *s, const made_hull *hull, world *w, fram_error *error);

#endif
