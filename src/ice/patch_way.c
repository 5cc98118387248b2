/* Ways out of a floe and of an overlap; see patch.h. */
#include "ice/patch_parts.h"

/* Cuts the range [*lo, *hi] of the ray down to one half space: `room` is left of it at the start, `rate` of it goes per
   metre.  Written without fmin and fmax, which are calls. */
static void ray_cut(double room, double rate, double *lo, double *hi)
{
    if (rate > 0) {
        double t = room / rate;
        *hi = t < *hi ? t : *hi;
    } else if (rate < 0) {
        double t = room / rate;
        *lo = t > *lo ? t : *lo;
    } else if (room < 0) {
        *hi = -HUGE_VAL;
    }
}

/* The interval of the ray inside one piece, empty when *lo > *hi. */
static void ray_in_piece(const patch_floe *floe, int32_t piece_index, vec3 point, vec3 direction, double *lo,
                         double *hi)
{
    piece_sides piece = sides_of(floe, piece_index);
    double half_height = half_height_of(floe);
    *lo = -HUGE_VAL;
    *hi = HUGE_VAL;
    ray_cut(half_height - point.z, direction.z, lo, hi);
    ray_cut(half_height + point.z, -direction.z, lo, hi);
    for (int32_t k = 0; k < piece.count; k++) {
        vec2 n = piece.normal[k], v = piece.vertex[k];
        ray_cut(n.x * (v.x - point.x) + n.y * (v.y - point.y), n.x * direction.x + n.y * direction.y, lo, hi);
    }
}

double patch_way_out(const patch_floe *floe, vec3 point, vec3 direction)
{
    double tolerance = tolerance_of(floe), way = 0;
    for (bool further = true; further;) {
        further = false;
        for (int32_t p = 0; p < piece_count_of(floe); p++) {
            double lo, hi;
            ray_in_piece(floe, p, point, direction, &lo, &hi);
            if (lo <= way + tolerance && hi > way + tolerance) {
                way = hi;
                further = true;
            }
        }
    }
    return way;
}

vec3 patch_inner_point(const patch_floe *floe)
{
    polygon piece = shape_piece(floe->shapes, floe->shape, 0);
    vec3 sum = {0, 0, 0};
    for (int32_t i = 0; i < piece.count; i++)
        sum = vec3_add(sum, (vec3){piece.vertex[i].x, piece.vertex[i].y, 0});
    return vec3_scale(sum, 1.0 / piece.count);
}

/* Way along `direction` (floe frame) out of the overlap of both bodies. */
static double way_out_of_both(const patch_surface *surface, const patch_floe *floe, vec3 point, vec3 direction)
{
    double way = patch_way_out(floe, point, direction);
    if (surface->prism < 0)
        return way;
    vec3 there = mat3_tmul_vec(surface->rotation, vec3_sub(point, surface->offset));
    const patch_floe other = {floe->shapes, surface->prism};
    return fmin(way, patch_way_out(&other, there, mat3_tmul_vec(surface->rotation, direction)));
}

/* Volume between one part and where lines along -normal leave the overlap.  The places lie inside the part, never on
   its edge, where a line along a face of the floe could end at once. */
static double part_volume(const patch_scratch *s, const patch_surface *surface, const patch_floe *floe,
                          const patch_part *part, vec3 normal)
{
    const vec3 *v = s->corners.data + part->first;
    vec3 back = vec3_neg(normal);
    double volume = 0;
    for (int32_t i = 0; i < part->count; i++) {
        vec3 a = v[i], b = v[i + 1 < part->count ? i + 1 : 0];
        vec3 area = vec3_scale(vec3_cross(vec3_sub(a, part->centre), vec3_sub(b, part->centre)), 0.5);
        vec3 middle = vec3_scale(vec3_add(part->centre, vec3_add(a, b)), 1.0 / 3);
        double along = vec3_dot(area, normal);
        if (along > 0 || (along < 0 && surface->prism < 0))
            volume += along * way_out_of_both(surface, floe, middle, back);
    }
    return volume;
}

void patch_measure_ways(patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    for (int32_t i = 0; i < s->parts.count; i++) {
        const patch_part *part = &s->parts.data[i];
        patch_component *c = &s->components.data[part->component];
        double area = vec3_length(c->area);
        if (area > 0)
            c->way += part_volume(s, surface, floe, part, vec3_scale(c->area, 1 / area)) / area;
    }
    double most = 2 * floe->shapes->shapes.radius[floe->shape];
    for (int32_t i = 0; i < s->components.count; i++)
        s->components.data[i].way = fmin(fmax(s->components.data[i].way, 0), most);
}
