/* A hierarchy of boxes over the triangles of a mesh, to find those near a box or a plate without walking them all.  It
   keeps boxes and face numbers, not the mesh: build it anew when the mesh changes.  The same mesh gives the same tree.
   Queries change nothing but their output and may run on several threads at once. */
#ifndef GEOMETRY_MESH_BVH_H
#define GEOMETRY_MESH_BVH_H

#include "geometry/mesh.h"

typedef struct mesh_bvh_node {
    box3 box;
    int32_t next;         /* inner: its second child (the first one follows the node); leaf: -1 */
    int32_t first, count; /* its places in `face` and `box` */
} mesh_bvh_node;

/* Nodes depth first, root at 0; none for a mesh without triangles. */
typedef struct mesh_bvh {
    ARRAY(mesh_bvh_node) node;
    int32_array face; /* face numbers in tree order */
    ARRAY(box3) box;  /* box of face[i] */
} mesh_bvh;

/* FRAM_ERROR_MEMORY leaves out empty.  n log n. */
fram_status mesh_bvh_build(context *ctx, const mesh *m, mesh_bvh *out);
void mesh_bvh_free(context *ctx, mesh_bvh *b);

/* The faces whose boxes meet `box` (touching counts), ascending; what faces_out held is dropped.  false: no memory. */
bool mesh_bvh_query(context *ctx, const mesh_bvh *b, box3 box, int32_array *faces_out);

/* The same for the part of `box` between two parallel planes, lo <= dot(normal, x) <= hi: a tilted floe meets far fewer
   triangles than the box around it. */
bool mesh_bvh_query_slab(context *ctx, const mesh_bvh *b, box3 box, vec3 normal, double lo, double hi,
                         int32_array *faces_out);

#endif
