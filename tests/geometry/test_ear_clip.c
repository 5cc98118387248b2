/* Ear clipping: area, edges and exactness on plain, straight-vertex, repeated-vertex and thin outlines. */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "geometry/ear_clip.h"
#include "geometry/predicate.h"

static context plain;

static void setup(void) { context_init(&plain); }

/* What bars an ear is looked for in a tree of boxes where there is memory for one, and along the ring where there is
   none: the same triangles, which both ways of failing show. */
static void expect_same_without_tree(polygon p, const index_array *t)
{
    enum { TREE = 3, COUNTS = 4 };
    for (long n = TREE; n <= COUNTS; n++) {
        failing_memory memory;
        context ctx = failing_context(&memory, n);
        index_array other = {0};
        ck_assert_int_eq(polygon_triangulate_ears(&ctx, p, &other), FRAM_OK);
        ck_assert(memory.failed || p.count < 64);
        ck_assert_int_eq(other.count, t->count);
        for (int32_t i = 0; i < t->count; i++)
            ck_assert_int_eq(other.data[i], t->data[i]);
        array_free(&ctx, &other);
        ck_assert_int_eq(memory.live, 0);
    }
}

/* Triangles have area, and each edge of the outline (repeated vertices skipped) is in one triangle, each inner edge in
   two, opposite ways: what a closed prism needs. */
static void check_triangles(polygon p, const index_array *t, int32_t expected)
{
    ck_assert_int_eq(t->count, 3 * expected);
    double area = 0;
    int32_t outline_edges = 0;
    for (int32_t i = 0; i < t->count; i += 3) {
        vec2 a = p.vertex[t->data[i]], b = p.vertex[t->data[i + 1]], c = p.vertex[t->data[i + 2]];
        ck_assert_int_eq(orientation(a, b, c), 1);
        area += 0.5 * vec2_cross(vec2_sub(b, a), vec2_sub(c, a));
        for (int32_t k = 0; k < 3; k++) {
            int32_t from = t->data[i + k], to = t->data[i + (k + 1) % 3], same = 0, opposite = 0;
            for (int32_t j = 0; j < t->count; j += 3)
                for (int32_t m = 0; m < 3; m++) {
                    int32_t u = t->data[j + m], v = t->data[j + (m + 1) % 3];
                    same += u == from && v == to;
                    opposite += u == to && v == from;
                }
            ck_assert_int_eq(same, 1);
            ck_assert_int_le(opposite, 1);
            outline_edges += opposite == 0;
        }
    }
    ck_assert_int_eq(outline_edges, expected + 2);
    double exact = polygon_area(p);
    assert_relative(area, exact, 1e-12);
}

static void check_outline(const vec2 *vertex, int32_t n, int32_t triangles)
{
    index_array t = {0};
    polygon p = {vertex, n};
    ck_assert_int_eq(polygon_triangulate_ears(&plain, p, &t), FRAM_OK);
    check_triangles(p, &t, triangles);
    expect_same_without_tree(p, &t);
    array_free(&plain, &t);
}

START_TEST(convex_and_concave_outlines)
{
    setup();
    const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    check_outline(square, 4, 2);
    const vec2 arrow[] = {{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};
    check_outline(arrow, 4, 2);
    const vec2 comb[] = {{0, 0}, {6, 0}, {6, 3}, {5, 3}, {5, 1}, {4, 1},
                         {4, 3}, {3, 3}, {3, 1}, {2, 1}, {2, 3}, {0, 3}};
    check_outline(comb, 12, 10);
}
END_TEST

START_TEST(straight_vertices_are_kept)
{
    setup();
    const vec2 square[] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    check_outline(square, 8, 6);
    const vec2 triangle[] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 3}};
    check_outline(triangle, 5, 3);
    const vec2 notch[] = {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    check_outline(notch, 8, 6);
}
END_TEST

START_TEST(repeated_vertices_are_skipped)
{
    setup();
    const vec2 v[] = {{0, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}, {0, 0}};
    check_outline(v, 9, 2);
}
END_TEST

/* 1e-15 m wide, and far from the origin: plain cross products would see no area or the wrong sign. */
START_TEST(thin_outlines_are_exact)
{
    setup();
    const vec2 sliver[] = {{0, 0}, {1, 0}, {2, 0x1p-50}, {1, 0x1p-51 + 0x1p-52}, {0, 0x1p-52}};
    index_array t = {0};
    ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){sliver, 5}, &t), FRAM_OK);
    ck_assert_int_eq(t.count, 9);
    const vec2 far[] = {{8.5e6, 8.5e6}, {8.5e6 + 1, 8.5e6}, {8.5e6 + 1, 8.5e6 + 0x1p-29}, {8.5e6, 8.5e6 + 0x1p-29}};
    ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){far, 4}, &t), FRAM_OK);
    check_triangles((polygon){far, 4}, &t, 2);
    array_free(&plain, &t);
}
END_TEST

