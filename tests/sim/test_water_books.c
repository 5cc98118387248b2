/* Floes in the water, stepped as in a run: what drag takes is what the body loses; terminal drift and the decay of spin
   against what follows on paper. */
#include "books.h"
#include "geometry/mesh_clip.h"
#include "scene.h"

#include <stdio.h>

/* Integral of z over the part of the floe under water [m4]. */
static double depth_moment(scene *k, int32_t slot)
{
    const body_table *b = &k->w.bodies;
    const shape_table *s = &k->w.shapes.shapes;
    int32_t shape = b->shape[slot];
    mesh m = {0}, wet = {0};
    mesh_adjacency adjacency = {0};
    fram_error error = {0};
    double half = s->half_height[shape], moment = 0;
    assert_ok(mesh_make_prism(&k->ctx, shape_outline(&k->w.shapes, shape), -half, half, &m, &error), error);
    mat3 r = quat_matrix(b->orientation[slot]);
    for (int32_t i = 0; i < m.vertex.count; i++)
        m.vertex.data[i] = vec3_add(mat3_mul_vec(r, m.vertex.data[i]), vec3_make(0, 0, b->position[slot].z));
    ck_assert_int_eq(mesh_adjacency_build(&k->ctx, &m, &adjacency), FRAM_OK);
    assert_ok(mesh_clip(&k->ctx, &m, &adjacency, vec3_make(0, 0, 1), 0, 1e-9, &wet, &error), error);
    if (wet.face.count > 0) {
        solid_properties p = mesh_solid_properties(&wet);
        moment = p.volume * p.centre.z;
    }
    mesh_adjacency_free(&k->ctx, &adjacency);
    mesh_free(&k->ctx, &m);
    mesh_free(&k->ctx, &wet);
    return moment;
}

/* Kinetic energy, weight, and the water that the floe keeps away: -rho g int z over its wet part. */
static double energy_of(scene *k, int32_t slot)
{
    const body_table *b = &k->w.bodies;
    const media *m = &k->m.media;
    vec3 v = b->velocity[slot], w = mat3_tmul_vec(quat_matrix(b->orientation[slot]), b->angular_velocity[slot]);
    double moving = 0.5 * (b->mass[slot] * vec3_dot(v, v) + vec3_dot(w, sym3_mul_vec(b->inertia[slot], w)));
    return moving + m->gravity * (b->mass[slot] * b->position[slot].z - m->water_density * depth_moment(k, slot));
}

/* The split of the load on a floe as it is now, nothing held. */
static fluid_load split_of(scene *k, int32_t slot)
{
    fluid_load load[8];
    wrench total[8];
    fram_error error = {0};
    ck_assert_int_le(k->w.bodies.count, 8);
    assert_ok(fluid_apply(&k->ctx, &k->m.media, k->m.drag, &k->w.bodies, &k->w.shapes, NULL, total,
                          &(fluid_details){.all = load}, &error),
              error);
    return load[slot];
}

/* Load of water and wind along x, as the next step will reckon it, with what it holds. */
static double push_along_x(scene *k, int32_t slot)
{
    wrench total[8];
    fram_error error = {0};
    held_drag_table held = {0};
    ck_assert_int_le(k->w.bodies.count, 8);
    ck_assert(table_copy(&k->ctx, &held, &k->w.held_drag, &held_drag_table_info));
    assert_ok(fluid_apply(&k->ctx, &k->m.media, k->m.drag, &k->w.bodies, &k->w.shapes, &held, total, NULL, &error),
              error);
    table_free(&k->ctx, &held, &held_drag_table_info);
    return total[slot].force.x;
}

