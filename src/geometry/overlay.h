/* Overlay, repair, triangulation and convex pieces of general polygons: overlay and repair through GEOS (C API, one
   handle per object, one object per thread), each overlay checked by its area, because GEOS errs on edges that nearly
   coincide.

   Results are normalised: rings counter-clockwise, starting at their least vertex (x, then y), no repeated vertices, no
   holes (a result with a hole is cut along bridges between its vertices into simple rings), none thinner than the
   rounding of its coordinates, ordered by their vertices in turn: the same input gives the same bits always.

   Arguments that are rings must be valid (overlay_is_valid): FRAM_ERROR_INPUT otherwise.  FRAM_ERROR_MEMORY, of Fram's
   memory or GEOS's; FRAM_ERROR_INTERNAL when there is no right result.  On failure what `out` held is unchanged.  No
   argument may be a view into out. */
#ifndef GEOMETRY_OVERLAY_H
#define GEOMETRY_OVERLAY_H

#include "geometry/polygon.h"

typedef struct overlay overlay;

/* NULL when there is no memory.  ctx must outlive the overlay. */
overlay *overlay_create(context *ctx);
void overlay_free(overlay *o);

/* Valid: a simple ring (repeated vertices in a row are allowed, neighbouring or distant edges that meet elsewhere
   are not), of at least 3 vertices, finite, counter-clockwise with area > 0.  Exact, and decided here, not by
   GEOS.  On false, reason and place (both may be NULL) say why and where. */
enum { OVERLAY_REASON_SIZE = 128 };
bool overlay_is_valid(overlay *o, polygon p, char reason[OVERLAY_REASON_SIZE], vec2 *place);

/* Each appends simple rings to out.  Where outlines touch without crossing, nothing is made of the points and lines. */
fram_status overlay_difference(overlay *o, polygon subject, polygon clip, polygon_list *out, fram_error *error);
fram_status overlay_intersection(overlay *o, polygon subject, polygon clip, polygon_list *out, fram_error *error);
fram_status overlay_union(overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error);
/* Repair of any ring with finite vertices (self-intersections, spikes, clockwise): appends the outlines of its
   interior, which is all that it winds round, with holes filled; nothing when it has no area. */
fram_status overlay_make_valid(overlay *o, polygon p, polygon_list *out, fram_error *error);
/* Douglas-Peucker within `tolerance` [m], topology kept: what out held is replaced by a valid ring, p itself where
   simplification would spoil it. */
fram_status overlay_simplify(overlay *o, polygon p, double tolerance, vec2_array *out, fram_error *error);
/* What of the interior is farther than `by` [m] from the outline, which may be in several parts or nothing; at hollow
   corners a mitred part more is left out.  Appends the parts. */
fram_status overlay_inset(overlay *o, polygon p, double by, polygon_list *out, fram_error *error);
/* Constrained Delaunay triangulation of the interior: appends triangles (3 vertices each, counter-clockwise), two less
   than p has vertices, which have every vertex of p as a corner and no others.  Without GEOS, exact but for which of
   the two diagonals of four vertices on one circle (to rounding) is taken: a triangle may be so thin that
   polygon_area of it is 0 or less. */
fram_status overlay_triangulate(overlay *o, polygon p, polygon_list *out, fram_error *error);

/* Cut a simple polygon into convex pieces that keep area and outline exactly.  Convex input is returned as it is,
   whatever its count; otherwise constrained Delaunay triangles are merged across their common edges, longest first,
   while the union is convex (Hertel and Mehlhorn 1983) and has at most `most` vertices.  Pieces that are still under
   `smallest` [m2] are dropped; lost_area (may be NULL) gets their area. */
fram_status overlay_convex_pieces(overlay *o, polygon p, double smallest, int32_t most, polygon_list *out,
                                  double *lost_area, fram_error *error);

#endif