/* Star-shaped outlines of 3 to 202 vertices. */
START_TEST(random_stars)
{
    setup();
    random_stream r = random_begin(11, 0, 0);
    index_array t = {0};
    for (int round = 0; round < 400; round++) {
        vec2 v[202];
        int32_t n = 3 + (int32_t)(random_bits(&r) % 200);
        for (int32_t i = 0; i < n; i++) {
            double angle = 2 * PI * (i + 0.5) / n, radius = random_uniform(&r, 2, 10);
            v[i] = vec2_make(radius * real_cos(angle), radius * real_sin(angle));
        }
        ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){v, n}, &t), FRAM_OK);
        check_triangles((polygon){v, n}, &t, n - 2);
        expect_same_without_tree((polygon){v, n}, &t);
    }
    array_free(&plain, &t);
}
END_TEST

/* A staircase of unit steps with every lattice point on its sides as a vertex: straight vertices everywhere. */
START_TEST(staircase_of_lattice_points)
{
    setup();
    vec2 v[256];
    int32_t n = 0;
    for (int i = 0; i <= 40; i++)
        v[n++] = vec2_make(i, 0);
    for (int i = 40; i > 0; i--) {
        v[n++] = vec2_make(i, 41 - i);
        v[n++] = vec2_make(i - 1, 41 - i);
    }
    for (int j = 39; j > 0; j--)
        v[n++] = vec2_make(0, j);
    check_outline(v, n, n - 2);
}
END_TEST

/* A rough shore about a rough lake that a bridge joins, every place a multiple of a step: places with two vertices,
   straight and repeated ones, in a ring long enough for a tree. */
START_TEST(lakes_with_bridges)
{
    setup();
    random_stream r = random_begin(12, 0, 0);
    index_array t = {0};
    int made = 0;
    for (int round = 0; round < 200; round++) {
        enum { SHORE = 60, LAKE = 40 };
        vec2 v[SHORE + LAKE + 2];
        for (int i = 0; i <= SHORE; i++) {
            double angle = 2 * PI * i / SHORE, radius = i % SHORE ? random_uniform(&r, 6, 9) : 9;
            v[i] = i < SHORE ? vec2_make(radius * real_cos(angle), radius * real_sin(angle)) : v[0];
        }
        for (int i = 0; i <= LAKE; i++) {
            double angle = -2 * PI * i / LAKE, radius = i % LAKE ? random_uniform(&r, 2, 5) : 5;
            vec2 at = {radius * real_cos(angle), radius * real_sin(angle)};
            v[SHORE + 1 + i] = i < LAKE ? at : v[SHORE + 1];
        }
        for (int i = 0; i < SHORE + LAKE + 2; i++)
            v[i] = vec2_make(floor(8 * v[i].x) / 8, floor(8 * v[i].y) / 8);
        polygon p = {v, SHORE + LAKE + 2};
        /* Rounding makes some touch themselves elsewhere. */
        if (polygon_triangulate_ears(&plain, p, &t) != FRAM_OK)
            continue;
        made++;
        expect_same_without_tree(p, &t);
    }
    ck_assert_int_gt(made, 100);
    array_free(&plain, &t);
}
END_TEST

/* A square with a hole that a bridge joins, and one with a hole that touches its corner: places with two vertices.  Two
   squares that hang together by a corner have no triangulation without degenerate triangles. */
START_TEST(outlines_that_touch_themselves)
{
    setup();
    const vec2 keyhole[] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}};
    check_outline(keyhole, 10, 8);
    const vec2 touching[] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 6}, {6, 3}};
    check_outline(touching, 7, 5);
    const vec2 hanging[] = {{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
    index_array t = {0};
    ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){hanging, 8}, &t), FRAM_ERROR_INPUT);
    array_free(&plain, &t);
}
END_TEST

START_TEST(what_is_refused)
{
    setup();
    index_array t = {0};
    const vec2 clockwise[] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    const vec2 flat[] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
    const vec2 point[] = {{1, 1}, {1, 1}, {1, 1}};
    ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){clockwise, 4}, &t), FRAM_ERROR_INPUT);
    ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){flat, 4}, &t), FRAM_ERROR_INPUT);
    ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){point, 3}, &t), FRAM_ERROR_INPUT);
    ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){flat, 2}, &t), FRAM_ERROR_INPUT);
    ck_assert_int_eq(polygon_triangulate_ears(&plain, (polygon){NULL, 0}, &t), FRAM_ERROR_INPUT);
    ck_assert_int_eq(t.count, 0);
    array_free(&plain, &t);
}
END_TEST

START_TEST(memory_runs_out)
{
    const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        index_array t = {0};
        turn.status = polygon_triangulate_ears(&turn.ctx, (polygon){square, 4}, &t);
        array_free(&turn.ctx, &t);
    }
}
END_TEST

TEST_MAIN("ear_clip", lakes_with_bridges, convex_and_concave_outlines, straight_vertices_are_kept,
          repeated_vertices_are_skipped, thin_outlines_are_exact, random_stars, staircase_of_lattice_points,
          outlines_that_touch_themselves, what_is_refused, memory_runs_out)
