/* Convexity (Algorithm 11), hulls, oriented boxes (Algorithm 9), separating axes. */
#include "geometry/outlines.h"

#include "geometry/predicate.h"

static context plain;

static bool convex(const vec2 *v, int32_t n) { return polygon_is_convex((polygon){v, n}); }

START_TEST(convex_rings)
{
    const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    ck_assert(convex(square, 4));
    ck_assert(convex(square, 3));
    const vec2 clockwise[] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    ck_assert(convex(clockwise, 4));
    const vec2 straight[] = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    ck_assert(convex(straight, 7));
    const vec2 repeated[] = {{0, 0}, {0, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 2}, {0, 0}};
    ck_assert(convex(repeated, 8));
    const vec2 needle[] = {{0, 0}, {100, 0}, {100, 1e-6}};
    ck_assert(convex(needle, 3));
}
END_TEST

START_TEST(rings_that_are_not_convex)
{
    const vec2 arrow[] = {{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};
    ck_assert(!convex(arrow, 4));
    /* The reflex vertex at each place of the ring: the printed index range misses some. */
    for (int first = 0; first < 4; first++) {
        vec2 v[4];
        for (int i = 0; i < 4; i++)
            v[i] = arrow[(first + i) % 4];
        ck_assert(!convex(v, 4));
    }
    const vec2 dent[] = {{0, 0}, {1, 1e-9}, {2, 0}, {2, 2}, {0, 2}};
    ck_assert(!convex(dent, 5));
    const vec2 line[] = {{0, 0}, {1, 0}, {2, 0}, {1, 0}};
    ck_assert(!convex(line, 4));
    const vec2 point[] = {{1, 1}, {1, 1}, {1, 1}};
    ck_assert(!convex(point, 3));
    ck_assert(!convex(point, 0));
    const vec2 spike[] = {{0, 0}, {2, 0}, {2, 2}, {2, 4}, {2, 2}, {0, 2}};
    ck_assert(!convex(spike, 6));
    const vec2 spike_on_edge[] = {{0, 0}, {2, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}};
    ck_assert(!convex(spike_on_edge, 6));
}
END_TEST

/* Left turns only, but two turns in all. */
START_TEST(rings_that_wind_twice)
{
    vec2 pentagram[5], twice[8], limacon[60];
    for (int i = 0; i < 5; i++)
        pentagram[i] = vec2_make(real_cos(4 * PI * i / 5), real_sin(4 * PI * i / 5));
    for (int i = 0; i < 8; i++)
        twice[i] = vec2_make(real_cos(PI * i / 2 + (i < 4 ? 0 : 0.1)), real_sin(PI * i / 2 + (i < 4 ? 0 : 0.1)));
    for (int i = 0; i < 60; i++) {
        double a = 2 * PI * (i + 0.5) / 60, radius = 1 + 2 * real_cos(a);
        limacon[i] = vec2_make(radius * real_cos(a), radius * real_sin(a));
    }
    ck_assert(!convex(pentagram, 5));
    ck_assert(!convex(twice, 8));
    for (int first = 0; first < 60; first++) {
        vec2 v[60];
        for (int i = 0; i < 60; i++)
            v[i] = limacon[(first + i) % 60];
        ck_assert(!convex(v, 60));
    }
}
END_TEST

/* What an overlay leaves: vertices that rounding moved off a straight edge, which no exact sign would forgive. */
START_TEST(rounding_is_forgiven)
{
    random_stream r = random_begin(41, 0, 0);
    int exactly_convex = 0;
    for (int round = 0; round < 2000; round++) {
        vec2 v[2 * OUTLINE_ROOM];
        int32_t n = outline_count(&r, 3, 12);
        vec2 corner[12], centre = {random_uniform(&r, -50, 50), random_uniform(&r, -50, 50)};
        outline_convex(&r, centre, 5, n, corner);
        bool exact = true;
        for (int32_t i = 0; i < n; i++) {
            vec2 next = corner[(i + 1) % n];
            v[2 * i] = corner[i];
            v[2 * i + 1] = vec2_add(corner[i], vec2_scale(vec2_sub(next, corner[i]), random_uniform(&r, 0.2, 0.8)));
            exact &= orientation(corner[i], v[2 * i + 1], next) >= 0;
        }
        exactly_convex += exact;
        ck_assert(convex(v, 2 * n));
        v[1] = vec2_add(v[1], vec2_scale(vec2_sub(centre, v[1]), 1e-9));
        ck_assert(!convex(v, 2 * n));
    }
    ck_assert_int_lt(exactly_convex, 1000);
}
END_TEST

/* A ring is convex when every vertex is on its hull, in order. */
START_TEST(convex_as_its_hull)
{
    context_init(&plain);
    random_stream r = random_begin(42, 0, 0);
    vec2_array hull = {0};
    int count = 0;
    for (int round = 0; round < 20000; round++) {
        vec2 v[OUTLINE_ROOM];
        int32_t n = outline_count(&r, 3, 7);
        polygon p = outline_star(&r, vec2_make(2, 1), 4, 9, n, v);
        ck_assert(polygon_convex_hull(&plain, p, &hull));
        ck_assert_int_eq(polygon_is_convex(p), hull.count == n);
        count += hull.count == n;
    }
    ck_assert_int_gt(count, 1000);
    ck_assert_int_lt(count, 19000);
    array_free(&plain, &hull);
}
END_TEST

START_TEST(hull_of_points)
{
    context_init(&plain);
    random_stream r = random_begin(43, 0, 0);
    vec2_array hull = {0};
    for (int round = 0; round < 500; round++) {
        vec2 v[100];
        int32_t n = outline_count(&r, 1, 100);
        for (int32_t i = 0; i < n; i++)
            v[i] = vec2_make(random_normal(&r), random_normal(&r));
        if (round % 2)
            outline_snap(v, n, 1);
        ck_assert(polygon_convex_hull(&plain, (polygon){v, n}, &hull));
        polygon h = {hull.data, hull.count};
        if (h.count >= 3) {
            for (int32_t i = 0; i < h.count; i++)
                ck_assert_int_eq(orientation(h.vertex[i], h.vertex[(i + 1) % h.count], h.vertex[(i + 2) % h.count]), 1);
            ck_assert(polygon_is_convex(h));
            for (int32_t i = 0; i < n; i++)
                ck_assert(polygon_contains(h, v[i]));
        } else {
            for (int32_t i = 0; i < n; i++)
                ck_assert(segment_contains(h.vertex[0], h.vertex[h.count - 1], v[i]));
        }
        for (int32_t i = 0; i < n; i++)
            ck_assert_int_le(vec2_compare(h.vertex[0], v[i]), 0);
        for (int32_t k = 0; k < h.count; k++) {
            int32_t i = 0;
            while (i < n && !vec2_equal(v[i], h.vertex[k]))
                i++;
            ck_assert_int_lt(i, n);
        }
    }
    ck_assert(polygon_convex_hull(&plain, (polygon){NULL, 0}, &hull));
    ck_assert_int_eq(hull.count, 0);
    array_free(&plain, &hull);
}
END_TEST

/* Area of the box along a direction, straight from the definition. */
static double box_area(polygon p, vec2 x)
{
    double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int32_t i = 0; i < p.count; i++) {
        double c[2] = {vec2_dot(p.vertex[i], x), vec2_dot(p.vertex[i], vec2_perp(x))};
        for (int k = 0; k < 2; k++) {
            lo[k] = fmin(lo[k], c[k]);
            hi[k] = fmax(hi[k], c[k]);
        }
    }
    return (hi[0] - lo[0]) * (hi[1] - lo[1]);
}

