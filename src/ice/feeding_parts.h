/* What the files of feeding share; see feeding.h. One module with feeding, whose inside this is. */
#ifndef ICE_FEEDING_PARTS_H
#define ICE_FEEDING_PARTS_H

#include "ice/feeding.h"

/* A floe has left the window when it is clear of it by this [m]. */
double feeding_clearance(double band);
/* The whole number of periods that x is nearest to: floor(x / period + 1/2). */
double feeding_periods(double x, double period);
/* Where a floe of the pattern is nearest to the window [m]. */
vec2 feeding_place(const feeding_world *w, int32_t row);
/* The same when the sheet has another displacement. */
vec2 feeding_place_at(const feeding_world *w, int32_t row, vec2 displacement);
/* The body that entered as the copy of this floe that is shown now is there still. */
bool feeding_lives(const feeding_world *w, int32_t row);
/* Its bounding circle reaches the window grown by `margin` [m]. */
bool feeding_reaches(const feeding_world *w, vec2 place, double radius, double margin);
/* A floe of the pattern becomes a body at its place, in the band or inside.  outline: NULL for that of the pattern,
   otherwise about the centroid of the pattern's. */
fram_status feeding_make_floe(context *ctx, overlay *o, const feeding_world *w, int32_t row, polygon outline,
                              fram_error *error);
polygon feeding_outline(const feeding_world *w, int32_t row);
/* The sheet moved by `moved` from the displacement `before`, and what is near is listed: where another copy of a floe
   is nearest to the window now, the body of the one before is kept among the copies, and one whose copy is back is that
   of the floe again. */
fram_status feeding_copies_step(context *ctx, const feeding_world *w, vec2 before, vec2 moved, fram_error *error);

#endif
