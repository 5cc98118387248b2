/* Fluid forces on a vessel's hull: the mesh as it is, and its triangles cut into four again and again.

       hull_bench HULL [STEP_MS]        HULL: a mesh file; STEP_MS: what a step takes, to tell the share */
#include "base/build_parts.h"
#include "base/pool.h"
#include "base/random.h"
#include "fluid/hull_load.h"
#include "io/hull_file.h"
#include "vessel/hull.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROUNDS = 200, MOST_TRIANGLES = 200000 };

/* Motions of a ship under way. */
#define SPEED 2.0     /* [m/s] */
#define TURNING 0.005 /* [rad/s] */
#define TILT 0.02     /* [rad] */
#define HEAVE 0.5     /* [m] */

static double wall_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool cut_in_four(context *ctx, const mesh *m, mesh *out)
{
    for (int32_t i = 0; i < m->face.count; i++) {
        vec3 v[6];
        mesh_face_points(m, i, v);
        for (int k = 0; k < 3; k++)
            v[3 + k] = vec3_scale(vec3_add(v[k], v[(k + 1) % 3]), 0.5);
        static const int part[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
        int32_t base = out->vertex.count;
        for (int k = 0; k < 6; k++)
            if (!mesh_add_vertex(ctx, out, v[k]))
                return false;
        for (int k = 0; k < 4; k++)
            if (!mesh_add_triangle(ctx, out, base + part[k][0], base + part[k][1], base + part[k][2]))
                return false;
    }
    return true;
}

static double median_ms(context *ctx, const solid *hull, const drag_coefficients *c)
{
    static const media sea = {.gravity = 9.81, .water_density = 1025, .air_density = 1.225, .wind = {8, 3, 0}};
    static double took[ROUNDS];
    random_stream r = random_begin(1, 0, 0);
    for (int i = 0; i < ROUNDS; i++) {
        double roll = random_uniform(&r, -TILT, TILT), pitch = random_uniform(&r, -TILT, TILT);
        fluid_motion state = {{0, 0, random_uniform(&r, -HEAVE, HEAVE)},
                              quat_matrix(quat_from_roll_pitch_yaw(roll, pitch, 1)),
                              {SPEED, 0.1 * SPEED, 0.1},
                              {TURNING, TURNING, TURNING}};
        fluid_load load;
        double start = wall_ms();
        fluid_load_solid(ctx, &sea, c, hull, &state, &load);
        took[i] = wall_ms() - start;
    }
    qsort(took, ROUNDS, sizeof *took, by_size);
    return took[ROUNDS / 2];
}

static void report(context *ctx, const solid *hull, double step_ms)
{
    static const drag_coefficients water = {.water_form = 0.1, .water_skin = 0.003}, both = {0.1, 0.003, 0.8, 0.003};
    double wet = median_ms(ctx, hull, &water), all = median_ms(ctx, hull, &both);
    printf("%7d triangles %6d points %d threads  water %.3f ms  with wind %.3f ms", (int)hull->surface.face.count,
           (int)hull->integrals.x.count, context_threads(ctx), wet, all);
    if (step_ms > 0)
        printf("  share %.1f %%", 100 * all / step_ms);
    printf("\n");
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: hull_bench HULL [STEP_MS]\n");
        return 2;
    }
    context ctx;
    context_init(&ctx);
    mesh surface = {0};
    hull_file_report made;
    fram_error error = {0};
    const hull_file_options options = {.scale = 1, .seal_width = (double)NAN, .freeboard = 10};
    fram_status status = hull_file_read(&ctx, argv[1], &options, &surface, &made, &error);
    double step_ms = argc > 2 ? atof(argv[2]) : 0;
    printf("# compiler %s, instruction set %s, medians of %d\n", build_compiler(), isa_name(ctx.isa), (int)ROUNDS);
    solid_array solids = {0};
    while (status == FRAM_OK) {
        mesh finer = {0};
        if (4 * surface.face.count <= MOST_TRIANGLES && !cut_in_four(&ctx, &surface, &finer))
            status = error_memory(&error);
        polyhedron_array pieces = {0};
        int32_t index;
        if (status == FRAM_OK)
            status = solid_add(&ctx, &solids, &surface, &pieces, 0, &index, &error);
        if (status != FRAM_OK)
            break;
        report(&ctx, &solids.data[index], step_ms);
        ctx.threads = pool_create(&ctx, 2);
        report(&ctx, &solids.data[index], step_ms);
        pool_free(&ctx, ctx.threads);
        ctx.threads = NULL;
        if (finer.face.count == 0)
            break;
        surface = finer;
    }
    if (status != FRAM_OK)
        fprintf(stderr, "hull_bench: %s\n", error.message);
    solid_array_free(&ctx, &solids);
    return status == FRAM_OK ? 0 : 1;
}
