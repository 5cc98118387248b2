/* Making polyhedra, inside geometry: from the triangles of a hull, and what every way of making one ends with. One
   module with polyhedron, whose inside this is. */
#ifndef GEOMETRY_POLYHEDRON_BUILD_H
#define GEOMETRY_POLYHEDRON_BUILD_H

#include "geometry/convex_hull3.h"
#include "geometry/polyhedron.h"

/* Joins triangles of a closed convex surface that lie within `tolerance` [m] of a common plane into faces, and leaves
   out vertices that are then straight.  out must be empty.  false: no memory (out is empty then). */
bool polyhedron_from_triangles(context *ctx, const vec3 *point, const hull_triangle_array *triangles, double tolerance,
                               polyhedron *out);
/* Planes, directions, centre and radius of a polyhedron that has vertices, loops and the faces' places in them. */
bool polyhedron_finish(context *ctx, polyhedron *p);

#endif
