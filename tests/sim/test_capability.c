/* The capability plot of simple ships against balances by hand, and its loads. */
#include "scene.h"
#include "sim/capability.h"

#include <unistd.h>

/* A box whose only load is form drag of the current: 1/2 rho v^2 A with A = 12 x 4 m ahead, 60 x 4 m abeam. */
static const char box[] =
    "vessel:\n  mode: free\n  heading_deg: 30\n  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 2}\n"
    "  thrusters:\n    - {kind: main, x: -25, thrust: 60.0e3, thrust_astern: 30.0e3}\n"
    "    - {kind: tunnel, x: 20, thrust: 50.0e3}\n    - {kind: tunnel, x: -20, thrust: 50.0e3}\n"
    "ice: {source: none}\n"
    "domain: {boundary: open}\n"
    "environment:\n  hull_drag: {water_form: 1, water_skin: 0, air_form: 0, air_skin: 0}\n";

static const capability_options plain = {.directions = 8,
                                         .speed_step = 0.25,
                                         .speed_most = 3,
                                         .allowance = 1.25,
                                         .measure = 1,
                                         .line_safety = 2,
                                         .line_safety_damaged = 1.43};

static double speed_for(double force, double area) { return sqrt(force / (1.25 * 0.5 * 1025 * area)); }

START_TEST(limits_by_hand)
{
    scene k;
    scene_open(&k, box);
    capability c;
    fram_error error = {0};
    assert_ok(capability_find(&k.ctx, &k.s, &plain, &c, &error), error);
    assert_relative(c.intact[0].speed, speed_for(60e3, 48), 2e-3);
    assert_relative(c.intact[4].speed, speed_for(30e3, 48), 2e-3);
    assert_relative(c.intact[2].speed, speed_for(100e3, 240), 2e-3);
    assert_relative(c.intact[6].speed, speed_for(100e3, 240), 2e-3);
    ck_assert_int_eq(c.intact[0].at.item, HOLDING_THRUSTER);
    ck_assert_int_eq(c.intact[0].at.number, 0);
    /* A quarter: both components must be held; drag is by the component on each face. */
    ck_assert(c.intact[1].speed > c.intact[2].speed && !c.intact[1].beyond);
    assert_relative(c.intact[1].speed, sqrt(2.0) * speed_for(100e3, 240), 2e-3);
    ck_assert_int_eq(c.failures, 3);
    ck_assert(c.damaged[0].speed < 1e-3 && c.damaged[0].failure == 0);
    ck_assert(c.damaged[2].speed < 1e-3 && c.damaged[2].failure >= 1);
    /* Use grows with the square of the speed; ring 1 of direction 0 is 0.5 m/s. */
    double share = 0.25 / (speed_for(60e3, 48) * speed_for(60e3, 48));
    assert_relative(c.use[1].use, share, 2e-3);
    capability_free(&k.ctx, &c);
    scene_close(&k);
}
END_TEST

/* Thrusters that fail, and lines that are let go, at the start of a run hold nothing, nor are they what is lost. */
START_TEST(out_of_order_from_the_start)
{
    scene k;
    scene_open_with(&k, box, (const char *const[]){"vessel.thrusters[1].failure_time=0"}, 1);
    capability c;
    fram_error error = {0};
    assert_ok(capability_find(&k.ctx, &k.s, &plain, &c, &error), error);
    ck_assert_int_eq(c.failures, 2);
    ck_assert(c.failure[0].number == 0 && c.failure[1].number == 2);
    ck_assert(c.intact[2].speed < 1e-3 && c.intact[0].speed > 1);
    capability_free(&k.ctx, &c);
    scene_close(&k);
    static const char moored[] =
        "vessel:\n  mode: free\n  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 2}\n"
        "  mooring:\n    lines:\n"
        "      - {kind: spring, distance: 300, stiffness: 1.0e4, pretension: 1.0e5, breaking_load: 4.0e5,\n"
        "         fairlead_distance: 30, release_time: 0}\n"
        "      - {kind: spring, distance: 300, stiffness: 1.0e4, pretension: 1.0e5, breaking_load: 4.0e5,\n"
        "         fairlead_distance: 30, direction_deg: 180}\n"
        "ice: {source: none}\ndomain: {boundary: open}\n";
    scene_open(&k, moored);
    assert_ok(capability_find(&k.ctx, &k.s, &plain, &c, &error), error);
    ck_assert_int_eq(c.failures, 1);
    ck_assert(c.failure[0].line && c.failure[0].number == 1);
    capability_free(&k.ctx, &c);
    scene_close(&k);
}
END_TEST

START_TEST(broken_ice_by_formula)
{
    /* B 18, h 1, S .8, v 1.5, rho 910: 379.8 kN (docs/oracles.md, section 8). */
    assert_relative(broken_ice_resistance(910, 9.81, 18, 1, 0.8, 1.5), 379.8e3, 1e-3);
    scene k;
    scene_open_with(&k, box, (const char *const[]){"ice.source=voronoi", "ice.density=910", "ice.thickness=0.5"}, 3);
    capability_options o = plain;
    capability c;
    fram_error error = {0};
    o.formula = true;
    assert_ok(capability_find(&k.ctx, &k.s, &o, &c, &error), error);
    double ahead = broken_ice_resistance(910, 9.81, 12, 0.5, 0.8, 0.5);
    double abeam = broken_ice_resistance(910, 9.81, 60, 0.5, 0.8, 0.5);
    assert_relative(-c.loads.ice[1].x, ahead, 1e-6);
    assert_relative(c.loads.ice[2 * c.loads.speeds + 1].y, abeam, 1e-6);
    assert_absolute(c.loads.ice[2 * c.loads.speeds + 1].z, 0, 1e-3 * abeam);
    /* With the allowance, and the drag. */
    vec3 sum = capability_load_at(&c, 0, 0.5);
    assert_relative(-sum.x, 1.25 * (ahead + 0.5 * 1025 * 0.25 * 48), 1e-3);
    capability_free(&k.ctx, &c);
    /* Measuring needs ice that is driven past. */
    o.formula = false;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "domain.boundary");
    scene_close(&k);
}
END_TEST

