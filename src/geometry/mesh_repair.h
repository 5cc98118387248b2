/* Making sound solids of surfaces that came from elsewhere: cracks sealed, holes capped, open tops extruded, triangles
   turned.  Each step does one thing and says what it did; none is done unasked.  Vertex numbers of triangles must be
   valid and coordinates finite (mesh_check).  Faces keep their numbers; new ones are appended.  Knows nothing of files
   or ships. */
#ifndef GEOMETRY_MESH_REPAIR_H
#define GEOMETRY_MESH_REPAIR_H

#include "geometry/mesh.h"

/* What sealing found and did. */
typedef struct mesh_seal_report {
    int32_t open_before, open_after; /* edges with one triangle */
    int32_t joined;                  /* vertices moved onto another */
    int32_t splits;                  /* times that an edge was led over a vertex of the other side */
    double width;                    /* of the widest crack that was closed [m] */
    double area;                     /* swept by the edges that moved, all counted positive [m2] */
    vec3 area_vector;                /* by which the surface failed to close there: change of its sum [m2] */
    vec3 volume;                     /* change of the three volume integrals [m3] */
} mesh_seal_report;

/* Close cracks of at most `width` [m] between edges with one triangle, as panels of unlike division leave them: loose
   vertices within reach of each other become one (the nearest first, never two of one triangle, nor two on one side of
   a crack), and an edge that passes a loose vertex within reach is led over it, its triangle cut in two.  What was at
   most `width` apart is then common; nothing moves farther, and no triangle is without area that had one.  width 0 does
   nothing but count.  source (may be NULL) gets, for every face, the face it was cut from.  FRAM_ERROR_MEMORY. */
fram_status mesh_seal(context *ctx, mesh *m, double width, int32_array *source, mesh_seal_report *report);

/* The rims of holes: rings of vertices around which a cap would run, in its sense, no vertex twice in a ring.  Ring i
   is vertex[start[i] .. start[i + 1]).  Rims that touch in a vertex are rings of their own. */
typedef struct mesh_rims {
    int32_array vertex, start;
} mesh_rims;
static inline int32_t mesh_rims_count(const mesh_rims *r) { return r->start.count > 0 ? r->start.count - 1 : 0; }
/* FRAM_ERROR_INPUT with *edge (a half-edge, -1 otherwise) where rims cannot be followed because triangles turn unlike
   ways; FRAM_ERROR_MEMORY.  Rings are in the order of their least half-edges. */
fram_status mesh_rims_find(context *ctx, const mesh *m, mesh_rims *out, int32_t *edge);
void mesh_rims_free(context *ctx, mesh_rims *r);
/* The area vector [m2] of a ring of vertices, counter-clockwise seen from where it points (Newell). */
vec3 mesh_ring_area(const mesh *m, const int32_t *ring, int32_t count);

/* Append a polygon of n existing vertices as triangles, counter-clockwise as given: a fan where that is sound, ears
   seen along its area vector otherwise.  FRAM_ERROR_INPUT when it crosses itself seen so, or has no area; m is then
   unchanged. */
fram_status mesh_add_polygon(context *ctx, mesh *m, const int32_t *ring, int32_t count);

/* Raise a level open top: every ring of `rims` (all at one height, to `tolerance` [m]) is led up by `height` > 0 and
   the deck closed.  A ring within another is a well through the deck.  FRAM_ERROR_INPUT where rings cross. */
fram_status mesh_raise_top(context *ctx, mesh *m, const mesh_rims *rims, double height, fram_error *error);

/* Leave out vertices that no triangle names; the others keep their order.  false: no memory (m is then unchanged). */
bool mesh_drop_unused_vertices(context *ctx, mesh *m);

/* Turn triangles so that all neighbours agree, and then closed parts right side out (cavities inward).  flipped gets
   the number of triangles turned.  FRAM_ERROR_INPUT with *face when a part has no two sides (a Moebius band);
   FRAM_ERROR_MEMORY. */
fram_status mesh_orient(context *ctx, mesh *m, int32_t *flipped, int32_t *face);

#endif
