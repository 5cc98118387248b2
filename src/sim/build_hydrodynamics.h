/* Added mass and damping of a scenario's vessel. */
#ifndef SIM_BUILD_HYDRODYNAMICS_H
#define SIM_BUILD_HYDRODYNAMICS_H

#include "model/model.h"
#include "model/scenario_vessel.h"

/* From the matrices of the vessel's hydrodynamics, moved to the centre of mass and to Fram's axes, or estimated from
   the hull, which `vessel` knows already, body being its solid: added mass of the ellipsoid with the hull's waterline
   length and beam and its draught, about amidships in the water line (fluid/added_mass.h); damping in heave, roll and
   pitch as parts of the critical one of the hull's own springs, as it floats with its mass.  Nothing when the scenario
   asks for nothing.  FRAM_ERROR_INPUT names the key of a matrix that cannot be. */
fram_status build_hydrodynamics(context *ctx, const scenario *s, const vessel_entry *entry, const solid *body,
                                vessel_model *vessel, fram_error *error);

#endif
