#include "fluid/facet.h"
#include "geometry/mesh.h"

#include <assert.h>
#include <math.h>

stream stream_of_water(const media *m, const drag_coefficients *c, vec3 velocity, vec3 spin, double height)
{
    return (stream){.velocity = vec3_sub(velocity, media_current(m, height)),
                    .spin = spin,
                    .form = 0.5 * m->water_density * c->water_form,
                    .skin = 0.5 * m->water_density * c->water_skin};
}

stream stream_of_air(const media *m, const drag_coefficients *c, vec3 velocity, vec3 spin)
{
    return (stream){.velocity = vec3_sub(velocity, m->wind),
                    .spin = spin,
                    .form = 0.5 * m->air_density * c->air_form,
                    .skin = 0.5 * m->air_density * c->air_skin};
}

/* Twice the area vector of a triangle. */
static vec3 double_area(vec3 a, vec3 b, vec3 c) { return vec3_cross(vec3_sub(b, a), vec3_sub(c, a)); }

void facet_add_pressure(pressure_sum *sum, const vec3 *vertex, int n, double height)
{
    assert(n <= FACET_VERTICES);
    for (int i = 1; i + 1 < n; i++) {
        vec3 a = vertex[0], b = vertex[i], c = vertex[i + 1];
        double za = a.z + height, zb = b.z + height, zc = c.z + height, z = za + zb + zc;
        vec3 area = vec3_scale(double_area(a, b, c), 0.5);
        vec3 first = vec3_add(vec3_scale(a, za + z), vec3_add(vec3_scale(b, zb + z), vec3_scale(c, zc + z)));
        sum->force = vec3_mad(sum->force, area, z * (1.0 / 3));
        sum->moment = vec3_mad(sum->moment, vec3_cross(first, area), 1.0 / 12);
    }
}

static vec3 velocity_at(const stream *s, vec3 point)
{
    return vec3_mad(vec3_add(s->velocity, vec3_cross(s->spin, point)), s->shear, point.z);
}

static void add_at(wrench *load, vec3 force, vec3 point)
{
    load->force = vec3_add(load->force, force);
    load->moment = vec3_add(load->moment, vec3_cross(point, force));
}

/* -form int vn^2 n dS over the part with vn > 0.  With f = vn at the corners of a triangle, S = sum f, Q = sum f^2, and
   A its area: int f^2 = A/12 (S^2 + Q), int f^2 r = A/60 sum r_k (S^2 + Q + 2 f_k (S + f_k)), from int of barycentric
   monomials. */
static void add_form(wrench *load, const stream *s, const vec3 *vertex, int n, vec3 normal)
{
    /* vn(r) = n . v + (n x spin) . r + (n . shear) z */
    vec3 slope = vec3_cross(normal, s->spin);
    slope.z += vec3_dot(normal, s->shear);
    double level = vec3_dot(normal, s->velocity);
    bool into = false, away = false;
    for (int i = 0; i < n; i++) {
        double f = level + vec3_dot(slope, vertex[i]);
        into = into || f > 0;
        away = away || f < 0;
    }
    if (!into)
        return;
    vec3 part[FACET_VERTICES];
    if (away) {
        n = facet_clip(vertex, n, vec3_neg(slope), level, part);
        vertex = part;
    }
    double pressure = 0;
    vec3 centre = {0, 0, 0};
    for (int i = 1; i + 1 < n; i++) {
        const vec3 corner[3] = {vertex[0], vertex[i], vertex[i + 1]};
        double area = 0.5 * vec3_dot(double_area(corner[0], corner[1], corner[2]), normal);
        double f[3], sum = 0, square = 0;
        for (int k = 0; k < 3; k++) {
            f[k] = level + vec3_dot(slope, corner[k]);
            sum += f[k];
            square += f[k] * f[k];
        }
        double both = sum * sum + square;
        pressure += area * both * (1.0 / 12);
        for (int k = 0; k < 3; k++)
            centre = vec3_mad(centre, corner[k], area * (both + 2 * f[k] * (sum + f[k])) * (1.0 / 60));
    }
    load->force = vec3_mad(load->force, normal, -s->form * pressure);
    load->moment = vec3_mad(load->moment, vec3_cross(centre, normal), -s->form);
}

/* -weight |vt| vt at a point, vt the velocity along the facet. */
static void add_skin_point(wrench *load, double weight, vec3 along, vec3 point)
{
    add_at(load, vec3_scale(along, -weight * vec3_length(along)), point);
}

static void add_skin_triangle(wrench *load, double skin, const vec3 point[3], const vec3 along[3], vec3 normal)
{
    /* Distance from two sides (the third is 1 - 2 of it), share of the area. */
    static const double rule[2][2] = {{0.44594849091596489, 0.22338158967801147},
                                      {0.091576213509770743, 0.10995174365532187}};
    double weight = skin * 0.5 * vec3_dot(double_area(point[0], point[1], point[2]), normal);
    vec3 points = vec3_add(point[0], vec3_add(point[1], point[2]));
    vec3 alongs = vec3_add(along[0], vec3_add(along[1], along[2]));
    for (int ring = 0; ring < 2; ring++) {
        double b = rule[ring][0], rest = 1 - 3 * b;
        for (int k = 0; k < 3; k++)
            add_skin_point(load, weight * rule[ring][1], vec3_mad(vec3_scale(alongs, b), along[k], rest),
                           vec3_mad(vec3_scale(points, b), point[k], rest));
    }
}

