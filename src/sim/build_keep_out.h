/* Where there is no ice at the start. */
#ifndef SIM_BUILD_KEEP_OUT_H
#define SIM_BUILD_KEEP_OUT_H

#include "model/scenario.h"
#include "model/world.h"

/* Appends the footprints of all vessels, as they are. */
fram_status build_footprints(context *ctx, const world *w, polygon_list *out, fram_error *error);
/* The same with ice.keep_out_margin around them: convex zones, counter-clockwise, in the order of the vessels. */
fram_status build_wide_footprints(context *ctx, const scenario *s, const world *w, polygon_list *out,
                                  fram_error *error);
/* Appends convex zones, counter-clockwise: the footprints with their margin; the rectangles of ice.open_water; the
   polygons of ice.open_water_file, cut into convex pieces. */
fram_status build_keep_out(context *ctx, const scenario *s, const world *w, polygon_list *out, fram_error *error);

#endif
