/* Wind and current coefficients of a scenario: what the hull then meets, and tables that are refused by name. */
#include "scene.h"
#include "sim/steady_load.h"

#include <stdio.h>

/* Held by the carriage in a current to port (from starboard) and a wind on the stern. */
#define BOX "vessel:\n  mode: towed\n  speed: 0\n  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 3}\n"
#define SEA                                                                                                        \
    "ice: {source: none}\ndomain: {boundary: open}\nenvironment: {current_speed: 0.8, current_direction_deg: 90, " \
    "wind_speed: 10, wind_direction_deg: 0}\n"

static const char tables[] = BOX "  current_coefficients:\n    x: 3\n    lateral_area: 250\n    table:\n"
                                 "      - {angle_deg: 0, cx: 0.1}\n      - {angle_deg: 90, cy: 0.7, cn: -0.05}\n"
                                 "      - {angle_deg: 180, cx: -0.1}\n"
                                 "  wind_coefficients:\n    table:\n      - {angle_deg: 0, cx: 0.8}\n"
                                 "      - {angle_deg: 180, cx: -0.9}\n" SEA;

START_TEST(the_hull_meets_the_tables)
{
    scene k;
    scene_open(&k, tables);
    scene_steps(&k, 1);
    const fluid_load *f = &k.w.scratch.fluid.data[0];
    double q = 0.5 * 1025 * 0.64, wind = 0.5 * 1.225 * 100;
    assert_relative(f->water_drag.force.y, q * 0.7 * 250, 1e-9);
    assert_absolute(f->water_drag.force.x, 0, 1e-6 * q);
    assert_relative(f->water_drag.moment.z, q * (0.7 * 250 * 3 - 0.05 * 250 * 60), 1e-9);
    assert_relative(f->wind_drag.force.x, wind * 0.8 * 12 * 3, 1e-9);
    /* What the equilibrium and the capability plot take is the same. */
    vec3 still = steady_media_load(&k.m, &k.w, 0, &k.m.media, 0);
    assert_relative(still.y, q * 0.7 * 250, 1e-9);
    assert_relative(still.x, wind * 0.8 * 12 * 3, 1e-9);
    /* They act at the middle of what is in the water, and of what is over it. */
    const vessel_model *v = &k.m.vessels.data[0];
    assert_absolute(v->flows.water.point.z + v->centre.z, -2, 1e-12);
    assert_absolute(v->flows.air.point.z + v->centre.z, 1.5, 1e-12);
    scene_close(&k);
}
END_TEST

/* A table of a whole turn whose last angle lacks what a conversion rounds off, in a current a hair past its end: that
   is the angle 0, not the other side of a ship with equal sides. */
START_TEST(a_turn_that_was_rounded_is_whole)
{
    scene k;
    scene_open(&k, BOX "  current_coefficients:\n    table:\n      - {angle_deg: 0, cx: 0.1, cy: 0.05}\n"
                       "      - {angle_deg: 90, cy: 0.7}\n      - {angle_deg: 270, cy: -0.6}\n"
                       "      - {angle_deg: 359.9999999999, cx: 0.1, cy: 0.05}\n"
                       "ice: {source: none}\ndomain: {boundary: open}\n"
                       "environment: {current_speed: 0.8, current_direction_deg: -1e-12}\n");
    scene_steps(&k, 1);
    assert_relative(k.w.scratch.fluid.data[0].water_drag.force.y, 0.5 * 1025 * 0.64 * 0.05 * 60 * 4, 1e-6);
    scene_close(&k);
}
END_TEST

/* Of a hull from a file the wind meets what the mesh has over the water, whatever the key of other hulls says. */
START_TEST(the_wind_meets_the_mesh)
{
    scene k;
    scene_open(&k, "vessel:\n  mode: towed\n  speed: 0\n"
                   "  hull: {form: file, file: scenes/fixed_cone.obj, freeboard: 20}\n"
                   "  wind_coefficients:\n    table:\n      - {angle_deg: 0, cx: 0.8}\n"
                   "      - {angle_deg: 180, cx: -0.9}\n" SEA);
    const vessel_model *v = &k.m.vessels.data[0];
    assert_relative(v->flows.air.lateral, 3 * v->particulars.length, 1e-9); /* its top is at 3 m */
    assert_absolute(v->flows.air.point.z + v->centre.z, 1.5, 1e-12);
    scene_close(&k);
}
END_TEST

