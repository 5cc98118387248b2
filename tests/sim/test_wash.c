/* The wash of thrusters and propulsion on floes: direction, bound, and nothing where it is off. */
#include "scene.h"

#include "base/pool.h"
#include "base/transcendental.h"
#include "fluid/jet.h"

#include <stdio.h>

/* Floes of 10 x 10 m: on the axis behind the ship, abeam, ahead. */
#define FLOES "ice: {source: floes, thickness: 1, floes: [{x: -70, y: 0}, {x: -28, y: 60}, {x: 90, y: 0}]}\n"

/* A ship along x, one main thruster at its stern, 4 m down. */
#define SHIP(more)                                                                              \
    "run: {time_step: 0.02, scale: 30}\n"                                                       \
    "vessel:\n  mode: free\n  x: 0\n"                                                           \
    "  hull: {form: box, length: 60, beam: 14, draught: 6, freeboard: 4}\n"                     \
    "  thrusters: [{kind: main, x: -28, z: -4, thrust: 4.0e5, diameter: 3, time_constant: 0,\n" \
    "               speed_rate: 1000, setting: 1}]\n"                                           \
    "  wash: {" more "}\n" FLOES "domain: {x_min: -200, x_max: 200, y_min: -200, y_max: 200, boundary: open}\n"

enum { BEHIND = 0, ABEAM = 1, AHEAD = 2 };

static const char *const ON = SHIP("active: true"), *const OFF = SHIP("active: false");

static double speed_of(const scene *k, int32_t floe) { return k->w.bodies.velocity[scene_floe(k, floe)].x; }

/* The momentum of the floe on the axis is what the wash gave it, less the water's drag; the others keep still. */
START_TEST(pushes_the_floe_behind_and_no_other)
{
    scene k;
    scene_open(&k, ON);
    scene_steps(&k, 2);
    double mass = k.w.bodies.mass[scene_floe(&k, BEHIND)], before = speed_of(&k, BEHIND);
    scene_steps(&k, 1);
    vec3 force = k.w.scratch.wash_force.data[0];
    ck_assert_msg(force.x < -1000 && force.x > -4e5, "%g N", force.x);
    assert_absolute(force.y, 0, 1e-6 * fabs(force.x));
    assert_relative((speed_of(&k, BEHIND) - before) * mass / 0.02, force.x, 0.02);
    scene_steps(&k, 47);
    ck_assert(speed_of(&k, BEHIND) < -0.02);
    assert_absolute(speed_of(&k, ABEAM), 0, 1e-9);
    assert_absolute(speed_of(&k, AHEAD), 0, 1e-9);
    scene_close(&k);
}
END_TEST

/* By hand: the mean jet on the floe's end, 1/2 rho Cd times its wet side, and skin drag on its bottom (and sides). */
START_TEST(pushes_with_the_floes_own_drag)
{
    static const char *const plain[] = {"environment.ice_drag.water_skin=0"};
    scene k;
    scene_open_with(&k, ON, plain, 1);
    scene_steps(&k, 1);
    const body_table *b = &k.w.bodies;
    int32_t floe = scene_floe(&k, BEHIND);
    double wet = b->mass[floe] / 1025 / 100, mean = 0;
    jet j = {.along = {1, 0}, .spread = 0.18, .length = 150};
    jet_set_thrust(&j, 4e5, 3, 0, 1025);
    for (int i = 0; i < 100; i++)
        for (int n = 0; n < 100; n++) {
            double x = -28 - (-75 + 0.1 * (i + 0.5)), y = -5 + 0.1 * (n + 0.5), z = 4 - 0.5 * wet;
            double u = jet_speed(&j, x, sqrt(y * y + z * z));
            mean += u * u / 1e4;
        }
    assert_relative(-k.w.scratch.wash_force.data[0].x, 0.5 * 1025 * 1 * 10 * wet * mean, 0.02);
    scene_close(&k);
}
END_TEST

/* Astern the jet goes ahead, through the ship, and the sign of the push turns. */
START_TEST(turns_round_with_the_thrust)
{
    static const char *const astern[] = {"vessel.thrusters[0].setting=-1"};
    scene k;
    scene_open_with(&k, ON, astern, 1);
    scene_steps(&k, 50);
    ck_assert(k.w.scratch.wash_force.data[0].x > 100);
    ck_assert(speed_of(&k, AHEAD) > 1e-3);
    assert_absolute(speed_of(&k, BEHIND), 0, 1e-9);
    scene_close(&k);
}
END_TEST

/* Floes cannot take more than the thrust, however many and large their drag. */
START_TEST(gives_no_more_than_the_thrust)
{
    static const char *const rough[] = {"environment.ice_drag.water_form=100", "vessel.wash.spread=0.05",
                                        "ice.thickness=3"};
    scene k;
    scene_open_with(&k, ON, rough, 3);
    scene_steps(&k, 1);
    assert_relative(-k.w.scratch.wash_force.data[0].x, 4e5, 1e-9);
    scene_close(&k);
}
END_TEST

/* The propulsion's jet carries the gross thrust of all its propellers: at rest, bollard pull. */
START_TEST(propulsion_washes_too)
{
    static const char *const text =
        "run: {time_step: 0.02, scale: 30}\n"
        "vessel:\n  mode: free\n"
        "  hull: {form: box, length: 60, beam: 14, draught: 6, freeboard: 4}\n"
        "  propulsion: {bollard_pull: 4.0e5, propellers: 2}\n"
        "  wash: {active: true, spread: 0.05}\n" FLOES "environment: {ice_drag: {water_form: 100}}\n"
        "domain: {x_min: -200, x_max: 200, y_min: -200, y_max: 200, boundary: open}\n";
    scene k;
    scene_open(&k, text);
    scene_steps(&k, 1);
    assert_relative(-k.w.scratch.wash_force.data[0].x, 4e5, 1e-9);
    assert_absolute(k.w.scratch.wash_force.data[0].y, 0, 1e-3);
    assert_relative(k.m.vessels.data[0].wash.diameter, sqrt(4 * 2e5 / (PI * 45e3)), 1e-12);
    scene_close(&k);
}
END_TEST

