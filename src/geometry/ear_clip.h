/* Triangulation by ear clipping: exact, deterministic, every vertex of the outline kept, no regard to shape.  For
   surfaces that only have to be closed; contacts want the Delaunay triangles of overlay.h. */
#ifndef GEOMETRY_EAR_CLIP_H
#define GEOMETRY_EAR_CLIP_H

#include "geometry/polygon.h"

typedef int32_array index_array;

/* Triangles of the interior of p into out (what it held is dropped): three vertex numbers of p each, counter-clockwise.
   p is simple and counter-clockwise, but may repeat a vertex several times in a row (the first one is used), may have
   straight vertices, and may touch itself as a hole joined by a bridge does (not where two parts hang together by a
   vertex).  Every edge between the vertices used belongs to exactly one triangle, a bridge to one on each side, and no
   triangle is without area.  Orientations are exact, so that no outline is too thin.  What bars an ear is looked for
   in a tree of boxes over the ring: time grows little more than with the vertices.
   FRAM_ERROR_MEMORY, or FRAM_ERROR_INPUT when p is too small, clockwise or so far from simple that the ears run out. */
fram_status polygon_triangulate_ears(context *ctx, polygon p, index_array *out);

#endif
