/* Closed triangle surfaces.  Triangles are counter-clockwise seen from outside: the area vector
   N = 1/2 (b - a) x (c - a) points outward.  Metres, body frame of the owner.  Knows nothing of bodies or water
   (a "plane" is a plane). */
#ifndef GEOMETRY_MESH_H
#define GEOMETRY_MESH_H

#include "geometry/polygon.h"

typedef struct triangle {
    int32_t v[3];
} triangle;

typedef struct mesh {
    ARRAY(vec3) vertex;
    ARRAY(triangle) face;
} mesh;

void mesh_free(context *ctx, mesh *m);
/* Empty, memory kept. */
void mesh_clear(mesh *m);
bool mesh_copy(context *ctx, mesh *dst, const mesh *src);
/* Move every vertex. */
void mesh_translate(mesh *m, vec3 by);
bool mesh_add_vertex(context *ctx, mesh *m, vec3 v);
bool mesh_add_triangle(context *ctx, mesh *m, int32_t a, int32_t b, int32_t c);
vec3 mesh_area_vector(const mesh *m, int32_t face);
/* Every triangle names three vertices that are there; what repair and sections build on. */
bool mesh_indices_are_valid(const mesh *m);
/* False for a triangle whose height over its longest side is nothing but rounding (MESH_DEGENERATE); mesh_check.c. */
bool mesh_has_area(const mesh *m, int32_t face);