/* What the load of the next step misses since the upper face is not flooded. */
static wrench missing_of(scene *k, int32_t slot)
{
    wrench flooded[8], dry[8];
    fram_error error = {0};
    flooding_table faces = {0};
    fluid_details details = {.flooding = &faces, .time_step = k->m.time_step};
    ck_assert(table_copy(&k->ctx, &faces, &k->w.flooding, &flooding_table_info));
    assert_ok(fluid_apply(&k->ctx, &k->m.media, k->m.drag, &k->w.bodies, &k->w.shapes, NULL, dry, &details, &error),
              error);
    details.flooding = NULL;
    assert_ok(fluid_apply(&k->ctx, &k->m.media, k->m.drag, &k->w.bodies, &k->w.shapes, NULL, flooded, &details, &error),
              error);
    table_free(&k->ctx, &faces, &flooding_table_info);
    return (wrench){vec3_sub(dry[slot].force, flooded[slot].force), vec3_sub(dry[slot].moment, flooded[slot].moment)};
}

/* Work of drag on the floe over the last step, at the mean of the velocities before and after. */
static double drag_work(const scene *k, const fluid_load *load, int32_t slot, vec3 velocity, vec3 spin)
{
    const body_table *b = &k->w.bodies;
    vec3 v = vec3_scale(vec3_add(velocity, b->velocity[slot]), 0.5);
    vec3 w = vec3_scale(vec3_add(spin, b->angular_velocity[slot]), 0.5);
    double power = vec3_dot(load->water_drag.force, v) + vec3_dot(load->water_drag.moment, w) +
                   vec3_dot(load->wind_drag.force, v) + vec3_dot(load->wind_drag.moment, w);
    return k->m.time_step * power;
}

typedef struct books {
    double lost;  /* energy at the start less that at the end [J] */
    double drawn; /* by drag, and by the pressure that is missing on a dry face [J] */
    vec3 up;      /* the body's z axis at the end */
    double height, speed;
    double lifted; /* the largest missing load, upward [N] */
} books;

#define FLOE                                                                                                 \
    "vessel: {present: false}\ndomain: {boundary: open, x_min: -1e4, x_max: 1e4, y_min: -1e4, y_max: 1e4}\n" \
    "run: {time_step: %g}\nice: {source: floes, floes: [%s]}\nenvironment: {%s}\n"

static void open_floe(scene *k, const char *floe, const char *environment, double dt)
{
    char text[1000];
    snprintf(text, sizeof text, FLOE, dt, floe, environment);
    scene_open(k, text);
}

static books run_floe(const char *floe, const char *environment, double duration, double dt)
{
    scene k;
    open_floe(&k, floe, environment, dt);
    int32_t slot = scene_floe(&k, 0);
    books out = {.lost = energy_of(&k, slot)};
    for (int i = 0; i < (int)(duration / dt + 0.5); i++) {
        vec3 v = k.w.bodies.velocity[slot], w = k.w.bodies.angular_velocity[slot];
        fluid_load load = split_of(&k, slot);
        if (k.m.ventilation) {
            wrench missing = missing_of(&k, slot);
            load.water_drag.force = vec3_add(load.water_drag.force, missing.force);
            load.water_drag.moment = vec3_add(load.water_drag.moment, missing.moment);
            out.lifted = fmax(out.lifted, missing.force.z);
        }
        scene_steps(&k, 1);
        out.drawn -= drag_work(&k, &load, slot, v, w);
    }
    out.lost -= energy_of(&k, slot);
    out.up = mat3_column(quat_matrix(k.w.bodies.orientation[slot]), 2);
    out.height = k.w.bodies.position[slot].z;
    out.speed = vec3_length(k.w.bodies.velocity[slot]);
    scene_close(&k);
    return out;
}

/* The books close, to first order in the step. */
static void check_books_in(const char *floe, const char *environment, double duration, double dt, double part,
                           books *fine)
{
    books coarse = run_floe(floe, environment, duration, dt);
    *fine = run_floe(floe, environment, duration, dt / 2);
    double open = fabs(coarse.lost - coarse.drawn), half_open = fabs(fine->lost - fine->drawn);
    ck_assert_msg(fine->drawn > 0 && half_open < part * fine->drawn, "lost %g J, taken by drag %g J, then %g and %g",
                  coarse.lost, coarse.drawn, fine->lost, fine->drawn);
    ck_assert_msg(half_open < 0.65 * open || half_open < 1e-3 * part * fine->drawn, "open by %g J, then %g J", open,
                  half_open);
}

