/* The geometry of crushing patches; see patch.h. */
#include "ice/patch_parts.h"

/* Corners of a clipped part at most: a triangle, cut by top and bottom and the edges of a piece, each of which adds
   one; and one more that facet_clip may write. */
enum { MOST_CORNERS = 3 + 2 + PIECE_MOST_VERTICES + 1 };

patch_scratch *patch_scratch_create(context *ctx) { return memory_array(ctx, 1, sizeof(patch_scratch)); }

void patch_scratch_free(context *ctx, patch_scratch *s)
{
    if (!s)
        return;
    array_free(ctx, &s->faces);
    array_free(ctx, &s->boxes);
    array_free(ctx, &s->parts);
    array_free(ctx, &s->corners);
    array_free(ctx, &s->components);
    mesh_free(ctx, &s->turned);
    polygon_list_free(ctx, &s->section);
    array_free(ctx, &s->ring_a);
    array_free(ctx, &s->ring_b);
    memory_free(ctx, s);
}

/* ---- clipping ---- */

typedef struct facet {
    vec3 corner[2][MOST_CORNERS]; /* filled and spare, in turn */
    int side, count;
    vec3 normal; /* of the triangle it came from, any length */
} facet;

/* Cut by one half space.  A facet in the boundary plane belongs to the side that its outward normal points to: there is
   the ice that it pushes. */
static void facet_cut(facet *f, half_space h, double tolerance)
{
    const vec3 *v = f->corner[f->side];
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int i = 0; i < f->count; i++) {
        double distance = vec3_dot(h.n, v[i]) - h.d;
        least = distance < least ? distance : least;
        most = distance > most ? distance : most;
    }
    if (least >= -tolerance && most <= tolerance) {
        if (vec3_dot(f->normal, h.n) >= 0)
            f->count = 0;
    } else if (least >= 0) {
        f->count = 0;
    } else if (most > 0) {
        f->count = facet_clip(v, f->count, h.n, h.d, f->corner[1 - f->side]);
        f->side = 1 - f->side;
    }
}

/* Area vector, centroid and second moments of a plane convex part, by its triangles about the first corner. */
static void part_measure(const vec3 *v, int32_t count, patch_part *part)
{
    vec3 area = {0, 0, 0}, first = {0, 0, 0};
    double surface = 0;
    for (int32_t i = 1; i + 1 < count; i++) {
        vec3 n = vec3_scale(vec3_cross(vec3_sub(v[i], v[0]), vec3_sub(v[i + 1], v[0])), 0.5);
        double a = vec3_length(n);
        area = vec3_add(area, n);
        surface += a;
        first = vec3_mad(first, vec3_add(vec3_sub(v[i], v[0]), vec3_sub(v[i + 1], v[0])), a / 3);
    }
    part->area = area;
    part->surface = surface;
    part->centre = surface > 0 ? vec3_mad(v[0], first, 1 / surface) : v[0];
    part->moment = (sym3){0};
    /* Integral of r r^T over a triangle: A/12 (sum of v v^T + s s^T) with s the sum of its corners. */
    for (int32_t i = 1; i + 1 < count; i++) {
        vec3 p[3] = {vec3_sub(v[0], part->centre), vec3_sub(v[i], part->centre), vec3_sub(v[i + 1], part->centre)};
        double a = vec3_length(vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]))) / 24;
        vec3 term[4] = {p[0], p[1], p[2], vec3_add(vec3_add(p[0], p[1]), p[2])};
        for (int k = 0; k < 4; k++) {
            part->moment.xx += a * term[k].x * term[k].x;
            part->moment.yy += a * term[k].y * term[k].y;
            part->moment.zz += a * term[k].z * term[k].z;
            part->moment.xy += a * term[k].x * term[k].y;
            part->moment.xz += a * term[k].x * term[k].z;
            part->moment.yz += a * term[k].y * term[k].z;
        }
    }
}

static bool push_part(context *ctx, patch_scratch *s, const facet *f, int32_t face, int32_t piece, double tolerance)
{
    const vec3 *v = f->corner[f->side];
    patch_part part = {.face = face,
                       .piece = piece,
                       .first = s->corners.count,
                       .count = f->count,
                       .root = s->parts.count,
                       .component = -1};
    part_measure(v, f->count, &part);
    if (!(part.surface > tolerance * tolerance))
        return true;
    for (int i = 0; i < f->count; i++)
        if (!array_push(ctx, &s->corners, v[i]))
            return false;
    return array_push(ctx, &s->parts, part);
}

