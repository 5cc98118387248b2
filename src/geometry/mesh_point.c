/* A point and a closed surface; see mesh_point.h. */
#include "geometry/mesh_point.h"

#include "base/transcendental.h"

static vec3 face_vertex(const mesh *m, int32_t face, int k) { return m->vertex.data[m->face.data[face].v[k]]; }

double triangle_solid_angle(vec3 a, vec3 b, vec3 c)
{
    double la = vec3_length(a), lb = vec3_length(b), lc = vec3_length(c);
    double triple = vec3_dot(a, vec3_cross(b, c));
    double below = la * lb * lc + vec3_dot(a, b) * lc + vec3_dot(b, c) * la + vec3_dot(c, a) * lb;
    return 2 * real_atan2(triple, below);
}

double mesh_winding(const mesh *m, vec3 point)
{
    double angle = 0;
    for (int32_t f = 0; f < m->face.count; f++)
        angle += triangle_solid_angle(vec3_sub(face_vertex(m, f, 0), point), vec3_sub(face_vertex(m, f, 1), point),
                                      vec3_sub(face_vertex(m, f, 2), point));
    return angle / (4 * PI);
}

/* By the region of the plane that the point falls into: corners, edges, face (Ericson 2005, section 5.1.5). */
vec3 triangle_nearest_point(vec3 a, vec3 b, vec3 c, vec3 p)
{
    vec3 ab = vec3_sub(b, a), ac = vec3_sub(c, a), ap = vec3_sub(p, a), bp = vec3_sub(p, b), cp = vec3_sub(p, c);
    double a1 = vec3_dot(ab, ap), a2 = vec3_dot(ac, ap);
    if (a1 <= 0 && a2 <= 0)
        return a;
    double b1 = vec3_dot(ab, bp), b2 = vec3_dot(ac, bp);
    if (b1 >= 0 && b2 <= b1)
        return b;
    double on_ab = a1 * b2 - b1 * a2;
    if (on_ab <= 0 && a1 >= 0 && b1 <= 0)
        return vec3_mad(a, ab, a1 / (a1 - b1));
    double c1 = vec3_dot(ab, cp), c2 = vec3_dot(ac, cp);
    if (c2 >= 0 && c1 <= c2)
        return c;
    double on_ac = c1 * a2 - a1 * c2;
    if (on_ac <= 0 && a2 >= 0 && c2 <= 0)
        return vec3_mad(a, ac, a2 / (a2 - c2));
    double on_bc = b1 * c2 - c1 * b2, along = b2 - b1, back = c1 - c2;
    if (on_bc <= 0 && along >= 0 && back >= 0)
        return vec3_mad(b, vec3_sub(c, b), along / (along + back));
    double sum = on_bc + on_ac + on_ab;
    return vec3_mad(vec3_mad(a, ab, on_ac / sum), ac, on_ab / sum);
}

vec3 mesh_nearest_point(const mesh *m, vec3 point, int32_t *face)
{
    vec3 nearest = point;
    double least = HUGE_VAL;
    for (int32_t f = 0; f < m->face.count; f++) {
        vec3 q = triangle_nearest_point(face_vertex(m, f, 0), face_vertex(m, f, 1), face_vertex(m, f, 2), point);
        vec3 way = vec3_sub(q, point);
        double square = vec3_dot(way, way);
        if (square < least) {
            least = square;
            nearest = q;
            if (face)
                *face = f;
        }
    }
    return nearest;
}
