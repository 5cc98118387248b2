/* Ways out of a floe and of an overlap; see patch.h. */
#include "ice/patch_parts.h"

enum { BATCH = 8 };

/* Rows of rays in a frame. */
static void set_ray(double *rays, int32_t stride, int32_t i, vec3 start, vec3 direction)
{
    const double row[6] = {start.x, start.y, start.z, direction.x, direction.y, direction.z};
    for (int k = 0; k < 6; k++)
        rays[(ptrdiff_t)k * stride + i] = row[k];
}

/* Floes of fewer pieces are not worth a look at which of them the rays pass. */
enum { LOOK_FROM = 16 };

/* Boxes count as wider than they are by this part of how far off they lie: far over rounding. */
static const double WIDER = 1e-6;

/* Rays of one batch in one direction, in plan: how far aside and ahead their starts lie, and the end of the longest in
   the slab of the floe. */
typedef struct ray_bundle {
    vec3 direction;
    double aside_from, aside_to; /* of the starts along the left of the direction, times its length in plan */
    double ahead_from, ahead_to; /* of the starts and of the ends along it, likewise */
} ray_bundle;

/* The bundles of a batch, whose first ray is `first`; returns how many. */
static int32_t gather_bundles(const double *rays, int32_t stride, int32_t first, double half_height,
                              ray_bundle out[BATCH])
{
    int32_t count = 0;
    for (int32_t i = first; i < first + BATCH; i++) {
        double row[6];
        for (int k = 0; k < 6; k++)
            row[k] = rays[(ptrdiff_t)k * stride + i];
        double x = row[0], y = row[1], dx = row[3], dy = row[4], dz = row[5];
        double aside = dx * y - dy * x, ahead = dx * x + dy * y,
               rise = dz > 0 ? half_height - row[2] : half_height + row[2];
        double end = dz == 0 ? HUGE_VAL : ahead + fmax(rise / fabs(dz), 0) * (dx * dx + dy * dy) * (1 + WIDER);
        int32_t k = 0;
        while (k < count && (out[k].direction.x != dx || out[k].direction.y != dy || out[k].direction.z != dz))
            k++;
        if (k == count)
            out[count++] = (ray_bundle){{dx, dy, dz}, aside, aside, ahead, end};
        out[k].aside_from = fmin(out[k].aside_from, aside);
        out[k].aside_to = fmax(out[k].aside_to, aside);
        out[k].ahead_from = fmin(out[k].ahead_from, ahead);
        out[k].ahead_to = fmax(out[k].ahead_to, end);
    }
    return count;
}

/* No ray of the bundle comes through the box on its way. */
static bool bundle_misses(const ray_bundle *b, const box2 *box)
{
    double cx = 0.5 * (box->lo.x + box->hi.x), cy = 0.5 * (box->lo.y + box->hi.y), dx = b->direction.x,
           dy = b->direction.y;
    double rx = 0.5 * (box->hi.x - box->lo.x), ry = 0.5 * (box->hi.y - box->lo.y), ux = fabs(dx), uy = fabs(dy);
    double aside = dx * cy - dy * cx, ahead = dx * cx + dy * cy;
    double wide = uy * rx + ux * ry, deep = ux * rx + uy * ry;
    double slack = WIDER * ((ux + uy) * (fabs(cx) + fabs(cy) + rx + ry));
    return aside - wide - slack > b->aside_to || aside + wide + slack < b->aside_from ||
           ahead + deep + slack < b->ahead_from || ahead - deep - slack > b->ahead_to;
}

/* The sides of the pieces that rays of a batch may come through, in their order.  The others have no say in how far a
   ray gets. */
static int32_t take_passed(patch_scratch *s, int32_t pieces, const ray_bundle *bundle, int32_t bundles)
{
    int32_t count = 0;
    for (int32_t p = 0; p < pieces; p++) {
        bool passed = false;
        for (int32_t k = 0; k < bundles && !passed; k++)
            passed = !bundle_misses(&bundle[k], &s->boxes.data[p]);
        if (passed)
            s->passed.data[count++] = s->sides.data[p];
    }
    return count;
}

