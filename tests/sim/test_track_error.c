/* How far a ship is off its track: the distance itself, the events when it passes its limit, the room that is given to
   corners and loops; mirrored patterns; data with which nobody can steer. */
#include "scene.h"

#include "base/transcendental.h"
#include "sim/turning.h"

#include <stdio.h>

/* The icebreaker of the ready escort, in open water. */
#define SHIP_AT(place, track)                                                                             \
    "run: {duration: 9000, time_step: 0.25, scale: 30}\n"                                                 \
    "vessel:\n  mode: free\n  mass: 1.49e7\n" place                                                       \
    "  hull: {form: icebreaker, length: 121, beam: 25, draught: 8.8, freeboard: 5, stem_angle_deg: 22,\n" \
    "         entrance_angle_deg: 35, flare_angle_deg: 8, stern_angle_deg: 35, parallel_midbody: 0.45,\n" \
    "         block_coefficient: 0.546}\n"                                                                \
    "  hydrodynamics: {source: estimate}\n"                                                               \
    "  propulsion: {bollard_pull: 2.44e6, open_water_speed: 8.7, propellers: 2, speed: 4, " track "}\n"   \
    "ice: {source: none}\n"                                                                               \
    "domain: {x_min: -8000, x_max: 8000, y_min: -8000, y_max: 8000, boundary: open}\n"                    \
    "environment: {hull_drag: {water_form: 1}}\n"

static vec2 place_of(const scene *k)
{
    vec3 r = k->w.bodies.position[k->w.vessels.body[0]];
    return vec2_make(r.x, r.y);
}

static int count_events(const scene *k, station_event kind, double *value)
{
    int n = 0;
    for (int32_t i = 0; i < k->w.events.count; i++) {
        if (k->w.events.kind[i] != (int32_t)kind)
            continue;
        *value = k->w.events.value[i];
        n++;
    }
    return n;
}

/* 40 m outside of a circle of 400 m radius about (500, 0), which is sailed counter-clockwise, so that outside is to
   starboard: the error is the distance, its limit of a beam is passed once, and half of it on the way back once. */
START_TEST(error_is_the_distance_and_is_told)
{
    scene k;
    scene_open(&k, SHIP_AT("  x: 500\n  y: -440\n  speed: 4\n", "pattern: {kind: circle, distance: 500, width: 800}"));
    const propulsion_table *p = &k.w.propulsion;
    double most = 0, square = 0, value = 0;
    for (int i = 0; i < 2400; i++) {
        vec2 at = place_of(&k);
        double off = 400 - sqrt((at.x - 500) * (at.x - 500) + at.y * at.y);
        scene_steps(&k, 1);
        assert_absolute(p->off[0], off, 1e-6 + 1e-3 * fabs(off));
        most = testing_larger(most, fabs(off));
        square += off * off / 2400;
    }
    assert_absolute(p->off_time[0], 600, 1e-9);
    assert_relative(p->off_most[0], most, 1e-3);
    assert_relative(sqrt(p->off_square[0] / p->off_time[0]), sqrt(square), 1e-3);
    ck_assert_int_eq(count_events(&k, EVENT_OFF_TRACK, &value), 1);
    assert_absolute(value, 40, 0.5);
    ck_assert_int_eq(count_events(&k, EVENT_ON_TRACK, &value), 1);
    assert_relative(value, most, 1e-3);
    ck_assert_msg(fabs(p->off[0]) < 12.5, "still %g m off", p->off[0]);
    scene_close(&k);
}
END_TEST

/* The same ship: what is before the transient's end does not count, and is not told. */
START_TEST(the_transient_does_not_count)
{
    static const char *const sets[] = {"run.transient=300"};
    scene k;
    double value = 0;
    scene_open_with(&k,
                    SHIP_AT("  x: 500\n  y: -440\n  speed: 4\n", "pattern: {kind: circle, distance: 500, width: 800}"),
                    sets, 1);
    scene_steps(&k, 2400);
    assert_absolute(k.w.propulsion.off_time[0], 300, 0.5);
    ck_assert(k.w.propulsion.off_most[0] > 0 && k.w.propulsion.off_most[0] < 20);
    ck_assert_int_eq(count_events(&k, EVENT_OFF_TRACK, &value), 0);
    scene_close(&k);
}
END_TEST