static vec2 unit(vec2 v) { return vec2_scale(v, 1 / vec2_length(v)); }

/* Against every direction between two vertices (hull edges are among them) and a scan of all angles; polygon edges
   alone, as printed, must miss the least area often. */
START_TEST(oriented_box_is_least)
{
    context_init(&plain);
    random_stream r = random_begin(44, 0, 0);
    double worst_print = 1;
    for (int round = 0; round < 300; round++) {
        vec2 v[OUTLINE_ROOM];
        polygon p = outline_star(&r, vec2_make(30, -20), 2, 9, outline_count(&r, 3, 20), v);
        oriented_box box;
        ck_assert_int_eq(polygon_oriented_box(&plain, p, &box), FRAM_OK);
        double area = box.sides[0] * box.sides[1], pairs = HUGE_VAL, edges = HUGE_VAL;
        for (int32_t i = 0; i < p.count; i++)
            for (int32_t j = 0; j < i; j++) {
                double a = box_area(p, unit(vec2_sub(v[i], v[j])));
                pairs = fmin(pairs, a);
                edges = i - j == 1 || i - j == p.count - 1 ? fmin(edges, a) : edges;
            }
        assert_relative(area, pairs, 1e-12);
        for (int k = 0; k < 400; k++)
            ck_assert_double_le(area,
                                box_area(p, vec2_make(real_cos(PI * k / 800), real_sin(PI * k / 800))) * (1 + 1e-12));
        worst_print = fmax(worst_print, edges / area);
        /* the box itself: unit axis, sides in order, everything inside */
        assert_relative(vec2_length(box.axis), 1, 1e-15);
        ck_assert_double_ge(box.sides[0], box.sides[1]);
        for (int32_t i = 0; i < p.count; i++) {
            vec2 d = vec2_sub(v[i], box.centre);
            ck_assert_double_le(fabs(vec2_dot(d, box.axis)), box.sides[0] / 2 + 1e-12);
            ck_assert_double_le(fabs(vec2_cross(box.axis, d)), box.sides[1] / 2 + 1e-12);
        }
    }
    ck_assert_double_gt(worst_print, 1.1);
}
END_TEST

