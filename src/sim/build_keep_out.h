/* Where there is no ice at the start. */
#ifndef SIM_BUILD_KEEP_OUT_H
#define SIM_BUILD_KEEP_OUT_H

#include "model/scenario.h"
#include "model/world.h"

/* Appends the footprints of all vessels, as they are. */
fram_status build_footprints(context *ctx, const world *w, polygon_list *out, fram_error *error);
/* Convex zones, counter-clockwise, in the order of the vessels: the footprints with ice.keep_out_margin around them; of
   a hull that stands in parts in the ice, as a catamaran or a semi-submersible, those of its parts there, where they
   leave water between them.  thickest: no ice that comes there is thicker [m]; HUGE_VAL where that is not known: parts
   are then those that nothing joins at any height. */
fram_status build_wide_footprints(context *ctx, const scenario *s, const world *w, double thickest, polygon_list *out,
                                  fram_error *error);
/* Appends convex zones, counter-clockwise: those around the vessels; the rectangles of ice.open_water; the
   polygons of ice.open_water_file, cut into convex pieces. */
fram_status build_keep_out(context *ctx, const scenario *s, const world *w, double thickest, polygon_list *out,
                           fram_error *error);

#endif