static void check_books(const char *floe, double duration, double dt, double part, books *fine)
{
    check_books_in(floe, "", duration, dt, part, fine);
}

START_TEST(held_under_and_released)
{
    books b;
    check_books("{elevation: -4}", 60, 0.01, 0.01, &b);
    assert_absolute(b.height, 0.5 - 920.0 / 1025, 0.02);
    assert_absolute(b.up.z, 1, 1e-6);
}
END_TEST

/* A tall block cannot stand: it falls over and comes to rest on its side. */
START_TEST(overturning)
{
    books b;
    check_books("{length: 2, width: 8, thickness: 4, pitch_deg: 3}", 60, 0.005, 0.01, &b);
    ck_assert_msg(fabs(b.up.z) < 0.1, "its axis points to (%g, %g, %g)", b.up.x, b.up.y, b.up.z);
}
END_TEST

/* A thin one that stands on its edge falls flat. */
START_TEST(falling_flat)
{
    books b;
    check_books("{thickness: 0.5, pitch_deg: 80, elevation: 0}", 60, 0.005, 0.01, &b);
    assert_absolute(fabs(b.up.z), 1, 1e-3);
}
END_TEST

/* A floe that falls into the water goes under with a dry face, takes water and comes to rest as every other one. */
START_TEST(diving_dry)
{
    books b;
    check_books_in("{thickness: 0.5, pitch_deg: 20, elevation: 4}", "floe_ventilation: true", 40, 0.005, 0.01, &b);
    ck_assert_msg(b.lifted > 1025 * 9.81 * 100 * 0.2, "%g N at most", b.lifted);
    assert_absolute(b.height, 0.5 * (0.5 - 920.0 / 1025), 0.02);
    assert_absolute(b.up.z, 1, 1e-3);
}
END_TEST

START_TEST(gliding)
{
    books b;
    check_books("{velocity_x: 1, velocity_y: 0.3, spin: 0.2}", 40, 0.02, 0.01, &b);
    ck_assert(b.speed < 0.5);
}
END_TEST

/* w(t) = w0 / (1 + w0 K t), K from the drag of one moment; half the step, half the error. */
START_TEST(spin_decays)
{
    double error[2];
    for (int n = 0; n < 2; n++) {
        double dt = n ? 0.0125 : 0.025, rate = 0;
        scene k;
        open_floe(&k, "{spin: 0.5}", "air_density: 0", dt);
        int32_t slot = scene_floe(&k, 0);
        for (int i = 0; i < (int)(60 / dt + 0.5); i++) {
            if (i == 0)
                rate = -split_of(&k, slot).water_drag.moment.z / (0.25 * k.w.bodies.inertia[slot].zz);
            scene_steps(&k, 1);
        }
        /* Sides: 1/2 rho Cd d w^2 b^4, four halves of which move in (docs/oracles.md, 5); caps and sides by their skin.
         */
        double draught = 920.0 / 1025, sides = 0.5 * 1025 * draught * 625;
        ck_assert(rate * k.w.bodies.inertia[slot].zz > sides && rate * k.w.bodies.inertia[slot].zz < 1.5 * sides);
        error[n] = k.w.bodies.angular_velocity[slot].z - 0.5 / (1 + 0.5 * rate * 60);
        scene_close(&k);
    }
    ck_assert_msg(fabs(error[1]) < 2e-3, "%g rad/s", error[1]);
    assert_absolute(error[0] / error[1], 2, 0.1);
    books b;
    check_books("{spin: 0.5}", 60, 0.025, 0.01, &b);
}
END_TEST

