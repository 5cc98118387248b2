/* Level ice of a scenario.  One module with build_ice, of which it is a part. */
#ifndef SIM_BUILD_LEVEL_H
#define SIM_BUILD_LEVEL_H

#include "ice/field.h"
#include "model/scenario.h"
#include "model/world.h"

/* Adds the sheet that is held in its place; warns of openings beside it, and refuses to leave nothing of it. */
fram_status build_level(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error);
/* The grid of a level sheet; without cells for any other source. */
tile_grid build_tiles(const scenario *s);
/* What is fixed of level ice that drifts; out stays as it is without. */
fram_status build_sheet(context *ctx, const scenario *s, drift_definition *out, fram_error *error);
/* Where a sheet that drifts is at the start, however far it reaches. */
box2 build_sheet_extent(const scenario *s);
/* The corners of an opening, counter-clockwise. */
void build_opening_corners(const scenario_opening *o, vec2 corner[4]);
/* Mass of a drifting sheet's ice in the domain at the start, of a domain full of it, or of all of it if that is less,
   where none is there yet [kg]; less where openings overlap one another, and never under 0. */
double build_ice_in_domain(const scenario *s);
/* Level ice that drifts: its tiles in the window at the start, at rest. */
fram_status build_drifting(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                           fram_error *error);
/* Its tiles, also where they are more than a grid can number. */
double build_tile_number(const scenario *s);

#endif
