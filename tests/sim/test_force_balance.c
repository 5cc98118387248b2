/* A hull towed slowly through a field: in every step what the carriage, the ice, the water, the air and gravity exert,
   each from the channel that is recorded, accounts for the change of the hull's momentum. */
#include "scene.h"

#include "base/transcendental.h"

#include <stdio.h>

static const char field[] = "run: {duration: 100, time_step: 0.02, seed: 7, scale: 30}\n"
                            "vessel: {mode: towed, x: -40, speed: 1, ramp: 1, "
                            "hull: {length: 48, beam: 12, draught: 4, freeboard: 3}}\n"
                            "ice: {concentration: 0.8, mean_floe_area: 64, thickness: 1}\n"
                            "domain: {x_min: -72, x_max: 72, y_min: -40, y_max: 40}\n"
                            "environment: {current_speed: 0.2, current_direction_deg: 90, wind_speed: 8}\n";

typedef struct balance {
    double worst; /* largest imbalance of a step [N] */
    double peak;  /* largest force of the carriage [N] */
    double ice;   /* largest ice load [N] */
} balance;

static balance towed_balance(const char *kind, const char *water, int steps)
{
    scene k;
    const char *keys[] = {kind, "run.solver.iterations=60", water};
    scene_open_with(&k, field, keys, 3);
    int32_t hull = k.w.vessels.body[0], joint = k.w.vessels.joint[0];
    double mass = k.w.bodies.mass[hull];
    vec3 weight = vec3_make(0, 0, -mass * k.m.media.gravity);
    balance b = {0};
    for (int i = 0; i < steps; i++) {
        vec3 before = k.w.bodies.velocity[hull];
        scene_steps(&k, 1);
        const fluid_load *f = &k.w.scratch.fluid.data[hull];
        vec3 ice = k.w.scratch.ice_loads.data[0].total.force, tow = k.w.joints.reaction_force[joint];
        vec3 fluid = vec3_add(f->hydrostatic.force, vec3_add(f->water_drag.force, f->wind_drag.force));
        fluid = vec3_add(fluid, k.w.scratch.responses.data[0].force);
        vec3 gain = vec3_scale(vec3_sub(k.w.bodies.velocity[hull], before), mass / k.m.time_step);
        vec3 rest = vec3_sub(vec3_add(vec3_add(tow, ice), vec3_add(fluid, weight)), gain);
        b.worst = testing_larger(b.worst, vec3_length(rest));
        b.peak = fmax(b.peak, vec3_length(tow));
        b.ice = fmax(b.ice, vec3_length(ice));
    }
    scene_close(&k);
    return b;
}

static void check_balance(const char *kind, const char *water, int steps, double tolerance)
{
    balance b = towed_balance(kind, water, steps);
    ck_assert_msg(b.ice > 1e4, "the hull met no ice (%g N)", b.ice);
    ck_assert_msg(b.worst <= tolerance * b.peak, "%s: %g N of %g N are not accounted for", kind, b.worst, b.peak);
}

static const char still[] = "vessel.hydrodynamics.source=none", moved[] = "vessel.hydrodynamics.source=estimate";

START_TEST(accurate_solver) { check_balance("run.solver.kind=accurate", still, 500, 1e-6); }
END_TEST
START_TEST(sequential_solver) { check_balance("run.solver.kind=sequential", still, 1500, 1e-2); }
END_TEST
START_TEST(fast_solver) { check_balance("run.solver.kind=fast", still, 1500, 1e-2); }
END_TEST

/* With added mass and damping, whose force is a channel of its own. */
START_TEST(water_that_moves_along)
{
    check_balance("run.solver.kind=accurate", moved, 400, 1e-6);
    check_balance("run.solver.kind=fast", moved, 800, 1e-2);
}
END_TEST

/* A carriage bears what the water does to a hull that goes obliquely or turns (Lamb 1932, section 124): Munk's moment,
   and the force of a steady turn, in which the mass that counts across is that ahead; nothing rubs. */
