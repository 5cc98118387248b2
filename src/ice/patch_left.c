/* What is left of a component when the floe's edge gives; see patch.h. */
#include "ice/patch_parts.h"

/* The faces of the floe with the edge where it has gone to: down, it is the top that leaves the surface. */
static half_space face_that_gives(const patch_floe *floe, double give)
{
    half_space face = prism_cap(half_height_of(floe), give < 0 ? 0 : 1);
    face.d -= fabs(give);
    return face;
}

/* The corners of a part on the inner side of a plane; those of a part in the plane are all inside. */
static int32_t corners_left(const patch_scratch *s, const patch_part *part, half_space h,
                            vec3 out[PATCH_MOST_CORNERS + 1])
{
    const vec3 *v = s->corners.data + part->first;
    bool any_in = false, any_out = false;
    for (int32_t i = 0; i < part->count; i++) {
        out[i] = v[i];
        any_out |= vec3_dot(h.n, v[i]) > h.d;
        any_in |= vec3_dot(h.n, v[i]) <= h.d;
    }
    if (!any_out || !any_in)
        return any_in ? part->count : 0;
    return facet_clip(v, part->count, h.n, h.d, out);
}

vec3 patch_area_left(const patch_scratch *s, const patch_floe *floe, int32_t component, double give)
{
    half_space h = face_that_gives(floe, give);
    vec3 v[PATCH_MOST_CORNERS + 1], twice = {0, 0, 0};
    for (int32_t i = 0; i < s->parts.count; i++) {
        if (s->parts.data[i].component != component)
            continue;
        int32_t count = corners_left(s, &s->parts.data[i], h, v);
        for (int32_t k = 1; k + 1 < count; k++)
            twice = vec3_add(twice, vec3_cross(vec3_sub(v[k], v[0]), vec3_sub(v[k + 1], v[0])));
    }
    return vec3_scale(twice, 0.5);
}

/* Second moments of a part about a point, added. */
static void add_moment(const patch_part *part, vec3 about, sym3 *sum)
{
    vec3 d = vec3_sub(part->centre, about);
    sum->xx += part->moment.xx + part->surface * d.x * d.x;
    sum->yy += part->moment.yy + part->surface * d.y * d.y;
    sum->zz += part->moment.zz + part->surface * d.z * d.z;
    sum->xy += part->moment.xy + part->surface * d.x * d.y;
    sum->xz += part->moment.xz + part->surface * d.x * d.z;
    sum->yz += part->moment.yz + part->surface * d.y * d.z;
}

patch_component patch_left(const patch_scratch *s, const patch_floe *floe, int32_t component, double give)
{
    half_space h = face_that_gives(floe, give);
    const patch_component *whole = &s->components.data[component];
    patch_component left = {.centre = whole->centre,
                            .way = whole->way,
                            .plan = whole->plan,
                            .slides = whole->slides,
                            .beside = whole->beside};
    vec3 v[PATCH_MOST_CORNERS + 1], first = {0, 0, 0};
    sym3 about = {0};
    /* About the whole's centre first, which is near, so that few digits are lost on the way to the own one. */
    for (int32_t i = 0; i < s->parts.count; i++) {
        if (s->parts.data[i].component != component)
            continue;
        int32_t count = corners_left(s, &s->parts.data[i], h, v);
        if (count < 3)
            continue;
        patch_part part = {.count = count};
        patch_part_measure(v, count, &part);
        left.area = vec3_add(left.area, part.area);
        left.surface += part.surface;
        first = vec3_mad(first, vec3_sub(part.centre, whole->centre), part.surface);
        add_moment(&part, whole->centre, &about);
    }
    if (!(left.surface > 0))
        return left;
    double weight = 1 / left.surface;
    vec3 d = vec3_scale(first, weight);
    left.centre = vec3_add(whole->centre, d);
    left.spread = (sym3){weight * about.xx - d.x * d.x, weight * about.yy - d.y * d.y, weight * about.zz - d.z * d.z,
                         weight * about.xy - d.x * d.y, weight * about.xz - d.x * d.z, weight * about.yz - d.y * d.z};
    return left;
}
