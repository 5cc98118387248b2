/* Level floes side to side: contacts of the narrow phase with the limits of crushing. */
#include "base/transcendental.h"
#include "ice_rig.h"

/* What the narrow phase needs beside the rig. */
typedef struct sides_rig {
    ice_rig r;
    broad_table boxes;
    collision_scratch *collision;
} sides_rig;

static void sides_make(sides_rig *s, double dt, double skin)
{
    ice_rig_make(&s->r, dt);
    s->r.settings.skin = s->r.solver.contact_skin = skin;
    s->r.solver.kind = SOLVER_ACCURATE;
    s->r.policies.of[MATERIAL_ICE][MATERIAL_ICE].sides = true;
    s->boxes = (broad_table){0};
    s->collision = collision_scratch_create(&s->r.ctx);
    ck_assert_ptr_nonnull(s->collision);
}

static void sides_free(sides_rig *s)
{
    table_free(&s->r.ctx, &s->boxes, &broad_table_info);
    collision_scratch_free(&s->r.ctx, s->collision);
    ice_rig_free(&s->r);
}

/* All contacts as a step finds them. */
static void sides_find(sides_rig *s)
{
    ice_rig *r = &s->r;
    fram_error e = {0};
    const collision_settings settings = {.margin = 0.5};
    array_clear(&r->patches);
    assert_ok(broad_phase_update(&r->ctx, &r->bodies, &r->shapes, &settings, &s->boxes, &r->pairs, s->collision, &e),
              e);
    assert_ok(narrow_phase_run(&r->ctx, &r->bodies, &r->shapes, &r->policies, &s->boxes, &r->pairs, &r->contacts,
                               &r->patch_pairs, s->collision, &e),
              e);
    assert_ok(crushing_contacts(&r->ctx, r->scratch, &r->settings, &r->bodies, &r->shapes, &r->floes, NULL, &r->pairs,
                                &r->patch_pairs, &r->policies, &r->patches, &r->contacts, &e),
              e);
}

static void sides_step(sides_rig *s)
{
    ice_rig *r = &s->r;
    fram_error e = {0};
    sides_find(s);
    ice_rig_solve(r);
    integrate_poses(&r->ctx, &r->bodies, r->settings.time_step);
    assert_ok(solver_correct_positions(&r->ctx, r->solve, &r->solver, r->settings.time_step, &r->bodies, &r->joints,
                                       &r->contacts, &e),
              e);
}

static double sum_of_limits(const ice_rig *r)
{
    double sum = 0;
    for (int32_t i = 0; i < r->contacts.count; i++)
        sum += r->contacts.data[i].impulse_limit;
    return sum / r->settings.time_step;
}

/* Two plates, face to face, overlapping by `depth`; the second is the weaker one and lies 0.1 m lower. */
START_TEST(face_to_face)
{
    static const double depth[4] = {0.05, 0, -1.5e-4, -2.5e-4};
    for (int i = 0; i < 4; i++) {
        sides_rig s;
        sides_make(&s, 0.01, 1e-4);
        ice_rig_plate(&s.r, 10, 6, 1, MOTION_DYNAMIC);
        int32_t weak = ice_rig_plate(&s.r, 10, 4, 0.8, MOTION_DYNAMIC);
        s.r.floes.material[weak].crushing_strength = 1.5e6;
        ice_rig_place(&s.r, 1, (vec3){10 - depth[i], 0.5, -0.2}, 0, 0, 0);
        sides_find(&s);
        ck_assert_int_eq(s.r.patch_pairs.count, 0);
        ck_assert_int_eq(s.r.contacts.count, 4);
        /* 4 m wide, from -0.5 to 0.2 m; one skin more on either side of the narrow floe. */
        assert_absolute(sum_of_limits(&s.r), i < 3 ? 1.5e6 * 4 * 0.7 : 0, i < 3 ? 1.5e6 * 0.7 * 4.1e-4 : 0);
        for (int32_t k = 0; k < s.r.contacts.count; k++)
            ck_assert(!s.r.contacts.data[k].correct);
        sides_free(&s);
    }
}
END_TEST