#define LED(WAY)                                                                                                 \
    "run: {duration: 100, time_step: 0.02}\n"                                                                    \
    "vessel: {mode: towed, " WAY "mass: 2.3e6, centre_of_gravity_x: 0,\n"                                        \
    "  hull: {form: box, length: 48, beam: 12, draught: 4, freeboard: 3}, hydrodynamics: {source: given,\n"      \
    "  added_mass: [{surge: 1e5}, {sway: 2e6, yaw: 5e6}, {heave: 3e6}, {roll: 2e7}, {pitch: 5e8},\n"             \
    "    {sway: 5e6, yaw: 4e8}],\n"                                                                              \
    "  damping: [{surge: 1e4}, {sway: 2e4}, {heave: 1e6}, {roll: 1e7}, {pitch: 1e8}, {sway: 3e5, yaw: 1e7}]}}\n" \
    "ice: {source: none}\nenvironment: {hull_drag: {water_form: 0, water_skin: 0, air_form: 0, air_skin: 0}}\n"

START_TEST(water_that_is_met_obliquely)
{
    scene k;
    scene_open(&k, LED("heading_deg: -10, course_deg: 0, speed: 2, ramp: 0, "));
    scene_steps(&k, 300);
    double ahead = 2 * real_cos(radians(10)), aside = 2 * real_sin(radians(10));
    double water = (1e5 - 2e6) * ahead * aside - 3e5 * aside;
    assert_relative(k.w.joints.reaction_moment[k.w.vessels.joint[0]].z, -water, 1e-6);
    scene_close(&k);
}
END_TEST

START_TEST(water_round_a_steady_turn)
{
    enum { POINTS = 25, MEAN_STEPS = 500 };
    const double radius = 120, speed = 2;
    char path[4096], text[sizeof path + 1024];
    size_t n = 0;
    for (int i = 0; i < POINTS; i++) {
        double turned = speed * i / radius;
        n += (size_t)snprintf(path + n, sizeof path - n, "{time: %d, x: %.9f, y: %.9f, heading_deg: %.9f}, ", i,
                              radius * real_sin(turned), radius * (1 - real_cos(turned)), degrees(turned));
    }
    ck_assert_int_lt(snprintf(text, sizeof text, LED("path: [%s], "), path), (int)sizeof text);
    scene k;
    scene_open(&k, text);
    scene_steps(&k, 525);
    vec3 tow = {0, 0, 0};
    for (int i = 0; i < MEAN_STEPS; i++) { /* between points the way is straight */
        scene_steps(&k, 1);
        vec3 force = k.w.joints.reaction_force[k.w.vessels.joint[0]];
        tow = vec3_mad(tow, plane_to_vessel(speed * k.w.clock.time[0] / radius, force), 1.0 / MEAN_STEPS);
    }
    assert_relative(tow.y, (2.3e6 + 1e5) * speed * speed / radius, 0.01);
    scene_close(&k);
}
END_TEST

/* A hull whose motion is given is not moved by the water: nothing answers to it. */
START_TEST(a_driven_hull_has_no_response)
{
    scene k;
    scene_open_with(&k, field, (const char *const[]){"vessel.mode=prescribed", moved, "ice.source=none"}, 3);
    for (int i = 0; i < 20; i++) {
        scene_steps(&k, 1);
        assert_vec3_close(k.w.scratch.responses.data[0].force, vec3_make(0, 0, 0), 0);
    }
    ck_assert(k.w.bodies.added_mass[k.w.vessels.body[0]].x > 0);
    scene_close(&k);
}
END_TEST

/* The ice load as a tank has it: what the carriage needs more than in open water. */
START_TEST(reaction_less_open_water)
{
    enum { STEPS = 1200 };
    vec3 tow[2] = {{0, 0, 0}, {0, 0, 0}}, ice = {0, 0, 0};
    for (int open = 0; open < 2; open++) {
        scene k;
        scene_open_with(&k, field, (const char *const[]){open ? "ice.source=none" : "ice.source=voronoi"}, 1);
        for (int i = 0; i < STEPS; i++) {
            scene_steps(&k, 1);
            tow[open] = vec3_mad(tow[open], k.w.joints.reaction_force[k.w.vessels.joint[0]], 1.0 / STEPS);
            if (!open)
                ice = vec3_mad(ice, k.w.scratch.ice_loads.data[0].total.force, 1.0 / STEPS);
        }
        scene_close(&k);
    }
    ck_assert_msg(ice.x < -1e4, "the hull met no ice (%g N)", ice.x);
    assert_relative(tow[0].x - tow[1].x, -ice.x, 0.02);
}
END_TEST

TEST_MAIN("force_balance", accurate_solver, sequential_solver, fast_solver, water_that_moves_along,
          water_that_is_met_obliquely, water_round_a_steady_turn, a_driven_hull_has_no_response,
          reaction_less_open_water)
