/* Tracks of lines and arcs: patterns as they are sailed, feet of perpendiculars, rounded corners. */
#include "testing.h"

#include "vessel/track.h"

#include "base/transcendental.h"

/* Each pattern is a closed line without kinks, whose length is that of its pieces, and whose curvature is no more than
   that of its corners. */
START_TEST(patterns_are_closed_and_smooth)
{
    for (int kind = PATTERN_LINE; kind <= PATTERN_SECTOR; kind++) {
        pattern_shape p = {(pattern_kind)kind, 900, 600, 0};
        const double radius = 120;
        track t = track_of_pattern(&p, radius);
        enum { PLACES = 20000 };
        double sum = 0, turned = 0;
        track_place last = track_at(&t, 0);
        for (int i = 1; i <= PLACES; i++) {
            track_place next = track_at(&t, t.length * i / PLACES);
            double step = vec2_length(vec2_sub(next.at, last.at));
            double turn = next.heading - last.heading;
            turn -= 2 * PI * floor((turn + PI) / (2 * PI));
            ck_assert_msg(fabs(turn) <= step / radius * 1.01 + 1e-9, "kind %d turns by %g in %g m", kind, turn, step);
            sum += step;
            turned += turn;
            last = next;
        }
        assert_relative(sum, t.length, 1e-5);
        ck_assert(vec2_length(vec2_sub(last.at, t.start)) < 1e-9);
        assert_absolute(turned, track_turned(&t, t.length * (1 - 1e-15)), 1e-6);
        assert_absolute(fabs(turned), kind == PATTERN_CIRCLE || kind == PATTERN_SQUARE ? 2 * PI : 0, 1e-6);
    }
}
END_TEST

/* A square that is all corners has no other way to be at work on. */
START_TEST(corners_of_a_narrow_square_are_its_track)
{
    const pattern_shape wide = {PATTERN_SQUARE, 900, 250, 0}, narrow = {PATTERN_SQUARE, 900, 200, 0};
    track with = track_of_pattern(&wide, 120), without = track_of_pattern(&narrow, 120);
    ck_assert(with.count == 8 && with.piece[1].turning && !with.piece[0].turning);
    ck_assert_int_eq(without.count, 4);
    for (int i = 0; i < 4; i++)
        ck_assert(!without.piece[i].turning);
    assert_relative(without.length, PI * 200, 1e-12);
}
END_TEST

/* What is asked for: circle, arc and straight parts lie where the pattern says, and nothing of a line is nearer than
   its distance, of nothing that goes to and fro across nearer than its ends. */
START_TEST(patterns_lie_where_they_are_asked_for)
{
    for (int kind = PATTERN_LINE; kind <= PATTERN_SECTOR; kind++) {
        pattern_shape p = {(pattern_kind)kind, 900, 600, 0};
        track t = track_of_pattern(&p, 120);
        double work = 0, nearest = HUGE_VAL;
        for (int i = 0; i < 4000; i++) {
            track_place at = track_at(&t, t.length * i / 4000);
            nearest = fmin(nearest, at.at.x);
            if (at.turning)
                continue;
            work += t.length / 4000;
            double x = at.at.x - 900, y = at.at.y, off = 0;
            off = kind == PATTERN_LINE     ? y
                  : kind == PATTERN_ACROSS ? x
                  : kind == PATTERN_CIRCLE ? hypot(x, y) - 300
                  : kind == PATTERN_SECTOR ? hypot(at.at.x, y) - 900
                                           : fmax(fabs(x), fabs(y)) - 300;
            assert_absolute(off, 0, 1e-9);
        }
        double sides = kind == PATTERN_CIRCLE ? PI * 600 : kind == PATTERN_SQUARE ? 4 * 360 : 1200;
        assert_relative(work, sides, 2e-2);
        ck_assert(kind != PATTERN_LINE || nearest >= 900 - 1e-9);
        ck_assert(kind != PATTERN_ACROSS || nearest >= 900 - 0.14 * 120);
    }
}
END_TEST

