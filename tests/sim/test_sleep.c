/* Floes that rest sleep, and whatever would move them wakes them (dynamics/rest.h): a row of floes does as it does
   awake. */
#include "sim/scene.h"

#include "ice/floe.h"

enum { ROW = 5, STRIKER = ROW };
#define SPEED 0.02
#define PITCH 10.001
#define STEP 0.02

/* Floes of 10 m in a row along x, the sixth 5 m before it; neither water nor weight, so that momentum is kept. */
static const char row[] = "run: {duration: 100, time_step: 0.02}\nvessel: {present: false}\n"
                          "ice:\n  source: floes\n  sleep_time: 1\n  floes:\n"
                          "    - {length: 10, width: 10, x: 0}\n    - {length: 10, width: 10, x: 10.001}\n"
                          "    - {length: 10, width: 10, x: 20.002}\n    - {length: 10, width: 10, x: 30.003}\n"
                          "    - {length: 10, width: 10, x: 40.004}\n    - {length: 10, width: 10, x: -15}\n"
                          "domain: {x_min: -100, x_max: 100, y_min: -20, y_max: 20, boundary: open}\n"
                          "environment: {water: false}\n";

static void open_row(scene *k, bool sleeps)
{
    static const char *const on[] = {"ice.sleep_speed=0.02"};
    scene_open_with(k, row, on, sleeps ? 1 : 0);
}

static int asleep(const scene *k)
{
    int count = 0;
    for (int32_t i = 0; i < k->w.bodies.count; i++)
        count += k->w.bodies.motion[i] == MOTION_ASLEEP;
    return count;
}

static double mass_of(const scene *k) { return k->w.bodies.mass[scene_floe(k, 0)]; }

START_TEST(what_rests_falls_asleep_after_its_time)
{
    scene k;
    open_row(&k, true);
    scene_steps(&k, 45);
    ck_assert_int_eq(asleep(&k), 0);
    scene_steps(&k, 10);
    ck_assert_int_eq(asleep(&k), ROW + 1);
    scene_close(&k);
    open_row(&k, false);
    scene_steps(&k, 55);
    ck_assert_int_eq(asleep(&k), 0);
    ck_assert_int_eq(k.w.rest.count, 0);
    scene_close(&k);
}
END_TEST

/* The last floe of a row strikes it at 1 m/s. */
static void strike_row(scene *k, bool sleeps)
{
    open_row(k, sleeps);
    scene_steps(k, 60);
    int32_t striker = scene_floe(k, STRIKER);
    rest_wake(&k->w.bodies, &k->w.rest, striker);
    k->w.bodies.velocity[striker].x = 1;
    scene_steps(k, 400);
}

START_TEST(a_row_that_sleeps_is_struck_as_one_awake)
{
    scene a, b;
    strike_row(&a, true);
    strike_row(&b, false);
    double momentum = 0;
    for (int32_t n = 0; n <= STRIKER; n++) {
        vec3 at = a.w.bodies.position[scene_floe(&a, n)], v = a.w.bodies.velocity[scene_floe(&a, n)];
        vec3 other = b.w.bodies.position[scene_floe(&b, n)];
        momentum += v.x * mass_of(&a);
        /* A blow goes on by one floe a step, which it passes in one step where all are awake. */
        ck_assert_double_le(vec3_length(vec3_sub(at, other)), 0.1);
        ck_assert_double_ge(at.x, n == STRIKER ? -10.01 : n * PITCH + 0.2);
    }
    /* Who is struck wakes before the blow is solved, so that nothing of it is missed. */
    ck_assert_double_eq_tol(momentum / mass_of(&a), 1, 1e-9);
    scene_close(&a);
    scene_close(&b);
}
END_TEST

/* The first floe is pushed along the row, at first by less than moves anybody within a step. */
static double pushed_to(bool sleeps, double acceleration)
{
    scene k;
    fram_error error = {0};
    open_row(&k, sleeps);
    scene_steps(&k, 60);
    wrench push = {.force = {acceleration * mass_of(&k) * ROW, 0, 0}};
    for (int step = 0; step < 500; step++) {
        assert_ok(world_add_wrench(&k.ctx, &k.w, scene_floe(&k, 0), push, &error), error);
        scene_steps(&k, 1);
    }
    double x = k.w.bodies.position[scene_floe(&k, ROW - 1)].x - (ROW - 1) * PITCH;
    scene_close(&k);
    return x;
}

START_TEST(a_slow_push_goes_through_a_row_that_sleeps)
{
    /* Three times what may be missed: the speed at which floes sleep, over the time. */
    double awake = pushed_to(false, 3 * SPEED), slept = pushed_to(true, 3 * SPEED);
    ck_assert_double_eq_tol(awake, 0.5 * 3 * SPEED * 100, 0.05);
    ck_assert_double_le(slept, awake + 1e-6);
    /* Each of the four before the last begins later, and has missed its speed at most. */
    ck_assert_double_ge(slept, awake - (ROW - 1) * SPEED * 10);
}
END_TEST

START_TEST(another_wind_wakes_all)
{
    scene k;
    open_row(&k, true);
    scene_steps(&k, 60);
    ck_assert_int_eq(asleep(&k), ROW + 1);
    scene_tell(&k, INPUT_WIND, 1e-3, 0);
    scene_steps(&k, 1);
    ck_assert_int_eq(asleep(&k), 0);
    /* In wind what nothing holds does not fall asleep again. */
    scene_steps(&k, 60);
    ck_assert_int_eq(k.w.bodies.motion[scene_floe(&k, STRIKER)], MOTION_DYNAMIC);
    scene_close(&k);
}
END_TEST

