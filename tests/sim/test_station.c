/* Vessels held in ice: the balance of recorded forces of a towed hull, events of a vessel on station. */
#include "scene.h"

#include <stdio.h>

static vec3 channel3(const scene_row *r, const char *name)
{
    char full[64];
    double v[3];
    for (int i = 0; i < 3; i++) {
        snprintf(full, sizeof full, "%s_%c", name, "xyz"[i]);
        v[i] = scene_channel(r, full);
    }
    return vec3_make(v[0], v[1], v[2]);
}

static const char towed[] = "run:\n  duration: 60\n  time_step: 0.02\n  seed: 2\n"
                            "vessel:\n  mode: towed\n  x: -34\n  speed: 1\n  ramp: 0.5\n"
                            "  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
                            "ice:\n  concentration: 0.85\n  mean_floe_area: 64\n"
                            "domain:\n  x_min: -64\n  x_max: 64\n  y_min: -40\n  y_max: 40\n"
                            "environment:\n  current_speed: 0.2\n  current_direction_deg: 120\n";

/* |joint + ice + fluid + gravity - m dv/dt| at every step, over the largest ice load. */
static double worst_balance(const char *const *overrides, int count, int steps)
{
    scene k;
    scene_open_with(&k, towed, overrides, count);
    scene_row row = {0};
    double worst = 0, peak = 0, mass = k.w.bodies.mass[k.w.vessels.body[0]];
    vec3 before = k.w.bodies.velocity[k.w.vessels.body[0]];
    for (int i = 0; i < steps; i++) {
        scene_steps(&k, 1);
        scene_take(&k, &row);
        vec3 now = channel3(&row, "velocity"), ice = channel3(&row, "ice_force");
        vec3 left = vec3_add(vec3_add(channel3(&row, "tow_force"), ice), channel3(&row, "fluid_force"));
        left.z -= mass * k.m.media.gravity;
        left = vec3_mad(left, vec3_sub(now, before), -mass / k.m.time_step);
        worst = testing_larger(worst, vec3_length(left));
        peak = fmax(peak, vec3_length(ice));
        before = now;
    }
    ck_assert_msg(peak > 1e4, "the hull met no ice (%g N)", peak);
    series_layout_free(&k.ctx, &row.layout);
    scene_close(&k);
    return worst / peak;
}

START_TEST(forces_on_a_towed_hull_balance)
{
    double left = worst_balance(NULL, 0, 600);
    ck_assert_msg(left <= 1e-2, "default solver: %g of the peak is missing", left);
    static const char *const accurate[] = {"run.solver.kind=accurate", "run.solver.tolerance=1e-9"};
    left = worst_balance(accurate, 2, 500);
    ck_assert_msg(left <= 1e-6, "accurate solver: %g of the peak is missing", left);
}
END_TEST

static const char held[] =
    "run:\n  duration: 60\n  time_step: 0.05\n  seed: 3\n"
    "vessel:\n  mode: free\n  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "  thrusters:\n    - {x: 18, thrust: 80.0e3}\n    - {x: -18, y: 3, thrust: 80.0e3, failure_time: 20}\n"
    "    - {x: -18, y: -3, thrust: 80.0e3, failure_time: 60}\n"
    "  positioning: {active: true}\n"
    "  station: {offset_limit: 8}\n"
    "ice:\n  source: none\n"
    "domain:\n  boundary: open\n  x_min: -500\n"
    "environment:\n  current_speed: 0.5\n  current_direction_deg: 90\n  wind_speed: 10\n  wind_direction_deg: 120\n";

