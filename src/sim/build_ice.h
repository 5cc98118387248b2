/* The ice of a scenario as bodies. One module with build_keep_out, build_level, build_packed and draw_ice: ice is drawn
   around what must stay clear. */
#ifndef SIM_BUILD_ICE_H
#define SIM_BUILD_ICE_H

#include "ice/field.h"
#include "model/scenario.h"
#include "model/world.h"

#include <math.h>

/* Adds the scenario's floes to a world whose vessel is in place (its footprint stays clear). */
fram_status build_ice(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error);

/* What the scenario's ice is made of, before it varies; and the height of the middle of ice that floats [m]. */
ice_material build_ice_material(const scenario *s);
double build_ice_elevation(const scenario *s, double thickness);

/* Small floes far from the origin are degrees in full size, metres in a tank; and how a user says that it is one. */
#define BUILD_SAY_TANK "metres of a tank go with its run.scale, under 10"
static inline bool build_is_of_tank(const scenario *s) { return s->run.scale < 10; }

/* Plan outlines, global [m], of what is drawn or kept clear: the convex hull of all of a solid body seen from above,
   and of its part below still water. */
fram_status build_footprint(context *ctx, const world *w, int32_t body, bool below_water, vec2_array *out,
                            fram_error *error);

/* Heights between which a body is looked at, global [m]. */
typedef struct build_slab {
    double low, high;
} build_slab;
static inline build_slab build_slab_all(void) { return (build_slab){-HUGE_VAL, HUGE_VAL}; }
/* Where ice of a thickness floats. */
build_slab build_slab_of_ice(const scenario *s, double thickness);

/* Outlines that do not cover each other and are hardly larger than what of the body is in a slab: those of the hull's
   convex pieces together, cut along seams where they go round a hole, where its convex outline holds open water, as of
   a catamaran or between the columns of a semi-submersible; else that outline alone.  None where nothing is in the
   slab.  Added to `out`. */
fram_status build_plan(context *ctx, const world *w, int32_t body, build_slab slab, polygon_list *out,
                       fram_error *error);
/* Area of all outlines of a plan together, and what they have in common with an outline [m2]. */
double build_plan_area(const polygon_list *plan);
double build_plan_overlap(const polygon_list *plan, polygon outline);

#endif
