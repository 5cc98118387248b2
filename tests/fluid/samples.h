/* Outlines, attitudes and water that the tests of fluid share. */
#ifndef FLUID_SAMPLES_H
#define FLUID_SAMPLES_H

#include "base/random.h"
#include "base/transcendental.h"
#include "fluid/fluid.h"
#include "testing.h"

static const media still_water = {.gravity = 9.81, .water_density = 1025, .air_density = 1.25};

/* Names a static array of vec2 as a polygon. */
#define OUTLINE(array) ((polygon){(array), (int32_t)(sizeof(array) / sizeof *(array))})

static const vec2 square_outline[] = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
static const vec2 hexagon_outline[] = {{4, 0}, {2.2, 3.1}, {-1.8, 3.3}, {-4.1, 0.4}, {-2, -3.6}, {1.9, -3}};
/* Concave, and its centroid is not the origin. */
static const vec2 arrow_outline[] = {{6, 0}, {-3, 5}, {-1, 0.5}, {-4, -4.5}, {0, -2}};
static const vec2 comb_outline[] = {{0, 0}, {9, 0}, {9, 4}, {7, 4}, {7, 1}, {5, 1.2}, {5, 4.1}, {3, 4}, {3, 1}, {0, 1}};

static inline fluid_motion motion_at(vec3 position, double roll, double pitch, double yaw)
{
    return (fluid_motion){position, quat_matrix(quat_from_roll_pitch_yaw(roll, pitch, yaw)), {0, 0, 0}, {0, 0, 0}};
}

/* Uniform over all rotations (Shoemake 1992). */
static inline mat3 random_rotation(random_stream *r)
{
    double u = random_unit(r), a = 2 * PI * random_unit(r), b = 2 * PI * random_unit(r);
    quat q = {sqrt(1 - u) * real_sin(a), sqrt(1 - u) * real_cos(a), sqrt(u) * real_sin(b), sqrt(u) * real_cos(b)};
    return quat_matrix(quat_unit(q));
}

static inline vec3 random_vector(random_stream *r, double size)
{
    double x = random_uniform(r, -size, size), y = random_uniform(r, -size, size);
    return vec3_make(x, y, random_uniform(r, -size, size));
}

/* The prism's mesh; the caller frees it. */
static inline mesh prism_mesh(context *ctx, polygon outline, double half_height)
{
    mesh m = {0};
    fram_error error = {0};
    assert_ok(mesh_make_prism(ctx, outline, -half_height, half_height, &m, &error), error);
    return m;
}

/* Every triangle of `m` cut into four at its edges' middles; the caller frees the result. */
static inline mesh refined_mesh(context *ctx, const mesh *m)
{
    mesh out = {0};
    for (int32_t i = 0; i < m->face.count; i++) {
        vec3 v[6];
        for (int k = 0; k < 3; k++)
            v[k] = m->vertex.data[m->face.data[i].v[k]];
        for (int k = 0; k < 3; k++)
            v[3 + k] = vec3_scale(vec3_add(v[k], v[(k + 1) % 3]), 0.5);
        int32_t base = out.vertex.count;
        for (int k = 0; k < 6; k++)
            ck_assert(mesh_add_vertex(ctx, &out, v[k]));
        static const int part[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
        for (int k = 0; k < 4; k++)
            ck_assert(mesh_add_triangle(ctx, &out, base + part[k][0], base + part[k][1], base + part[k][2]));
    }
    return out;
}

#endif
