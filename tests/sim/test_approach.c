/* Vessels that are going to pass too close: predicted distance and time, and the events of a run. */
#include "scene.h"

/* A box of 20 x 10 m about a place. */
static approach_hull box_at(vec2 corner[4], double x, double y, double vx, double vy)
{
    corner[0] = vec2_make(x - 10, y - 5);
    corner[1] = vec2_make(x + 10, y - 5);
    corner[2] = vec2_make(x + 10, y + 5);
    corner[3] = vec2_make(x - 10, y + 5);
    return (approach_hull){{corner, 4}, {vx, vy}};
}

/* Prediction for a box that rests in the origin and another. */
static approach_prediction predicted(double x, double y, double vx, double vy, double look_ahead)
{
    vec2 first[4], second[4];
    approach_hull a = box_at(first, 0, 0, 1, -2), b = box_at(second, x, y, vx + 1, vy - 2);
    return approach_predict(&a, &b, look_ahead);
}

START_TEST(distance_and_time_are_those_of_geometry)
{
    /* Head on: 100 m between centres, 20 m of boxes, 4 m/s. */
    approach_prediction p = predicted(100, 0, -4, 0, 60);
    assert_absolute(p.gap, 0, 1e-9);
    assert_relative(p.time, 20, 1e-7);
    assert_relative(p.distance, 80, 1e-12);
    /* Passes abeam, 30 m between the centre lines: 20 m of water, first when the bows are level. */
    p = predicted(100, 30, -4, 0, 60);
    assert_relative(p.gap, 20, 1e-12);
    assert_relative(p.time, 20, 1e-7);
    assert_relative(p.distance, sqrt(80 * 80 + 20 * 20), 1e-12);
    /* Too far off in time: 40 m are left after 10 s. */
    p = predicted(100, 0, -4, 0, 10);
    assert_relative(p.gap, 40, 1e-12);
    assert_relative(p.time, 10, 1e-7);
    /* Goes away, or keeps its place: now is nearest. */
    p = predicted(100, 30, 4, 0, 60);
    assert_relative(p.gap, sqrt(80 * 80 + 20 * 20), 1e-9);
    assert_absolute(p.time, 0, 1e-7);
    p = predicted(0, 25, 0, 0, 60);
    assert_relative(p.gap, 15, 1e-12);
    assert_absolute(p.time, 0, 1e-7);
    /* Corner past corner: the near corners, (10, 5) and (80, -5), are 60 / sqrt 2 apart where the line between them is
       square to the way along (-1, 1). */
    p = predicted(90, 0, -2, 2, 600);
    assert_relative(p.gap, 60 / sqrt(2), 1e-9);
}
END_TEST

/* Of places of a map projection the distances round, and what goes on beyond the look-ahead is at its end all the
   same. */
START_TEST(the_end_of_the_look_ahead_is_told_far_from_the_origin)
{
    for (int i = 0; i < 8; i++) {
        vec2 first[4], second[4];
        approach_hull a = box_at(first, 1.4e6, 2e6, 0.02, 0), b = box_at(second, 1.4e6 + 60 + i / 7.0, 2e6, -0.02, 0);
        approach_prediction p = approach_predict(&a, &b, 300);
        ck_assert_double_eq(p.time, 300);
        assert_absolute(p.gap, 28 + i / 7.0, 1e-8);
    }
}
END_TEST

/* Overlap is no distance, and never negative. */
START_TEST(overlap_is_zero)
{
    approach_prediction p = predicted(15, 3, 0.5, 0, 60);
    assert_absolute(p.gap, 0, 1e-12);
    assert_absolute(p.distance, 0, 1e-12);
    assert_absolute(p.time, 0, 1e-7);
}
END_TEST

/* Two towed boxes that meet abeam: 40 x 10 m, centre lines 50 m apart, 2 m/s each. */
static const char *const MEETING =
    "run: {duration: 300, time_step: 0.1}\n"
    "vessels:\n"
    "  - {name: east, mode: prescribed, x: -300, speed: 2, approach: {limit: 45, look_ahead: 100},\n"
    "     hull: {form: box, length: 40, beam: 10, draught: 3, freeboard: 2}}\n"
    "  - {name: west, mode: prescribed, x: 300, y: 50, heading_deg: 180, speed: 2,\n"
    "     hull: {form: box, length: 40, beam: 10, draught: 3, freeboard: 2}}\n"
    "ice: {source: none}\n"
    "domain: {x_min: -1000, x_max: 1000, y_min: -300, y_max: 300, boundary: open}\n";