/* The parts of one triangle in all pieces. */
static bool clip_face(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe,
                      int32_t face)
{
    double tolerance = tolerance_of(floe), half_height = half_height_of(floe);
    facet slab = {.count = 3};
    for (int k = 0; k < 3; k++)
        slab.corner[0][k] = to_floe(surface, surface->surface->vertex.data[surface->surface->face.data[face].v[k]]);
    const vec3 *v = slab.corner[0];
    slab.normal = vec3_cross(vec3_sub(v[1], v[0]), vec3_sub(v[2], v[0]));
    facet_cut(&slab, prism_cap(half_height, 0), tolerance);
    facet_cut(&slab, prism_cap(half_height, 1), tolerance);
    if (slab.count < 3)
        return true;
    v = slab.corner[slab.side];
    box2 reach = {{v[0].x, v[0].y}, {v[0].x, v[0].y}};
    for (int i = 1; i < slab.count; i++) {
        reach.lo = (vec2){fmin(reach.lo.x, v[i].x), fmin(reach.lo.y, v[i].y)};
        reach.hi = (vec2){fmax(reach.hi.x, v[i].x), fmax(reach.hi.y, v[i].y)};
    }
    for (int32_t p = 0; p < piece_count_of(floe); p++) {
        box2 box = s->boxes.data[p];
        if (reach.lo.x > box.hi.x + tolerance || reach.hi.x < box.lo.x - tolerance ||
            reach.lo.y > box.hi.y + tolerance || reach.hi.y < box.lo.y - tolerance)
            continue;
        piece_sides piece = sides_of(floe, p);
        facet part = {.count = slab.count, .normal = slab.normal};
        for (int i = 0; i < slab.count; i++)
            part.corner[0][i] = v[i];
        for (int32_t k = 0; k < piece.count && part.count >= 3; k++)
            facet_cut(&part, piece_side(&piece, k), tolerance);
        if (part.count >= 3 && !push_part(ctx, s, &part, face, p, tolerance))
            return false;
    }
    return true;
}

/* The triangles near the floe: those that meet the box around its oriented box, between the planes of top and bottom.
 */
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

/* ---- components ---- */

static int32_t find_root(patch_scratch *s, int32_t part)
{
    patch_part *all = s->parts.data;
    while (all[part].root != part) {
        all[part].root = all[all[part].root].root;
        part = all[part].root;
    }
    return part;
}

/* The lower root stays: a component is named by its first part. */
static void join(patch_scratch *s, int32_t a, int32_t b)
{
    a = find_root(s, a);
    b = find_root(s, b);
    if (a < b)
        s->parts.data[b].root = a;
    else
        s->parts.data[a].root = b;
}

static bool piece_holds(const piece_sides *piece, vec3 point, double tolerance)
{
    for (int32_t k = 0; k < piece->count; k++) {
        half_space side = piece_side(piece, k);
        if (vec3_dot(side.n, point) - side.d > tolerance)
            return false;
    }
    return true;
}

/* Two parts of one triangle touch along a seam: both ends of what they share are corners of one of them. */
static bool parts_touch(const patch_scratch *s, const patch_floe *floe, const patch_part *a, const patch_part *b,
                        double tolerance)
{
    bool found = false;
    vec3 at = {0, 0, 0};
    for (int turn = 0; turn < 2; turn++) {
        const patch_part *from = turn == 0 ? a : b, *in = turn == 0 ? b : a;
        piece_sides piece = sides_of(floe, in->piece);
        for (int32_t i = 0; i < from->count; i++) {
            vec3 corner = s->corners.data[from->first + i];
            if (!piece_holds(&piece, corner, tolerance))
                continue;
            if (found && vec3_length(vec3_sub(corner, at)) > 4 * tolerance)
                return true;
            if (!found)
                at = corner;
            found = true;
        }
    }
    return false;
}

/* Cuts the range [*lo, *hi] of the parameter of the segment from a to b down to what lies inside a half space. */
static void segment_cut(vec3 a, vec3 b, half_space h, double tolerance, double *lo, double *hi)
{
    double da = vec3_dot(h.n, a) - h.d - tolerance, db = vec3_dot(h.n, b) - h.d - tolerance;
    if (da > 0 && db > 0)
        *hi = -1;
    else if (da > 0)
        *lo = fmax(*lo, da / (da - db));
    else if (db > 0)
        *hi = fmin(*hi, da / (da - db));
}

/* Something of a mesh edge runs inside the piece. */
static bool edge_in_piece(const patch_floe *floe, int32_t piece_index, vec3 a, vec3 b, double tolerance)
{
    double lo = 0, hi = 1, half_height = half_height_of(floe);
    piece_sides piece = sides_of(floe, piece_index);
    for (int k = 0; k < 2; k++)
        segment_cut(a, b, prism_cap(half_height, k), tolerance, &lo, &hi);
    for (int32_t k = 0; k < piece.count && lo < hi; k++)
        segment_cut(a, b, piece_side(&piece, k), tolerance, &lo, &hi);
    return (hi - lo) * vec3_length(vec3_sub(b, a)) > 4 * tolerance;
}

