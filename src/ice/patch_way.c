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

/* Ways along rays out of a floe. */
static bool ways_out(context *ctx, patch_scratch *s, const patch_floe *floe, const double *rays, int32_t stride,
                     double *way)
{
    int32_t pieces = piece_count_of(floe);
    if (!array_resize(ctx, &s->sides, pieces))
        return false;
    for (int32_t p = 0; p < pieces; p++)
        s->sides.data[p] = sides_of(floe, p);
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

/* The lines by which the volume between one part and where they leave the overlap is found, along -normal.  The places
   lie inside the part, never on its edge, where a line along a face of the floe could end at once. */
static bool add_lines(context *ctx, patch_scratch *s, const patch_surface *surface, int32_t number, vec3 normal)
{
    const patch_part *part = &s->parts.data[number];
    const vec3 *v = s->corners.data + part->first;
    vec3 back = vec3_neg(normal);
    if (!array_reserve(ctx, &s->lines, s->lines.count + part->count))
        return false;
    for (int32_t i = 0; i < part->count; i++) {
        vec3 a = v[i], b = v[i + 1 < part->count ? i + 1 : 0];
        vec3 area = vec3_scale(vec3_cross(vec3_sub(a, part->centre), vec3_sub(b, part->centre)), 0.5);
        vec3 middle = vec3_scale(vec3_add(part->centre, vec3_add(a, b)), 1.0 / 3);
        double along = vec3_dot(area, normal);
        if (along > 0 || (along < 0 && surface->prism < 0))
            s->lines.data[s->lines.count++] = (patch_line){middle, back, along, number};
    }
    return true;
}

/* Lengths of all lines out of the floe, and out of the surface's prism where it is one, whichever is shorter. */
static bool measure_lines(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    int32_t count = s->lines.count, stride = (count + BATCH - 1) / BATCH * BATCH;
    if (!array_resize(ctx, &s->rays, 6 * stride) || !array_resize(ctx, &s->ways, 2 * stride))
        return false;
    double *rays = s->rays.data, *way = s->ways.data, *other_way = way + stride;
    for (int32_t i = 0; i < stride; i++) {
        const patch_line *line = &s->lines.data[i < count ? i : count - 1];
        set_ray(rays, stride, i, line->start, line->direction);
    }
    if (!ways_out(ctx, s, floe, rays, stride, way))
        return false;
    if (surface->prism < 0)
        return true;
    for (int32_t i = 0; i < stride; i++) {
        const patch_line *line = &s->lines.data[i < count ? i : count - 1];
        set_ray(rays, stride, i, mat3_tmul_vec(surface->rotation, vec3_sub(line->start, surface->offset)),
                mat3_tmul_vec(surface->rotation, line->direction));
    }
    if (!ways_out(ctx, s, &(patch_floe){floe->shapes, surface->prism}, rays, stride, other_way))
        return false;
    for (int32_t i = 0; i < count; i++)
        way[i] = other_way[i] < way[i] ? other_way[i] : way[i];
    return true;
}

/* Volumes under parts over the areas of their components; lines stand in the order of parts. */
static void add_volumes(patch_scratch *s)
{
    for (int32_t i = 0; i < s->lines.count;) {
        int32_t part = s->lines.data[i].part;
        patch_component *c = &s->components.data[s->parts.data[part].component];
        double volume = 0;
        for (; i < s->lines.count && s->lines.data[i].part == part; i++)
            volume += s->lines.data[i].weight * s->ways.data[i];
        c->way += volume / vec3_length(c->area);
    }
}

bool patch_measure_ways(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    array_clear(&s->lines);
    for (int32_t i = 0; i < s->parts.count; i++) {
        const patch_component *c = &s->components.data[s->parts.data[i].component];
        double area = vec3_length(c->area);
        if (area > 0 && !add_lines(ctx, s, surface, i, vec3_scale(c->area, 1 / area)))
            return false;
    }
    if (s->lines.count > 0) {
        if (!measure_lines(ctx, s, surface, floe))
            return false;
        add_volumes(s);
    }
    double most = 2 * floe->shapes->shapes.radius[floe->shape];
    for (int32_t i = 0; i < s->components.count; i++)
        s->components.data[i].way = fmin(fmax(s->components.data[i].way, 0), most);
    return true;
}