START_TEST(a_ship_holds_its_place_until_its_thrusters_fail)
{
    scene k;
    scene_open(&k, held);
    scene_row row = {0};
    scene_steps(&k, 59 * 20);
    scene_take(&k, &row);
    ck_assert(fabs(scene_channel(&row, "offset_x")) < 0.5 && fabs(scene_channel(&row, "offset_y")) < 1);
    ck_assert(scene_channel(&row, "thrusters_failed") == 1);
    ck_assert(scene_channel(&row, "thruster_2_thrust") == 0 && scene_channel(&row, "thruster_1_thrust") > 0);
    ck_assert(scene_channel(&row, "thruster_power") > 0);
    /* What the observer takes for the load is what the thrusters work against. */
    vec3 thrust = channel3(&row, "thruster_force"), load = channel3(&row, "estimated_load");
    ck_assert(vec2_dot((vec2){thrust.x, thrust.y}, (vec2){load.x, load.y}) < 0);
    ck_assert_int_eq(k.w.events.count, 1);
    ck_assert_int_eq(k.w.events.kind[0], EVENT_THRUSTER_FAILURE);
    ck_assert_int_eq(k.w.events.number[0], 1);
    for (int32_t i = 0; i < k.w.thrusters.count; i++)
        k.w.thrusters.failure_time[i] = 0;
    scene_steps(&k, 120 * 20);
    ck_assert_int_eq(k.w.events.count, 4);
    ck_assert_int_eq(k.w.events.kind[3], EVENT_POSITION_LOST);
    assert_absolute(k.w.events.value[3], 8, 0.1);
    series_layout_free(&k.ctx, &row.layout);
    scene_close(&k);
}
END_TEST

START_TEST(a_moored_ship_begins_in_balance)
{
    static const char moored[] =
        "run:\n  duration: 60\n  time_step: 0.05\n"
        "vessel:\n  mode: free\n  hull:\n    form: cone\n    length: 40\n    beam: 40\n    draught: 6\n"
        "    freeboard: 2\n"
        "    flare_angle_deg: 50\n"
        "  mooring:\n    depth: 60\n    lines:\n      - {count: 6, spacing_deg: 60, distance: 400, pretension: 3.0e5}\n"
        "ice:\n  source: none\n"
        "domain:\n  boundary: open\n"
        "environment:\n  current_speed: 2\n  current_direction_deg: 30\n";
    scene k;
    scene_open(&k, moored);
    vec3 start = k.w.bodies.position[0];
    ck_assert(start.x > 0.1 && start.y > 0.05);
    scene_row row = {0};
    scene_steps(&k, 1);
    scene_take(&k, &row);
    vec3 pull = channel3(&row, "mooring_force"), drag = channel3(&row, "fluid_force");
    assert_absolute(pull.x + drag.x, 0, 2e-3 * fabs(drag.x) + 1);
    assert_absolute(pull.y + drag.y, 0, 2e-3 * fabs(drag.y) + 1);
    assert_relative(scene_channel(&row, "line_4_tension"), scene_channel(&row, "line_tension_max"), 0.05);
    scene_steps(&k, 400);
    assert_absolute(k.w.bodies.position[0].x, start.x, 0.1);
    assert_absolute(k.w.bodies.position[0].y, start.y, 0.1);
    series_layout_free(&k.ctx, &row.layout);
    scene_close(&k);
}
END_TEST

/* Under way by a given thrust: the speed at which drag balances it. */
START_TEST(transit_at_a_given_thrust)
{
    static const char ship[] =
        "run: {time_step: 0.1}\n"
        "vessel:\n  mode: free\n  hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2}\n"
        "  thrusters:\n    - {kind: main, x: -18, z: -2, thrust: 60.0e3, setting: 0.5}\n"
        "ice: {source: none}\ndomain: {boundary: open, x_max: 2000}\n"
        "environment:\n  hull_drag: {water_form: 1, water_skin: 0, air_form: 0, air_skin: 0}\n";
    scene k;
    scene_open(&k, ship);
    scene_steps(&k, 4000);
    assert_relative(k.w.thrusters.thrust[0], 30e3, 1e-3);
    assert_relative(k.w.bodies.velocity[0].x, sqrt(2 * 30e3 / (1025 * 48)), 0.01);
    assert_absolute(k.w.bodies.velocity[0].y, 0, 1e-6);
    scene_close(&k);
}
END_TEST

