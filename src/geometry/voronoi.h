/* Voronoi cells of points in a rectangle, by half-plane clipping against near neighbours of a grid: every cell is
   convex, the cells tile the rectangle.  Deterministic to the bit, the same on any number of threads. */
#ifndef GEOMETRY_VORONOI_H
#define GEOMETRY_VORONOI_H

#include "geometry/polygon.h"

/* Appends one cell per site, in site order, to out: counter-clockwise, convex, areas summing to the box's to
   rounding. Sites must be distinct and inside the box or on its edge. weights [m2] (may be NULL: all equal) make a
   power diagram: cell i is where |x - s_i|^2 - w_i is least (Aurenhammer 1987); a cell may then be empty, which
   appends a ring of 0 vertices, and need not hold its site. Vertices within a few roundings of the coordinates are
   one, so that a lattice of sites gives squares. Linear in the count for sites spread evenly; slow when most sites
   crowd into a small part of their bounds. FRAM_ERROR_INPUT names the site; FRAM_ERROR_MEMORY; out is then as it
   was. */
fram_status voronoi_cells(context *ctx, const vec2 *site, const double *weight, int32_t count, box2 box,
                          polygon_list *out, fram_error *error);

#endif
