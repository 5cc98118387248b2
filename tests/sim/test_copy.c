/* A world is copied with all that its next steps depend on: original and copy go the same way, each by itself, stepped
   by one model.  One that goes on with half the time step finds the loads and the instants of the controller that the
   original has, in a window as long as that, and wakes nothing that sleeps on in the original. */
#include "scene.h"

#include "sim/ice_loads.h"
#include "sim/rerun_step.h"

static const char moored_in_ice[] =
    "run: {time_step: 0.02, duration: 10}\nvessel:\n  mode: free\n"
    "  hull: {length: 60, beam: 14, draught: 5, freeboard: 3, parallel_midbody: 0.3}\n"
    "  hydrodynamics: {source: estimate}\n"
    "  mooring:\n    lines:\n      - {count: 4, spacing_deg: 90, direction_deg: 45, distance: 400, pretension: 2e5}\n"
    "  thrusters: [{x: 20, thrust: 3e5}]\n"
    "  positioning: {active: true, feed_forward: measured, observer: kalman}\n"
    "domain: {boundary: open, x_min: -200, x_max: 200, y_min: -200, y_max: 200}\n"
    "environment: {current_speed: 0.3, wind_speed: 12, wind_direction_deg: 90}\n"
    "ice:\n  source: floes\n  thickness: 0.6\n  floes:\n"
    "    - {x: 38.2, y: 2, length: 16, width: 60, yaw_deg: 10, velocity_x: -2}\n"
    "    - {x: 3, y: 16, length: 12, width: 12, velocity_y: -0.6}\n"
    "output: {averaging_window: 0.25}\n"; /* 12.5 steps: 13, of half the time 26 */

static uint64_t steps(scene *k, world *w, int count)
{
    fram_error error = {0};
    for (int i = 0; i < count; i++)
        assert_ok(world_step(&k->ctx, &k->m, w, &error), error);
    return world_hash(w);
}

START_TEST(original_and_copy_go_the_same_way)
{
    scene k;
    world copy;
    fram_error error = {0};
    scene_open(&k, moored_in_ice);
    scene_steps(&k, 60);
    ck_assert(k.w.memory.count > 0); /* contacts that are remembered */
    const wrench push = {{2e5, 0, 0}, {0, 0, 1e6}};
    assert_ok(world_add_wrench(&k.ctx, &k.w, k.w.vessels.body[0], push, &error), error);
    assert_ok(world_copy(&k.ctx, &k.w, &copy, &error), error);
    ck_assert_int_eq(copy.scratch.ice_loads.count, 1);
    ck_assert(vec3_length(k.w.scratch.ice_loads.data[0].total.force) > 0);
    assert_vec3_close(copy.scratch.ice_loads.data[0].total.force, k.w.scratch.ice_loads.data[0].total.force, 0);
    uint64_t then = world_hash(&k.w), hash = steps(&k, &copy, 60);
    ck_assert(world_hash(&k.w) == then);
    ck_assert(hash != then);
    ck_assert(steps(&k, &k.w, 60) == hash);
    world_free(&k.ctx, &copy);
    scene_close(&k);
}
END_TEST

static void copy_with_half_the_step(scene *k, model *fine, world *copy)
{
    fram_error error = {0};
    scenario s = k->s;
    s.run.time_step = 0.01;
    assert_ok(build_model(&k->ctx, &s, fine, &error), error);
    assert_ok(world_copy(&k->ctx, &k->w, copy, &error), error);
    assert_ok(rerun_divide_step(&k->ctx, &k->w, 2, fine, copy, &error), error);
}

/* 60 steps of 0.02 s are 120 of 0.01; the controller measures each 0.5 s, next at 1.5 s. */
START_TEST(a_copy_goes_on_with_half_the_step)
{
    scene k;
    world copy;
    model fine;
    fram_error error = {0};
    scene_open(&k, moored_in_ice);
    scene_steps(&k, 60);
    copy_with_half_the_step(&k, &fine, &copy);
    ck_assert_int_eq(copy.clock.step[0], 120);
    ck_assert_int_eq(load_window_length(&k.w), 13);
    ck_assert_int_eq(load_window_length(&copy), 26);
    vec3 last = last_ice_load(&k.w, 0).force, mean = load_window_average(&k.w, 0).force;
    ck_assert(vec3_length(last) > 0 && vec3_length(vec3_sub(last, mean)) > 0.01 * vec3_length(mean));
    assert_vec3_close(last_ice_load(&copy, 0).force, last, 0);
    assert_vec3_close(load_window_average(&copy, 0).force, mean, 1e-9 * vec3_length(mean));
    vec3 measured = copy.stations.measured[0];
    for (int i = 0; i < 30; i++)
        assert_ok(world_step(&k.ctx, &fine, &copy, &error), error);
    assert_vec3_close(copy.stations.measured[0], measured, 0);
    assert_ok(world_step(&k.ctx, &fine, &copy, &error), error);
    ck_assert(vec3_length(vec3_sub(copy.stations.measured[0], measured)) > 0);
    /* Of places that are nearly those of the run, and with its noise. */
    scene_steps(&k, 16);
    assert_vec3_close(copy.stations.measured[0], k.w.stations.measured[0], 0.005);
    world_free(&k.ctx, &copy);
    model_free(&k.ctx, &fine);
    scene_close(&k);
}
END_TEST

/* A current holds floes against the wall; the outermost stays awake by the hull, and pushes those that sleep. */
static const char leaning[] =
    "run: {time_step: 0.02, duration: 60}\n"
    "vessel: {mode: towed, x: -19.9, speed: 0, hull: {form: box, length: 20, beam: 6, draught: 2, freeboard: 2}}\n"
    "ice:\n  source: floes\n  thickness: 0.5\n  sleep_speed: 0.005\n  sleep_time: 5\n  floes:\n"
    "    - {x: 14.9, length: 10, width: 10}\n"
    "    - {x: 4.8, length: 10, width: 10}\n"
    "    - {x: -5.3, length: 10, width: 10}\n"
    "domain: {x_min: -60, x_max: 20, y_min: -20, y_max: 20}\n"
    "environment: {current_speed: 0.6}\n";

static int32_t asleep(const world *w)
{
    int32_t count = 0;
    for (int32_t i = 0; i < w->bodies.count; i++)
        count += w->bodies.motion[i] == MOTION_ASLEEP;
    return count;
}

START_TEST(half_the_step_wakes_nothing_by_itself)
{
    scene k;
    world copy;
    model fine;
    fram_error error = {0};
    scene_open(&k, leaning);
    scene_steps(&k, 2000);
    ck_assert_int_eq(asleep(&k.w), 2);
    copy_with_half_the_step(&k, &fine, &copy);
    ck_assert_int_gt(copy.memory.count, 0);
    assert_vec3_close(copy.memory.on_lower[0], vec3_scale(k.w.memory.on_lower[0], 0.5), 0);
    assert_bits(copy.joints.impulse[0].row[0], 0.5 * k.w.joints.impulse[0].row[0]);
    for (int i = 0; i < 400; i++) {
        assert_ok(world_step(&k.ctx, &fine, &copy, &error), error);
        ck_assert_int_eq(asleep(&copy), 2);
    }
    scene_steps(&k, 200);
    ck_assert_int_eq(asleep(&k.w), 2);
    world_free(&k.ctx, &copy);
    model_free(&k.ctx, &fine);
    scene_close(&k);
}
END_TEST

TEST_MAIN("copy", original_and_copy_go_the_same_way, a_copy_goes_on_with_half_the_step,
          half_the_step_wakes_nothing_by_itself)