/* 160 N for each kilowatt at the larger thrust of the two ways, that of an azimuth alone; thrust over it to 3/2. */
START_TEST(power_is_that_of_the_larger_thrust)
{
    static const char ship[] =
        "run: {time_step: 0.1}\n"
        "vessel:\n  mode: free\n  hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2}\n"
        "  thrusters:\n"
        "    - {kind: main, thrust: 100.0e3, thrust_astern: 200.0e3, setting: -1, time_constant: 0, speed_rate: 100}\n"
        "    - {kind: tunnel, thrust: 100.0e3, thrust_astern: 200.0e3, setting: 1, time_constant: 0, speed_rate: 100}\n"
        "    - {kind: main, thrust: 200.0e3, thrust_astern: 0}\n"
        "    - {kind: azimuth, thrust: 100.0e3, thrust_astern: 200.0e3}\n"
        "ice: {source: none}\ndomain: {boundary: open}\n";
    scene k;
    scene_open(&k, ship);
    scene_steps(&k, 1);
    assert_relative(thruster_power(&k.w.thrusters, 0), 1.25e6, 1e-12);
    assert_relative(thruster_power(&k.w.thrusters, 1), 1.25e6 / sqrt(8), 1e-12);
    assert_relative(k.w.thrusters.full_power[2], 1.25e6, 1e-12);
    assert_relative(k.w.thrusters.full_power[3], 0.625e6, 1e-12);
    scene_close(&k);
}
END_TEST

/* Measurements are taken and orders given at their own intervals, and the noise has the deviation that is asked for. */
START_TEST(sensors_and_controller_keep_their_own_time)
{
    scene k;
    scene_open_with(&k, held,
                    (const char *const[]){"vessel.positioning.interval=0.5", "vessel.positioning.sample_interval=1",
                                          "vessel.positioning.noise_position=0.2"},
                    3);
    const station_table *s = &k.w.stations;
    vec3 measured = s->measured[0], demand = s->demand[0];
    double square = 0;
    int samples = 0, orders = 0;
    for (int i = 0; i < 8000; i++) {
        vec3 true_place = k.w.bodies.position[k.w.vessels.body[0]];
        scene_steps(&k, 1);
        bool fresh = vec3_length(vec3_sub(measured, s->measured[0])) > 0;
        bool ordered = vec3_length(vec3_sub(demand, s->demand[0])) > 0;
        ck_assert_msg(!fresh || i % 20 == 0, "a measurement in step %d", i);
        ck_assert_msg(!ordered || i % 10 == 0, "an order in step %d", i);
        measured = s->measured[0];
        demand = s->demand[0];
        orders += ordered;
        if (!fresh)
            continue;
        samples++;
        double x = measured.x - true_place.x, y = measured.y - true_place.y;
        square += x * x + y * y;
    }
    ck_assert_int_eq(samples, 400);
    ck_assert_int_eq(orders, 800);
    assert_relative(sqrt(square / (2 * samples)), 0.2, 0.1);
    scene_close(&k);
}
END_TEST

/* Largest offset after a load of 60 kN that comes at once, which strain gauges tell as ice. */
static double offset_under_load(const char *feed)
{
    scene k;
    fram_error error = {0};
    scene_open_with(&k, held,
                    (const char *const[]){feed, "vessel.positioning.feed_forward_gain=1",
                                          "vessel.positioning.feed_forward_time=2",
                                          "vessel.positioning.noise_position=0", "environment.current_speed=0",
                                          "environment.wind_speed=0"},
                    6);
    for (int32_t i = 0; i < k.w.thrusters.count; i++)
        k.w.thrusters.failure_time[i] = 1e9;
    double largest = 0;
    for (int i = 0; i < 2400; i++) {
        const wrench push = {{-60e3, 0, 0}, {0, 0, 0}};
        assert_ok(world_add_wrench(&k.ctx, &k.w, k.w.vessels.body[0], push, &error), error);
        scene_steps(&k, 1);
        k.w.load_window.force[i % k.w.load_window.count] = push.force;
        largest = testing_larger(largest, fabs(k.w.stations.offset[0].x));
    }
    scene_close(&k);
    return largest;
}

