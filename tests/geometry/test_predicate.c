/* Orientation and segments: signs where plain arithmetic fails, and every way two segments can lie. */
#include "testing.h"

#include "base/random.h"
#include "geometry/predicate.h"

/* Points about (0.5, 0.5), one unit in the last place apart, against a far part of the diagonal: det = 12 (y - x).  The
   plain determinant gets many of these signs wrong (Kettner et al. 2008). */
START_TEST(orientation_is_exact_near_a_line)
{
    int plain_wrong = 0;
    vec2 q = {12, 12}, r = {24, 24};
    for (int i = 0; i < 256; i++)
        for (int j = 0; j < 256; j++) {
            vec2 p = {0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53};
            int expected = (p.y > p.x) - (p.y < p.x);
            ck_assert_int_eq(orientation(p, q, r), expected);
            ck_assert_int_eq(orientation(q, r, p), expected);
            ck_assert_int_eq(orientation(r, q, p), -expected);
            double det = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
            plain_wrong += ((det > 0) - (det < 0)) != expected;
        }
    ck_assert_int_gt(plain_wrong, 1000);
}
END_TEST

START_TEST(orientation_of_plain_points)
{
    ck_assert_int_eq(orientation(vec2_make(0, 0), vec2_make(1, 0), vec2_make(0, 1)), 1);
    ck_assert_int_eq(orientation(vec2_make(0, 0), vec2_make(0, 1), vec2_make(1, 0)), -1);
    ck_assert_int_eq(orientation(vec2_make(-3, 5), vec2_make(1, 5), vec2_make(9, 5)), 0);
    ck_assert_int_eq(orientation(vec2_make(7, 5), vec2_make(7, 5), vec2_make(9, 6)), 0);
    ck_assert_int_eq(orientation(vec2_make(0.1, 0.1), vec2_make(0.2, 0.2), vec2_make(0.3, 0.3)), 0);
    ck_assert_int_eq(orientation(vec2_make(1e60, 1e60), vec2_make(1e-60, 0), vec2_make(-1e60, -1e60)), -1);
}
END_TEST

/* Any order of three points gives the sign of the permutation. */
START_TEST(orientation_is_antisymmetric)
{
    random_stream s = random_begin(1, 0, 0);
    for (int i = 0; i < 20000; i++) {
        vec2 a = {random_unit(&s), random_unit(&s)}, b = {random_unit(&s), random_unit(&s)};
        double t = random_uniform(&s, -2, 3);
        vec2 c = vec2_add(a, vec2_scale(vec2_sub(b, a), t)); /* on the line to rounding */
        int o = orientation(a, b, c);
        ck_assert_int_eq(orientation(b, c, a), o);
        ck_assert_int_eq(orientation(c, a, b), o);
        ck_assert_int_eq(orientation(b, a, c), -o);
        ck_assert_int_eq(orientation(a, c, b), -o);
        ck_assert_int_eq(orientation(c, b, a), -o);
    }
}
END_TEST

typedef struct segment_case {
    double x[4], y[4];
    bool touch;
} segment_case;

START_TEST(segments_that_touch_and_do_not)
{
    static const segment_case list[] = {
        {{0, 2, 0, 2}, {0, 2, 2, 0}, true},    /* cross */
        {{0, 2, 1, 1}, {0, 0, 0, 5}, true},    /* T */
        {{0, 2, 2, 3}, {0, 0, 0, 5}, true},    /* common end */
        {{0, 2, 1, 3}, {0, 0, 0, 0}, true},    /* overlap on a line */
        {{0, 3, 1, 2}, {0, 3, 1, 2}, true},    /* one in the other */
        {{0, 1, 2, 3}, {0, 0, 0, 0}, false},   /* apart on a line */
        {{0, 1, 0, 1}, {0, 0, 1, 1}, false},   /* parallel */
        {{0, 4, 3, 3}, {0, 4, 0, 2.9}, false}, /* boxes overlap, segments do not */
        {{0, 2, 1, 1}, {0, 0, 0, 0}, true},    /* a point on a segment */
        {{0, 2, 1, 1}, {0, 2, 0, 0}, false},   /* a point beside one */
        {{1, 1, 1, 1}, {1, 1, 1, 1}, true},    /* two equal points */
        {{1, 1, 1, 1}, {1, 1, 2, 2}, false},   /* two points */
        {{0, 1, 0.5, 2}, {0, 0, 0x1p-60, 1}, false},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        vec2 p[4];
        for (int k = 0; k < 4; k++)
            p[k] = vec2_make(list[i].x[k], list[i].y[k]);
        for (int swap = 0; swap < 8; swap++) {
            vec2 a = p[swap & 1], b = p[1 - (swap & 1)], c = p[2 + (swap >> 1 & 1)], d = p[3 - (swap >> 1 & 1)];
            bool touch = swap & 4 ? segments_touch(c, d, a, b) : segments_touch(a, b, c, d);
            ck_assert_msg(touch == list[i].touch, "case %zu, swap %d", i, swap);
        }
    }
}
END_TEST

START_TEST(segment_contains_its_points)
{
    vec2 a = {0, 0}, b = {4, 2};
    ck_assert(segment_contains(a, b, a));
    ck_assert(segment_contains(a, b, b));
    ck_assert(segment_contains(a, b, vec2_make(2, 1)));
    ck_assert(!segment_contains(a, b, vec2_make(6, 3)));
    ck_assert(!segment_contains(a, b, vec2_make(2, 1 + 0x1p-52)));
    ck_assert(segment_contains(a, a, a));
    ck_assert(!segment_contains(a, a, b));
}
END_TEST

START_TEST(points_in_order)
{
    ck_assert_int_lt(vec2_compare(vec2_make(0, 5), vec2_make(1, 0)), 0);
    ck_assert_int_gt(vec2_compare(vec2_make(0, 5), vec2_make(0, 0)), 0);
    ck_assert_int_eq(vec2_compare(vec2_make(0, 5), vec2_make(-0.0, 5)), 0);
    ck_assert(vec2_equal(vec2_make(0, 5), vec2_make(-0.0, 5)));
}
END_TEST

TEST_MAIN("predicate", orientation_is_exact_near_a_line, orientation_of_plain_points, orientation_is_antisymmetric,
          segments_that_touch_and_do_not, segment_contains_its_points, points_in_order)
