/* What patch.c, patch_clip.c, patch_motion.c, patch_left.c, patch_way.c and patch_top.c share: one module with patch.h.
 * Not for others. */
#ifndef ICE_PATCH_PARTS_H
#define ICE_PATCH_PARTS_H

#include "ice/patch.h"
#include "ice/patch_kernel.h"

/* What counts as the same place, as part of the floe's size: far over rounding, far under anything of interest. */
#define PATCH_SAME_PLACE 1e-10

/* Corners of a clipped part at most: a face, cut by top and bottom and the edges of a piece, each of which adds
   one; one more where the motion changes kind; and one more that facet_clip may write. */
enum { PATCH_MOST_CORNERS = PRISM_FACE_MOST_CORNERS + 2 + PIECE_MOST_VERTICES + 2 };

/* A face of a surface: its corners among the vertices, and the faces across the edges from each to the next. */
typedef struct patch_face {
    const int32_t *corner, *neighbour;
    int32_t count;
} patch_face;

static inline patch_face face_of(const patch_surface *s, int32_t face)
{
    if (!s->faces)
        return (patch_face){s->surface->face.data[face].v, s->adjacency->neighbour.data + 3 * (ptrdiff_t)face, 3};
    int32_t first = s->faces->first.data[face];
    return (patch_face){s->faces->corner.data + first, s->faces->neighbour.data + first,
                        s->faces->first.data[face + 1] - first};
}

/* What one face has inside one piece, of one kind of motion. */
typedef struct patch_part {
    int32_t face, piece;
    int32_t first, count; /* corners in the pool */
    vec3 area;            /* area vector */
    double surface;       /* its length */
    vec3 centre;
    sym3 moment;   /* integral of (r - centre)(r - centre)^T over the area [m4] */
    bool enters;   /* moves into the ice */
    bool divided;  /* the rest of what the face has in the piece moves otherwise */
    int32_t root;  /* union-find: a part of the same component, itself at the root; always the least in the end */
    int32_t whole; /* likewise of the same patch, whatever moves into the ice */
    int32_t component;
} patch_part;

/* A line along which the way out is looked for, for a share of the volume of an overlap. */
typedef struct patch_line {
    vec3 start, direction;
    double weight; /* area along the normal [m2] */
    int32_t part;
} patch_line;

/* A patch before its motion divides it. */
typedef struct patch_whole {
    vec3 area;
    double way;
    bool enters, slides; /* in a part */
} patch_whole;

struct patch_scratch {
    int32_array faces;  /* triangles near the floe, where not all are looked at */
    ARRAY(vec3) points; /* their corners in the floe's frame: vertices of the surface, or three of each such triangle */
    ARRAY(uint8_t) caps;   /* of each point: where it lies to top and bottom */
    box2 reach;            /* of the points, plan view */
    int32_array near;      /* pieces of the floe in reach of the points */
    ARRAY(uint32_t) codes; /* of each such piece: of each point about its sides (patch_kernel.h) */
    ARRAY(piece_sides) sides, passed;
    ARRAY(box2) boxes; /* of the floe's pieces */
    ARRAY(patch_part) parts;
    ARRAY(vec3) corners;
    patch_component_array components;
    ARRAY(patch_whole) wholes; /* under the number of the part at the root */
    ARRAY(patch_line) lines;
    ARRAY(double) rays, ways;
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

static inline piece_sides sides_of(const patch_floe *f, int32_t piece)
{
    int32_t at = f->shapes->shapes.piece_first[f->shape] + piece, first = f->shapes->pieces.first[at];
    return (piece_sides){f->shapes->vertices.point + first, f->shapes->vertices.side + first,
                         f->shapes->pieces.size[at], f->shapes->vertices.count - first};
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

static inline void box_take(box2 *b, vec3 r)
{
    b->lo = (vec2){r.x < b->lo.x ? r.x : b->lo.x, r.y < b->lo.y ? r.y : b->lo.y};
    b->hi = (vec2){r.x > b->hi.x ? r.x : b->hi.x, r.y > b->hi.y ? r.y : b->hi.y};
}

static inline box2 box_of_nothing(void) { return (box2){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}}; }

/* The parts of all faces in all pieces of the floe, by face and piece. */
bool patch_clip(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe);

/* Tells of each part whether it goes into the ice, and cuts those in two of which some does: then parts are by face,
   piece and kind.  Each is its own root. */
bool patch_divide_by_motion(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe);

/* Area vector, centroid and second moments of a plane convex part, by its triangles about the first corner. */
void patch_part_measure(const vec3 *v, int32_t count, patch_part *part);

/* The mean way of the overlap of each component: that of its patch before motion divided it, from all its parts. */
bool patch_measure_ways(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe);

#endif
