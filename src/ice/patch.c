/* The geometry of crushing patches; see patch.h. */
#include "ice/patch_parts.h"

patch_scratch *patch_scratch_create(context *ctx) { return memory_array(ctx, 1, sizeof(patch_scratch)); }

void patch_scratch_free(context *ctx, patch_scratch *s)
{
    if (!s)
        return;
    array_free(ctx, &s->faces);
    array_free(ctx, &s->points);
    array_free(ctx, &s->caps);
    array_free(ctx, &s->near);
    array_free(ctx, &s->codes);
    array_free(ctx, &s->sides);
    array_free(ctx, &s->passed);
    array_free(ctx, &s->boxes);
    array_free(ctx, &s->parts);
    array_free(ctx, &s->corners);
    array_free(ctx, &s->components);
    array_free(ctx, &s->lines);
    array_free(ctx, &s->rays);
    array_free(ctx, &s->ways);
    mesh_free(ctx, &s->turned);
    polygon_list_free(ctx, &s->section);
    array_free(ctx, &s->ring_a);
    array_free(ctx, &s->ring_b);
    memory_free(ctx, s);
}

/* ---- components ---- */

/* A part slides along the ice where the way that it goes in is under this part of its whole way: 6 degrees, more than a
   shoulder turns from facet to facet, less than most bows stand to their way [1].  Range 0.01 to 0.2. */
static const double SLIDING = 0.1;

/* Whether a part of the surface goes into the ice, not along it or away.  At rest none goes anywhere. */
static bool part_enters(const patch_surface *surface, const patch_part *part)
{
    vec3 u = vec3_add(surface->slip, vec3_cross(surface->turn, part->centre));
    double speed = vec3_length(u);
    return speed > surface->rest && vec3_dot(u, part->area) > SLIDING * speed * part->surface;
}

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

/* Two parts of one face touch along a seam: both ends of what they share are corners of one of them. */
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
    if (da > 0 && db > 0) {
        *hi = -1;
    } else if (da > 0) {
        double t = da / (da - db);
        *lo = t > *lo ? t : *lo;
    } else if (db > 0) {
        double t = da / (da - db);
        *hi = t < *hi ? t : *hi;
    }
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
    patch_part *part = s->parts.data;
    bool moves = vec3_dot(surface->slip, surface->slip) > 0 || vec3_dot(surface->turn, surface->turn) > 0;
    for (int32_t i = 0; i < s->parts.count; i++)
        part[i].enters = moves && part_enters(surface, &part[i]);
    for (int32_t i = 0; i < s->parts.count; i++) {
        for (int32_t j = i + 1; j < s->parts.count && part[j].face == part[i].face; j++)
            if (part[i].enters == part[j].enters && find_root(s, i) != find_root(s, j) &&
                parts_touch(s, floe, &part[i], &part[j], tolerance))
                join(s, i, j);
        patch_face face = face_of(surface, part[i].face);
        for (int32_t k = 0; k < face.count; k++) {
            int32_t across = face.neighbour[k];
            int32_t other = across > part[i].face ? find_part(s, across, part[i].piece) : -1;
            if (other < 0 || part[i].enters != part[other].enters || find_root(s, i) == find_root(s, other))
                continue;
            const vec3 *vertex = surface->surface->vertex.data;
            vec3 a = to_floe(surface, vertex[face.corner[k]]);
            vec3 b = to_floe(surface, vertex[face.corner[k + 1 < face.count ? k + 1 : 0]]);
            if (edge_in_piece(floe, part[i].piece, a, b, tolerance))
                join(s, i, other);
        }
    }
}

/* Sums over the parts of each component: areas and first moments, then second moments about the centroid. */
static bool sum_components(context *ctx, patch_scratch *s)
{
    for (int32_t i = 0; i < s->parts.count; i++) {
        int32_t root = find_root(s, i);
        patch_part *part = &s->parts.data[i];
        if (root == i) {
            part->component = s->components.count;
            if (!array_push(ctx, &s->components, (patch_component){.plan = box_of_nothing()}))
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
    if (!patch_clip(ctx, s, surface, floe))
        return false;
    if (s->parts.count == 0)
        return true;
    connect_parts(s, surface, floe);
    return sum_components(ctx, s) && patch_measure_ways(ctx, s, surface, floe);
}
