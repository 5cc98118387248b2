/* Simple planar polygons: vertices counter-clockwise, in metres, the last edge closes the ring.
   Areas and moments are taken about the first vertex, so that a polygon far from the origin loses no digits.
   Knows nothing of ice or bodies. */
#ifndef GEOMETRY_POLYGON_H
#define GEOMETRY_POLYGON_H

#include "base/array.h"
#include "base/vec.h"

typedef ARRAY(vec2) vec2_array;

/* A view of n vertices that somebody else owns. */
typedef struct polygon {
    const vec2 *vertex;
    int32_t count;
} polygon;

/* Many polygons in one pool: ring i is vertex[start[i] .. start[i+1]). start has count+1 entries when count > 0. */
typedef struct polygon_list {
    vec2_array vertex;
    ARRAY(int32_t) start;
} polygon_list;

static inline int32_t polygon_list_count(const polygon_list *l) { return l->start.count > 0 ? l->start.count - 1 : 0; }
polygon polygon_list_get(const polygon_list *l, int32_t i);
/* Append a copy of p, which may be one of the list itself; false when there is no memory (l is then unchanged). */
bool polygon_list_push(context *ctx, polygon_list *l, polygon p);
void polygon_list_clear(polygon_list *l);
void polygon_list_free(context *ctx, polygon_list *l);

/* Signed area [m2], positive counter-clockwise. */
double polygon_area(polygon p);
double polygon_perimeter(polygon p);
/* +1 when a simple ring runs counter-clockwise, -1 when clockwise, 0 when it has no area: exact, where the sign of the
   computed area of a sliver may not be. */
int polygon_orientation(polygon p);

/* Area [m2], centroid [m] and second moments of area about the centroid [m4]:
   xx = integral of y^2, yy = integral of x^2, xy = integral of x y (product, not negated).  A clockwise ring has all of
   them negative; one without area has zeros and its first vertex as centroid. */
typedef struct polygon_moments {
    double area;
    vec2 centroid;
    double xx, yy, xy;
} polygon_moments;
polygon_moments polygon_moments_of(polygon p);

typedef struct box2 {
    vec2 lo, hi;
} box2;
/* Of no vertices: lo is +infinity, hi is -infinity. */
box2 polygon_bounds(polygon p);
/* Largest distance between two vertices [m], to rounding.  false: no memory. */
bool polygon_farthest_apart(context *ctx, polygon p, double *out);

/* Inside or on the edge, exactly (geometry/predicate.h).  Any closed ring, by the even-odd rule. */
bool polygon_contains(polygon p, vec2 point);
/* Nearest point of the closed segment ab. */
vec2 segment_nearest(vec2 a, vec2 b, vec2 point);
/* Whether something between a and b along an axis, in any order, may come nearer than `reach` to p. */
static inline bool span_may_reach(double a, double b, double p, double reach)
{
    return a < b ? p - b < reach && a - p < reach : p - a < reach && b - p < reach;
}
/* Whether a segment may be nearer to the point than `least`, by the box around it: never false for one that is,
   rounding included. */
static inline bool segment_may_reach(vec2 a, vec2 b, vec2 point, double least)
{
    double reach = least * (1 + 1e-9);
    return span_may_reach(a.x, b.x, point.x, reach) && span_may_reach(a.y, b.y, point.y, reach);
}
/* Nearest boundary point; edge (may be NULL) is the index of its first vertex, the lowest of equally near ones. */
vec2 polygon_nearest_boundary(polygon p, vec2 point, int32_t *edge);

/* How far off a vertex may be because it is stored in doubles: a few roundings of the largest coordinate [m].
   A vertex that an overlay put on a straight edge lies that far beside it. */
double polygon_rounding(polygon p);
/* +1 when a, b, c turn counter-clockwise, -1 clockwise, 0 when straight or when moving them by `rounding` [m] could
   make them so: the sign for questions of convexity, where `orientation` (predicate.h) would see too much. */
int turn_sign(vec2 a, vec2 b, vec2 c, double rounding);

/* Algorithm 11, repaired: all cross products of consecutive edges over the full cycle keep the last
   non-zero sign, and the ring turns once.  Signs within rounding count as zero, repeated vertices are skipped;
   a ring without area is not convex, a clockwise one may be. */
