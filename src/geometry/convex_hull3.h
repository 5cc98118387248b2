/* The convex hull of points in space as triangles, inside geometry: what polyhedron_hull merges into faces. */
#ifndef GEOMETRY_CONVEX_HULL3_H
#define GEOMETRY_CONVEX_HULL3_H

#include "geometry/mesh.h"

/* Counter-clockwise from outside; neighbour[k] lies across the edge from v[k] to v[k + 1]. */
typedef struct hull_triangle {
    int32_t v[3], neighbour[3];
} hull_triangle;
typedef ARRAY(hull_triangle) hull_triangle_array;

/* How far points may be apart and still count as one, whatever the caller's tolerance: the digits of the largest
   coordinate [m]. */
double hull_rounding(const vec3 *point, int32_t count);

/* Hull of the points: a closed surface of triangles, exactly convex, whose vertices are points.  Points that stand out
   less than `tolerance` [m] (at least hull_rounding) may be left outside.  The same points in the same order give the
   same triangles.  FRAM_ERROR_INPUT for points that are not finite or within the tolerance of a plane,
   FRAM_ERROR_MEMORY. */
fram_status convex_hull_triangles(context *ctx, const vec3 *point, int32_t count, double tolerance,
                                  hull_triangle_array *out, fram_error *error);

#endif
