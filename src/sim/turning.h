/* How tightly a ship that drives itself turns in open water: the steady turn of the same hull, water and rudders as in
   the run.  Its autopilot, the rounding of corners and `fram check` use it (docs/decisions/0380). */
#ifndef SIM_TURNING_H
#define SIM_TURNING_H

#include "model/model.h"
#include "vessel/propulsion.h"

/* Of a vessel with these settings (all but `turning` are used) at a speed ahead, to the side on which it turns wider
   where a table of the current makes a difference.  Without water, or without a helm that turns the ship as it should,
   to both sides, all distances are its length and the drift is 0. */
turning_ability turning_ability_of(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s,
                                   double speed);
/* The largest steering angle of use to such a vessel, up to its own: past it rudders stall, or push along the ship, in
   its steady turn [rad]. */
double turning_helm_of(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s, double speed);
/* Whether it was found: a hull is askew in every turn, and by which is found by halving, never to 0. */
bool turning_is_found(const turning_ability *t);
/* Whether the radius is the least that is tried, a third of the length: the steady turn is no wider, if any is. */
bool turning_is_sought_no_further(const turning_ability *t, const vessel_model *hull);
/* Whether the hull turns on by itself there, with its helm amidships, at the speed of `turning`. */
bool turning_goes_on(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s);
/* The tightest turn at the speed of `turning` that helm to the other side checks, as corners and loops ask for;
   infinity if there is none [m]. */
double turning_checked_radius(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s);
/* Whether a hull has a table of the current whose sides are not alike. */
bool turning_sides_differ(const vessel_model *hull);

#endif
