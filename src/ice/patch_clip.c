/* The parts of a surface's faces inside the pieces of a floe; see patch.h.

   What is cut away, and what nothing is cut from, is found for all points of the surface at once first: a face
   whose corners lie outside of one side has no part, and a side that all corners lie inside of cuts nothing.  "Outside"
   and "inside" are meant by a margin that is far over rounding, so that the cuts which are left give the same bits as
   all. */
#include "ice/patch_parts.h"

/* The margin of points that count as outside or inside, in tolerances. */
#define SURE_MARGIN 4.0

/* Where a point lies to top and bottom. */
enum { OVER_TOP = 1, UNDER_BOTTOM = 2, OUTSIDE_CAPS = 3, BELOW_TOP = 4, ABOVE_BOTTOM = 8 };

_Static_assert((int)PIECE_MOST_VERTICES <= (int)PATCH_INSIDE, "a code has a bit for each side of a piece");

/* ---- cutting ---- */

typedef struct facet {
    vec3 corner[2][PATCH_MOST_CORNERS]; /* filled and spare, in turn */
    int side, count;
    vec3 normal; /* of the face it came from, any length */
} facet;

/* Cut by one half space.  A facet in the boundary plane belongs to the side that its outward normal points to: there is
   the ice that it pushes. */
static void facet_cut(facet *f, half_space h, double tolerance)
{
    const vec3 *v = f->corner[f->side];
    double distance[PATCH_MOST_CORNERS], least = HUGE_VAL, most = -HUGE_VAL;
    for (int i = 0; i < f->count; i++) {
        double d = vec3_dot(h.n, v[i]) - h.d;
        distance[i] = d;
        least = d < least ? d : least;
        most = d > most ? d : most;
    }
    if (least >= -tolerance && most <= tolerance) {
        if (vec3_dot(f->normal, h.n) >= 0)
            f->count = 0;
    } else if (least >= 0) {
        f->count = 0;
    } else if (most > 0) {
        f->count = facet_clip_at(v, f->count, distance, f->corner[1 - f->side]);
        f->side = 1 - f->side;
    }
}

void patch_part_measure(const vec3 *v, int32_t count, patch_part *part)
{
    vec3 twice = {0, 0, 0};
    for (int32_t i = 1; i + 1 < count; i++)
        twice = vec3_add(twice, vec3_cross(vec3_sub(v[i], v[0]), vec3_sub(v[i + 1], v[0])));
    double length = vec3_length(twice), surface = 0;
    vec3 unit = vec3_scale(twice, length > 0 ? 1 / length : 0), first = {0, 0, 0};
    sym3 m = {0};
    /* About v[0], which is a corner of all triangles: the integrals of r and of r r^T over one with the sides a and b
       are A/3 (a + b) and A/12 (a a^T + b b^T + (a + b)(a + b)^T). */
    for (int32_t i = 1; i + 1 < count; i++) {
        vec3 a = vec3_sub(v[i], v[0]), b = vec3_sub(v[i + 1], v[0]), s = vec3_add(a, b);
        double area = 0.5 * vec3_dot(vec3_cross(a, b), unit), share = area / 12;
        surface += area;
        first = vec3_mad(first, s, area / 3);
        m.xx += share * (a.x * a.x + b.x * b.x + s.x * s.x);
        m.yy += share * (a.y * a.y + b.y * b.y + s.y * s.y);
        m.zz += share * (a.z * a.z + b.z * b.z + s.z * s.z);
        m.xy += share * (a.x * a.y + b.x * b.y + s.x * s.y);
        m.xz += share * (a.x * a.z + b.x * b.z + s.x * s.z);
        m.yz += share * (a.y * a.z + b.y * b.z + s.y * s.z);
    }
    part->area = vec3_scale(twice, 0.5);
    part->surface = surface;
    vec3 c = vec3_scale(first, surface > 0 ? 1 / surface : 0);
    part->centre = vec3_add(v[0], c);
    part->moment = (sym3){m.xx - surface * c.x * c.x, m.yy - surface * c.y * c.y, m.zz - surface * c.z * c.z,
                          m.xy - surface * c.x * c.y, m.xz - surface * c.x * c.z, m.yz - surface * c.y * c.z};
}

static bool push_part(context *ctx, patch_scratch *s, const facet *f, int32_t face, int32_t piece, double tolerance)
{
    const vec3 *v = f->corner[f->side];
    patch_part part = {.face = face, .piece = piece, .first = s->corners.count, .count = f->count, .component = -1};
    patch_part_measure(v, f->count, &part);
    if (!(part.surface > tolerance * tolerance))
        return true;
    if (!array_reserve(ctx, &s->corners, s->corners.count + f->count))
        return false;
    for (int i = 0; i < f->count; i++)
        s->corners.data[s->corners.count++] = v[i];
    return array_push(ctx, &s->parts, part);
}

