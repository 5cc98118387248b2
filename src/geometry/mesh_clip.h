/* The part of a solid on one side of a plane, as a solid.  Knows nothing of why it is cut. */
#ifndef GEOMETRY_MESH_CLIP_H
#define GEOMETRY_MESH_CLIP_H

#include "geometry/mesh.h"

/* The part of closed m with dot(normal, x) <= d, closed by caps in the plane; normal need not be a unit vector.
   Vertices whose dot is within `snap` of d are taken to be on the plane and not moved; what has no volume beneath it is
   dropped, so out may be empty.  What out held is dropped; it must not be m.

   The result is a closed manifold and its volume exact, always.  Caps are ears of the section's rings.  The ring of a
   hole is capped by itself, turned over, on top of the cap around it.  Triangles without area come where a ring touches
   itself, and may come where a flat side is cut; a ring that rounding folded beyond that is capped by a fan.
   FRAM_ERROR_INPUT where m is open, FRAM_ERROR_MEMORY; out is empty then. */
fram_status mesh_clip(context *ctx, const mesh *m, const mesh_adjacency *adjacency, vec3 normal, double d, double snap,
                      mesh *out, fram_error *error);

#endif