START_TEST(oriented_box_of_a_turned_rectangle)
{
    context_init(&plain);
    for (int k = 0; k < 36; k++) {
        double c = real_cos(PI * k / 18), s = real_sin(PI * k / 18);
        const double x[] = {0, 7, 7, 3, 0}, y[] = {0, 0, 2, 2, 2};
        vec2 v[5];
        for (int i = 0; i < 5; i++)
            v[i] = vec2_make(100 + c * x[i] - s * y[i], s * x[i] + c * y[i]);
        oriented_box box;
        ck_assert_int_eq(polygon_oriented_box(&plain, (polygon){v, 5}, &box), FRAM_OK);
        assert_relative(box.sides[0], 7, 1e-12);
        assert_relative(box.sides[1], 2, 1e-12);
        assert_absolute(fabs(box.axis.x * c + box.axis.y * s), 1, 1e-12);
        assert_vec2_close(box.centre, vec2_make(100 + 3.5 * c - s, 3.5 * s + c), 1e-12);
    }
}
END_TEST

START_TEST(oriented_box_of_degenerate_rings)
{
    context_init(&plain);
    oriented_box box;
    const vec2 line[] = {{0, 0}, {3, 4}, {1.5, 2}};
    ck_assert_int_eq(polygon_oriented_box(&plain, (polygon){line, 3}, &box), FRAM_OK);
    assert_absolute(box.sides[0], 5, 1e-15);
    assert_absolute(box.sides[1], 0, 1e-15);
    ck_assert_int_eq(polygon_oriented_box(&plain, (polygon){line, 1}, &box), FRAM_OK);
    assert_absolute(box.sides[0], 0, 0);
    assert_vec2_close(box.axis, vec2_make(1, 0), 0);
    ck_assert_int_eq(polygon_oriented_box(&plain, (polygon){line, 0}, &box), FRAM_ERROR_INPUT);
}
END_TEST

