/* Do two triangles of one surface cross?  Exact, without tolerance.  Knows no mesh. */
#ifndef GEOMETRY_TRIANGLE_PAIR_H
#define GEOMETRY_TRIANGLE_PAIR_H

#include "base/vec.h"
#include <stdbool.h>

/* The triangles (with area) have a point in common that is not on the vertex or edge they share: neighbours on a sound
   surface do not, all other pairs must not even touch.  Vertices are shared when their coordinates are equal.  Touching
   counts, and so does lying on one another: neighbours over a common edge cross when they are folded flat on each
   other. */
bool triangles_cross(const vec3 a[3], const vec3 b[3]);

#endif
