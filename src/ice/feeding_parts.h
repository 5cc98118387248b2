/* What the files of feeding share; see feeding.h. One module with feeding, whose inside this is. */
#ifndef ICE_FEEDING_PARTS_H
#define ICE_FEEDING_PARTS_H

#include "ice/feeding.h"

/* A floe has left the window when it is clear of it by this [m]. */
double feeding_clearance(double band);
/* Where a floe of the pattern is nearest to the window [m]. */
vec2 feeding_place(const feeding_world *w, int32_t row);
/* Its bounding circle reaches the window grown by `margin` [m]. */
bool feeding_reaches(const feeding_world *w, vec2 place, double radius, double margin);
/* A floe of the pattern becomes a body at its place, in the band or inside.  outline: NULL for that of the pattern,
   otherwise about the centroid of the pattern's. */
fram_status feeding_make_floe(context *ctx, overlay *o, const feeding_world *w, int32_t row, polygon outline,
                              fram_error *error);
polygon feeding_outline(const feeding_world *w, int32_t row);

#endif