START_TEST(feed_forward_of_the_ice_load)
{
    double none = offset_under_load("vessel.positioning.feed_forward=none");
    double measured = offset_under_load("vessel.positioning.feed_forward=measured");
    double observed = offset_under_load("vessel.positioning.feed_forward=observed");
    ck_assert_msg(measured < 0.5 * none, "%g m with the load fed forward, %g m without", measured, none);
    ck_assert_msg(observed < none, "%g m with the observed load fed forward, %g m without", observed, none);
}
END_TEST

/* A ship on a turret, pushed aside and turned; thrusters fore and aft. */
static const char assisted[] =
    "run:\n  time_step: 0.1\n"
    "vessel:\n  mode: free\n  hull: {form: ship, length: 80, beam: 16, draught: 5, freeboard: 3}\n"
    "  mooring:\n    turret: true\n    depth: 100\n"
    "    lines:\n      - {kind: spring, count: 4, spacing_deg: 90, distance: 200,\n"
    "         pretension: 2.0e5, stiffness: 2.0e4}\n"
    "  thrusters:\n    - {kind: tunnel, x: 30, thrust: 1.5e5}\n    - {kind: tunnel, x: -30, thrust: 1.5e5}\n"
    "  positioning:\n    active: true\n    feed_forward: observed\n    noise_position: 0\n    noise_heading_deg: 0\n"
    "ice: {source: none}\ndomain: {boundary: open}\n";

/* Offset, heading deviation, and force and moment of the thrusters after five minutes of a steady push.  forward: place
   of the forward thruster [m]. */
static void push_assisted(const char *control, double forward, vec3 *offset, wrench *thrust)
{
    scene k;
    fram_error error = {0};
    vec3 sum = {0, 0, 0};
    char place[48];
    snprintf(place, sizeof place, "vessel.thrusters[0].x=%g", forward);
    scene_open_with(&k, assisted, (const char *const[]){control, place}, 2);
    bool heading_alone = station_is_of_heading_alone(&k.w.stations, 0);
    for (int i = 0; i < 3000; i++) {
        const wrench push = {{-10e3, 20e3, 0}, {0, 0, 2e6}};
        assert_ok(world_add_wrench(&k.ctx, &k.w, k.w.vessels.body[0], push, &error), error);
        scene_steps(&k, 1);
        /* It swings about its place with little damping, for 70 s a time: the mean of the last four. */
        if (i >= 3000 - 2800)
            sum = vec3_add(sum, k.w.stations.offset[0]);
    }
    *offset = vec3_make(sum.x / 2800, sum.y / 2800, k.w.stations.offset[0].z);
    *thrust = k.w.stations.thruster_load[0];
    if (heading_alone) {
        const vec3 demand = k.w.stations.demand[0];
        ck_assert(demand.x == 0 && demand.y == 0 && demand.z != 0);
        ck_assert_msg(k.w.stations.saturated[0] == 0, "the moment is not reached");
    }
    scene_close(&k);
}

/* Thrusters that assist a mooring: the heading is held, all force is left to the lines, and the ship lies where the
   lines alone would have it. */
START_TEST(heading_alone)
{
    vec3 free, turned, placed;
    wrench none, couple, all;
    push_assisted("vessel.positioning.active=false", 30, &free, &none);
    push_assisted("vessel.positioning.control=heading", 30, &turned, &couple);
    push_assisted("vessel.positioning.control=all", 30, &placed, &all);
    ck_assert_msg(fabs(degrees(free.z)) > 20, "without thrusters it turns by %g degrees only", degrees(free.z));
    assert_absolute(degrees(turned.z), 0, 0.5);
    assert_relative(couple.moment.z, -2e6, 0.02);
    assert_absolute(couple.force.x, 0, 1);
    assert_absolute(couple.force.y, 0, 500);
    /* Of springs that lead down at an angle a each gives k cos^2 a along itself, and pretension over its way across. */
    double way = sqrt(200 * 200 + 100 * 100), along = 200 / way;
    double stiffness = 2 * 2.0e4 * along * along + 2 * 2.0e5 / way * (2 - along * along);
    assert_relative(sqrt(turned.x * turned.x + turned.y * turned.y), sqrt(5) * 10e3 / stiffness, 0.2);
    ck_assert(fabs(placed.y) < 0.3 * fabs(turned.y) && fabs(all.force.y) > 10e3);
}
END_TEST