/* A corner of 90 degrees that has entered a side by d: A = 2 d h, as a patch has it; and past a quarter of the height
   the contacts are those of the patch, with the same cap. */
START_TEST(corner_in_a_side)
{
    static const double depth[4] = {0.01, 0.1, 0.24, 0.26};
    for (int i = 0; i < 4; i++) {
        sides_rig s;
        sides_make(&s, 0.01, 0);
        ice_rig_plate(&s.r, 10, 10, 1, MOTION_DYNAMIC);
        ice_rig_plate(&s.r, 8, 40, 1, MOTION_DYNAMIC);
        ice_rig_place(&s.r, 0, (vec3){0, 0, 0}, 0, 0, PI / 4);
        ice_rig_place(&s.r, 1, (vec3){sqrt(50) + 4 - depth[i], 1, 0}, 0, 0, 0);
        sides_find(&s);
        ck_assert_int_eq(s.r.patches.count, i < 3 ? 0 : 1);
        assert_relative(sum_of_limits(&s.r), 2e6 * 2 * depth[i], 1e-5);
        assert_vec3_close(s.r.contacts.data[0].normal, ((vec3){s.r.contacts.data[0].a == 0 ? -1 : 1, 0, 0}), 1e-9);
        sides_free(&s);
    }
}
END_TEST

/* A floe of 92 t at 0.5 m/s, corner first, against a fixed floe: F = 2 sigma h d is a spring that does not give back.
   It stops after v sqrt(m/K) with v sqrt(K m), K = 4 MN/m, and stays there. */
static void corner_impact(double dt, double *force, double *penetration)
{
    sides_rig s;
    sides_make(&s, dt, 0);
    ice_rig_plate(&s.r, 10, 10, 1, MOTION_DYNAMIC);
    ice_rig_plate(&s.r, 8, 40, 1, MOTION_STATIC);
    ice_rig_place(&s.r, 0, (vec3){0, 0, 0}, 0, 0, PI / 4);
    ice_rig_place(&s.r, 1, (vec3){sqrt(50) + 4, 0, 0}, 0, 0, 0);
    s.r.bodies.velocity[0] = (vec3){0.5, 0, 0};
    *force = *penetration = 0;
    for (int step = 0; step * dt < 0.3; step++) {
        sides_step(&s);
        *force = testing_larger(*force, fabs(ice_rig_force(&s.r).x));
        *penetration += s.r.bodies.velocity[0].x * dt;
    }
    assert_absolute(s.r.bodies.velocity[0].x, 0, 1e-9);
    assert_absolute(s.r.bodies.position[0].x, *penetration, 1e-9); /* nothing pushes it back */
    sides_free(&s);
}

START_TEST(corner_impact_on_ice)
{
    double force[2], way[2], stiffness = 4e6, mass = 92000;
    for (int i = 0; i < 2; i++)
        corner_impact(i == 0 ? 1e-3 : 5e-4, &force[i], &way[i]);
    double exact = 0.5 * sqrt(mass / stiffness);
    assert_relative(force[0], 0.5 * sqrt(mass * stiffness), 1e-3);
    assert_relative(force[1], 0.5 * sqrt(mass * stiffness), 5e-4);
    assert_relative(way[0], exact, 2e-3);
    ck_assert_msg(fabs(way[1] - exact) <= 0.6 * fabs(way[0] - exact) || fabs(way[0] - exact) < 1e-6 * exact,
                  "errors %g at dt, %g at dt/2", way[0] - exact, way[1] - exact);
}
END_TEST

/* The line load that builds a ridge bounds the load of a wide face, of level floes and of a patch alike: 1 m of ice,
   100 m wide, R = 2. */