/* Units that turn push with the gross thrust as long as it is ahead, though the ship brakes a little; braking hard, or
   backing, they push along the ship, and so goes the jet: as the load on the hull has it (propulsion_step). */
START_TEST(the_jet_turns_as_the_thrust_does)
{
    static const char *const text =
        "run: {time_step: 0.02, scale: 30}\n"
        "vessel:\n  mode: free\n"
        "  hull: {form: box, length: 60, beam: 14, draught: 6, freeboard: 4}\n"
        "  propulsion: {bollard_pull: 4.0e5, open_water_speed: 7, speed: 2, rudder_area: 0}\n"
        "  wash: {active: true}\n" FLOES "domain: {x_min: -200, x_max: 200, y_min: -200, y_max: 200, boundary: open}\n";
    static const double speeds[] = {1.9, 2.02, 4};
    static const bool turned[] = {true, true, false};
    for (int i = 0; i < 3; i++) {
        scene k;
        scene_open(&k, text);
        k.w.propulsion.steering[0] = 0.1;
        k.w.bodies.velocity[k.w.vessels.body[0]].x = speeds[i];
        scene_steps(&k, 1);
        ck_assert((k.w.propulsion.thrust[0] < 0) == (i > 0));
        vec3 force = k.w.scratch.wash_force.data[0];
        ck_assert_msg(turned[i] ? force.y > 0.01 * fabs(force.x) : fabs(force.y) < 1e-9,
                      "%g N aside, %g N along at %g m/s", force.y, force.x, speeds[i]);
        scene_close(&k);
    }
}
END_TEST

/* At a quarter of full size, by Froude: discs bear a quarter of the pressure, a newton takes half of the power. */
START_TEST(propellers_left_to_fram_go_with_scale)
{
    static const char *const quarter[] = {"run.scale=7.5"};
    static const char *const text =
        "run: {scale: 30}\n"
        "vessel:\n  mode: free\n"
        "  hull: {form: box, length: 60, beam: 14, draught: 6, freeboard: 4}\n"
        "  propulsion: {bollard_pull: 4.0e5}\n"
        "  thrusters: [{x: 20, thrust: 1.0e5}, {kind: main, thrust: 1.0e5, thrust_astern: 2.0e5}]\n"
        "ice: {source: none}\n";
    scene k;
    scene_open_with(&k, text, quarter, 1);
    const wash_model *wash = &k.m.vessels.data[0].wash;
    assert_relative(wash->diameter, sqrt(4 * 4e5 / (PI * 45e3 / 4)), 1e-12);
    assert_relative(wash->thruster[0], sqrt(4 * 1e5 / (PI * 45e3 / 4)), 1e-12);
    assert_relative(wash->thruster[1], sqrt(4 * 2e5 / (PI * 45e3 / 4)), 1e-12);
    assert_relative(k.w.thrusters.full_power[0], 6.25 / 2 * 1e5, 1e-12);
    scene_close(&k);
}
END_TEST

/* Off: as if there were no such thing; on: the same with another number of threads, and as state goes on. */
START_TEST(off_changes_nothing)
{
    scene a, b, c;
    static const char *const wild[] = {"vessel.wash.spread=0.5", "vessel.wash.reach=9",
                                       "vessel.thrusters[0].diameter=1"};
    scene_open(&a, OFF);
    scene_open_with(&b, OFF, wild, 3);
    scene_open(&c, ON);
    scene_steps(&a, 40);
    scene_steps(&b, 40);
    scene_steps(&c, 40);
    ck_assert(world_hash(&a.w) == world_hash(&b.w));
    ck_assert(world_hash(&a.w) != world_hash(&c.w));
    scene_close(&a);
    scene_close(&b);
    scene_close(&c);
}
END_TEST

START_TEST(goes_on_from_a_copy_with_more_threads)
{
    scene a;
    fram_error error = {0};
    world w;
    scene_open(&a, ON);
    scene_steps(&a, 20);
    assert_ok(world_copy(&a.ctx, &a.w, &w, &error), error);
    context other;
    context_init(&other);
    other.threads = pool_create(&other, 3);
    for (int i = 0; i < 20; i++)
        assert_ok(world_step(&other, &a.m, &w, &error), error);
    scene_steps(&a, 20);
    ck_assert(world_hash(&a.w) == world_hash(&w));
    world_free(&a.ctx, &w);
    pool_free(&other, other.threads);
    scene_close(&a);
}
END_TEST

START_TEST(refuses_wash_that_cannot_be)
{
    static const char *const dry[] = {"environment.water=false"}, *const wide[] = {"vessel.wash.spread=2"};
    check_refusal(ON, dry, 1, "vessel.wash.active");
    check_refusal(ON, wide, 1, "vessel.wash.spread");
    check_refusal("vessel: {wash: {active: true}}\nice: {source: none}\n", NULL, 0, "vessel.wash.active");
}
END_TEST

TEST_MAIN("wash", pushes_the_floe_behind_and_no_other, pushes_with_the_floes_own_drag, turns_round_with_the_thrust,
          gives_no_more_than_the_thrust, propulsion_washes_too, the_jet_turns_as_the_thrust_does, off_changes_nothing,
          propellers_left_to_fram_go_with_scale, goes_on_from_a_copy_with_more_threads, refuses_wash_that_cannot_be)