START_TEST(what_lost_its_neighbour_wakes)
{
    scene k;
    open_row(&k, true);
    scene_steps(&k, 60);
    floe_remove(&k.w.bodies, &k.w.shapes, &k.w.floes, 0);
    scene_steps(&k, 1);
    ck_assert_int_eq(k.w.bodies.motion[scene_floe(&k, 1)], MOTION_DYNAMIC);
    ck_assert_int_eq(k.w.bodies.motion[scene_floe(&k, 2)], MOTION_ASLEEP);
    scene_close(&k);
}
END_TEST

/* A hull into floes that float: what it meets is awake before it touches it, and its load is that of ice awake. */
static double towed_impulse(bool sleeps, int *near_asleep)
{
    static const char towed[] = "run: {duration: 100, time_step: 0.02, seed: 3}\n"
                                "vessel: {mode: towed, x: -45, speed: 2, ramp: 0.5,\n"
                                "  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}\n"
                                "ice: {concentration: 0.7, mean_floe_area: 60, thickness: 0.5, sleep_time: 0.5}\n"
                                "domain: {x_min: -75, x_max: 40, y_min: -25, y_max: 25}\n";
    static const char *const on[] = {"ice.sleep_speed=0.02"};
    scene k;
    double sum = 0;
    scene_open_with(&k, towed, on, sleeps ? 1 : 0);
    int32_t hull = k.w.vessels.body[0];
    for (int step = 0; step < 600; step++) {
        scene_steps(&k, 1);
        for (int32_t i = 0; i < k.w.scratch.contacts.count; i++) {
            const contact *c = &k.w.scratch.contacts.data[i];
            if (c->a != hull && c->b != hull)
                continue;
            vec3 impulse = contact_impulse(c);
            sum += c->a == hull ? -impulse.x : impulse.x;
        }
        for (int32_t i = 0; i < k.w.pairs.count; i++) {
            int32_t a = k.w.pairs.a[i], b = k.w.pairs.b[i];
            *near_asleep += (a == hull && k.w.bodies.motion[b] == MOTION_ASLEEP) ||
                            (b == hull && k.w.bodies.motion[a] == MOTION_ASLEEP);
        }
    }
    ck_assert_int_eq(asleep(&k) > 5, sleeps);
    scene_close(&k);
    return sum;
}

/* A push too small to wake anybody is remembered, and forgotten when it has faded. */
START_TEST(pushes_are_forgotten_in_time)
{
    scene k;
    fram_error error = {0};
    open_row(&k, true);
    scene_steps(&k, 60);
    const rest_table *r = &k.w.rest;
    int32_t first = scene_floe(&k, 0), next = scene_floe(&k, 1);
    ck_assert_int_eq(r->touch[next], REST_RECALLS); /* fallen asleep lately */
    scene_steps(&k, 4 * 50 + 10);
    ck_assert_int_eq(r->touch[next], 0);
    wrench push = {.force = {0.05 * SPEED / STEP * mass_of(&k), 0, 0}};
    for (int step = 0; step < 3; step++) {
        assert_ok(world_add_wrench(&k.ctx, &k.w, first, push, &error), error);
        scene_steps(&k, 1);
    }
    scene_steps(&k, 20); /* a millimetre to go */
    ck_assert_int_eq(k.w.bodies.motion[next], MOTION_ASLEEP);
    ck_assert_int_eq(r->touch[next], REST_RECALLS);
    ck_assert_double_gt(r->gain[next].x, 0);
    rest_wake(&k.w.bodies, &k.w.rest, first);
    k.w.bodies.velocity[first] = vec3_make(-1.5 * SPEED, 0, 0); /* away, too slowly to wake */
    scene_steps(&k, 4 * 50);
    ck_assert_int_eq(r->touch[next], REST_RECALLS);
    ck_assert_double_gt(r->mean_push[next].x, 0);
    scene_steps(&k, 16 * 4 * 50);
    ck_assert_int_eq(k.w.bodies.motion[next], MOTION_ASLEEP);
    ck_assert_int_eq(r->touch[next], 0);
    assert_bits(r->mean_push[next].x, 0);
    assert_bits(r->gain[next].x, 0);
    assert_bits(r->age[next], 4);
    scene_close(&k);
}
END_TEST

/* What fell asleep in another wind wakes, too, when its state is given to a world that knows this wind. */
START_TEST(a_state_that_is_given_is_looked_at)
{
    scene k, other;
    fram_error error = {0};
    open_row(&k, true);
    open_row(&other, true);
    scene_steps(&k, 60);
    scene_steps(&other, 60);
    ck_assert_int_eq(asleep(&k), ROW + 1);
    for (int32_t i = 0; i < other.w.rest.count; i++)
        other.w.rest.wind[i].x = 3;
    assert_ok(world_copy_state(&k.ctx, &k.w, &other.w, &error), error);
    ck_assert_int_eq(asleep(&k), ROW + 1);
    scene_steps(&k, 1);
    ck_assert_int_eq(asleep(&k), 0);
    scene_close(&k);
    scene_close(&other);
}
END_TEST

START_TEST(a_hull_meets_ice_awake)
{
    int near = 0;
    double awake = towed_impulse(false, &near), slept = towed_impulse(true, &near);
    ck_assert_int_eq(near, 0);
    ck_assert_double_gt(awake, 0);
    ck_assert_double_eq_tol(slept / awake, 1, 0.01);
}
END_TEST

TEST_MAIN("sleep", what_rests_falls_asleep_after_its_time, a_row_that_sleeps_is_struck_as_one_awake,
          a_slow_push_goes_through_a_row_that_sleeps, another_wind_wakes_all, what_lost_its_neighbour_wakes,
          pushes_are_forgotten_in_time, a_state_that_is_given_is_looked_at, a_hull_meets_ice_awake)
