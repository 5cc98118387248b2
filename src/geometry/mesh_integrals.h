/* What integrals over a large closed surface need to know of it beforehand, for whole branches of its tree
   (mesh_bvh.h) at once: moments that give the integral of a pressure linear in space exactly, and sample points for
   what is not linear.  Made once from mesh and tree; knows nothing of water. */
#ifndef GEOMETRY_MESH_INTEGRALS_H
#define GEOMETRY_MESH_INTEGRALS_H

#include "geometry/mesh_bvh.h"

/* With n the outward unit normal and r the place, body frame: over the faces of one node. */
typedef struct surface_moments {
    vec3 area;       /* int n dS [m2] */
    vec3 turn;       /* int r x n dS [m3] */
    mat3 area_first; /* m[i][j] = int n_i r_j dS [m3] */
    mat3 turn_first; /* m[i][j] = int (r x n)_i r_j dS [m4] */
} surface_moments;

/* Points that stand for flat parts of the surface, in the order of the tree: several small triangles that lie nearly in
   one plane, one triangle, or a part of a large one.  A triangle so large that more than MESH_MOST_PARTS points would
   be needed has none and stands in `large`. */
enum { MESH_MOST_PARTS = 128 };

typedef struct mesh_integrals {
    ARRAY(surface_moments) moments; /* per node of the tree */
    ARRAY(double) x, y, z;          /* of the points [m] */
    ARRAY(double) nx, ny, nz, area; /* unit normal, area [m2] */
    int32_array point_first;        /* per place in tree.face, and one more: the points of places i..k-1 are
                                       point_first[i]..point_first[k]-1 when i..k-1 are the places of a node that is no
                                       part of a point */
    int32_array large;              /* places in tree.face, ascending */
    int32_array large_first;        /* per place, and one more: the same for `large` */
} mesh_integrals;

/* A point stands for no more than this, over the radius of the mesh about its origin: for several triangles that are
   joined, whose normals differ, and for a part of one triangle, where only what turns with the body is not uniform: the
   midpoint rule then errs by (1/8)^2 / 24 of that.  Triangles are joined when the length of their summed area vectors
   is more than MESH_FLATNESS of the sum of their areas, which is when their normals differ by three degrees or so. */
#define MESH_SPACING (1.0 / 16)
#define MESH_PART (1.0 / 8)
#define MESH_FLATNESS 0.998

/* The moments of one triangle. */
surface_moments triangle_moments(const vec3 corner[3]);

/* false: no memory, out is empty. */
bool mesh_integrals_build(context *ctx, const mesh *m, const mesh_bvh *tree, mesh_integrals *out);
void mesh_integrals_free(context *ctx, mesh_integrals *i);

#endif
