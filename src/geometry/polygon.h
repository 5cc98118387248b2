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
bool polygon_list_push(context *ctx, polygon_list *l, polygon p);
void polygon_list_clear(polygon_list *l);
void polygon_list_free(context *ctx, polygon_list *l);

/* Signed area [m2], positive counter-clockwise. */
double polygon_area(polygon p);
double polygon_perimeter(polygon p);

/* Area [m2], centroid [m] and second moments of area about the centroid [m4]:
   xx = integral of y^2, yy = integral of x^2, xy = integral of x y (product, not negated). */
typedef struct polygon_moments {
    double area;
    vec2 centroid;
    double xx, yy, xy;
} polygon_moments;
polygon_moments polygon_moments_of(polygon p);

typedef struct box2 {
    vec2 lo, hi;
} box2;
box2 polygon_bounds(polygon p);
/* Largest distance between two vertices [m]. */
double polygon_diameter(polygon p);

/* Inside or on the edge. */
bool polygon_contains(polygon p, vec2 point);
/* Nearest boundary point; edge (may be NULL) is the index of its first vertex. */
vec2 polygon_nearest_boundary(polygon p, vec2 point, int32_t *edge);

/* Algorithm 11, repaired: all cross products of consecutive edges over the full cycle keep the last
   non-zero sign (and the ring turns once). */
bool polygon_is_convex(polygon p);
/* First crossing or touching pair of non-adjacent edges; false when there is none.  O(n^2) under 32 vertices,
   a sweep over sorted intervals beyond. */
bool polygon_self_intersects(context *ctx, polygon p, int32_t *edge_a, int32_t *edge_b);

/* Algorithm 9, repaired: the smallest-area box aligned with an edge of the convex hull; sides[0] >= sides[1] [m]. */
typedef struct oriented_box {
    vec2 axis;   /* unit, along sides[0] */
    vec2 centre;
    double sides[2];
} oriented_box;
fram_status polygon_oriented_box(context *ctx, polygon p, oriented_box *box);

/* Andrew's monotone chain; out is counter-clockwise without collinear vertices. */
bool polygon_convex_hull(context *ctx, polygon p, vec2_array *out);

/* Algorithm 10, repaired: drops vertices of edges shorter than `edge`, spikes and near-straight vertices
   (|cos turn| > 0.99, and, for a straight one, height over the chord under `edge` too), repeats until a pass drops
   none, stops at 3 vertices.  out may end with fewer than 3 vertices only if p had. */
bool polygon_clean(context *ctx, polygon p, double edge, vec2_array *out);

/* Sutherland-Hodgman by one half plane: keeps n . x <= d.  Exact for convex p. */
bool polygon_clip_half_plane(context *ctx, polygon p, vec2 n, double d, vec2_array *out);
/* The part of convex p inside convex q. out empty when there is none. */
bool polygon_clip_convex(context *ctx, polygon p, polygon q, vec2_array *out);

/* Largest overlap depth of two convex polygons by the separating axis test over edge normals: negative is the gap.
   axis (may be NULL): unit, pointing from a to b. */
double polygon_convex_depth(polygon a, polygon b, vec2 *axis);

#endif
