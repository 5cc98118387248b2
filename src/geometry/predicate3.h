/* On which side of a plane?  The sign is right for any doubles that neither overflow nor underflow when three are
   multiplied: every yes-or-no question of the room about triangles in space goes through here. */
#ifndef GEOMETRY_PREDICATE3_H
#define GEOMETRY_PREDICATE3_H

#include "base/vec.h"
#include <stdbool.h>

/* The exact sign of ((b - a) x (c - a)) . (d - a): +1 when d is on the side of the plane abc from which a, b, c turn
   counter-clockwise, -1 on the other side, 0 on the plane.  Adaptive, after Shewchuk (1997), section 4.3. */
int orientation3(vec3 a, vec3 b, vec3 c, vec3 d);

static inline bool vec3_equal(vec3 a, vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

#endif
