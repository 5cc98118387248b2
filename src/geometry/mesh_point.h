/* A point and a closed surface: inside or not, and the nearest place.  Both walk all triangles: for questions that are
   asked now and then. */
#ifndef GEOMETRY_MESH_POINT_H
#define GEOMETRY_MESH_POINT_H

#include "geometry/mesh.h"

/* Solid angle [sr] of the triangle abc seen from the origin, positive from the side that its area vector points away
   from (Van Oosterom and Strackee 1983, eq. 8). */
double triangle_solid_angle(vec3 a, vec3 b, vec3 c);

/* Winding number of a closed mesh about a point: 1 inside, 0 outside, anything between on the surface.  Sum of the
   solid angles of all triangles over 4 pi; right beside edges and vertices too. */
double mesh_winding(const mesh *m, vec3 point);

/* The point of the closed triangle abc that is nearest to p. */
vec3 triangle_nearest_point(vec3 a, vec3 b, vec3 c, vec3 p);

/* The point of the surface nearest to `point`, on the lowest such face (may be NULL).  The mesh has triangles. */
vec3 mesh_nearest_point(const mesh *m, vec3 point, int32_t *face);

#endif