/* ---- the triangles near the floe ---- */

/* Those that meet the box around its oriented box, between the planes of top and bottom. */
static bool query_faces(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    double tolerance = tolerance_of(floe), half_height = half_height_of(floe) + tolerance;
    box2 plan = polygon_bounds(shape_outline(floe->shapes, floe->shape));
    box3 box = box3_empty();
    for (int i = 0; i < 8; i++) {
        vec3 corner = {i & 1 ? plan.hi.x + tolerance : plan.lo.x - tolerance,
                       i & 2 ? plan.hi.y + tolerance : plan.lo.y - tolerance, i & 4 ? half_height : -half_height};
        box = box3_add(box, mat3_tmul_vec(surface->rotation, vec3_sub(corner, surface->offset)));
    }
    /* z of the floe's frame as a function of the surface's coordinates: its third row. */
    vec3 z = {surface->rotation.m[2][0], surface->rotation.m[2][1], surface->rotation.m[2][2]};
    return mesh_bvh_query_slab(ctx, surface->tree, box, z, -half_height - surface->offset.z,
                               half_height - surface->offset.z, &s->faces);
}

/* ---- points ---- */

/* A point of the surface: its place in the floe's frame, and where that is to top and bottom. */
static void take_point(patch_scratch *s, const patch_surface *surface, vec3 r, double half_height, double margin,
                       int32_t i)
{
    vec3 p = to_floe(surface, r);
    s->points.data[i] = p;
    s->caps.data[i] =
        (uint8_t)((p.z > half_height + margin ? OVER_TOP : 0) | (p.z < -half_height - margin ? UNDER_BOTTOM : 0) |
                  (p.z < half_height - margin ? BELOW_TOP : 0) | (p.z > -half_height + margin ? ABOVE_BOTTOM : 0));
    box_take(&s->reach, p);
}

/* A surface without a tree is looked at as a whole; of others the triangles near the floe are asked for. */
static bool is_whole(const patch_surface *surface) { return !surface->tree; }

/* All vertices of the surface, or three for each triangle near the floe. */
static bool take_points(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    const mesh *m = surface->surface;
    bool whole = is_whole(surface);
    if (!whole && !query_faces(ctx, s, surface, floe))
        return false;
    int32_t count = whole ? m->vertex.count : 3 * s->faces.count;
    if (!array_resize(ctx, &s->points, count) || !array_resize(ctx, &s->caps, count))
        return false;
    double half_height = half_height_of(floe), margin = SURE_MARGIN * tolerance_of(floe);
    s->reach = box_of_nothing();
    for (int32_t i = 0; i < count; i++) {
        vec3 r = m->vertex.data[whole ? i : m->face.data[s->faces.data[i / 3]].v[i % 3]];
        take_point(s, surface, r, half_height, margin, i);
    }
    return true;
}

/* Part of the box lies farther off than `tolerance` from the other: they have nothing in common. */
static bool boxes_are_apart(const box2 *a, const box2 *b, double tolerance)
{
    return a->lo.x > b->hi.x + tolerance || a->hi.x < b->lo.x - tolerance || a->lo.y > b->hi.y + tolerance ||
           a->hi.y < b->lo.y - tolerance;
}

/* The pieces in reach of the points, and where the points lie about their sides. */
static bool take_pieces(context *ctx, patch_scratch *s, const patch_floe *floe)
{
    int32_t pieces = piece_count_of(floe), points = s->points.count;
    double tolerance = tolerance_of(floe);
    array_clear(&s->near);
    if (!array_resize(ctx, &s->boxes, pieces) || !array_resize(ctx, &s->sides, pieces))
        return false;
    for (int32_t p = 0; p < pieces; p++) {
        s->sides.data[p] = sides_of(floe, p);
        s->boxes.data[p] = polygon_bounds(shape_piece(floe->shapes, floe->shape, p));
        if (!boxes_are_apart(&s->reach, &s->boxes.data[p], tolerance) && !array_push(ctx, &s->near, p))
            return false;
    }
    if (points > INT32_MAX / (s->near.count + 1) || !array_resize(ctx, &s->codes, points * s->near.count))
        return false;
    for (int32_t k = 0; k < s->near.count; k++)
        KERNEL_PICK(ctx, patch_codes)
    (&s->sides.data[s->near.data[k]], SURE_MARGIN * tolerance, s->points.data, points,
     s->codes.data + (ptrdiff_t)k * points);
    return true;
}

/* ---- faces ---- */

/* The corners of a face among the points. */
typedef struct point_ring {
    const int32_t *at;
    int32_t count;
} point_ring;

/* What is true of all corners about the sides of a piece in reach. */
static uint32_t code_of(const patch_scratch *s, int32_t near, point_ring v)
{
    const uint32_t *code = s->codes.data + (ptrdiff_t)near * s->points.count;
    uint32_t all = ~0u;
    for (int32_t i = 0; i < v.count; i++)
        all &= code[v.at[i]];
    return all;
}

