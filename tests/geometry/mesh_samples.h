/* Surfaces that several tests of geometry share. */
#ifndef MESH_SAMPLES_H
#define MESH_SAMPLES_H

#include "base/random.h"
#include "base/transcendental.h"
#include "geometry/mesh.h"
#include "testing.h"

/* A closed grid surface over u (stations) and v (around, closed), capped at both ends by fans: what ships are made of.
   point(u index, v index) gives the vertices; v runs so that triangles look outward for u along +x and v clockwise seen
   from +x, that is from port over the keel to starboard. */
typedef vec3 (*surface_point)(int32_t u, int32_t v, const void *arg);

static inline void sample_surface(context *ctx, int32_t stations, int32_t around, surface_point point, const void *arg,
                                  mesh *out)
{
    for (int32_t u = 0; u < stations; u++)
        for (int32_t v = 0; v < around; v++)
            mesh_add_vertex(ctx, out, point(u, v, arg));
    for (int32_t u = 0; u + 1 < stations; u++)
        for (int32_t v = 0; v < around; v++) {
            int32_t w = v + 1 < around ? v + 1 : 0;
            int32_t a = u * around + v, b = u * around + w, c = a + around, d = b + around;
            mesh_add_triangle(ctx, out, a, c, d);
            mesh_add_triangle(ctx, out, a, d, b);
        }
    for (int end = 0; end < 2; end++) {
        int32_t first = end ? (stations - 1) * around : 0, centre = out->vertex.count;
        vec3 sum = {0, 0, 0};
        for (int32_t v = 0; v < around; v++)
            sum = vec3_add(sum, out->vertex.data[first + v]);
        mesh_add_vertex(ctx, out, vec3_scale(sum, 1.0 / around));
        for (int32_t v = 0; v < around; v++) {
            int32_t w = v + 1 < around ? v + 1 : 0;
            if (end)
                mesh_add_triangle(ctx, out, centre, first + w, first + v);
            else
                mesh_add_triangle(ctx, out, centre, first + v, first + w);
        }
    }
}

/* Append a copy of src moved by `shift`. */
static inline void sample_append(context *ctx, mesh *dst, const mesh *src, vec3 shift)
{
    int32_t base = dst->vertex.count;
    for (int32_t i = 0; i < src->vertex.count; i++)
        mesh_add_vertex(ctx, dst, vec3_add(src->vertex.data[i], shift));
    for (int32_t i = 0; i < src->face.count; i++) {
        const int32_t *v = src->face.data[i].v;
        mesh_add_triangle(ctx, dst, base + v[0], base + v[1], base + v[2]);
    }
}

/* Turn and shift all vertices. */
static inline void sample_move(mesh *m, quat q, vec3 shift)
{
    mat3 r = quat_matrix(quat_unit(q));
    for (int32_t i = 0; i < m->vertex.count; i++)
        m->vertex.data[i] = vec3_add(mat3_mul_vec(r, m->vertex.data[i]), shift);
}

/* A sphere-like grid surface of 2 stations around triangles, radius about 1, for large meshes. */
typedef struct sample_sphere {
    int32_t stations, around;
    double radius;
} sample_sphere;
static inline vec3 sample_sphere_point(int32_t u, int32_t v, const void *arg)
{
    const sample_sphere *s = arg;
    double along = PI * (u + 0.5) / s->stations, turn = -2 * PI * v / s->around;
    double r = s->radius * real_sin(along);
    return (vec3){-s->radius * real_cos(along), r * real_cos(turn), r * real_sin(turn)};
}
static inline void sample_sphere_mesh(context *ctx, int32_t stations, int32_t around, double radius, mesh *out)
{
    sample_sphere s = {stations, around, radius};
    sample_surface(ctx, stations, around, sample_sphere_point, &s, out);
}

/* A hull of length 200, beam 44, depth 24 m with bulb, flared bow and hollow run: stations along, `around` points from
   the port deck edge over the keel to the starboard one. */
typedef struct sample_hull {
    int32_t stations, around;
} sample_hull;
static inline vec3 sample_hull_point(int32_t u, int32_t v, const void *arg)
{
    const sample_hull *h = arg;
    double along = (double)u / (h->stations - 1), turn = PI * v / (h->around - 1);
    double z = -12 * real_sin(turn), side = real_cos(turn); /* 0 at the deck edge, -12 at the keel */
    z = z > -6 ? 2 * z : 12 * (z + 6) / 6 - 12;
    double below = (z + 24) / 24; /* 0 keel, 1 deck */
    /* The stem goes back under the flare and out again for the bulb; the stern rises. */
    double notch = 1 - (below - 0.45) * (below - 0.45) / 0.16;
    double stem = 92 + 12 * below - (notch > 0 ? 9 * notch : 0), stern = -100 + 14 * (1 - below);
    double t = 2 * along - 1, end = t > 0 ? t : -t;
    /* Fuller at the deck than below it, where the waterlines are hollow towards the ends. */
    double full = 1 - end * end * end * end, hollow = full * full * (0.35 + 0.65 * full);
    double breadth = 0.02 + 0.98 * (below * full + (1 - below) * hollow);
    return (vec3){stern + (stem - stern) * along, 22 * breadth * side * (0.6 + 0.4 * below), z};
}
static inline void sample_hull_mesh(context *ctx, int32_t stations, int32_t around, mesh *out)
{
    sample_hull h = {stations, around};
    sample_surface(ctx, stations, around, sample_hull_point, &h, out);
}

/* A square ring (a moonpool platform): the square of half side 2 without that of half side 1, from z = 0 to 1. */
static inline void sample_frame_mesh(context *ctx, mesh *out)
{
    for (int i = 0; i < 16; i++) {
        static const double x[4] = {-1, 1, 1, -1}, y[4] = {-1, -1, 1, 1};
        double side = i / 4 % 2 ? 1 : 2;
        mesh_add_vertex(ctx, out, (vec3){side * x[i % 4], side * y[i % 4], i / 8});
    }
    for (int i = 0; i < 4; i++) {
        int32_t j = (i + 1) % 4;
        /* Quadrilaterals, counter-clockwise from outside: bottom, top, outer and inner side. */
        const int32_t quad[4][4] = {
            {i, i + 4, j + 4, j}, {i + 8, j + 8, j + 12, i + 12}, {i, j, j + 8, i + 8}, {i + 4, i + 12, j + 12, j + 4}};
        for (int k = 0; k < 4; k++) {
            mesh_add_triangle(ctx, out, quad[k][0], quad[k][1], quad[k][2]);
            mesh_add_triangle(ctx, out, quad[k][0], quad[k][2], quad[k][3]);
        }
    }
}

#endif
