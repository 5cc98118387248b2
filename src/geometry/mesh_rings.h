/* The rings along which a plane, or any other division of the vertices in two, cuts a closed surface.  Combinatorial: a
   vertex is above or below, never on, so that no cut is degenerate.  Inside geometry. */
#ifndef GEOMETRY_MESH_RINGS_H
#define GEOMETRY_MESH_RINGS_H

#include "geometry/mesh.h"

/* Ring i is half_edge[start[i] .. start[i + 1]), counter-clockwise around solid seen from above.  Each half-edge (3 f +
   k, see mesh_edges.h) runs up, from a vertex below to one above, and the next one belongs to the triangle across
   it. */
typedef struct mesh_rings {
    int32_array half_edge, start;
} mesh_rings;

static inline int32_t mesh_rings_count(const mesh_rings *r) { return r->start.count > 0 ? r->start.count - 1 : 0; }

/* above[v] is 0 or 1.  Rings begin at their least triangle, in ascending order of those.  FRAM_ERROR_INPUT with
 *edge, the half-edge where the surface is open or turns over (-1 otherwise); FRAM_ERROR_MEMORY. */
fram_status mesh_rings_build(context *ctx, const mesh *m, const mesh_adjacency *adjacency, const uint8_t *above,
                             mesh_rings *out, int32_t *edge);
void mesh_rings_free(context *ctx, mesh_rings *r);
/* The edge (0 to 2) of a face that runs up, or -1 when no edge does. */
int mesh_edge_up(const mesh *m, int32_t face, const uint8_t *above);
/* The one message for a surface that a cut finds open at a half-edge. */
fram_status mesh_open_error(const mesh *m, int32_t half_edge, fram_error *error);

#endif
