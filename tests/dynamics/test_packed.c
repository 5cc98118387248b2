/* Ice that is packed and stays so: how far the default solver is from the accurate one, jitter and drift over long
   runs, and an arch that stands or falls by its friction.  FRAM_SOAK_STEPS sets the length of the long run. */
#include "geometry/polygon.h"
#include "packed.h"

#include <stdlib.h>

static rig fast_rig(int columns, int rows, double friction, uint64_t seed)
{
    rig r = packed_rig(columns, rows, friction, seed);
    r.settings.kind = SOLVER_FAST;
    r.settings.position_iterations = 10;
    return r;
}

/* Root mean square of the floes' velocities [m/s]; walls come first. */
enum { FIRST_FLOE = 3 };

static double rms_velocity(const rig *r)
{
    double sum = 0;
    for (int32_t b = FIRST_FLOE; b < r->bodies.count; b++)
        sum += vec3_dot(r->bodies.velocity[b], r->bodies.velocity[b]);
    return sqrt(sum / (r->bodies.count - FIRST_FLOE));
}

/* ---- against the accurate solver ---- */

START_TEST(the_default_solves_what_the_accurate_one_does)
{
    enum { STEPS = 25 };
    const uint64_t scenes = getenv("FRAM_TEST_SHORT") ? 4 : 5;
    double worst = 0, apart = 0;
    for (uint64_t seed = 1; seed <= scenes; seed++) {
        rig fast = fast_rig(8, 6, 0.3, seed), accurate = fast_rig(8, 6, 0.3, seed);
        rig_run(&fast, STEPS);
        rig_run(&accurate, STEPS);
        accurate.settings.kind = SOLVER_ACCURATE;
        rig_detect(&fast);
        rig_detect(&accurate);
        rig_solve(&fast);
        rig_solve(&accurate);
        double sum = 0;
        for (int32_t b = FIRST_FLOE; b < fast.bodies.count; b++) {
            vec3 d = vec3_sub(fast.bodies.velocity[b], accurate.bodies.velocity[b]);
            sum += vec3_dot(d, d);
        }
        ck_assert_int_gt(fast.contacts.count, 2 * 48);
        ck_assert_double_lt(accurate.report.residual, 1e-6);
        worst = testing_larger(worst, fast.report.residual);
        apart = testing_larger(apart, sqrt(sum / (fast.bodies.count - FIRST_FLOE)));
        rig_free(&fast);
        rig_free(&accurate);
    }
    ck_assert_msg(worst < 1e-3 && apart < 1e-3, "residual %g m/s, velocities %g m/s apart", worst, apart);
}
END_TEST

/* ---- long runs ---- */

START_TEST(a_packed_field_neither_jitters_nor_drifts)
{
    const char *words = getenv("FRAM_SOAK_STEPS");
    long settle = 3000, steps = words ? strtol(words, NULL, 10) : 3000;
    rig r = fast_rig(4, 3, 0.3, 2);
    r.settings.contact_skin = 1e-4;
    rig_run(&r, (int)settle);
    int32_t count = r.bodies.count;
    vec3 *start = memory_array(&r.ctx, (size_t)count, sizeof *start);
    ck_assert_ptr_nonnull(start);
    memcpy(start, r.bodies.position, (size_t)count * sizeof *start);
    double fastest = 0, deepest = 0, drift = 0;
    for (long i = 0; i < steps; i++) {
        rig_run(&r, 1);
        fastest = testing_larger(fastest, rms_velocity(&r));
        deepest = testing_larger(deepest, r.report.max_depth);
    }
    for (int32_t b = FIRST_FLOE; b < count; b++)
        drift = testing_larger(drift, vec3_length(vec3_sub(r.bodies.position[b], start[b])));
    ck_assert_msg(fastest < 1e-9, "%g m/s", fastest);
    ck_assert_msg(deepest < 1e-4, "%g m deep", deepest);
    ck_assert_msg(drift < 1e-9, "%g m in %ld steps", drift, steps);
    memory_free(&r.ctx, start);
    rig_free(&r);
}
END_TEST

/* ---- an arch ---- */

/* A half ring of nine wedges on two footings, gravity in the plane.  Its thickness of 0.3 radii is well over Heyman's
   least (0.107), so it stands while friction keeps the joints from sliding: the line of thrust crosses none of them at
   more than about 20 degrees, a friction of 0.37. */
static double arch_sag(double friction)
{
    enum { WEDGES = 9 };
    const double inner = 8.5, outer = 11.5;
    rig r = rig_make(0.01);
    r.settings.kind = SOLVER_FAST;
    r.settings.position_iterations = 10;
    r.gravity = vec3_make(0, -GRAVITY, 0);
    rig_friction(&r, friction, friction);
    rig_box(&r, MOTION_STATIC, vec3_make(6, 2, 4), 1, vec3_make(10, -1, 0));
    rig_box(&r, MOTION_STATIC, vec3_make(6, 2, 4), 1, vec3_make(-10, -1, 0));
    int32_t key = 0;
    vec3 start = vec3_make(0, 0, 0);
    for (int i = 0; i < WEDGES; i++) {
        double a = PI * i / WEDGES, b = PI * (i + 1) / WEDGES;
        vec2 corner[4] = {{inner * real_cos(a), inner * real_sin(a)},
                          {outer * real_cos(a), outer * real_sin(a)},
                          {outer * real_cos(b), outer * real_sin(b)},
                          {inner * real_cos(b), inner * real_sin(b)}};
        vec2 middle = polygon_moments_of((polygon){corner, 4}).centroid;
        for (int k = 0; k < 4; k++)
            corner[k] = vec2_sub(corner[k], middle);
        int32_t slot = rig_prism(&r, MOTION_DYNAMIC, (polygon){corner, 4}, 2, 900, vec3_make(middle.x, middle.y, 0));
        if (i == WEDGES / 2) {
            key = slot;
            start = r.bodies.position[slot];
        }
    }
    rig_run(&r, 400);
    double sag = start.y - r.bodies.position[key].y;
    rig_free(&r);
    return sag;
}

START_TEST(an_arch_stands_by_its_friction)
{
    double rough = arch_sag(0.7), smooth = arch_sag(0.05);
    ck_assert_msg(rough < 0.02, "with friction the keystone sank by %g m", rough);
    ck_assert_msg(smooth > 1, "without friction it sank by %g m only", smooth);
}
END_TEST

TEST_MAIN("packed", the_default_solves_what_the_accurate_one_does, a_packed_field_neither_jitters_nor_drifts,
          an_arch_stands_by_its_friction)
