/* From the keys of a vessel that drives itself to its rows (vessel/propulsion.h). */
#ifndef SIM_BUILD_PROPULSION_H
#define SIM_BUILD_PROPULSION_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* Nothing for a vessel without a bollard pull. */
fram_status build_propulsion(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, int32_t vessel,
                             world *w, fram_error *error);

/* Which of the way points are a course: the first, and the one after one of them, or their count.  Left out are those
   within half the ship's length [m] of where it begins, while another follows, and those that are nearer to the one
   before than a twentieth of it. */
int32_t course_first(const scenario_propulsion *p, vec2 begins, double length);
int32_t course_next(const scenario_propulsion *p, int32_t last, double length);

#endif