/* The distance abeam is 40 m, first reached when the bows are level, after (600 - 40) / 4 = 140 s.  Within a look-ahead
   the distance falls under 45 m when the gap along x at its end is under sqrt(45^2 - 40^2) = 20.6 m: from
   (560 - 20.6) / 4 - 100 = 34.8 s on, seen at the next look, which come a second apart.  It is over a tenth of the
   look-ahead after the sterns have parted by as much: (600 + 40 + 20.6) / 4 + 10 = 175.2 s, to a look. */
START_TEST(an_approach_begins_and_ends)
{
    scene k;
    scene_open(&k, MEETING);
    scene_steps(&k, 3000);
    const event_table *e = &k.w.events;
    ck_assert_int_eq(e->count, 2);
    ck_assert_int_eq(e->kind[0], EVENT_APPROACH);
    ck_assert_int_eq(e->vessel[0], 0);
    ck_assert_int_eq(e->number[0], 1);
    double edge = sqrt(45.0 * 45 - 40 * 40), begins = (560 - edge) / 4 - 100, ends = (640 + edge) / 4 + 10;
    ck_assert_msg(e->time[0] >= begins && e->time[0] <= begins + 1, "at %g s, expected %g", e->time[0], begins);
    assert_absolute(e->ahead[0], 100, 1e-6);
    double left = 600 - 40 - 4 * (e->time[0] + 100);
    assert_absolute(e->value[0], sqrt(left * left + 40 * 40), 0.1);
    ck_assert_int_eq(e->kind[1], EVENT_APPROACH_OVER);
    ck_assert_msg(e->time[1] > ends - 1 && e->time[1] < ends + 1, "over at %g s, expected %g", e->time[1], ends);
    assert_absolute(e->value[1], 40, 1e-6);
    char text[160];
    /* They still come nearer as the look-ahead ends: that is not where they pass. */
    event_text(e, 0, "west", 100, text, sizeof text);
    ck_assert(strncmp(text, "vessel west comes within 4", 26) == 0);
    ck_assert_msg(strstr(text, " m in 100 s at present velocities, and nearer after that") != NULL, "%s", text);
    e->ahead[0] = 99;
    event_text(e, 0, "west", 100, text, sizeof text);
    ck_assert_msg(strstr(text, "vessel west is going to pass at 4") == text, "%s", text);
    e->ahead[0] = 3e-9;
    e->value[0] = 12;
    event_text(e, 0, "west", 100, text, sizeof text);
    ck_assert_str_eq(text, "vessel west is at 12 m, and comes no nearer at present velocities");
    event_text(e, 1, NULL, 100, text, sizeof text);
    ck_assert_str_eq(text, "vessel 2 is clear again: it came as near as 40 m");
    scene_close(&k);
}
END_TEST

/* A limit that they keep tells nothing, and no limit watches nobody; both change no state but their own. */
START_TEST(who_keeps_clear_is_not_told)
{
    static const char *const limits[] = {"vessels.east.approach.limit=39.9", "vessels.east.approach.limit=auto"};
    uint64_t hash[2];
    for (int i = 0; i < 2; i++) {
        scene k;
        scene_open_with(&k, MEETING, &limits[i], 1);
        scene_steps(&k, 3000);
        ck_assert_int_eq(k.w.events.count, 0);
        ck_assert_int_eq(k.w.approaches.count, i == 0 ? 1 : 0);
        table_resize(&k.ctx, &k.w.approaches, &approach_table_info, 0);
        hash[i] = world_hash(&k.w);
        scene_close(&k);
    }
    ck_assert(hash[0] == hash[1]);
}
END_TEST