/* Ice that drifts onto a hull from ahead pushes it astern, from starboard to port; mirrored from port. */
START_TEST(measured_ice)
{
    scene k;
    static const char *const ice[] = {"ice.source=voronoi",    "ice.concentration=0.9",   "ice.mean_floe_area=80",
                                      "ice.thickness=0.6",     "domain.boundary=feeding", "domain.x_min=-70",
                                      "domain.x_max=70",       "domain.y_min=-70",        "domain.y_max=70",
                                      "vessel.hull.length=40", "run.time_step=0.05"};
    scene_open_with(&k, box, ice, sizeof ice / sizeof *ice);
    capability_options o = plain;
    o.directions = 4;
    o.speed_step = o.speed_most = 0.8;
    o.measure = 20;
    capability c;
    fram_error error = {0};
    assert_ok(capability_find(&k.ctx, &k.s, &o, &c, &error), error);
    const vec3 *load = c.loads.ice;
    ck_assert(load[0].x < -1e3 && load[2].x > 1e3);
    ck_assert(load[1].y > 1e3);
    assert_absolute(load[3].y, -load[1].y, 0);
    assert_absolute(load[3].x, load[1].x, 0);
    capability_free(&k.ctx, &c);
    scene_close(&k);
}
END_TEST

/* Four fifths of the ice in floes of 4 m, the rest in floes of 9 m: of the field that is made for the vessel as much.
 */
START_TEST(ice_that_was_met)
{
    scene k;
    scene_open_with(&k, box, (const char *const[]){"vessel.x=50", "ice.density=900"}, 2);
    k.s.ice.source = ICE_LEVEL;
    managed_ice sum = {.windows = 0};
    for (int i = 0; i < 2; i++) {
        managed_cover window = {.sheet = 0};
        managed_cover_add(&window, i ? 4 : 9, i ? 0.6 : 0.3);
        managed_cover_add(&window, 4, 0.3);
        window.volume = 0.45;
        managed_ice_add(&sum, &window, i ? 4 : 9);
    }
    capability_met_ice met = {.windows = 2, .sheet_as = (double)NAN};
    fram_error error = {0};
    assert_ok(managed_law_of(&sum, (double)NAN, &met.law, &error), error);
    const size_law sizes = managed_size_law(&met.law);
    scenario_population population;
    scenario s;
    assert_ok(capability_met_scenario(&k.s, &met, 120, &population, &sizes, &s, &error), error);
    ck_assert_double_eq(s.domain.x_min, -10);
    ck_assert_double_eq(s.domain.x_max, 110);
    ck_assert_double_eq(s.domain.y_max, 60);
    ck_assert_double_eq(s.ice.density, 900);
    assert_relative(s.ice.thickness, 0.6, 1e-12);
    model m;
    world w;
    field_report report;
    s.vessel.present = false;
    assert_ok(build_model(&k.ctx, &s, &m, &error), error);
    assert_ok(build_world(&k.ctx, &s, &m, &w, &report, &error), error);
    double small = 0, large = 0;
    for (int32_t i = 0; i < w.floes.count; i++) {
        double size = sqrt(4 / PI * w.floes.area[i]);
        *(size < 6 ? &small : &large) += w.floes.area[i];
    }
    assert_relative(report.concentration, 0.75, 0.01);
    /* The window shows some thirty of the large floes; by numbers, not areas, it would be 20. */
    assert_relative(small / large, 4, 0.25);
    world_free(&k.ctx, &w);
    model_free(&k.ctx, &m);
    scene_close(&k);
}
END_TEST

START_TEST(refusals)
{
    scene k;
    scene_open(&k, box);
    capability c;
    fram_error error = {0};
    capability_options o = plain;
    o.directions = 2;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    o = plain;
    const capability_met_ice met = {.windows = 1};
    o.met = &met;
    o.formula = true;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "formula");
    o = plain;
    o.speed_step = 0;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    o = plain;
    o.allowance = 0.5;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "allowance");
    o = plain;
    o.line_safety_damaged = 0;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "line_safety_damaged");
    o = plain;
    o.measure = (double)NAN;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    k.s.vessel.thrusters.count = 0;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &plain, &c, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "vessel");
    k.s.vessel.thrusters.count = 3;
    scene_close(&k);
}
END_TEST

/* The balances alone, and the runs before them, see the flag. */
START_TEST(a_stop_flag_is_seen)
{
    const volatile int stop = 1;
    const char *const ice[] = {"ice.source=voronoi", "domain.boundary=feeding"};
    for (int runs = 0; runs < 2; runs++) {
        scene k;
        scene_open_with(&k, box, ice, runs ? 2 : 0);
        capability_options o = plain;
        o.stop = &stop;
        capability c;
        fram_error error = {0};
        assert_fails(capability_find(&k.ctx, &k.s, &o, &c, &error), error, FRAM_INTERRUPTED, "nothing was written");
        scene_close(&k);
    }
}
END_TEST

TEST_MAIN("capability", limits_by_hand, out_of_order_from_the_start, broken_ice_by_formula, measured_ice,
          ice_that_was_met, refusals, a_stop_flag_is_seen)
