/* The ice of a scenario as bodies. One module with build_keep_out, build_packed and draw_ice: ice is drawn around what
   must stay clear. */
#ifndef SIM_BUILD_ICE_H
#define SIM_BUILD_ICE_H

#include "ice/field.h"
#include "model/scenario.h"
#include "model/world.h"

/* Adds the scenario's floes to a world whose vessel is in place (its footprint stays clear). */
fram_status build_ice(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error);

/* The grid of a level sheet; without cells for any other source. */
tile_grid build_tiles(const scenario *s);
/* What is fixed of level ice that drifts; out stays as it is without. */
fram_status build_sheet(context *ctx, const scenario *s, drift_definition *out, fram_error *error);
/* Level ice that drifts: its tiles in the window at the start, at rest. */
fram_status build_drifting(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                           fram_error *error);
/* Its tiles, also where they are more than a grid can number. */
double build_tile_number(const scenario *s);

/* Plan outlines, global [m], of what is drawn or kept clear: the convex hull of all of a solid body seen from above,
   and of its part below still water. */
fram_status build_footprint(context *ctx, const world *w, int32_t body, bool below_water, vec2_array *out,
                            fram_error *error);

#endif
