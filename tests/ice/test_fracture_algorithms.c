/* Algorithms 7 to 11 of the reference, repaired, on 15,000 random polygons each (100,000 with FRAM_TEST_LONG), against
   other ways to the same. */
#include "fracture_rig.h"

#include "geometry/outlines.h"

#include "ice/fracture_parts.h"

enum { ROOM = 64 };

static int cases(void) { return getenv("FRAM_TEST_SHORT") ? 5000 : getenv("FRAM_TEST_LONG") ? 100000 : 15000; }

/* A star about the origin, convex or not, at times on a grid; simple. */
static polygon random_polygon(random_stream *s, vec2 out[ROOM])
{
    int n = 3 + (int)random_uniform(s, 0, 14);
    double size = random_power_law(s, 1, 100, 0), inner = random_unit(s) < 0.3 ? 1 : random_uniform(s, 0.3, 1);
    for (int i = 0; i < n; i++) {
        double angle = 2 * PI * (i + 0.7 * random_unit(s)) / n, radius = size * random_uniform(s, inner, 1);
        out[i] = (vec2){radius * real_cos(angle), radius * real_sin(angle)};
    }
    return (polygon){out, n};
}

static vec2 random_near(random_stream *s, polygon p)
{
    int32_t i = (int32_t)random_uniform(s, 0, p.count);
    vec2 a = p.vertex[i], b = p.vertex[(i + 1) % p.count];
    vec2 on = random_unit(s) < 0.2 ? a : vec2_add(a, vec2_scale(vec2_sub(b, a), random_unit(s)));
    return vec2_scale(on, random_uniform(s, 0.7, 1));
}

/* 7: the start is the nearest of the boundary's points; the direction leads into the ice. */
START_TEST(crack_starts)
{
    vec2 room[ROOM];
    int at_corners = 0;
    for (int i = 0; i < cases(); i++) {
        random_stream s = random_begin(7, 1, (uint32_t)i);
        polygon p = random_polygon(&s, room);
        if (!(polygon_area(p) > 0))
            continue;
        vec2 load = random_near(&s, p);
        double size = polygon_diameter(p);
        crack_start c = crack_start_of(p, load, 1e-6 * size);
        for (int32_t k = 0; k < p.count; k++) {
            vec2 a = p.vertex[k], b = p.vertex[(k + 1) % p.count];
            for (int m = 0; m <= 10; m++) {
                vec2 q = vec2_add(a, vec2_scale(vec2_sub(b, a), m / 10.0));
                ck_assert_double_ge(vec2_length(vec2_sub(q, load)), c.distance - 1e-12 * size);
            }
        }
        assert_absolute(vec2_length(c.direction), 1, 1e-12);
        bool corner = c.point.x == p.vertex[c.edge].x && c.point.y == p.vertex[c.edge].y;
        at_corners += corner;
        vec2 e = vec2_sub(p.vertex[(c.edge + 1) % p.count], p.vertex[c.edge]);
        if (!corner)
            assert_absolute(vec2_dot(e, c.direction), 0, 1e-12 * size);
        ck_assert_double_gt(vec2_cross(e, c.direction), -1e-12 * size);
        ck_assert(polygon_contains(p, vec2_add(c.point, vec2_scale(c.direction, 1e-9 * size))));
    }
    ck_assert_int_gt(at_corners, cases() / 500);
}
END_TEST

/* 8: the way through ends where the ray first leaves the polygon. */
START_TEST(ways_through)
{
    vec2 room[ROOM];
    for (int i = 0; i < cases(); i++) {
        random_stream s = random_begin(8, 1, (uint32_t)i);
        polygon p = random_polygon(&s, room);
        if (!(polygon_area(p) > 0))
            continue;
        crack_start c = crack_start_of(p, random_near(&s, p), 0);
        int32_t edge;
        double length = crack_length(p, &c, &edge), size = polygon_diameter(p);
        ck_assert_int_ge(edge, 0);
        ck_assert(length > 0 && length <= size * (1 + 1e-12));
        if (length < 1e-6 * size)
            continue;
        for (int m = 1; m < 16; m++)
            ck_assert(polygon_contains(p, vec2_add(c.point, vec2_scale(c.direction, length * m / 16))));
        vec2 end = vec2_add(c.point, vec2_scale(c.direction, length));
        vec2 near = polygon_nearest_boundary(p, end, NULL);
        assert_absolute(vec2_length(vec2_sub(near, end)), 0, 1e-12 * size);
    }
}
END_TEST

