/* The triangle surface itself: storage, bounds, volume integrals, boxes.  Knows nothing of what the solid is for. */
#include "geometry/mesh.h"

#include <string.h>

void mesh_free(context *ctx, mesh *m)
{
    array_free(ctx, &m->vertex);
    array_free(ctx, &m->face);
}

void mesh_clear(mesh *m)
{
    array_clear(&m->vertex);
    array_clear(&m->face);
}

bool mesh_copy(context *ctx, mesh *dst, const mesh *src)
{
    if (dst == src)
        return true;
    if (!array_reserve(ctx, &dst->vertex, src->vertex.count) || !array_reserve(ctx, &dst->face, src->face.count))
        return false;
    dst->vertex.count = src->vertex.count;
    dst->face.count = src->face.count;
    if (src->vertex.count)
        memcpy(dst->vertex.data, src->vertex.data, (size_t)src->vertex.count * sizeof *src->vertex.data);
    if (src->face.count)
        memcpy(dst->face.data, src->face.data, (size_t)src->face.count * sizeof *src->face.data);
    return true;
}

void mesh_translate(mesh *m, vec3 by)
{
    for (int32_t i = 0; i < m->vertex.count; i++)
        m->vertex.data[i] = vec3_add(m->vertex.data[i], by);
}

bool mesh_add_vertex(context *ctx, mesh *m, vec3 v) { return array_push(ctx, &m->vertex, v); }

bool mesh_add_triangle(context *ctx, mesh *m, int32_t a, int32_t b, int32_t c)
{
    return array_push(ctx, &m->face, (triangle){{a, b, c}});
}

vec3 mesh_area_vector(const mesh *m, int32_t face)
{
    const int32_t *v = m->face.data[face].v;
    vec3 a = m->vertex.data[v[0]];
    vec3 ab = vec3_sub(m->vertex.data[v[1]], a), ac = vec3_sub(m->vertex.data[v[2]], a);
    return vec3_scale(vec3_cross(ab, ac), 0.5);
}

box3 mesh_bounds(const mesh *m)
{
    if (m->vertex.count == 0)
        return (box3){{0, 0, 0}, {0, 0, 0}};
    box3 b = box3_empty();
    for (int32_t i = 0; i < m->vertex.count; i++)
        b = box3_add(b, m->vertex.data[i]);
    return b;
}

box3 mesh_face_bounds(const mesh *m, int32_t face)
{
    const int32_t *v = m->face.data[face].v;
    return box3_add(box3_add(box3_add(box3_empty(), m->vertex.data[v[0]]), m->vertex.data[v[1]]), m->vertex.data[v[2]]);
}

/* Second moments of a solid about a point: the six integrals of x_i x_j. */
static void add_second_moments(sym3 *s, double weight, vec3 p)
{
    s->xx += weight * p.x * p.x;
    s->yy += weight * p.y * p.y;
    s->zz += weight * p.z * p.z;
    s->xy += weight * p.x * p.y;
    s->xz += weight * p.x * p.z;
    s->yz += weight * p.y * p.z;
}

/* Integrals over the tetrahedron (0, a, b, c) of six times signed volume D = a . (b x c):
     1: D/6,  x: D/24 (a + b + c),  x_i x_j: D/120 (a_i a_j + b_i b_j + c_i c_j + s_i s_j), s = a + b + c.
   Everything is taken about the first vertex, so that a body far from the origin loses no digits. */
solid_properties mesh_solid_properties(const mesh *m)
{
    solid_properties out = {0};
    if (m->face.count == 0)
        return out;
    vec3 origin = m->vertex.data[m->face.data[0].v[0]], first = {0, 0, 0};
    double volume = 0;
    sym3 second = {0};
    for (int32_t i = 0; i < m->face.count; i++) {
        const int32_t *v = m->face.data[i].v;
        vec3 a = vec3_sub(m->vertex.data[v[0]], origin);
        vec3 b = vec3_sub(m->vertex.data[v[1]], origin);
        vec3 c = vec3_sub(m->vertex.data[v[2]], origin);
        double d = vec3_dot(a, vec3_cross(b, c));
        vec3 s = vec3_add(vec3_add(a, b), c);
        volume += d / 6;
        first = vec3_mad(first, s, d / 24);
        add_second_moments(&second, d / 120, a);
        add_second_moments(&second, d / 120, b);
        add_second_moments(&second, d / 120, c);
        add_second_moments(&second, d / 120, s);
    }
    out.volume = volume;
    if (!(fabs(volume) > 0)) {
        out.centre = origin;
        return out;
    }
    vec3 arm = vec3_scale(first, 1 / volume);
    add_second_moments(&second, -volume, arm);
    out.centre = vec3_add(origin, arm);
    out.inertia =
        (sym3){second.yy + second.zz, second.xx + second.zz, second.xx + second.yy, -second.xy, -second.xz, -second.yz};
    return out;
}

vec3 mesh_volume_integrals(const mesh *m)
{
    vec3 sum = {0, 0, 0};
    for (int32_t i = 0; i < m->face.count; i++) {
        const int32_t *v = m->face.data[i].v;
        vec3 mid = vec3_add(vec3_add(m->vertex.data[v[0]], m->vertex.data[v[1]]), m->vertex.data[v[2]]);
        vec3 n = mesh_area_vector(m, i);
        sum.x += mid.x * n.x / 3;
        sum.y += mid.y * n.y / 3;
        sum.z += mid.z * n.z / 3;
    }
    return sum;
}

bool mesh_make_box(context *ctx, vec3 lo, vec3 hi, mesh *out)
{
    /* Corner i: bit 0 is x, bit 1 is y, bit 2 is z. */
    static const triangle face[12] = {{{0, 2, 3}}, {{0, 3, 1}}, {{4, 5, 7}}, {{4, 7, 6}}, {{0, 1, 5}}, {{0, 5, 4}},
                                      {{2, 6, 7}}, {{2, 7, 3}}, {{0, 4, 6}}, {{0, 6, 2}}, {{1, 3, 7}}, {{1, 7, 5}}};
    mesh_clear(out);
    if (!array_reserve(ctx, &out->vertex, 8) || !array_reserve(ctx, &out->face, 12))
        return false;
    for (int i = 0; i < 8; i++)
        out->vertex.data[i] = (vec3){i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
    memcpy(out->face.data, face, sizeof face);
    out->vertex.count = 8;
    out->face.count = 12;
    return true;
}

bool mesh_indices_are_valid(const mesh *m)
{
    for (int32_t f = 0; f < m->face.count; f++)
        for (int k = 0; k < 3; k++)
            if (m->face.data[f].v[k] < 0 || m->face.data[f].v[k] >= m->vertex.count)
                return false;
    return true;
}
