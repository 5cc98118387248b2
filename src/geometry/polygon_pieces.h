/* Polygons with holes, and triangulations, as simple rings: what turns the results of overlays into polygons.
   Exact: no vertex moves and none is made.  Knows nothing of GEOS. */
#ifndef GEOMETRY_POLYGON_PIECES_H
#define GEOMETRY_POLYGON_PIECES_H

#include "geometry/ear_clip.h"

/* The same ring the other way round, its first vertex last. */
void ring_reverse(vec2 *ring, int32_t n);
/* The normal form of a simple ring of n vertices, in place: no vertex equal to the one before, counter-clockwise,
   least vertex (x, then y) first.  Returns the count that is left; fewer than 3 when the ring has no area. */
int32_t ring_normal_form(vec2 *ring, int32_t n);

/* Append the rings of `list`, which are in normal form, to out in ascending order (by their vertices in turn).
   false when there is no memory; out is then unchanged. */
bool polygon_list_append_sorted(context *ctx, polygon_list *out, const polygon_list *list);

/* Half edge 3 f + k of a triangulation runs from corner k of triangle f to the next; twin (resized to t's count)
   gets the half edge that runs the other way, -1 on the outline.  false when there is no memory. */
bool triangles_find_twins(context *ctx, const index_array *t, int32_t vertex_count, int32_array *twin);

/* Flip edges of a triangulation until it is Delaunay, as far as its outline allows (Lawson 1977): no vertex of a
   neighbour is inside a triangle's circle, but for rounding.  t as for triangles_merge.  false when there is no memory;
   t is then a triangulation still. */
bool triangles_make_delaunay(context *ctx, const vec2 *vertex, int32_t vertex_count, index_array *t);

/* When two pieces may become one. */
typedef enum merge_rule {
    MERGE_CONVEX, /* the union is convex (within polygon_rounding) and has at most `most` vertices */
    MERGE_SIMPLE  /* the union is a simple ring: no hole, no point where it touches itself */
} merge_rule;

/* Merge the triangles of a triangulation across their common edges, longest first, as far as the rule allows
   (Hertel and Mehlhorn 1983), and append the pieces to out in normal form, unsorted.  t holds three numbers of
   vertices per triangle, counter-clockwise; no two vertices are equal, and none lies inside the triangulated
   region. false when there is no memory; out may then have gained some pieces. */
bool triangles_merge(context *ctx, const vec2 *vertex, int32_t vertex_count, const index_array *t, merge_rule rule,
                     int32_t most, polygon_list *out);

/* Number the distinct places of n vertices in ascending order: number[i] is the place of vertex[i],
   place[number[i]] its coordinates; both arrays have room for n.  Returns how many there are, or -1 when there is
   no memory. */
int32_t vertex_places(context *ctx, const vec2 *vertex, int32_t n, vec2 *place, int32_t *number);

/* Cut a polygon with holes into simple rings along straight bridges between its vertices, short ones first, and
   append them to out in normal form, unsorted.  Ring 0 is the outline, counter-clockwise, the others are its holes,
   clockwise; rings touch at most in common vertices, as those of a valid polygon do.  FRAM_ERROR_MEMORY (out may
   then have gained rings), FRAM_ERROR_INPUT when the rings cross. */
fram_status polygon_cut_holes(context *ctx, const polygon_list *rings, polygon_list *out);

#endif