/* The gain is the work of water and wind; in the end they are in balance: c_w (u - U)|u - U| = c_a (W - u)^2. */
START_TEST(terminal_drift)
{
    double draught = 920.0 / 1025, freeboard = 1 - draught;
    double water = 0.5 * 1025 * (10 * draught + 0.01 * (100 + 20 * draught));
    double air = 0.5 * 1.225 * (10 * freeboard + 0.003 * (100 + 20 * freeboard)), root = sqrt(air / water);
    static const double currents[] = {0, 0.3};
    for (int n = 0; n < 2; n++) {
        char text[200];
        snprintf(text, sizeof text, "current_speed: %g, wind_speed: 12", currents[n]);
        scene k;
        open_floe(&k, "{}", text, 0.1);
        int32_t slot = scene_floe(&k, 0);
        /* Its books: what water and wind do along the way is what it gains. */
        double work = 0;
        for (int i = 0; i < 2000; i++) {
            double push = push_along_x(&k, slot), before = k.w.bodies.velocity[slot].x;
            scene_steps(&k, 1);
            work += push * 0.1 * 0.5 * (before + k.w.bodies.velocity[slot].x);
        }
        assert_relative(work, body_books_of(&k.w.bodies).kinetic_energy, 1e-6);
        scene_steps(&k, 18000);
        double u = (root * 12 + currents[n]) / (1 + root);
        assert_absolute(k.w.bodies.velocity[slot].x, u, 2e-3 * u);
        scene_close(&k);
    }
}
END_TEST

/* Current across the wind: no component of the force is left. */
START_TEST(drift_across)
{
    scene k;
    open_floe(&k, "{yaw_deg: 20}", "current_speed: 0.4, current_direction_deg: 90, wind_speed: 15", 0.1);
    int32_t slot = scene_floe(&k, 0);
    scene_steps(&k, 30000);
    fluid_load load = split_of(&k, slot);
    vec3 rest = vec3_add(load.water_drag.force, load.wind_drag.force);
    ck_assert_msg(vec3_length(load.wind_drag.force) > 50 && fabs(rest.x) < 0.5 && fabs(rest.y) < 0.5,
                  "(%g, %g) N are left", rest.x, rest.y);
    ck_assert(k.w.bodies.velocity[slot].x > 0.02 && k.w.bodies.velocity[slot].y > 0.35);
    scene_close(&k);
}
END_TEST

/* With all that the water can add, thin floes thrown about at steps near what their springs allow stay tame. */
START_TEST(stable_over_the_range)
{
    static const double thickness[] = {0.02, 0.1, 0.5, 2};
    for (int n = 0; n < 24; n++) {
        double h = thickness[n % 4];
        int option = n / 4 % 2, rough = n / 8 > 0, dry = n / 8 > 1;
        char floe[300], environment[200];
        snprintf(floe, sizeof floe,
                 "{thickness: %g, elevation: %g, pitch_deg: %d, velocity_x: %d, velocity_z: %d, spin: 0.5}", h,
                 rough ? 3.0 : 0.0, rough ? 40 : 2, rough ? 10 : 1, rough ? -8 : 0);
        snprintf(environment, sizeof environment,
                 "current_speed: 3, floe_added_mass: %s, floe_damping: %g, floe_ventilation: %s",
                 option ? "true" : "false", option ? 0.2 : 0.0, dry ? "true" : "false");
        /* Springs alone allow 2 sqrt(rho_i h / (rho_w g)). */
        double dt = 0.5 * sqrt(920 * h / (1025 * 9.81));
        scene k;
        open_floe(&k, floe, environment, dt);
        int32_t slot = scene_floe(&k, 0);
        double fastest = 0;
        for (int i = 0; i * dt < 60; i++) {
            scene_steps(&k, 1);
            if (i * dt > 30)
                fastest =
                    testing_larger(fastest, fabs(k.w.bodies.velocity[slot].z) + fabs(k.w.bodies.velocity[slot].x));
        }
        ck_assert_msg(fastest < 6, "thickness %g m, option %d: %g m/s after 30 s", h, option, fastest);
        assert_absolute(k.w.bodies.position[slot].z, h * (0.5 - 920.0 / 1025), 0.1 + 0.3 * h);
        scene_close(&k);
    }
}
END_TEST

TEST_MAIN("water_books", held_under_and_released, overturning, falling_flat, diving_dry, gliding, spin_decays,
          terminal_drift, drift_across, stable_over_the_range)