/* A hull that turns in still water is still slowed down by its panels. */
START_TEST(turning_is_damped)
{
    scene k;
    scene_open_with(&k, tables,
                    (const char *const[]){"vessel.mode=free", "environment.current_speed=0", "environment.wind_speed=0",
                                          "environment.hull_drag.water_form=1"},
                    4);
    k.w.bodies.angular_velocity[0].z = 0.02;
    scene_steps(&k, 500);
    double left = k.w.bodies.angular_velocity[0].z;
    ck_assert_msg(left > 0.001 && left < 0.0199, "%g rad/s are left of 0.02", left);
    scene_close(&k);
}
END_TEST

/* Munk's moment of a free hull in an oblique current is what the equilibrium and the capability plot take, once: in a
   table of coefficients it is measured with the rest, and so is the lift of a ship that drives itself. */
START_TEST(munk_is_in_a_table)
{
    vec3 alone = {0, 0, 0};
    for (int n = 0; n < 3; n++) {
        bool table = n > 0, drives = n > 1;
        char text[1024];
        snprintf(text, sizeof text,
                 "run: {time_step: 0.001}\nvessel:\n  mode: free\n  hydrodynamics: {source: estimate}\n"
                 "  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 3}\n"
                 "  current_coefficients:\n    table: %s\n%s"
                 "ice: {source: none}\ndomain: {boundary: open}\n"
                 "environment: {current_speed: 0.8, current_direction_deg: 135}\n",
                 table ? "[{angle_deg: 0}, {angle_deg: 135, cy: 0.2, cn: 0.1}, {angle_deg: 180}]" : "[]",
                 drives ? "  propulsion: {bollard_pull: 1, open_water_speed: 20, rudder_area: 0}\n" : "");
        scene k;
        scene_open(&k, text);
        int32_t body = k.w.vessels.body[0];
        const hydrodynamics *h = &k.m.vessels.data[0].hydrodynamics;
        double inertia = k.w.bodies.inertia[body].zz + h->added_mass.m[5][5], half = 0.8 / sqrt(2.0);
        double munk = (h->added_mass.m[1][1] - h->added_mass.m[0][0]) * half * half;
        double still = steady_media_load(&k.m, &k.w, 0, &k.m.media, 0).z;
        scene_steps(&k, 1);
        assert_relative(k.w.bodies.angular_velocity[body].z * inertia / 0.001, still, 1e-3);
        if (table)
            assert_relative(still, 0.5 * 1025 * 0.64 * 0.1 * 60 * 4 * 60, 1e-6);
        else
            assert_relative(still, munk, 0.02); /* and the drag of its sides, which balance */
        if (drives)
            assert_relative(k.w.bodies.velocity[body].y, alone.y, 1e-3);
        alone = k.w.bodies.velocity[body];
        scene_close(&k);
    }
}
END_TEST

static void refuse(const char *rows, const char *key)
{
    char text[1024];
    context ctx;
    scenario s;
    world w;
    model m;
    fram_error error = {0};
    snprintf(text, sizeof text, BOX "  wind_coefficients:\n    table:\n%s" SEA, rows);
    context_init(&ctx);
    assert_ok(scenario_parse(&ctx, "scene.yaml", text, strlen(text), NULL, &s, &error), error);
    ck_assert_int_eq(scene_build(&ctx, &s, &m, &w, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, key);
    ck_assert(error.line > 0);
    scenario_free(&ctx, &s);
}

START_TEST(faulty_tables)
{
    refuse("      - {angle_deg: 0, cx: 1}\n", "vessel.wind_coefficients.table");
    refuse("      - {angle_deg: 10, cx: 1}\n      - {angle_deg: 180, cx: 1}\n", "vessel.wind_coefficients.table[0]");
    refuse("      - {angle_deg: 0, cx: 1}\n      - {angle_deg: 0, cx: 1}\n", "vessel.wind_coefficients.table[1]");
    refuse("      - {angle_deg: 0, cx: 1}\n      - {angle_deg: 170, cx: 1}\n", "vessel.wind_coefficients.table[1]");
    refuse("      - {angle_deg: 0, cx: 1}\n      - {angle_deg: 180, cy: 1}\n", "vessel.wind_coefficients.table[1]");
    refuse("      - {angle_deg: 0, cx: 1}\n      - {angle_deg: 360, cx: 2}\n", "vessel.wind_coefficients.table[1]");
}
END_TEST

TEST_MAIN("flows", the_hull_meets_the_tables, the_wind_meets_the_mesh, a_turn_that_was_rounded_is_whole,
          turning_is_damped, munk_is_in_a_table, faulty_tables)