/* The foot of a point beside a track is where the point was put beside it. */
START_TEST(feet_are_found)
{
    for (int kind = PATTERN_LINE; kind <= PATTERN_SECTOR; kind++) {
        pattern_shape p = {(pattern_kind)kind, 900, 600, 0};
        track t = track_of_pattern(&p, 150);
        for (int i = 0; i < 97; i++) {
            double way = t.length * i / 97;
            for (int side = -1; side <= 1; side++) {
                track_place at = track_at(&t, way);
                vec2 port = {-real_sin(at.heading), real_cos(at.heading)};
                vec2 point = vec2_add(at.at, vec2_scale(port, 30.0 * side));
                double foot = track_foot(&t, way - 8, point);
                double apart = foot - way - t.length * floor((foot - way) / t.length + 0.5);
                track_place found = track_at(&t, foot);
                ck_assert_msg(fabs(apart) < 0.1, "kind %d at %g: %g m apart", kind, way, apart);
                assert_absolute(track_off(&found, point), 30.0 * side, 0.01);
            }
        }
    }
}
END_TEST

/* A ship that comes along the leg back joins that one, though the leg there is as near. */
START_TEST(joins_the_way_that_it_goes)
{
    pattern_shape p = {PATTERN_ACROSS, 900, 600, 0};
    track t = track_of_pattern(&p, 120);
    vec2 here = {905, 100};
    double there = track_join(&t, here, 0.5 * PI, 240), back = track_join(&t, here, -0.5 * PI, 240);
    assert_absolute(track_at(&t, there).heading, 0.5 * PI, 1e-9);
    assert_absolute(real_cos(track_at(&t, back).heading + 0.5 * PI), 1, 1e-9);
    assert_absolute(track_at(&t, back).at.y, 100, 1e-6);
}
END_TEST

/* By hand: a corner of 90 degrees with radius 50 takes 50 m of each leg; one that has a leg of 30 m alone takes that;
   two that would take 50 and 25 of a leg of 60 share it as 40 and 20; the last point has no corner. */
START_TEST(corners_are_rounded)
{
    vec2 point[] = {{0, 0}, {200, 0}, {200, 300}, {500, 300}};
    double corner;
    track t = track_of_legs(point, 4, 0, 50, &corner);
    ck_assert_int_eq(t.count, 5);
    assert_relative(t.piece[0].length, 150, 1e-12);
    assert_relative(t.piece[1].curvature, 0.02, 1e-12);
    assert_relative(t.piece[2].length, 200, 1e-12);
    assert_relative(t.piece[3].curvature, -0.02, 1e-12);
    assert_relative(corner, 150 + 25 * PI, 1e-12);
    track_place end = track_at(&t, corner), last = track_at(&t, t.length + 10);
    track next = track_of_legs(point, 4, 1, 50, &corner);
    assert_absolute(vec2_length(vec2_sub(end.at, vec2_make(200, 50))), 0, 1e-9);
    assert_absolute(vec2_length(vec2_sub(end.at, next.start)), 0, 1e-9);
    assert_absolute(end.heading, 0.5 * PI, 1e-12);
    assert_absolute(vec2_length(vec2_sub(last.at, vec2_make(510, 300))), 0, 1e-9);
    ck_assert(track_of_legs(point, 4, 2, 50, &corner).count == 1 && corner == HUGE_VAL);
    point[2].y = -30;
    assert_relative(track_of_legs(point, 3, 0, 50, &corner).piece[1].curvature, -1.0 / 30, 1e-12);
    vec2 shared[] = {{0, 0}, {200, 0}, {200, 60}, {360, 180}};
    t = track_of_legs(shared, 4, 0, 50, &corner);
    ck_assert_int_ge(t.count, 4);
    assert_relative(t.piece[0].length, 160, 1e-12);
    assert_relative(t.piece[1].curvature, 1.0 / 40, 1e-12);
    assert_relative(t.piece[t.count - 2].curvature, -1.0 / 40, 1e-12);
    assert_relative(t.piece[t.count - 1].length, 180, 1e-9);
    assert_absolute(track_at(&t, -10).at.x, -10, 1e-12);
}
END_TEST