START_TEST(depth_of_squares)
{
    const vec2 a[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    vec2 b[4], axis;
    for (int i = 0; i < 4; i++)
        b[i] = vec2_make(a[i].x + 1.75, a[i].y + 0.5);
    assert_absolute(polygon_convex_depth((polygon){a, 4}, (polygon){b, 4}, &axis), 0.25, 1e-15);
    assert_vec2_close(axis, vec2_make(1, 0), 0);
    assert_absolute(polygon_convex_depth((polygon){b, 4}, (polygon){a, 4}, &axis), 0.25, 1e-15);
    assert_vec2_close(axis, vec2_make(-1, 0), 0);
    for (int i = 0; i < 4; i++)
        b[i] = vec2_make(a[i].x - 1, a[i].y - 5);
    assert_absolute(polygon_convex_depth((polygon){a, 4}, (polygon){b, 4}, &axis), -3, 1e-15);
    assert_vec2_close(axis, vec2_make(0, -1), 0);
    assert_absolute(polygon_convex_depth((polygon){a, 4}, (polygon){b, 4}, NULL), -3, 1e-15);
    /* only b's own edge sees the gap between a corner and a slope; a's edges are repeated vertices too */
    const vec2 slope[] = {{2.5, 2}, {2.5, 2}, {5, 5}, {2, 2.5}};
    assert_absolute(polygon_convex_depth((polygon){a, 4}, (polygon){slope, 4}, &axis), -sqrt(0.125), 1e-15);
    assert_vec2_close(axis, vec2_make(sqrt(0.5), sqrt(0.5)), 1e-15);
}
END_TEST

/* Moving b by the depth along the axis ends the overlap; by a little less it does not. */
START_TEST(depth_parts_two_rings)
{
    context_init(&plain);
    random_stream r = random_begin(45, 0, 0);
    vec2_array common = {0};
    int overlapping = 0;
    for (int round = 0; round < 5000; round++) {
        vec2 a[OUTLINE_ROOM], b[OUTLINE_ROOM], axis;
        polygon p = outline_convex(&r, vec2_make(0, 0), 3, outline_count(&r, 3, 9), a);
        vec2 centre = {random_uniform(&r, -6, 6), random_uniform(&r, -6, 6)};
        polygon q = outline_convex(&r, centre, 2, outline_count(&r, 3, 9), b);
        double depth = polygon_convex_depth(p, q, &axis);
        ck_assert(polygon_clip_convex(&plain, p, q, &common));
        ck_assert_int_eq(common.count > 0, depth > 0);
        assert_relative(vec2_length(axis), 1, 1e-14);
        if (depth <= 0)
            continue;
        overlapping++;
        vec2 old[OUTLINE_ROOM];
        memcpy(old, b, sizeof old);
        for (int side = 0; side < 2; side++) {
            for (int32_t i = 0; i < q.count; i++)
                b[i] = vec2_add(old[i], vec2_scale(axis, depth + (side ? 1e-9 : -1e-9)));
            ck_assert(polygon_clip_convex(&plain, p, q, &common));
            ck_assert_int_eq(common.count > 0, side == 0);
        }
    }
    ck_assert_int_gt(overlapping, 1000);
    array_free(&plain, &common);
}
END_TEST

START_TEST(memory_runs_out)
{
    const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        oriented_box box;
        turn.status = polygon_oriented_box(&turn.ctx, (polygon){square, 4}, &box);
    }
}
END_TEST

TEST_MAIN("polygon_convex", convex_rings, rings_that_are_not_convex, rings_that_wind_twice, rounding_is_forgiven,
          convex_as_its_hull, hull_of_points, oriented_box_is_least, oriented_box_of_a_turned_rectangle,
          oriented_box_of_degenerate_rings, depth_of_squares, depth_parts_two_rings, memory_runs_out)