/* A limit of 0 is passed by hulls that are going to touch, and by no others. */
START_TEST(a_limit_of_nothing_tells_collisions)
{
    static const char *const courses[][2] = {{"vessels.east.approach.limit=0", "vessels.west.y=9.9"},
                                             {"vessels.east.approach.limit=0", "vessels.west.y=10.1"}};
    for (int i = 0; i < 2; i++) {
        scene k;
        scene_open_with(&k, MEETING, courses[i], 2);
        scene_steps(&k, 500);
        ck_assert_int_eq(k.w.events.count, i == 0 ? 1 : 0);
        ck_assert(i > 0 || (k.w.events.kind[0] == EVENT_APPROACH && k.w.events.value[0] == 0));
        scene_close(&k);
    }
}
END_TEST

/* Boxes that cross at right angles, 20 x 6 m with the bow at 10 m and 30 x 8 m with it at (60, -55), 2 m/s each: the
   bow of the first is at the side of the second, x = 56, after 23 s, that of the second at the first's, y = -3, after
   26.  It is told as less than a quarter of what was told is predicted, and once, 20 s before, that they touch. */
START_TEST(what_comes_much_nearer_is_told_again)
{
    static const char crossing[] = "run: {duration: 30, time_step: 0.1}\n"
                                   "vessels:\n"
                                   "  - {name: a, mode: prescribed, speed: 2, approach: {limit: 12, look_ahead: 20},\n"
                                   "     hull: {form: box, length: 20, beam: 6, draught: 3, freeboard: 2}}\n"
                                   "  - {name: b, mode: prescribed, x: 60, y: -70, heading_deg: 90, speed: 2,\n"
                                   "     hull: {form: box, length: 30, beam: 8, draught: 3, freeboard: 2}}\n"
                                   "ice: {source: none}\n"
                                   "domain: {x_min: -100, x_max: 200, y_min: -100, y_max: 100, boundary: open}\n";
    scene k;
    scene_open(&k, crossing);
    scene_steps(&k, 250);
    const event_table *e = &k.w.events;
    ck_assert_int_ge(e->count, 3);
    ck_assert_int_le(e->count, 5);
    for (int32_t i = 0; i < e->count; i++) {
        ck_assert_int_eq(e->kind[i], EVENT_APPROACH);
        ck_assert(e->value[i] < (i > 0 ? 0.25 * e->value[i - 1] : 12));
    }
    const int32_t last = e->count - 1;
    char text[160];
    ck_assert_double_eq(e->value[last], 0);
    ck_assert_msg(e->time[last] > 5.9 && e->time[last] < 6.3, "%g s", e->time[last]);
    assert_absolute(e->time[last] + e->ahead[last], 26, 0.1);
    event_text(e, last, "b", 20, text, sizeof text);
    ck_assert_msg(strstr(text, "the hull and vessel b are going to touch, in ") == text, "%s", text);
    scene_close(&k);
}
END_TEST

START_TEST(refusals_name_their_key)
{
    static const char *const bad[] = {"vessels.east.approach.limit=nan", "vessels.east.approach.limit=-1",
                                      "vessels.west.approach.look_ahead=0", "vessels.west.approach.look_ahead=inf"};
    static const char *const keys[] = {"vessels[0].approach.limit", "vessels[0].approach.limit",
                                       "vessels[1].approach.look_ahead", "vessels[1].approach.look_ahead"};
    for (int i = 0; i < 4; i++) {
        context ctx;
        scenario s = {0};
        fram_error error = {0};
        const scenario_overrides list = {&bad[i], 1};
        context_init(&ctx);
        ck_assert_int_eq(scenario_parse(&ctx, "scene.yaml", MEETING, strlen(MEETING), &list, &s, &error),
                         FRAM_ERROR_INPUT);
        ck_assert_str_eq(error.key, keys[i]);
        scenario_free(&ctx, &s);
    }
}
END_TEST

TEST_MAIN("approach", distance_and_time_are_those_of_geometry, the_end_of_the_look_ahead_is_told_far_from_the_origin,
          overlap_is_zero, an_approach_begins_and_ends, who_keeps_clear_is_not_told,
          a_limit_of_nothing_tells_collisions, what_comes_much_nearer_is_told_again, refusals_name_their_key)