/* The part of a face in a piece, -1 without: parts are in order of face, then piece. */
static int32_t find_part(const patch_scratch *s, int32_t face, int32_t piece)
{
    int32_t lo = 0, hi = s->parts.count;
    while (lo < hi) {
        int32_t middle = lo + (hi - lo) / 2;
        const patch_part *p = &s->parts.data[middle];
        if (p->face < face || (p->face == face && p->piece < piece))
            lo = middle + 1;
        else
            hi = middle;
    }
    if (lo == s->parts.count || s->parts.data[lo].face != face || s->parts.data[lo].piece != piece)
        return -1;
    return lo;
}

static void connect_parts(patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    double tolerance = tolerance_of(floe);
    const patch_part *part = s->parts.data;
    for (int32_t i = 0; i < s->parts.count; i++) {
        for (int32_t j = i + 1; j < s->parts.count && part[j].face == part[i].face; j++)
            if (find_root(s, i) != find_root(s, j) && parts_touch(s, floe, &part[i], &part[j], tolerance))
                join(s, i, j);
        for (int k = 0; k < 3; k++) {
            int32_t across = surface->adjacency->neighbour.data[3 * part[i].face + k];
            int32_t other = across > part[i].face ? find_part(s, across, part[i].piece) : -1;
            if (other < 0 || find_root(s, i) == find_root(s, other))
                continue;
            const triangle *t = &surface->surface->face.data[part[i].face];
            vec3 a = to_floe(surface, surface->surface->vertex.data[t->v[k]]);
            vec3 b = to_floe(surface, surface->surface->vertex.data[t->v[k == 2 ? 0 : k + 1]]);
            if (edge_in_piece(floe, part[i].piece, a, b, tolerance))
                join(s, i, other);
        }
    }
}

static void box_take(box2 *b, vec3 r)
{
    b->lo = (vec2){fmin(b->lo.x, r.x), fmin(b->lo.y, r.y)};
    b->hi = (vec2){fmax(b->hi.x, r.x), fmax(b->hi.y, r.y)};
}

/* Sums over the parts of each component: areas and first moments, then second moments about the centroid. */
static bool sum_components(context *ctx, patch_scratch *s)
{
    for (int32_t i = 0; i < s->parts.count; i++) {
        int32_t root = find_root(s, i);
        patch_part *part = &s->parts.data[i];
        if (root == i) {
            part->component = s->components.count;
            const box2 nothing = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
            if (!array_push(ctx, &s->components, (patch_component){.plan = nothing}))
                return false;
        }
        part->component = s->parts.data[root].component;
        patch_component *c = &s->components.data[part->component];
        vec3 reach = vec3_sub(part->centre, s->parts.data[root].centre);
        c->area = vec3_add(c->area, part->area);
        c->surface += part->surface;
        c->centre = vec3_mad(c->centre, reach, part->surface);
        for (int32_t k = part->first; k < part->first + part->count; k++)
            box_take(&c->plan, s->corners.data[k]);
    }
    for (int32_t i = 0; i < s->parts.count; i++)
        if (find_root(s, i) == i) {
            patch_component *c = &s->components.data[s->parts.data[i].component];
            c->centre = vec3_mad(s->parts.data[i].centre, c->centre, 1 / c->surface);
        }
    for (int32_t i = 0; i < s->parts.count; i++) {
        const patch_part *part = &s->parts.data[i];
        patch_component *c = &s->components.data[part->component];
        vec3 d = vec3_sub(part->centre, c->centre);
        double weight = 1 / c->surface;
        c->spread.xx += weight * (part->moment.xx + part->surface * d.x * d.x);
        c->spread.yy += weight * (part->moment.yy + part->surface * d.y * d.y);
        c->spread.zz += weight * (part->moment.zz + part->surface * d.z * d.z);
        c->spread.xy += weight * (part->moment.xy + part->surface * d.x * d.y);
        c->spread.xz += weight * (part->moment.xz + part->surface * d.x * d.z);
        c->spread.yz += weight * (part->moment.yz + part->surface * d.y * d.z);
    }
    return true;
}

bool patch_components(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe,
                      const patch_component_array **out)
{
    array_clear(&s->parts);
    array_clear(&s->corners);
    array_clear(&s->components);
    *out = &s->components;
    if (!query_faces(ctx, s, surface, floe))
        return false;
    if (s->faces.count == 0)
        return true;
    if (!array_resize(ctx, &s->boxes, piece_count_of(floe)))
        return false;
    for (int32_t p = 0; p < piece_count_of(floe); p++)
        s->boxes.data[p] = polygon_bounds(shape_piece(floe->shapes, floe->shape, p));
    for (int32_t i = 0; i < s->faces.count; i++)
        if (!clip_face(ctx, s, surface, floe, s->faces.data[i]))
            return false;
    connect_parts(s, surface, floe);
    if (!sum_components(ctx, s))
        return false;
    patch_measure_ways(s, surface, floe);
    return true;
}