/* A limit of its own, and a circle on which nobody can stay: told as soon as it is passed, with the largest error each
   time that it comes back. */
START_TEST(a_circle_that_is_too_narrow_is_told)
{
    scene k;
    double value = 0;
    scene_open(&k, SHIP_AT("  x: 500\n  y: -75\n  speed: 4\n",
                           "track_limit: 10, pattern: {kind: circle, distance: 500, width: 150}"));
    ck_assert(k.w.propulsion.settings[0].turning.radius > 75);
    scene_steps(&k, 1200);
    int off = count_events(&k, EVENT_OFF_TRACK, &value);
    ck_assert(off >= 1 && value > 10 && value < 11);
    int on = count_events(&k, EVENT_ON_TRACK, &value);
    ck_assert(on == off || on == off - 1);
    ck_assert((k.w.propulsion.astray[0] > 0) == (on < off));
    ck_assert(k.w.propulsion.off_most[0] > 25);
    scene_close(&k);
}
END_TEST

/* Way points whose corners leave nothing straight are all that is asked for: what the ship is off them counts from the
   start, on the bend that begins there at once too, which is told. */
START_TEST(way_points_that_are_all_corners_count)
{
    scene k;
    double value = 0;
    scene_open(&k, SHIP_AT("  speed: 4\n", "waypoints: [{x: 200, y: 0}, {x: 200, y: 400}, {x: -200, y: 400}, "
                                           "{x: -200, y: 0}, {x: 200, y: 0}, {x: 200, y: 400}]"));
    const propulsion_table *p = &k.w.propulsion;
    ck_assert(p->settings[0].turning.corner > 200);
    scene_steps(&k, 800);
    printf("all corners: %.0f m off at most, in %.0f s\n", p->off_most[0], p->off_time[0]);
    assert_absolute(p->off_time[0], 200, 1e-9);
    ck_assert_int_eq(count_events(&k, EVENT_OFF_TRACK, &value), 1);
    ck_assert(value > 25 && p->off_most[0] > 25);
    scene_close(&k);
}
END_TEST

/* Out and back on two legs: the ship turns about on a loop, which does not count, and is on its way back at once. */
START_TEST(a_ship_that_turns_about_keeps_its_track)
{
    scene k;
    double value = 0;
    scene_open(&k, SHIP_AT("  speed: 4\n", "waypoints: [{x: 500, y: 0}, {x: -4000, y: 0}]"));
    const propulsion_table *p = &k.w.propulsion;
    double corner = p->settings[0].turning.corner, most = 0;
    for (int i = 0; i < 3600; i++) {
        scene_steps(&k, 1);
        most = fmax(most, fabs(p->off[0]));
    }
    printf("turns about at 500 m with corners of %.0f m: %.1f m off, %.1f where it counts, then at (%.0f, %.0f)\n",
           corner, most, p->off_most[0], place_of(&k).x, place_of(&k).y);
    ck_assert(p->off_most[0] < 12.5 && most < 25);
    ck_assert_int_eq(count_events(&k, EVENT_OFF_TRACK, &value), 0);
    ck_assert(place_of(&k).x < 400 && fabs(place_of(&k).y) < 12.5 && p->off_time[0] < 900 - 2 * corner / 4);
    scene_close(&k);
}
END_TEST

/* Corners and loops take the radius that is given, where the ship can do less. */
START_TEST(room_to_turn_can_be_given)
{
    static const double given[] = {1, 600};
    double corner[2], length[2];
    for (int i = 0; i < 2; i++) {
        scene k;
        char key[64];
        const char *sets[] = {key};
        snprintf(key, sizeof key, "vessel.propulsion.turning_radius=%g", given[i]);
        scene_open_with(&k, SHIP_AT("", "pattern: {kind: across, distance: 500, width: 800}"), sets, 1);
        const propulsion_settings *s = &k.w.propulsion.settings[0];
        pattern_shape shape = {(pattern_kind)k.w.propulsion.pattern[0], s->distance, s->width, s->aside};
        corner[i] = s->turning.corner;
        length[i] = track_of_pattern(&shape, corner[i]).length;
        scene_close(&k);
    }
    ck_assert(corner[0] > 100 && corner[0] < 600);
    ck_assert(corner[1] == 600);
    assert_relative((length[1] - 1600) / 600, (length[0] - 1600) / corner[0], 1e-9);
}
END_TEST

