/* Coefficients of wind and current of a scenario's vessel, from its tables or their files. */
#ifndef SIM_BUILD_FLOWS_H
#define SIM_BUILD_FLOWS_H

#include "model/model.h"
#include "model/scenario_vessel.h"

/* Into vessel->flows, of the hull that `vessel` knows already.  Errors name the row at fault, and a table
   whose forces go against the motion, or that leaves a ship with propulsion without lift, is told to the log. */
fram_status build_flows(context *ctx, const scenario *s, const vessel_entry *entry, vessel_model *vessel,
                        fram_error *error);

#endif