/* Batch by batch: ways of rays out of a floe of many pieces, of which each batch comes through a few. */
static bool ways_through_few(context *ctx, patch_scratch *s, const patch_floe *floe, const double *rays, int32_t stride,
                             double *way)
{
    int32_t pieces = piece_count_of(floe);
    if (!array_resize(ctx, &s->boxes, pieces) || !array_resize(ctx, &s->passed, pieces))
        return false;
    for (int32_t p = 0; p < pieces; p++)
        s->boxes.data[p] = polygon_bounds((polygon){s->sides.data[p].vertex, s->sides.data[p].count});
    for (int32_t i = 0; i < stride; i += BATCH) {
        ray_bundle bundle[BATCH];
        double batch[6 * BATCH];
        int32_t passed = take_passed(s, pieces, bundle, gather_bundles(rays, stride, i, half_height_of(floe), bundle));
        for (int k = 0; k < 6 * BATCH; k++)
            batch[k] = rays[(ptrdiff_t)(k / BATCH) * stride + i + k % BATCH];
        KERNEL_PICK(ctx, patch_ways)
        (s->passed.data, passed, half_height_of(floe), tolerance_of(floe), &(patch_rays){batch, BATCH}, way + i);
    }
    return true;
}

/* Ways along rays out of a floe. */
static bool ways_out(context *ctx, patch_scratch *s, const patch_floe *floe, const double *rays, int32_t stride,
                     double *way)
{
    int32_t pieces = piece_count_of(floe);
    if (!array_resize(ctx, &s->sides, pieces))
        return false;
    for (int32_t p = 0; p < pieces; p++)
        s->sides.data[p] = sides_of(floe, p);
    if (pieces >= LOOK_FROM)
        return ways_through_few(ctx, s, floe, rays, stride, way);
    KERNEL_PICK(ctx, patch_ways)
    (s->sides.data, pieces, half_height_of(floe), tolerance_of(floe), &(patch_rays){rays, stride}, way);
    return true;
}

bool patch_way_out(context *ctx, patch_scratch *s, const patch_floe *floe, vec3 point, vec3 direction, double *way)
{
    double rays[6 * BATCH], ways[BATCH];
    for (int32_t i = 0; i < BATCH; i++)
        set_ray(rays, BATCH, i, point, direction);
    if (!ways_out(ctx, s, floe, rays, BATCH, ways))
        return false;
    *way = ways[0];
    return true;
}

vec3 patch_inner_point(const patch_floe *floe)
{
    polygon piece = shape_piece(floe->shapes, floe->shape, 0);
    vec3 sum = {0, 0, 0};
    for (int32_t i = 0; i < piece.count; i++)
        sum = vec3_add(sum, (vec3){piece.vertex[i].x, piece.vertex[i].y, 0});
    return vec3_scale(sum, 1.0 / piece.count);
}

/* One of those lines, for an area along the normal; what faces away counts against that, but on a prism. */
static void add_line(patch_scratch *s, const patch_surface *surface, patch_line line)
{
    if (line.weight > 0 || (line.weight < 0 && surface->prism < 0))
        s->lines.data[s->lines.count++] = line;
}

/* The lines by which the volume between one part and where they leave the overlap is found, along -normal.  The places
   lie inside the part, never on its edge, where a line along a face of the floe could end at once. */
static bool add_lines(context *ctx, patch_scratch *s, const patch_surface *surface, int32_t number, vec3 normal)
{
    const patch_part *part = &s->parts.data[number];
    const vec3 *v = s->corners.data + part->first;
    vec3 back = vec3_neg(normal);
    if (!array_reserve(ctx, &s->lines, s->lines.count + part->count))
        return false;
    if (surface->rough_way) {
        add_line(s, surface, (patch_line){part->centre, back, vec3_dot(part->area, normal), number});
        return true;
    }
    for (int32_t i = 0; i < part->count; i++) {
        vec3 a = v[i], b = v[i + 1 < part->count ? i + 1 : 0];
        vec3 area = vec3_scale(vec3_cross(vec3_sub(a, part->centre), vec3_sub(b, part->centre)), 0.5);
        vec3 middle = vec3_scale(vec3_add(part->centre, vec3_add(a, b)), 1.0 / 3);
        add_line(s, surface, (patch_line){middle, back, vec3_dot(area, normal), number});
    }
    return true;
}

/* What is left of the last batch takes the last ray again. */
static void fill_batch(double *rays, int32_t stride, int32_t count)
{
    for (int k = 0; k < 6; k++)
        for (int32_t i = count; i < stride; i++)
            rays[(ptrdiff_t)k * stride + i] = rays[(ptrdiff_t)k * stride + count - 1];
}