/* To and fro across a drift that turns, and on an arc: with place, heading and turn of the drift mirrored, the way is
   mirrored to rounding. */
START_TEST(driven_patterns_are_mirrored)
{
    static const char *const tracks[][2] = {{SHIP_AT("  x: 600\n  y: -200\n  heading_deg: 90\n  speed: 4\n",
                                                     "pattern: {kind: across, distance: 600, width: 500}"),
                                             SHIP_AT("  x: 600\n  y: 200\n  heading_deg: -90\n  speed: 4\n",
                                                     "pattern: {kind: across, distance: 600, width: 500}")},
                                            {SHIP_AT("  x: 580\n  y: -150\n  heading_deg: 75\n  speed: 4\n",
                                                     "pattern: {kind: sector, distance: 600, width: 500}"),
                                             SHIP_AT("  x: 580\n  y: 150\n  heading_deg: -75\n  speed: 4\n",
                                                     "pattern: {kind: sector, distance: 600, width: 500}")}};
    for (int kind = 0; kind < 2; kind++) {
        vec2 end[2];
        double off[2], most[2];
        for (int side = 0; side < 2; side++) {
            scene k;
            scene_open(&k, tracks[kind][side]);
            k.m.boundary = DOMAIN_FEEDING; /* no ice: only the drift that the pattern turns with */
            k.m.drift_given = true;
            for (int i = 0; i < 2400; i++) {
                double angle = PI + (side ? -1 : 1) * PI / 18 * i / 2400;
                k.m.drift = vec2_make(0.3 * real_cos(angle), 0.3 * real_sin(angle));
                scene_steps(&k, 1);
            }
            end[side] = place_of(&k);
            off[side] = k.w.propulsion.off[0];
            most[side] = k.w.propulsion.off_most[0];
            scene_close(&k);
        }
        printf("end (%.3f, %.3f) m, %.3f m off, %.2f at most\n", end[0].x, end[0].y, off[0], most[0]);
        assert_absolute(end[0].x, end[1].x, 1e-3);
        assert_absolute(end[0].y, -end[1].y, 1e-3);
        assert_absolute(off[0], -off[1], 1e-3);
        assert_absolute(most[0], most[1], 1e-3);
        ck_assert(most[0] > 0.01 && most[0] < 50);
    }
}
END_TEST

/* Sway and yaw that hang together more than a ship's can: a helm that turns it the wrong way at first, an inertia below
   zero.  Nothing is known of such a ship, and what is told is finite. */
START_TEST(odd_data_leave_no_nan)
{
    scene k;
    scene_open(&k, SHIP_AT("", "pattern: {kind: circle, distance: 500, width: 800}"));
    for (int i = 0; i < 5; i++) {
        static const double coupling[] = {0, 1e9, -1e9, 1e11, -1e11};
        propulsion_settings s = k.w.propulsion.settings[0];
        s.ship.a26 = coupling[i];
        turning_ability t = turning_ability_of(&k.ctx, &k.m, 0, &s, 4);
        ck_assert_msg(t.radius > 0 && isfinite(t.radius) && t.corner > 0 && isfinite(t.corner) && t.reach > 0 &&
                          isfinite(t.reach) && isfinite(t.drift),
                      "a26 %g: radius %g, corner %g, reach %g, drift %g", coupling[i], t.radius, t.corner, t.reach,
                      t.drift);
    }
    scene_close(&k);
}
END_TEST

enum { TABLE_LAST = 72 };
#define SIDE (121 * 8.8)

/* Of the cross flow's drag on the side, where it comes from starboard and from port. */
typedef struct side_drag {
    double starboard, port;
} side_drag;