/* Axis-aligned, both ends inside; empty when lo > hi. */
typedef struct box3 {
    vec3 lo, hi;
} box3;
static inline box3 box3_empty(void)
{
    return (box3){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
}
static inline box3 box3_union(box3 a, box3 b)
{
    return (box3){
        {a.lo.x < b.lo.x ? a.lo.x : b.lo.x, a.lo.y < b.lo.y ? a.lo.y : b.lo.y, a.lo.z < b.lo.z ? a.lo.z : b.lo.z},
        {a.hi.x > b.hi.x ? a.hi.x : b.hi.x, a.hi.y > b.hi.y ? a.hi.y : b.hi.y, a.hi.z > b.hi.z ? a.hi.z : b.hi.z}};
}
static inline box3 box3_add(box3 b, vec3 p) { return box3_union(b, (box3){p, p}); }
static inline bool box3_meet(box3 a, box3 b)
{
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
           b.lo.z <= a.hi.z;
}
/* All vertices; a point at the origin for a mesh without any. */
box3 mesh_bounds(const mesh *m);
box3 mesh_face_bounds(const mesh *m, int32_t face);
static inline void mesh_face_points(const mesh *m, int32_t face, vec3 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = m->vertex.data[m->face.data[face].v[k]];
}

/* Which triangle lies across which edge: neighbour[3 f + k] is the face that shares the edge of face f from its vertex
   k to its vertex k + 1 (mod 3), whichever way it turns; -1 where the surface is open and where more than two faces
   meet.  Made in linear time.  Face indices must be valid. */
typedef struct mesh_adjacency {
    ARRAY(int32_t) neighbour;
} mesh_adjacency;
fram_status mesh_adjacency_build(context *ctx, const mesh *m, mesh_adjacency *out);
void mesh_adjacency_free(context *ctx, mesh_adjacency *a);
/* The edge (0 to 2) of `face` that leads to `neighbour`, or -1. */
int mesh_edge_to(const mesh_adjacency *a, int32_t face, int32_t neighbour);

/* Volume [m3], centre [m] and inertia tensor about that centre of unit density [m5] (xy, xz, yz are the products with
   the minus sign of an inertia tensor already in), from signed tetrahedra (Eberly 2002).  Exact for a closed mesh. */
typedef struct solid_properties {
    double volume;
    vec3 centre;
    sym3 inertia;
} solid_properties;
solid_properties mesh_solid_properties(const mesh *m);
/* The three volume integrals of x n_x, y n_y, z n_z dS [m3], about the origin of the mesh's own frame: equal for a
   closed mesh (and the third is the volume also for one that is open at z = 0 only). */
vec3 mesh_volume_integrals(const mesh *m);

/* What is wrong with a surface, in the order in which it is looked for. */
typedef enum mesh_defect {
    MESH_CLOSED = 0,
    MESH_EMPTY,            /* no triangles */
    MESH_BAD_INDEX,        /* a triangle names a vertex that is not there */
    MESH_NOT_FINITE,       /* a coordinate is not a number */
    MESH_DEGENERATE,       /* a triangle without area, or a closed part without volume */
    MESH_OPEN,             /* an edge with one triangle */
    MESH_NOT_MANIFOLD,     /* an edge with more than two triangles */
    MESH_INCONSISTENT,     /* two neighbours turn opposite ways */
    MESH_INSIDE_OUT,       /* a connected part is turned the wrong way: inward in the open, outward inside another */
    MESH_SELF_INTERSECTING /* two triangles cross, or touch off their common vertices */
} mesh_defect;
typedef struct mesh_report {
    mesh_defect defect;
    int32_t face, other_face; /* -1 when not meant */
    int32_t edge[2];          /* vertices of the edge */
    int32_t open_edges;
    char text[200]; /* "edge between vertices 3 (x, y, z) and 7 (...) has one triangle (12)" */
} mesh_report;
/* Finds the first defect in the order of mesh_defect and, of its kind, the one of the least triangle;
   report->open_edges counts all open edges when that is the defect.  A mesh may have several closed parts, cavities
   among them (turned inward).  self_intersection: look for crossing triangles too (exact tests on a box hierarchy;
   n log n for real hulls), and then for bodies inside bodies.  FRAM_OK whatever is found, or FRAM_ERROR_MEMORY. */
fram_status mesh_check(context *ctx, const mesh *m, bool self_intersection, mesh_report *report);

/* Join vertices at most `distance` [m] apart (0: equal ones).  In the order of vertices, each becomes the first kept
   one within reach or is kept itself, so that chains do not creep; kept vertices stay in order and in place, triangles
   that name one of them twice are dropped.  joined gets the number of vertices that went.  Indices must be valid. */
fram_status mesh_weld(context *ctx, mesh *m, double distance, int32_t *joined);

/* The polygon extruded along z from `bottom` to `top`: outer faces only (bottom, top, sides), closed.  Vertices
   repeated in a row are taken once; of the n that are left, vertex i is at the bottom, n + i at the top.  Lids are fans
   where that is a triangulation (convex outlines), ears otherwise.  What out held is dropped; it is empty on failure.
   FRAM_ERROR_INPUT: outline not simple, not counter-clockwise, or bottom >= top. */
fram_status mesh_make_prism(context *ctx, polygon outline, double bottom, double top, mesh *out, fram_error *error);
/* Axis-aligned box; what out held is dropped.  false: no memory. */
bool mesh_make_box(context *ctx, vec3 lo, vec3 hi, mesh *out);

/* The part of one triangle below the plane z <= level, as a convex polygon of at most 4 vertices; returns the count,
   which is 1 or 2 where the triangle only touches the plane from above.  Vertices exactly on the plane belong to both
   sides; neighbours are cut at the same points to the bit, and new points have z = level. */
int triangle_clip_below(const vec3 in[3], double level, vec3 out[4]);
/* The part of a convex polygon of n vertices with dot(normal, x) <= d; out has room for n + 1 and may
   not be `in`; returns the count (1 or 2 where the polygon only touches). */
int facet_clip(const vec3 *in, int n, vec3 normal, double d, vec3 *out);
/* The same where the distances dot(normal, x) - d of its vertices are known. */
int facet_clip_at(const vec3 *in, int n, const double *distance, vec3 *out);

/* Where a segment meets a plane, from its inner end (distance < 0) to its outer one (distance >= 0).  Always asked in
   this direction, so that two triangles cut their common edge at the same point to the bit. */
static inline vec3 segment_crossing(vec3 inner, double inner_distance, vec3 outer, double outer_distance)
{
    if (outer_distance == 0)
        return outer;
    return vec3_mad(inner, vec3_sub(outer, inner), inner_distance / (inner_distance - outer_distance));
}

/* The point of the closed segment ab that is nearest to p. */
static inline vec3 segment_nearest3(vec3 p, vec3 a, vec3 b)
{
    vec3 ab = vec3_sub(b, a);
    double t = vec3_dot(vec3_sub(p, a), ab), length = vec3_dot(ab, ab);
    if (t <= 0)
        return a;
    return t >= length ? b : vec3_mad(a, ab, t / length);
}

/* Plan outline of the section z = level: appends closed rings, counter-clockwise around solid (a hole is clockwise), in
   the order of their least triangles.  The level is taken as just below its number: vertices on it count as above it,
   so a box has a section at its top and none at its bottom, and a point or line of contact gives nothing.  Repeated
   points are taken once.  FRAM_ERROR_INPUT where the surface is open, FRAM_ERROR_MEMORY; rings may have been appended
   in the latter case. */
fram_status mesh_section(context *ctx, const mesh *m, double level, polygon_list *out, fram_error *error);
/* The same for a surface whose adjacency is known; it may have been moved since. */
fram_status mesh_section_along(context *ctx, const mesh *m, const mesh_adjacency *adjacency, double level,
                               polygon_list *out, fram_error *error);

#endif
