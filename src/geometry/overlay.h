/* Overlay, validity and triangulation of general polygons through GEOS (C API, one handle per object, one object per
   thread).  Results are normalised: rings counter-clockwise, starting at their least vertex (x, then y), no repeated
   vertices, no holes (a result with a hole is cut along a bridge into simple rings), ordered by their least vertex: the same
   input gives the same bits always. */
#ifndef GEOMETRY_OVERLAY_H
#define GEOMETRY_OVERLAY_H

#include "geometry/polygon.h"

typedef struct overlay overlay;

/* NULL when there is no memory. */
overlay *overlay_create(context *ctx);
void overlay_free(overlay *o);

/* Each appends simple rings to out.  FRAM_ERROR_INPUT when an argument is no valid polygon. */
fram_status overlay_difference(overlay *o, polygon subject, polygon clip, polygon_list *out, fram_error *error);
fram_status overlay_intersection(overlay *o, polygon subject, polygon clip, polygon_list *out, fram_error *error);
fram_status overlay_union(overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error);
/* Valid: simple ring, at least 3 vertices, area > 0.  On false, reason and place (may be NULL) say why and where. */
bool overlay_is_valid(overlay *o, polygon p, char reason[128], vec2 *place);
/* Repair of an invalid ring (self-intersections, spikes): appends the simple rings of its interior, holes dropped. */
fram_status overlay_make_valid(overlay *o, polygon p, polygon_list *out, fram_error *error);
/* Douglas-Peucker within `tolerance` [m], topology kept. */
fram_status overlay_simplify(overlay *o, polygon p, double tolerance, vec2_array *out, fram_error *error);
/* Constrained Delaunay triangulation of the interior: appends triangles (3 vertices each, counter-clockwise). */
fram_status overlay_triangulate(overlay *o, polygon p, polygon_list *out, fram_error *error);

/* Cut a simple polygon into convex pieces that keep area and outline exactly: convex input is returned as it is,
   otherwise constrained Delaunay triangles under `smallest` [m2] are dropped and neighbours merged while convex
   (Hertel-Mehlhorn), at most `most` vertices a piece.  lost_area (may be NULL) gets the area of the dropped triangles. */
fram_status overlay_convex_pieces(overlay *o, polygon p, double smallest, int32_t most, polygon_list *out,
                                  double *lost_area, fram_error *error);

#endif
