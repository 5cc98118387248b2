/* Vessels that drive themselves in a step (vessel/propulsion.h): what they know of water and ice. */
#ifndef SIM_PROPULSION_FORCES_H
#define SIM_PROPULSION_FORCES_H

#include "model/world.h"

/* Velocity of the water that a vessel with its propulsion goes through: the one current that its hull as a whole meets,
   as its damping does; 0 where there is no water [m/s]. */
vec2 propulsion_water(const model *m, const media *now, int32_t vessel);
/* What the water takes of a vessel's thrust along its bow [N], `water` being the velocity of the one that it goes
   through: drag on the hull, and linear damping. */
double propulsion_resistance(const model *m, const world *w, int32_t vessel, vec2 water);
/* What the linear damping does to a hull that goes through the water in its plane, `velocity` being surge, sway and
   rate of turn [m/s, m/s, rad/s]: forces along these and moment about the centre of mass [N, N, N m]. */
vec3 propulsion_damping(const vessel_model *hull, vec3 velocity);
/* From the place of a row's pattern to the ice that comes there, at the distance of the pattern, or of the ship, that
   is so far `away` [m], from a pattern that goes ahead: against the drift, or with a forecast where it is going to come
   from; and its way, outward.  At (0, 0): no drift. */
track_place propulsion_comes(const model *m, const world *w, int32_t row, double time, double away);
/* After the water's forces are known: steers, and adds thrust to the loads. */
fram_status propulsion_forces(context *ctx, const model *m, world *w, fram_error *error);

#endif