/* Corners between legs of which they leave hardly anything are no room to turn; with a seventh of one left they are. */
START_TEST(a_course_that_is_all_corners_is_no_room_to_turn)
{
    for (int more = 1; more <= 10; more += 9) {
        const vec2 point[] = {{0, 0}, {30, 0}, {30, 60 + more}, {-30, 60 + more}, {-30, more}};
        double corner;
        track t = track_of_legs(point, 5, 0, 50, &corner);
        int turning = 0, bends = 0;
        for (int32_t i = 0; i < t.count; i++) {
            turning += t.piece[i].turning;
            bends += t.piece[i].curvature != 0;
        }
        ck_assert_int_eq(bends, 3);
        ck_assert_int_eq(turning, more > 1 ? 3 : 1); /* the last one has half a leg straight after it */
    }
}
END_TEST

/* A corner of more than 135 degrees is turned about at: past it, and back through it along the next leg. */
START_TEST(sharp_corners_have_loops)
{
    static const double turns[] = {136, -136, 150, -179, 180};
    for (size_t i = 0; i < sizeof turns / sizeof *turns; i++) {
        double angle = radians(turns[i]), corner, far = 0;
        const vec2 at = {600, 0}, legs[] = {{0, 0}, at, {600 + 400 * real_cos(angle), 400 * real_sin(angle)}};
        track t = track_of_legs(legs, 3, 0, 50, &corner);
        track_place end = track_at(&t, corner);
        assert_absolute(vec2_length(vec2_sub(end.at, at)), 0, 1e-9);
        assert_absolute(real_cos(end.heading - angle), 1, 1e-12);
        for (double way = 601; way < corner - 1; way++) {
            track_place on = track_at(&t, way);
            ck_assert(on.turning && fabs(on.curvature) <= 1.0 / 50);
            far = fmax(far, vec2_length(vec2_sub(on.at, at)));
        }
        ck_assert_msg(far > 170 && far < 4.4 * 50, "a loop of %g degrees reaches %g m", turns[i], far);
        ck_assert(!track_at(&t, 599).turning && !track_at(&t, corner + 1).turning);
    }
}
END_TEST

/* Through its place, with its heading, and as bent behind it as before it. */
START_TEST(a_bend_goes_both_ways)
{
    const double radius = 500, heading = 0.3;
    for (int side = -1; side <= 1; side++) {
        double way;
        track bend = track_of_bend(vec2_make(40, -30), heading, side / radius, &way);
        track_place middle = track_at(&bend, way);
        assert_absolute(middle.at.x, 40, 1e-9);
        assert_absolute(middle.at.y, -30, 1e-9);
        assert_absolute(middle.heading, heading, 1e-12);
        ck_assert(!bend.closed && (side != 0 || way > 0));
        for (double far = -200; far <= 200; far += 400) {
            assert_absolute(track_turned(&bend, way + far) - track_turned(&bend, way), side * far / radius, 1e-12);
            /* On its circle. */
            vec2 centre = {40 - side * radius * real_sin(heading), -30 + side * radius * real_cos(heading)};
            vec2 from = vec2_sub(track_at(&bend, way + far).at, centre);
            if (side != 0)
                assert_absolute(vec2_length(from), radius, 1e-9);
        }
    }
}
END_TEST

TEST_MAIN("track", patterns_are_closed_and_smooth, patterns_lie_where_they_are_asked_for,
          corners_of_a_narrow_square_are_its_track, feet_are_found, joins_the_way_that_it_goes, corners_are_rounded,
          a_course_that_is_all_corners_is_no_room_to_turn, sharp_corners_have_loops, a_bend_goes_both_ways)
