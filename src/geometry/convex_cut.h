/* One cut of a convex ring by a line, for the clippers of this room.  Knows nothing but the ring. */
#ifndef GEOMETRY_CONVEX_CUT_H
#define GEOMETRY_CONVEX_CUT_H

#include "geometry/polygon.h"
#include "geometry/predicate.h"

/* Where the segment ab meets the line; side_a, side_b are the signed distances of its ends from it, up to a factor, of
   opposite signs.  The same bits for ba and for the other side of the line. */
static inline vec2 line_crossing(vec2 a, double side_a, vec2 b, double side_b)
{
    bool swap = vec2_compare(a, b) > 0;
    vec2 from = swap ? b : a, to = swap ? a : b;
    double t = swap ? side_b / (side_b - side_a) : side_a / (side_a - side_b);
    return vec2_add(from, vec2_scale(vec2_sub(to, from), t));
}

/* Writes the part of a convex ring of n vertices with side <= 0 to out, which has room for n + 1 and is not the
   ring, and returns its count; side[i] is the signed distance of vertex i from the line, up to a factor.  A vertex
   within `slack` of the line is on it and gets no new neighbour there. 0 when only points of the line are left.  The
   ring is walked both ways from its innermost vertex, so that one whose rounding is not quite convex still is cut
   once, and never grows by more than one vertex. */
static inline int32_t convex_cut(const vec2 *ring, const double *side, int32_t n, double slack, vec2 *out)
{
    int32_t inner = 0, count = 0;
    for (int32_t i = 1; i < n; i++)
        inner = side[i] < side[inner] ? i : inner;
    if (n == 0 || side[inner] >= -slack)
        return 0;
    int32_t last, after = inner, first, before = inner; /* kept ones, and the cut ones beyond them */
    do {
        last = after;
        after = after + 1 < n ? after + 1 : 0;
    } while (side[after] <= slack && after != inner);
    do {
        first = before;
        before = before > 0 ? before - 1 : n - 1;
    } while (side[before] <= slack && before != inner);
    bool whole = after == inner;
    if (whole) {
        first = 0;
        last = n - 1;
    }
    for (int32_t i = first;; i = i + 1 < n ? i + 1 : 0) {
        out[count++] = ring[i];
        if (i == last)
            break;
    }
    if (whole)
        return count;
    if (side[last] < -slack)
        out[count++] = line_crossing(ring[last], side[last], ring[after], side[after]);
    if (side[first] < -slack)
        out[count++] = line_crossing(ring[before], side[before], ring[first], side[first]);
    return count;
}

#endif