START_TEST(ridge_line_load)
{
    double line = 2e6 * real_pow(100, -0.54);
    assert_relative(ice_ridging_line_load(2, 1, 100), 0.16635e6, 1e-4);
    assert_relative(ice_ridging_line_load(2, 2, 100), real_pow(2, 1.25) * line, 1e-14);
    ck_assert(isinf(ice_ridging_line_load(0, 1, 100)) && isinf(ice_ridging_line_load(2, 1, 0)));
    static const double depth[2] = {0.2, 0.3};
    for (int i = 0; i < 4; i++) {
        /* The last two of 2 and 3 m: the thinner one builds the ridge. */
        double thin = i < 2 ? 1 : 2, thick = i < 2 ? 1 : 3;
        sides_rig s;
        sides_make(&s, 0.01, 0);
        s.r.settings.pack.ridging = 2;
        ice_rig_plate(&s.r, 40, 100, i % 2 ? thin : thick, MOTION_DYNAMIC);
        ice_rig_plate(&s.r, 40, 100, i % 2 ? thick : thin, MOTION_DYNAMIC);
        ice_rig_place(&s.r, 1, (vec3){40 - thin * depth[i % 2], 0, 0}, 0, 0, 0);
        sides_find(&s);
        ck_assert_int_eq(s.r.patches.count, i % 2);
        assert_relative(sum_of_limits(&s.r), 100 * line * real_pow(thin, 1.25), 1e-5);
        sides_free(&s);
    }
    /* A narrow face is crushed before. */
    sides_rig s;
    sides_make(&s, 0.01, 0);
    s.r.settings.pack.ridging = 2;
    for (int k = 0; k < 2; k++)
        ice_rig_plate(&s.r, 4, 0.5, 1, MOTION_DYNAMIC);
    ice_rig_place(&s.r, 1, (vec3){4 - 0.01, 0, 0}, 0, 0, 0);
    sides_find(&s);
    assert_relative(sum_of_limits(&s.r), 2e6 * 0.5, 1e-5);
    sides_free(&s);
}
END_TEST

/* Of an inclined patch the front is what is seen level: a plate tilted by 30 degrees runs with its side under another
   one, whose own sides stand upright. */
START_TEST(ridge_of_an_inclined_patch)
{
    sides_rig s;
    sides_make(&s, 0.01, 0);
    s.r.settings.pack.ridging = 0.5;
    ice_rig_plate(&s.r, 40, 100, 2, MOTION_DYNAMIC);
    ice_rig_plate(&s.r, 40, 100, 2, MOTION_DYNAMIC);
    ice_rig_place(&s.r, 0, (vec3){-36, 0, 9}, 0, radians(30), 0);
    sides_find(&s);
    ck_assert_int_eq(s.r.patches.count, 1);
    const crushing_patch *p = &s.r.patches.data[0];
    double level = sqrt(p->normal.x * p->normal.x + p->normal.y * p->normal.y);
    ck_assert(level > 0.2 && level < 0.95);
    double width = level * p->area / 2;
    assert_relative(p->pressure, 0.5e6 * real_pow(2, 1.25) * real_pow(width, -0.54) / 2, 1e-9);
    sides_free(&s);
}
END_TEST

/* Sheets of 5 cm pass each other at 274.6 N/m, of 5 and 4 cm at 226.5 N/m, from finite elements of the beam on water
   (validation/raft_beams.py); the thickness beyond which a sheet breaks before is Parmerter's 14.2 (1 - nu^2)
   sigma^2/(rho_w g E) within a tenth, and the stress goes with the root of the thickness. */
