/* The edges of a mesh as sorted half-edges, inside geometry: half-edge h = 3 f + k runs from vertex k of face f to its
   vertex k + 1 (mod 3).  The half-edges of one undirected edge stand together, ascending; edges ascend by their lower
   vertex, then by their higher one.  Sorted by two counting passes: linear whatever the mesh. */
#ifndef GEOMETRY_MESH_EDGES_H
#define GEOMETRY_MESH_EDGES_H

#include "geometry/mesh.h"

static inline int32_t half_edge_from(const mesh *m, int32_t h) { return m->face.data[h / 3].v[h % 3]; }
static inline int32_t half_edge_to(const mesh *m, int32_t h) { return m->face.data[h / 3].v[(h % 3 + 1) % 3]; }
static inline bool same_edge(const mesh *m, int32_t g, int32_t h)
{
    int32_t a = half_edge_from(m, g), b = half_edge_to(m, g), c = half_edge_from(m, h), d = half_edge_to(m, h);
    return (a == c && b == d) || (a == d && b == c);
}

/* All half-edges of m; indices must be valid.  false: no memory. */
bool mesh_edges_sort(context *ctx, const mesh *m, int32_array *sorted);
/* One past the last half-edge of the edge that begins at `first`. */
int32_t mesh_edges_end(const mesh *m, const int32_array *sorted, int32_t first);
/* mesh_adjacency_build for edges that are sorted already. */
fram_status mesh_adjacency_from_edges(context *ctx, const mesh *m, const int32_array *sorted, mesh_adjacency *out);

#endif