/* Thrusters astern alone turn the ship by pushing aside, which the lines hold as they hold the rest. */
START_TEST(heading_alone_from_one_end)
{
    vec3 offset;
    wrench thrust;
    push_assisted("vessel.positioning.control=heading", -26, &offset, &thrust);
    assert_absolute(degrees(offset.z), 0, 0.5);
    /* Both push alike, by their levers: with 2 MN m over 26 and 30 m, squared, in all. */
    double aside = 2e6 * (26 + 30) / (26 * 26 + 30 * 30);
    assert_relative(thrust.force.y, aside, 0.1);
    ck_assert_msg(offset.y > 1.5, "%g m aside, as if the thrust did not reach the lines", offset.y);
}
END_TEST

/* Pushed to port, with thrusters that turn it alone: the lines hold all of the push, and against that the bow goes. */
START_TEST(a_moored_ship_turns_against_the_load)
{
    static const char *const vanes[] = {"vessel.positioning.control=heading", "vessel.positioning.heading=vaning",
                                        "vessel.positioning.vaning_rate_deg=1", "vessel.positioning.vaning_time=20",
                                        "vessel.positioning.vaning_load=1e4"};
    scene k;
    fram_error error = {0};
    vec3 sum = {0, 0, 0};
    scene_open_with(&k, assisted, vanes, 5);
    for (int i = 0; i < 2000; i++) {
        const wrench push = {{0, 60e3, 0}, {0, 0, 0}};
        assert_ok(world_add_wrench(&k.ctx, &k.w, k.w.vessels.body[0], push, &error), error);
        scene_steps(&k, 1);
        /* The mean of two times of its swinging about its place, of 71 s. */
        if (i >= 2000 - 1420)
            sum = vec3_add(sum, station_load(&k.w.stations, 0));
    }
    assert_absolute(degrees(k.w.stations.vane_heading[0]), -90, 5);
    assert_absolute(sum.x / 1420, 0, 6e3);
    assert_absolute(sum.y / 1420, 60e3, 6e3);
    scene_close(&k);
}
END_TEST

/* Way points of a ship that is turned only: it has not moved, and is not off by what their x and y say. */
START_TEST(offsets_of_a_moored_ship_are_those_of_its_mooring)
{
    static const char *const there[] = {"vessel.positioning.control=heading", "vessel.x=50", "vessel.y=20"};
    scene k;
    scene_open_with(&k, assisted, there, 3);
    ck_assert(table_resize(&k.ctx, &k.w.waypoints, &waypoint_table_info, 1));
    k.w.waypoints.time[0] = 20;
    k.w.waypoints.place[0] = vec3_make(0, 0, radians(30));
    vec3 off = station_deviation(&k.w.stations, 0, 20, &k.w.vessels, &k.w.bodies, &k.w.waypoints);
    assert_absolute(off.x, 0, 1e-9);
    assert_absolute(off.y, 0, 1e-9);
    assert_absolute(degrees(off.z), -30, 1e-9);
    scene_close(&k);
}
END_TEST

TEST_MAIN("station", heading_alone, heading_alone_from_one_end, a_moored_ship_turns_against_the_load,
          offsets_of_a_moored_ship_are_those_of_its_mooring, transit_at_a_given_thrust,
          power_is_that_of_the_larger_thrust, sensors_and_controller_keep_their_own_time, feed_forward_of_the_ice_load,
          forces_on_a_towed_hull_balance, a_ship_holds_its_place_until_its_thrusters_fail,
          a_moored_ship_begins_in_balance)