START_TEST(raft_lift)
{
    ice_material m = {.elastic_modulus = 5e9, .poisson_ratio = 0.3, .flexural_strength = 6e5};
    double k = 1025 * 9.81;
    assert_relative(ice_rafting_lift(&m, 0.05, &m, 0.05, k), 274.558, 1e-3);
    assert_relative(ice_rafting_lift(&m, 0.05, &m, 0.04, k), 226.473, 1e-3);
    assert_relative(ice_rafting_lift(&m, 0.04, &m, 0.05, k), 226.473, 1e-3);
    double lo = 0.01, hi = 1;
    while (hi - lo > 1e-9) {
        double h = 0.5 * (lo + hi);
        *(isfinite(ice_rafting_lift(&m, h, &m, h, k)) ? &lo : &hi) = h;
    }
    assert_relative(lo, 14.2 * (1 - 0.09) * 6e5 * 6e5 / (k * 5e9), 0.1);
    m.flexural_strength *= sqrt(2);
    ck_assert(isfinite(ice_rafting_lift(&m, 1.999 * lo, &m, 1.999 * lo, k)));
    ck_assert(isinf(ice_rafting_lift(&m, 2.001 * lo, &m, 2.001 * lo, k)));
    /* Of a thin sheet and a thick one either may break. */
    ck_assert(isinf(ice_rafting_lift(&m, 1, &m, 0.05, k)) && isinf(ice_rafting_lift(&m, 0.05, &m, 1, k)));
}
END_TEST

/* Up a slope of 45 degrees with friction 0.1 it takes 1.1/0.9 of the lift, on one of 85 friction holds it; side to side
   and as a patch; the lower of ridges and rafts. */
START_TEST(raft_line_load)
{
    static const double depth[2] = {0.01, 0.02};
    for (int i = 0; i < 8; i++) {
        sides_rig s;
        sides_make(&s, 0.01, 0);
        pair_policy *policy = &s.r.policies.of[MATERIAL_ICE][MATERIAL_ICE];
        policy->friction_static = policy->friction_kinetic = 0.1;
        double h = i / 2 == 1 ? 0.5 : 0.05, slope = i / 2 == 2 ? 12 : 1;
        s.r.settings.pack = (pack_limit){i / 2 == 3 ? 1e-4 : 0, slope, 1025 * 9.81};
        for (int k = 0; k < 2; k++)
            ck_assert_int_eq(ice_rig_plate(&s.r, 4, 20, h, MOTION_DYNAMIC), k);
        ice_rig_place(&s.r, 1, (vec3){4 - depth[i % 2], 0, 0}, 0, 0, 0);
        sides_find(&s);
        ck_assert_int_eq(s.r.patches.count, i / 2 == 1 ? 0 : i % 2);
        const ice_material *ice = &s.r.floes.material[0];
        double raft = 20 * ice_rafting_lift(ice, 0.05, ice, 0.05, 1025 * 9.81) * 1.1 / 0.9;
        double ridge = 20 * ice_ridging_line_load(1e-4, 0.05, 20);
        ck_assert(ridge < raft && raft < 2e6 * 20 * 0.05);
        assert_relative(sum_of_limits(&s.r), i / 2 == 0 ? raft : i / 2 == 3 ? ridge : 2e6 * 20 * h, 1e-4);
        sides_free(&s);
    }
}
END_TEST

/* The limit of a pair is shared by the points that touch; one that stands apart carries nothing. */
START_TEST(points_apart_carry_nothing)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    r.policies.of[MATERIAL_ICE][MATERIAL_ICE].sides = true;
    for (int i = 0; i < 2; i++)
        ck_assert_int_eq(ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC), i);
    ice_rig_place(&r, r.floes.body[1], (vec3){9.9, 0, 0}, 0, 0, 0);
    static const double depth[3] = {0.1, -0.01, 0.1};
    for (int i = 0; i < 3; i++) {
        contact c = {.a = 0, .b = 1, .point = {5, 5.0 * i - 5, 0}, .normal = {1, 0, 0}, .depth = depth[i], .patch = -1};
        ck_assert(array_push(&r.ctx, &r.contacts, c));
    }
    crushing_limit_sides(&r.ctx, &r.settings, &r.bodies, &r.shapes, &r.floes, &r.policies, &r.contacts);
    for (int i = 0; i < 3; i++)
        assert_relative(r.contacts.data[i].impulse_limit, i == 1 ? 0 : 2e6 * 10 * 0.01 / 2, 1e-7);
    ice_rig_free(&r);
}
END_TEST

