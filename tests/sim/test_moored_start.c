/* The heading at which a moored ship begins is that at which it comes to rest when it is let go. */
#include "scene.h"

#include "sim/steady_load.h"
#include "vessel/mooring.h"
#include "vessel/plane_motion.h"

#include <stdio.h>

static const char moored[] =
    "run: {time_step: 0.2, scale: 30}\n"
    "vessel:\n  mode: free\n  x: 5\n  y: -3\n"
    "  hull: {form: box, length: 100, beam: 20, draught: 7, freeboard: 4}\n"
    "  mooring:\n    depth: 100\n    turret: true\n    x: 30\n"
    "    lines:\n      - {count: 4, spacing_deg: 90, direction_deg: 10, distance: 600, pretension: 5e5, weight: 1000}\n"
    "ice: {source: none}\ndomain: {boundary: open}\n"
    "environment: {current_speed: 0.5, current_direction_deg: 90, wind_speed: 10, wind_direction_deg: 0}\n";

static double heading_of(const scene *k) { return quat_roll_pitch_yaw(k->w.bodies.orientation[0]).z; }

/* Yaw moment of lines, current and wind on the ship as it lies, turned by so much about its turret [N m]. */
static double moment_beside(const scene *k, double turn)
{
    media now = media_at(&k->m.media, &k->m.history, 0);
    double heading = heading_of(k) + turn;
    vec3 lead = k->w.lines.fairlead[0], at = k->w.bodies.position[0];
    vec3 before = plane_to_global(heading - turn, lead), after = plane_to_global(heading, lead);
    at = vec3_add(at, vec3_sub(before, after));
    wrench pull = mooring_pull(&k->w.lines, 0, at, quat_from_roll_pitch_yaw(0, 0, heading));
    vec3 steady = steady_media_load(&k->m, &k->w, 0, &now, heading);
    /* About the turret, which stays where it is. */
    double about =
        pull.moment.z + steady.z - (after.x * (pull.force.y + steady.y) - after.y * (pull.force.x + steady.x));
    return about;
}

/* What a step leaves of the speed: swinging dies away within minutes. */
#define SLOWED 0.998

/* Let go at its heading and slowed at every step until it rests. */
static double comes_to_rest(const char *const *overrides, int count)
{
    const char *list[8];
    for (int i = 0; i < count; i++)
        list[i] = overrides[i];
    list[count] = "vessel.mooring.equilibrium=false";
    scene k;
    scene_open_with(&k, moored, list, count + 1);
    for (int i = 0; i < 40000; i++) {
        scene_steps(&k, 1);
        k.w.bodies.velocity[0] = vec3_scale(k.w.bodies.velocity[0], SLOWED);
        k.w.bodies.angular_velocity[0] = vec3_scale(k.w.bodies.angular_velocity[0], SLOWED);
    }
    double heading = heading_of(&k);
    scene_close(&k);
    return heading;
}

static void begins_at_rest(const char *const *overrides, int count, double within)
{
    scene k;
    scene_open_with(&k, moored, overrides, count);
    double heading = heading_of(&k), beside = radians(1);
    assert_absolute(moment_beside(&k, 0), 0, 1e3);
    ck_assert(moment_beside(&k, beside) < 0 && moment_beside(&k, -beside) > 0);
    scene_close(&k);
    double rest = comes_to_rest(overrides, count);
    ck_assert_msg(fabs(degrees(plane_angle(rest - heading))) < within, "begins at %g, comes to rest at %g degrees",
                  degrees(heading), degrees(rest));
}

START_TEST(wind_across_the_current)
{
    begins_at_rest((const char *const[]){"vessel.heading_deg=0"}, 1, 0.5);
    begins_at_rest((const char *const[]){"vessel.heading_deg=40"}, 1, 0.5);
    begins_at_rest((const char *const[]){"vessel.heading_deg=90"}, 1, 0.5);
}
END_TEST

/* A current alone, whose moment has no slope where the bow points into it: the last degrees take for ever. */
START_TEST(current_alone)
{
    begins_at_rest((const char *const[]){"environment.wind_speed=0", "environment.current_direction_deg=60",
                                         "vessel.heading_deg=20"},
                   3, 5);
}
END_TEST

/* The bow points into it, whatever its direction, with and without drag of the form. */
START_TEST(bow_into_the_current)
{
    for (int i = 0; i < 12; i++) {
        char towards[64];
        snprintf(towards, sizeof towards, "environment.current_direction_deg=%d", 30 * i + 10);
        const char *const list[] = {"environment.wind_speed=0", towards, "environment.hull_drag.water_form=1"};
        for (int n = 2; n <= 3; n++) {
            scene k;
            scene_open_with(&k, moored, list, n);
            assert_absolute(degrees(plane_angle(heading_of(&k) - radians(30 * i + 10) - PI)), 0, 0.1);
            scene_close(&k);
        }
    }
}
END_TEST

/* Four springs of a ship without a turret, whose fourth is another from time to time. */
static void open_of_springs(scene *k, const char *others, const char *fourth)
{
    char text[1024];
    snprintf(text, sizeof text,
             "run: {time_step: 0.1}\n"
             "vessel:\n  mode: free\n  x: 5\n  y: -3\n"
             "  hull: {form: box, length: 100, beam: 20, draught: 7, freeboard: 4}\n"
             "  mooring:\n    lines:\n"
             "      - {kind: spring, count: 3, spacing_deg: 90, distance: 100, pretension: 5e5, stiffness: 1e5,\n"
             "         fairlead_distance: 10%s}\n%s"
             "ice: {source: none}\ndomain: {boundary: open}\n"
             "environment: {current_speed: 0.5, current_direction_deg: 270}\n",
             others, fourth);
    scene_open(k, text);
}

/* A line that is let go at the start does not count where the vessel begins, however hard it would pull there; it is
   booked as let go in the first step. */
START_TEST(without_lines_that_are_let_go)
{
    static const char fourth[] =
        "      - {kind: spring, direction_deg: 270, distance: 100, pretension: 5e5,\n"
        "         stiffness: 1e5, fairlead_distance: 10, breaking_load: 6e5, release_time: 0}\n";
    scene k, wanted;
    open_of_springs(&wanted, "", "");
    open_of_springs(&k, "", fourth);
    vec3 at = k.w.bodies.position[0];
    ck_assert(wanted.w.bodies.position[0].y > -3 + 3);
    assert_vec3_close(at, wanted.w.bodies.position[0], 1e-3);
    ck_assert_int_eq(k.w.lines.broken[3], 0);
    scene_steps(&k, 1);
    ck_assert_int_eq(k.w.events.count, 1);
    ck_assert_int_eq(k.w.events.kind[0], EVENT_LINE_RELEASE);
    ck_assert_int_eq(k.w.events.number[0], 3);
    ck_assert_int_eq(k.w.lines.broken[3], 1);
    scene_close(&k);
    scene_close(&wanted);
    /* Where none is left the vessel begins where it is put. */
    open_of_springs(&k, ", release_time: 0", fourth);
    assert_absolute(k.w.bodies.position[0].x, 5, 1e-12);
    assert_absolute(k.w.bodies.position[0].y, -3, 1e-12);
    scene_close(&k);
}
END_TEST

TEST_MAIN("moored_start", without_lines_that_are_let_go, bow_into_the_current, wind_across_the_current, current_alone)
