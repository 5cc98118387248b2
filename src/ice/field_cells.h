/* Work on lists of convex cells: cutting them by zones, cutting corners, moving edges inwards.  Knows polygons only;
   all cells are convex and counter-clockwise, in metres.  Every function that returns bool is false without memory. */
#ifndef ICE_FIELD_CELLS_H
#define ICE_FIELD_CELLS_H

#include "geometry/polygon.h"

typedef struct cells_scratch {
    vec2_array a, b, rest;
} cells_scratch;
void cells_scratch_free(context *ctx, cells_scratch *s);

/* What every field asks of its area: a domain with an area, a concentration over 0 and under 1, convex zones and a
   margin that is none or more.  FRAM_ERROR_INPUT with the key at fault. */
fram_status field_area_check(box2 domain, double concentration, const polygon_list *zones, double margin,
                             fram_error *error);

/* That zones leave an area for ice [m2].  FRAM_ERROR_INPUT under keep_out. */
fram_status field_room_check(double free_area, fram_error *error);

/* That the widest floe drawn fits between two edges of the domain [m].  FRAM_ERROR_INPUT under domain. */
fram_status field_width_check(box2 domain, double largest, fram_error *error);

/* Convex zones, grown by a margin all around: edges move outwards, corners become arcs of short tangents, so that
   nothing within the margin is left outside.  Appends one ring per zone. */
bool zones_grow(context *ctx, const polygon_list *zones, double margin, polygon_list *out);

/* What lies outside all zones, cut into convex parts; the largest part of a cell comes off first.  Together the parts
   have exactly the area of the cells less the zones.  Many cells ask work_continue. */
fram_status cells_outside_zones(context *ctx, const polygon_list *cells, const polygon_list *zones, cells_scratch *s,
                                polygon_list *out, fram_error *error);

/* Summed area [m2]. */
double cells_area(const polygon_list *cells);
/* Area of a polygon outside of zones, which may lie over one another [m2]. */
fram_status cells_area_outside(context *ctx, polygon whole, const polygon_list *zones, double *area, fram_error *error);

/* The cells made smaller, to `target` area [m2], at most the area there is: `corners` of the area that must go is cut
   off the corners, as far as every edge keeps a part, and the rest goes off the edges, all moved inwards by the one
   distance `inset` [m].  cut and out are made anew, one ring per cell, in out of 0 vertices where nothing is left. */
fram_status cells_shrink(context *ctx, const polygon_list *cells, double corners, double target, cells_scratch *s,
                         polygon_list *cut, polygon_list *out, double *inset, fram_error *error);

#endif