/* Four floes of 1 m and 100 m width, pushed against a fixed one by a driven one, at two steps: what stands them on end
   is the ridge's line load, 16.6 MN in all, where crushing alone would be 200 MN; the limit does not depend on the
   step. */
START_TEST(squeezed_row)
{
    for (int i = 0; i < 4; i++) {
        sides_rig s;
        double dt = i % 2 ? 0.01 : 0.02, line = 2e6 * real_pow(100, -0.54);
        sides_make(&s, dt, 1e-4);
        s.r.settings.pack.ridging = i < 2 ? 2 : 0;
        for (int k = 0; k < 6; k++) {
            ice_rig_plate(&s.r, 40, 100, 1, k == 0 ? MOTION_PRESCRIBED : k == 5 ? MOTION_STATIC : MOTION_DYNAMIC);
            ice_rig_place(&s.r, k, (vec3){40.0 * k, 0, 0}, 0, 0, 0);
        }
        s.r.bodies.velocity[0] = (vec3){0.05, 0, 0};
        double mean = 0;
        int steps = (int)(2 / dt), counted = 0;
        for (int step = 0; step < steps; step++) {
            sides_step(&s);
            double force = 0;
            for (int32_t k = 0; k < s.r.contacts.count; k++)
                if (s.r.contacts.data[k].a == 5 || s.r.contacts.data[k].b == 5)
                    force += fabs(contact_impulse(&s.r.contacts.data[k]).x) / dt;
            if (2 * step >= steps) {
                mean += force;
                counted++;
            }
        }
        assert_relative(mean / counted, i < 2 ? 100 * line : 2e6 * 100, 0.01);
        sides_free(&s);
    }
}
END_TEST

/* Floes that lie over each other, or tilt, or are concave, have patches; the order of pairs does not depend on it. */
START_TEST(others_have_patches)
{
    sides_rig s;
    sides_make(&s, 0.01, 1e-4);
    vec2 fork[8] = {{-5, -5}, {5, -5}, {5, -2}, {-2, -2}, {-2, 2}, {5, 2}, {5, 5}, {-5, 5}};
    ice_rig_plate(&s.r, 10, 10, 1, MOTION_DYNAMIC);
    for (int k = 0; k < 2; k++)
        ice_rig_plate(&s.r, 10, 10, 1, MOTION_DYNAMIC);
    ice_rig_floe(&s.r, (polygon){fork, 8}, 1, MOTION_DYNAMIC);
    ice_rig_place(&s.r, 1, (vec3){9.9, 0, 0}, 0.4, 0, 0);  /* tilts */
    ice_rig_place(&s.r, 2, (vec3){0, 1, 0.95}, 0, 0, 0.1); /* lies on the first */
    ice_rig_place(&s.r, 3, (vec3){-9.9, 0, 0}, 0, 0, PI);  /* concave */
    sides_find(&s);
    ck_assert_int_eq(s.r.patches.count, 3);
    for (int32_t i = 1; i < s.r.patch_pairs.count; i++)
        ck_assert_int_lt(s.r.patch_pairs.data[i - 1], s.r.patch_pairs.data[i]);
    for (int32_t i = 0; i < s.r.contacts.count; i++) {
        ck_assert_int_ge(s.r.contacts.data[i].patch, 0);
        ck_assert(isfinite(s.r.contacts.data[i].impulse_limit) && !s.r.contacts.data[i].correct);
    }
    sides_free(&s);
}
END_TEST

TEST_MAIN("crushing sides", face_to_face, corner_in_a_side, corner_impact_on_ice, ridge_line_load,
          ridge_of_an_inclined_patch, raft_lift, raft_line_load, points_apart_carry_nothing, squeezed_row,
          others_have_patches)
