/* Exact answers about points and segments of the plane: the sign is right for any doubles (coordinates from 1e-70
   to 1e70 or 0), because the last digits are computed when they matter.  Every yes-or-no question of the room about
   the outline of a polygon goes through here, so that two functions never disagree about the same three points.
   Knows nothing of polygons. */
#ifndef GEOMETRY_PREDICATE_H
#define GEOMETRY_PREDICATE_H

#include "base/vec.h"
#include <stdbool.h>

/* +1 when a, b, c turn counter-clockwise, -1 clockwise, 0 on one line: the exact sign of (b - a) x (c - a).
   Floating-point filter and expansions of Shewchuk (1997), Adaptive precision floating-point arithmetic. */
int orientation(vec2 a, vec2 b, vec2 c);

/* p lies on the closed segment ab. */
bool segment_contains(vec2 a, vec2 b, vec2 p);

/* The closed segments ab and cd have a point in common. */
bool segments_touch(vec2 a, vec2 b, vec2 c, vec2 d);

/* fmin and fmax without their rule for NaN, which keeps compilers from inlining them. */
static inline double real_min(double a, double b) { return a < b ? a : b; }
static inline double real_max(double a, double b) { return a > b ? a : b; }

static inline bool vec2_equal(vec2 a, vec2 b) { return a.x == b.x && a.y == b.y; }

/* Order by x, then y: negative, 0 or positive as a comes before, with or after b. */
static inline int vec2_compare(vec2 a, vec2 b)
{
    if (a.x != b.x)
        return a.x < b.x ? -1 : 1;
    return (a.y > b.y) - (a.y < b.y);
}

#endif