/* Lengths of all lines out of the floe, and out of the surface's prism where it is one, whichever is shorter. */
static bool measure_lines(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    int32_t count = s->lines.count, stride = (count + BATCH - 1) / BATCH * BATCH;
    if (!array_resize(ctx, &s->rays, 6 * stride) || !array_resize(ctx, &s->ways, 2 * stride))
        return false;
    double *rays = s->rays.data, *way = s->ways.data, *other_way = way + stride;
    for (int32_t i = 0; i < count; i++)
        set_ray(rays, stride, i, s->lines.data[i].start, s->lines.data[i].direction);
    fill_batch(rays, stride, count);
    if (!ways_out(ctx, s, floe, rays, stride, way))
        return false;
    if (surface->prism < 0)
        return true;
    for (int32_t i = 0; i < count; i++) {
        const patch_line *line = &s->lines.data[i];
        set_ray(rays, stride, i, mat3_tmul_vec(surface->rotation, vec3_sub(line->start, surface->offset)),
                mat3_tmul_vec(surface->rotation, line->direction));
    }
    fill_batch(rays, stride, count);
    if (!ways_out(ctx, s, &(patch_floe){floe->shapes, surface->prism}, rays, stride, other_way))
        return false;
    for (int32_t i = 0; i < count; i++)
        way[i] = other_way[i] < way[i] ? other_way[i] : way[i];
    return true;
}

/* Volumes under parts over the areas of their patches; lines stand in the order of parts. */
static void add_volumes(patch_scratch *s)
{
    for (int32_t i = 0; i < s->lines.count;) {
        int32_t part = s->lines.data[i].part;
        patch_whole *whole = &s->wholes.data[s->parts.data[part].whole];
        double volume = 0;
        for (; i < s->lines.count && s->lines.data[i].part == part; i++)
            volume += s->lines.data[i].weight * s->ways.data[i];
        whole->way += volume / vec3_length(whole->area);
    }
}

/* The rest of the patch that a component is of, as it looks along that one's normal. */
static void add_beside(patch_scratch *s, int32_t root)
{
    const patch_part *all = s->parts.data;
    patch_component *c = &s->components.data[all[root].component];
    double area = vec3_length(c->area);
    for (int32_t i = 0; i < s->parts.count && area > 0; i++)
        if (all[i].whole == all[root].whole && all[i].component != all[root].component)
            c->beside += fmax(vec3_dot(all[i].area, c->area) / area, 0);
}

/* What slides beside what enters has no back of its own: the way along its normal would be that through all of the
   floe (decision 0579). */
bool patch_measure_ways(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    const patch_part *part = s->parts.data;
    array_clear(&s->lines);
    array_clear(&s->wholes);
    if (!array_resize(ctx, &s->wholes, s->parts.count))
        return false;
    for (int32_t i = 0; i < s->parts.count; i++)
        s->wholes.data[i] = (patch_whole){{0, 0, 0}, 0, false, false};
    for (int32_t i = 0; i < s->parts.count; i++) {
        patch_whole *whole = &s->wholes.data[part[i].whole];
        whole->area = vec3_add(whole->area, part[i].area);
        whole->enters = whole->enters || part[i].enters;
        whole->slides = whole->slides || !part[i].enters;
    }
    for (int32_t i = 0; i < s->parts.count; i++) {
        vec3 normal = s->wholes.data[part[i].whole].area;
        double area = vec3_length(normal);
        if (area > 0 && !add_lines(ctx, s, surface, i, vec3_scale(normal, 1 / area)))
            return false;
    }
    if (s->lines.count > 0) {
        if (!measure_lines(ctx, s, surface, floe))
            return false;
        add_volumes(s);
    }
    double most = 2 * floe->shapes->shapes.radius[floe->shape];
    for (int32_t i = 0; i < s->parts.count; i++) {
        patch_component *c = &s->components.data[part[i].component];
        c->way = fmin(fmax(s->wholes.data[part[i].whole].way, 0), most);
        c->slides = s->wholes.data[part[i].whole].enters && !part[i].enters;
        if (part[i].root == i && s->wholes.data[part[i].whole].enters && s->wholes.data[part[i].whole].slides)
            add_beside(s, i);
    }
    return true;
}