/* Bilinear map of the square [-1, 1]^2 with Gauss points at +-1/sqrt 3: the point near corner k sees that corner with
   (1 + g)^2/4, its neighbours with (1 - g^2)/4, the opposite one with (1 - g)^2/4. */
static void add_skin_quadrilateral(wrench *load, double skin, const vec3 point[4], const vec3 along[4], vec3 normal)
{
    static const double near_weight = 0.62200846792814621, side_weight = 1.0 / 6, far_weight = 0.044658198738520456;
    static const double g = 0.57735026918962576;
    for (int k = 0; k < 4; k++) {
        int next = (k + 1) & 3, far = (k + 2) & 3, last = (k + 3) & 3;
        /* Derivatives along the two sides that leave corner k, per unit of the square's coordinates. */
        vec3 u = vec3_add(vec3_scale(vec3_sub(point[next], point[k]), 0.25 * (1 + g)),
                          vec3_scale(vec3_sub(point[far], point[last]), 0.25 * (1 - g)));
        vec3 v = vec3_add(vec3_scale(vec3_sub(point[last], point[k]), 0.25 * (1 + g)),
                          vec3_scale(vec3_sub(point[far], point[next]), 0.25 * (1 - g)));
        vec3 r = vec3_add(vec3_mad(vec3_scale(point[k], near_weight), point[far], far_weight),
                          vec3_scale(vec3_add(point[next], point[last]), side_weight));
        vec3 t = vec3_add(vec3_mad(vec3_scale(along[k], near_weight), along[far], far_weight),
                          vec3_scale(vec3_add(along[next], along[last]), side_weight));
        add_skin_point(load, skin * vec3_dot(vec3_cross(u, v), normal), t, r);
    }
}

static void add_skin(wrench *load, const stream *s, const vec3 *vertex, int n, vec3 normal)
{
    vec3 along[FACET_VERTICES];
    vec3 mean = {0, 0, 0}, mean_along = {0, 0, 0};
    for (int i = 0; i < n; i++) {
        vec3 v = velocity_at(s, vertex[i]);
        along[i] = vec3_mad(v, normal, -vec3_dot(v, normal));
        mean = vec3_mad(mean, vertex[i], 1.0 / n);
        mean_along = vec3_mad(mean_along, along[i], 1.0 / n);
    }
    if (n == 3) {
        add_skin_triangle(load, s->skin, vertex, along, normal);
    } else if (n == 4) {
        add_skin_quadrilateral(load, s->skin, vertex, along, normal);
    } else {
        for (int i = 0; i < n; i++) {
            int j = i + 1 == n ? 0 : i + 1;
            const vec3 corner[3] = {mean, vertex[i], vertex[j]}, corner_along[3] = {mean_along, along[i], along[j]};
            add_skin_triangle(load, s->skin, corner, corner_along, normal);
        }
    }
}

void facet_add_drag(wrench *load, const stream *s, const vec3 *vertex, int n, vec3 normal)
{
    assert(n < FACET_VERTICES);
    if (n < 3)
        return;
    if (s->form > 0)
        add_form(load, s, vertex, n, normal);
    if (s->skin > 0)
        add_skin(load, s, vertex, n, normal);
}

/* ---- a current that changes with depth ---- */

/* Rows of the profile that are no deeper than a height over still water. */
static int32_t rows_above(const current_profile *p, double height)
{
    int32_t k = 0;
    while (k < p->count && p->depth[k] <= -height)
        k++;
    return k;
}

/* The water between rows k - 1 and k, the first and the last one having all above and below. */
static stream stream_of_layer(const stream *surface, const current_profile *p, int32_t k, double height)
{
    stream s = *surface;
    int32_t above = k > 0 ? k - 1 : 0;
    s.velocity = vec3_sub(s.velocity, vec3_sub(p->velocity[above], p->velocity[0]));
    if (k == 0 || k == p->count)
        return s;
    vec3 change = vec3_sub(p->velocity[k], p->velocity[above]);
    s.shear = vec3_scale(change, 1 / (p->depth[k] - p->depth[above]));
    s.velocity = vec3_mad(s.velocity, s.shear, height + p->depth[above]);
    return s;
}

/* The part of a facet between two heights, in its own axes. */
static int facet_between(const vec3 *vertex, int n, double low, double high, vec3 out[FACET_VERTICES])
{
    vec3 under[FACET_VERTICES];
    n = facet_clip(vertex, n, vec3_make(0, 0, 1), high, under);
    return facet_clip(under, n, vec3_make(0, 0, -1), -low, out);
}

void facet_add_water_drag(wrench *load, const stream *s, const media *m, double height, const vec3 *vertex, int n,
                          vec3 normal)
{
    const current_profile *p = &m->profile;
    assert(n <= 4);
    if (p->count == 0 || n < 3) {
        facet_add_drag(load, s, vertex, n, normal);
        return;
    }
    double low = vertex[0].z, high = vertex[0].z;
    for (int i = 1; i < n; i++) {
        low = fmin(low, vertex[i].z);
        high = fmax(high, vertex[i].z);
    }
    /* A facet that lies flat where the profile bends has one layer, and is cut by none. */
    int32_t first = rows_above(p, high + height), last = rows_above(p, low + height);
    for (int32_t k = first; k <= last; k++) {
        vec3 part[FACET_VERTICES];
        stream own = stream_of_layer(s, p, k, height);
        int count = facet_between(vertex, n, k < last ? -p->depth[k] - height : -HUGE_VAL,
                                  k > first ? -p->depth[k - 1] - height : HUGE_VAL, part);
        facet_add_drag(load, &own, part, count, normal);
    }
}