/* 9: no box at any of 180 angles is smaller. */
START_TEST(boxes)
{
    context ctx;
    context_init(&ctx);
    vec2 room[ROOM];
    for (int i = 0; i < cases(); i++) {
        random_stream s = random_begin(9, 1, (uint32_t)i);
        polygon p = random_polygon(&s, room);
        oriented_box box;
        ck_assert_int_eq(polygon_oriented_box(&ctx, p, &box), FRAM_OK);
        double area = box.sides[0] * box.sides[1];
        ck_assert(area >= polygon_area(p) * (1 - 1e-12));
        vec2 axis = {1, 0};
        const vec2 turn = {real_cos(PI / 36), real_sin(PI / 36)};
        for (int m = 0; m < 18; m++) {
            double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
            for (int32_t k = 0; k < p.count; k++) {
                double u = vec2_dot(axis, p.vertex[k]), v = vec2_cross(axis, p.vertex[k]);
                lo[0] = fmin(lo[0], u), hi[0] = fmax(hi[0], u), lo[1] = fmin(lo[1], v), hi[1] = fmax(hi[1], v);
            }
            ck_assert_double_ge((hi[0] - lo[0]) * (hi[1] - lo[1]), area * (1 - 1e-12));
            axis = (vec2){axis.x * turn.x - axis.y * turn.y, axis.x * turn.y + axis.y * turn.x};
        }
    }
}
END_TEST

/* 10: no short edge stays, and no more area goes than a rim as wide as the edge threshold has. */
START_TEST(cleaning)
{
    context ctx;
    context_init(&ctx);
    vec2 room[ROOM];
    vec2_array out = {0};
    for (int i = 0; i < cases(); i++) {
        random_stream s = random_begin(10, 1, (uint32_t)i);
        polygon p = random_polygon(&s, room);
        double edge = polygon_diameter(p) * random_power_law(&s, 1e-3, 0.2, 0);
        ck_assert(polygon_clean(&ctx, p, edge, &out));
        ck_assert_int_ge(out.count, 3);
        for (int32_t k = 0; k < out.count && out.count > 3; k++) {
            vec2 e = vec2_sub(out.data[(k + 1) % out.count], out.data[k]);
            ck_assert_double_ge(vec2_length(e), edge * (1 - 1e-12));
        }
        if (out.count > 3)
            ck_assert(fabs(polygon_area((polygon){out.data, out.count}) - polygon_area(p)) <
                      2 * edge * polygon_perimeter(p));
    }
    array_free(&ctx, &out);
}
END_TEST

/* 11: convex is what has as many vertices as its hull. */
START_TEST(convexity)
{
    context ctx;
    context_init(&ctx);
    vec2 room[ROOM];
    vec2_array hull = {0};
    int convex = 0;
    for (int i = 0; i < cases(); i++) {
        random_stream s = random_begin(11, 1, (uint32_t)i);
        polygon p = random_polygon(&s, room);
        if (!(polygon_area(p) > 0))
            continue;
        ck_assert(polygon_convex_hull(&ctx, p, &hull));
        ck_assert_int_eq(polygon_is_convex(p), hull.count == p.count);
        convex += hull.count == p.count;
    }
    ck_assert_int_gt(convex, cases() / 10);
    array_free(&ctx, &hull);
}
END_TEST

TEST_MAIN("fracture_algorithms", crack_starts, ways_through, boxes, cleaning, convexity)