static bool any_piece_meets(const patch_scratch *s, point_ring v)
{
    for (int32_t k = 0; k < s->near.count; k++)
        if (!(code_of(s, k, v) & PATCH_OUTSIDE_BITS))
            return true;
    return false;
}

/* The face between the planes of top and bottom, given what is true of its corners about them; whether anything was
   cut off. */
static bool make_slab(const patch_scratch *s, point_ring v, unsigned caps, double half_height, double tolerance,
                      facet *slab)
{
    slab->side = 0;
    slab->count = v.count;
    slab->normal = (vec3){0, 0, 0};
    vec3 *corner = slab->corner[0];
    for (int k = 0; k < v.count; k++)
        corner[k] = s->points.data[v.at[k]];
    for (int k = 1; k + 1 < v.count; k++)
        slab->normal =
            vec3_add(slab->normal, vec3_cross(vec3_sub(corner[k], corner[0]), vec3_sub(corner[k + 1], corner[0])));
    if (!(caps & BELOW_TOP))
        facet_cut(slab, prism_cap(half_height, 0), tolerance);
    if (!(caps & ABOVE_BOTTOM))
        facet_cut(slab, prism_cap(half_height, 1), tolerance);
    return (caps & (BELOW_TOP | ABOVE_BOTTOM)) != (BELOW_TOP | ABOVE_BOTTOM);
}

/* The slab's codes about a piece, those of what is left of a face. */
static uint32_t slab_code(context *ctx, const facet *slab, const piece_sides *piece, double margin)
{
    uint32_t code[PATCH_MOST_CORNERS], all = ~0u;
    KERNEL_PICK(ctx, patch_codes)(piece, margin, slab->corner[slab->side], slab->count, code);
    for (int i = 0; i < slab->count; i++)
        all &= code[i];
    return all;
}

/* The part of a slab inside a piece, where the sides may cut that its corners are not all inside of. */
static void cut_by_piece(const facet *slab, const piece_sides *piece, uint32_t code, double tolerance, facet *part)
{
    part->side = 0;
    part->count = slab->count;
    part->normal = slab->normal;
    for (int i = 0; i < slab->count; i++)
        part->corner[0][i] = slab->corner[slab->side][i];
    for (int32_t k = 0; k < piece->count && part->count >= 3; k++)
        if (!(code >> PATCH_INSIDE >> k & 1u))
            facet_cut(part, piece_side(piece, k), tolerance);
}

/* The parts of one face in all pieces; v: its corners among the points. */
static bool clip_face(context *ctx, patch_scratch *s, const patch_floe *floe, int32_t face, point_ring v)
{
    unsigned caps = OUTSIDE_CAPS | BELOW_TOP | ABOVE_BOTTOM;
    for (int32_t i = 0; i < v.count; i++)
        caps &= s->caps.data[v.at[i]];
    if ((caps & OUTSIDE_CAPS) || !any_piece_meets(s, v))
        return true;
    double tolerance = tolerance_of(floe);
    facet slab, part;
    bool is_cut = make_slab(s, v, caps, half_height_of(floe), tolerance, &slab);
    if (slab.count < 3)
        return true;
    box2 reach = box_of_nothing();
    for (int i = 0; i < slab.count; i++)
        box_take(&reach, slab.corner[slab.side][i]);
    for (int32_t k = 0; k < s->near.count; k++) {
        int32_t p = s->near.data[k];
        const piece_sides *piece = &s->sides.data[p];
        uint32_t code = code_of(s, k, v);
        if ((code & PATCH_OUTSIDE_BITS) || boxes_are_apart(&reach, &s->boxes.data[p], tolerance))
            continue;
        if (is_cut)
            code = slab_code(ctx, &slab, piece, SURE_MARGIN * tolerance);
        if (code & PATCH_OUTSIDE_BITS)
            continue;
        cut_by_piece(&slab, piece, code, tolerance, &part);
        if (part.count >= 3 && !push_part(ctx, s, &part, face, p, tolerance))
            return false;
    }
    return true;
}

bool patch_clip(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    if (!take_points(ctx, s, surface, floe) || !take_pieces(ctx, s, floe))
        return false;
    if (s->near.count == 0)
        return true;
    bool whole = is_whole(surface);
    int32_t count = !whole           ? s->faces.count
                    : surface->faces ? prism_faces_count(surface->faces)
                                     : surface->surface->face.count;
    for (int32_t i = 0; i < count; i++) {
        const int32_t own[3] = {3 * i, 3 * i + 1, 3 * i + 2};
        point_ring ring = {own, 3};
        if (whole) {
            patch_face face = face_of(surface, i);
            ring = (point_ring){face.corner, face.count};
        }
        if (!clip_face(ctx, s, floe, whole ? i : s->faces.data[i], ring))
            return false;
    }
    return true;
}