/* A table of the current: what goes with u v of this lift, and the cross flow's drag; with unequal sides all around. */
static void write_table(char *text, size_t size, hull_lift l, double forward, side_drag cross)
{
    double turn = cross.starboard == cross.port ? PI : 2 * PI;
    const double unit = 0.5 * 1025 * SIDE;
    int at = snprintf(text, size, "  current_coefficients: {lateral_area: %g, length: 121, x: %.9g, table: [", SIDE,
                      forward);
    for (int i = 0; i <= TABLE_LAST; i++) {
        double flow = turn * i / TABLE_LAST, s = real_sin(flow), both = s * real_cos(flow);
        double drag = s > 0 ? cross.starboard * s * s : -cross.port * s * s;
        at += snprintf(text + at, size - (size_t)at, "{angle_deg: %g, cy: %.9g, cn: %.9g}%s",
                       degrees(turn) * i / TABLE_LAST, l.y_v * both / unit + drag, l.n_v * both / (unit * 121),
                       i < TABLE_LAST ? ", " : "]}\n");
    }
}

/* Of a ship with this table, whose faces have no drag: linear damping holds its turn.  Its lift, and how far forward of
   amidships its mass is. */
static turning_ability ability_by(const char *table, hull_lift *l, double *forward)
{
    static const char *const sets[] = {"environment.hull_drag.water_form=0", "environment.hull_drag.water_skin=0"};
    char text[8192];
    scene k;
    snprintf(text, sizeof text, SHIP_AT("%s", "waypoints: [{x: 7000, y: 0}]"), table);
    scene_open_with(&k, text, sets, 2);
    vessel_model *v = &k.m.vessels.data[0];
    v->hydrodynamics.damping.m[1][1] = 3e5;
    v->hydrodynamics.damping.m[5][5] = 4e8;
    turning_ability out = turning_ability_of(&k.ctx, &k.m, 0, &k.w.propulsion.settings[0], 4);
    *l = k.w.propulsion.settings[0].ship.whole;
    *forward = v->centre.x - v->particulars.midships;
    scene_close(&k);
    return out;
}

/* A table that holds the regression's part of sliding is the same ship; with the drag of its side it turns on more. */
START_TEST(the_table_is_known_to_the_turn)
{
    char table[6144];
    hull_lift l, left;
    double forward;
    turning_ability without = ability_by("", &l, &forward);
    write_table(table, sizeof table, l, forward, (side_drag){0, 0});
    turning_ability same = ability_by(table, &left, &forward);
    ck_assert(left.y_v == 0 && left.n_v == 0 && left.y_r == l.y_r && left.n_r == l.n_r);
    write_table(table, sizeof table, l, forward, (side_drag){0.7, 0.7});
    turning_ability wider = ability_by(table, &left, &forward);
    write_table(table, sizeof table, l, forward, (side_drag){0.7, 0});
    turning_ability port = ability_by(table, &left, &forward);
    write_table(table, sizeof table, l, forward, (side_drag){0, 0.7});
    turning_ability starboard = ability_by(table, &left, &forward);
    printf("without a table %.2f and %.2f m, with it %.2f and %.2f, with drag of the side %.2f\n", without.radius,
           without.corner, same.radius, same.corner, wider.radius);
    assert_relative(same.radius, without.radius, 2e-3);
    assert_relative(same.corner, without.corner, 2e-3);
    assert_relative(same.drift, without.drift, 2e-3);
    ck_assert(wider.radius > 1.1 * without.radius);
    /* With the drag of one side it turns as with that of both, to that side: a ship and its mirror image alike. */
    assert_relative(port.radius, wider.radius, 0.02); /* rows are 5 degrees apart instead of 2.5 */
    assert_relative(starboard.radius, port.radius, 1e-6);
    assert_relative(starboard.corner, port.corner, 1e-6);
}
END_TEST

TEST_MAIN("track_error", error_is_the_distance_and_is_told, the_transient_does_not_count,
          a_circle_that_is_too_narrow_is_told, way_points_that_are_all_corners_count,
          a_ship_that_turns_about_keeps_its_track, room_to_turn_can_be_given, driven_patterns_are_mirrored,
          odd_data_leave_no_nan, the_table_is_known_to_the_turn)
