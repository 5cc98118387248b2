/* What a field of outlines is, measured on the outlines alone: overlap, concentration in windows, cover map.  Must not
   know how the field was made. */
#ifndef ICE_FIELD_MEASURE_H
#define ICE_FIELD_MEASURE_H

#include "geometry/overlay.h"

/* The deepest overlap of any two outlines of `floes`, or of one of `floes` and one of `others` (may be NULL), as the
   least way that parts their convex pieces [m]; 0 when none overlap.  Pieces of one outline are not compared.
   o NULL: all outlines are convex. */
fram_status field_largest_overlap(context *ctx, overlay *o, const polygon_list *floes, const polygon_list *others,
                                  double *overlap, fram_error *error);

/* Area that two simple outlines, counter-clockwise, have in common [m2]; 0 where it is rounding, which outlines that
   lie apart may have too (polygon_overlap_area). */
double field_common_area(polygon a, polygon b);

/* Ice area within a window over the window's area; outlines must not overlap.  period: by which the field repeats
   itself along each axis [m]; 0, 0: it does not. */
double field_concentration(const polygon_list *floes, vec2 period, box2 window);

/* Concentration in each of nx x ny equal cells of a box, row by row from its lower left corner; cover is of nx ny
   numbers, and exact. */
void field_cover_map(const polygon_list *floes, vec2 period, box2 box, int32_t nx, int32_t ny, double *cover);

#endif
