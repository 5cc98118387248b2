/* What patch.c, patch_way.c and patch_top.c share: one module with patch.h.  Not for others. */
#ifndef ICE_PATCH_PARTS_H
#define ICE_PATCH_PARTS_H

#include "ice/patch.h"

/* What counts as the same place, as part of the floe's size: far over rounding, far under anything of interest. */
#define PATCH_SAME_PLACE 1e-10

/* What one triangle has inside one piece. */
typedef struct patch_part {
    int32_t face, piece;
    int32_t first, count; /* corners in the pool */
    vec3 area;            /* area vector */
    double surface;       /* its length */
    vec3 centre;
    sym3 moment;  /* integral of (r - centre)(r - centre)^T over the area [m4] */
    int32_t root; /* union-find: a part of the same component, itself at the root; always the least in the end */
    int32_t component;
} patch_part;

struct patch_scratch {
    int32_array faces;
    ARRAY(box2) boxes; /* of the floe's pieces */
    ARRAY(patch_part) parts;
    ARRAY(vec3) corners;
    patch_component_array components;
    mesh turned; /* the surface in the floe's frame */
    polygon_list section;
    vec2_array ring_a, ring_b;
};

static inline double half_height_of(const patch_floe *f) { return f->shapes->shapes.half_height[f->shape]; }

static inline int32_t piece_count_of(const patch_floe *f) { return f->shapes->shapes.piece_count[f->shape]; }

static inline double tolerance_of(const patch_floe *f) { return PATCH_SAME_PLACE * f->shapes->shapes.radius[f->shape]; }

static inline vec3 to_floe(const patch_surface *s, vec3 r) { return vec3_add(mat3_mul_vec(s->rotation, r), s->offset); }

/* n . x <= d */
typedef struct half_space {
    vec3 n;
    double d;
} half_space;

/* A convex piece of the floe: its vertices, and the unit outward normals of the sides that start there. */
typedef struct piece_sides {
    const vec2 *vertex, *normal;
    int32_t count;
} piece_sides;

static inline piece_sides sides_of(const patch_floe *f, int32_t piece)
{
    int32_t at = f->shapes->shapes.piece_first[f->shape] + piece, first = f->shapes->pieces.first[at];
    return (piece_sides){f->shapes->vertices.point + first, f->shapes->vertices.side + first,
                         f->shapes->pieces.size[at]};
}

static inline half_space piece_side(const piece_sides *piece, int32_t k)
{
    vec2 n = piece->normal[k], a = piece->vertex[k];
    return (half_space){{n.x, n.y, 0}, n.x * a.x + n.y * a.y};
}

/* Top (k = 0) and bottom (k = 1) of a prism. */
static inline half_space prism_cap(double half_height, int k)
{
    return (half_space){{0, 0, k == 0 ? 1 : -1}, half_height};
}

/* The mean way of the overlap of each component, from its parts. */
void patch_measure_ways(patch_scratch *s, const patch_surface *surface, const patch_floe *floe);

#endif
