/* Better shapes for the triangles of a triangulation, inside geometry: for surfaces that are looked at and checked. */
#ifndef GEOMETRY_TRIANGLE_FLIP_H
#define GEOMETRY_TRIANGLE_FLIP_H

#include "geometry/ear_clip.h"

/* Exchange diagonals of neighbouring triangles while that makes the flatter one of the two less flat.  Outline and area
   stay, and all triangles stay counter-clockwise; a triangle as thin as rounding goes wherever the outline allows it.
   triangles: three vertex numbers of p each, as polygon_triangulate_ears leaves them.  false: no memory. */
bool polygon_flip_diagonals(context *ctx, polygon p, index_array *triangles);

#endif
