/* A hull or its carriage on a prescribed path: it stands on it at every step, the hull follows its carriage. */
#include "scene.h"

#include "sim/ice_loads.h"
#include "vessel/prescribed_path.h"

#include <stdio.h>

static const char path[] =
    "run: {time_step: 0.05}\n"
    "vessel:\n  mode: towed\n  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}\n"
    "  path:\n    - {time: 0, x: -10, y: 2, heading_deg: 10}\n"
    "    - {time: 10, x: 0, y: 2, heading_deg: 10}\n"
    "    - {time: 30, x: 10, y: -8, heading_deg: -50}\n"
    "ice: {source: none}\ndomain: {boundary: open}\n";

static void check_place(const scene *k, double x, double y, double heading_deg, double tolerance)
{
    int32_t body = k->w.vessels.body[0];
    vec3 at = body_to_global(&k->w.bodies, body, vec3_neg(k->w.vessels.centre[0]));
    assert_absolute(at.x, x, tolerance);
    assert_absolute(at.y, y, tolerance);
    assert_absolute(degrees(quat_roll_pitch_yaw(k->w.bodies.orientation[body]).z), heading_deg, 100 * tolerance);
}

static void follow(const char *mode, double tolerance)
{
    scene k;
    scene_open_with(&k, path, &mode, 1);
    check_place(&k, -10, 2, 10, 1e-12);
    scene_steps(&k, 100);
    check_place(&k, -5, 2, 10, tolerance);
    scene_steps(&k, 300); /* halfway round */
    check_place(&k, 5, -3, -20, tolerance);
    scene_steps(&k, 300); /* 5 s past the end */
    check_place(&k, 10, -8, -50, tolerance);
    assert_absolute(vec3_length(k.w.bodies.velocity[k.w.vessels.body[0]]), 0, tolerance);
    scene_close(&k);
}

START_TEST(driven_hull) { follow("vessel.mode=prescribed", 1e-9); }
END_TEST
START_TEST(towed_hull) { follow("vessel.mode=towed", 1e-3); }
END_TEST

START_TEST(places_between_points)
{
    scene k;
    scene_open(&k, path);
    assert_vec3_close(path_place(&k.w.waypoints, 0, -1), vec3_make(-10, 2, radians(10)), 1e-12);
    assert_vec3_close(path_place(&k.w.waypoints, 0, 20), vec3_make(5, -3, radians(-20)), 1e-12);
    assert_vec3_close(path_place(&k.w.waypoints, 0, 1e9), vec3_make(10, -8, radians(-50)), 1e-12);
    ck_assert(isnan(path_place(&k.w.waypoints, 1, 0).z));
    scene_close(&k);
}
END_TEST

/* Walls stand around where a path begins, wherever that is; x and y are not looked at. */
START_TEST(begins_inside_the_walls)
{
    static const char far[] =
        "vessel:\n  mode: towed\n  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}\n"
        "  path: [{time: 0, x: 1000, y: 500}, {time: 60, x: 1010, y: 500}]\n"
        "ice: {source: none}\ndomain: {x_min: 940, x_max: 1060, y_min: 460, y_max: 540}\n";
    static const char *const elsewhere[] = {"vessel.path[0].x=0"};
    fram_error error = {0};
    scenario s = {0};
    context ctx;
    scene k;
    scene_open(&k, far);
    check_place(&k, 1000, 500, 0, 1e-12);
    scene_close(&k);
    context_init(&ctx);
    const scenario_overrides overrides = {elsewhere, 1};
    assert_fails(scenario_parse(&ctx, "far.yaml", far, strlen(far), &overrides, &s, &error), error, FRAM_ERROR_INPUT,
                 "vessel.path[0].x and vessel.path[0].y inside the walls");
    ck_assert_str_eq(error.key, "vessel.path[0].x");
}
END_TEST

/* A driven hull that has crushed its way into ice at rest and stands there carries nothing, whatever its heading: its
   velocity is 0, without what rounding leaves of place and yaw.  Then it goes on and ends where it should. */
START_TEST(at_rest_in_the_ice)
{
    static const char text[] =
        "run: {time_step: 0.01}\n"
        "vessel:\n  mode: %s\n  hull: {form: box, length: 10, beam: 20, draught: 1.5, freeboard: 1}\n"
        "  path:\n    - {time: 0, x: -5.3, y: 3.1, heading_deg: %g}\n"
        "    - {time: 0.1, x: -3.7, y: 3.7, heading_deg: %g}\n"
        "    - {time: 0.3, x: -3.7, y: 3.7, heading_deg: %g}\n    - {time: 0.4, x: -6.1, y: 2.9, heading_deg: %g}\n"
        "ice: {source: floes, thickness: 1, floes: [{fixed: true, length: 60, width: 120, x: 30}]}\n"
        "domain: {boundary: open}\n";
    for (int i = 0; i < 36; i++) {
        char scene_text[1024];
        scene k;
        double to = i % 4 * 90 + 0.3 * i + (i % 3 - 1) * 360;
        snprintf(scene_text, sizeof scene_text, text, i < 32 ? "prescribed" : "towed", to - 2, to, to, to - 1);
        scene_open(&k, scene_text);
        int32_t slot = k.w.vessels.carriage[0] >= 0 ? k.w.vessels.carriage[0] : k.w.vessels.body[0];
        scene_steps(&k, 10);
        ck_assert(vec3_length(k.w.scratch.ice_loads.data[0].total.force) > 1e5);
        scene_steps(&k, 1); /* which turns by what the steps of the turn left */
        for (int n = 0; n < 19; n++) {
            scene_steps(&k, 1);
            assert_vec3_close(k.w.bodies.velocity[slot], vec3_make(0, 0, 0), 0);
            assert_vec3_close(k.w.bodies.angular_velocity[slot], vec3_make(0, 0, 0), 0);
            if (i < 32)
                assert_absolute(vec3_length(k.w.scratch.ice_loads.data[0].total.force), 0, 0);
        }
        scene_steps(&k, 15);
        if (i < 32)
            check_place(&k, -6.1, 2.9, degrees(plane_angle(radians(to - 1))), 1e-12);
        scene_close(&k);
    }
}
END_TEST

TEST_MAIN("prescribed_path", driven_hull, towed_hull, places_between_points, at_rest_in_the_ice,
          begins_inside_the_walls)