bool polygon_is_convex(polygon p);
/* Crossing or touching pair of non-adjacent edges, the first in order of edge_a, then edge_b > edge_a (either may
   be NULL); false when there is none.  Exact.  Repeated vertices in a row do no harm.  Every pair of edges under 32
   vertices or without memory, a sweep over sorted intervals otherwise. */
bool polygon_self_intersects(context *ctx, polygon p, int32_t *edge_a, int32_t *edge_b);
/* No vertex lies within `reach` [m] of an edge that is not its own.  Every pair under 32 vertices or without memory, a
   sweep otherwise, with the same answer. */
bool polygon_has_clearance(context *ctx, polygon p, double reach);

/* Algorithm 9, repaired: the smallest-area box aligned with an edge of the convex hull; sides[0] >= sides[1] [m].
   Points on a line give sides[1] = 0.  FRAM_ERROR_INPUT for no vertices, FRAM_ERROR_MEMORY. */
typedef struct oriented_box {
    vec2 axis; /* unit, along sides[0] */
    vec2 centre;
    double sides[2];
} oriented_box;
fram_status polygon_oriented_box(context *ctx, polygon p, oriented_box *box);

/* Andrew's monotone chain (1979); out is counter-clockwise from the least vertex (x, then y), without repeated and
   collinear vertices, exactly.  Fewer than 3 vertices when all are on a line.  false when there is no memory. */
bool polygon_convex_hull(context *ctx, polygon p, vec2_array *out);

/* Algorithm 10, repaired: drops vertices of edges shorter than `edge` [m], spikes (cos turn < -0.99) and
   near-straight vertices (cos turn > 0.99 and height over the chord under `edge` too), repeats until a pass drops
   none, stops at 3 vertices.  A chain of vertices is never eaten up: those that were dropped, spikes apart, stay
   within `edge` of the chord that replaces them; of a short edge the other end goes if that serves it, and only if
   neither does may they lie farther off.  So no edge is shorter than `edge` unless 3 vertices are left.  The listing
   lets a fine arc collapse. out may end with fewer than 3 vertices only if p had; it must not hold p. false when
   there is no memory. */
bool polygon_clean(context *ctx, polygon p, double edge, vec2_array *out);
/* Whether a ring is as polygon_clean leaves one of more than 3 vertices: no edge under `edge`, no spike. */
bool polygon_is_clean(polygon p, double edge);
/* polygon_clean for a ring inside a box, of which the vertices on the box's sides stay whatever they are. */
bool polygon_clean_inside(context *ctx, polygon p, double edge, box2 box, vec2_array *out);
/* polygon_clean_inside that leaves spikes, however sharp, so that no area goes with them; box NULL: of no box. */
bool polygon_merge(context *ctx, polygon p, double edge, const box2 *box, vec2_array *out);

/* A simple outline with fewer vertices that covers simple p, counter-clockwise, with at most (1 + part) times its area:
   bays are filled and short edges replaced by the corner of their neighbours, what adds least area first.  At least 3
   vertices stay.  Covers p to rounding.  out must not hold p. false when there is no memory. */
bool polygon_cover(context *ctx, polygon p, double part, vec2_array *out);

/* Sutherland-Hodgman by one half plane: keeps n . x <= d, n of any length.  Exact for convex p; the pieces of a
   concave one stay joined along the line.  Both halves of a cut get the same new vertices, to the bit. out is empty
   when nothing with an area is left; it must not hold p. false when there is no memory. */
bool polygon_clip_half_plane(context *ctx, polygon p, vec2 n, double d, vec2_array *out);
/* The part of convex p inside convex q (both counter-clockwise). out is empty when there is none, when they only
   touch, or when the overlap is thinner than a few roundings of the coordinates; it must hold neither. false when
   there is no memory. */
bool polygon_clip_convex(context *ctx, polygon p, polygon q, vec2_array *out);

/* Area [m2] common to two simple polygons, counter-clockwise, of any shape, without their intersection: a sum over all
   pairs of edges, exact up to rounding of about 1e-15 of the area of their bounds.  No degenerate position disturbs it,
   which is why overlays are checked by it. */
double polygon_overlap_area(polygon a, polygon b);

/* Overlap depth of two convex polygons by the separating axis test over the edge normals of both: the least way
   along one of them that parts the two; negative is the widest gap. axis (may be NULL): unit, pointing from a to b. */
double polygon_convex_depth(polygon a, polygon b, vec2 *axis);

#endif
