/* Clipping by half planes and convex polygons, against GEOS and against itself. */
#include "geometry/outlines.h"

#include "geometry/overlay.h"
#include "geometry/predicate.h"

static context plain;

static polygon view(const vec2_array *a) { return (polygon){a->data, a->count}; }

START_TEST(half_plane_of_a_square)
{
    context_init(&plain);
    const vec2 v[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    polygon square = {v, 4};
    vec2_array out = {0};
    ck_assert(polygon_clip_half_plane(&plain, square, vec2_make(4, 0), 2, &out)); /* x <= 1/2 */
    const vec2 strip[] = {{0, 0}, {0.5, 0}, {0.5, 2}, {0, 2}};
    ck_assert_int_eq(out.count, 4);
    assert_array_bits(&out.data->x, &strip->x, 8);
    ck_assert(polygon_clip_half_plane(&plain, square, vec2_make(1, 0), 2, &out)); /* touches an edge: whole */
    ck_assert_int_eq(out.count, 4);
    ck_assert(polygon_clip_half_plane(&plain, square, vec2_make(-1, 0), -2, &out)); /* only that edge: nothing */
    ck_assert_int_eq(out.count, 0);
    ck_assert(polygon_clip_half_plane(&plain, square, vec2_make(-1, -1), -4, &out)); /* only a vertex */
    ck_assert_int_eq(out.count, 0);
    ck_assert(polygon_clip_half_plane(&plain, square, vec2_make(1, -1), 0, &out)); /* along the diagonal */
    ck_assert_int_eq(out.count, 3);
    ck_assert(polygon_clip_half_plane(&plain, (polygon){NULL, 0}, vec2_make(1, 0), 0, &out));
    ck_assert_int_eq(out.count, 0);
    const vec2 ell[] = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}; /* two prongs */
    ck_assert(polygon_clip_half_plane(&plain, (polygon){ell, 8}, vec2_make(0, -1), -2, &out));
    assert_absolute(polygon_area(view(&out)), 2, 1e-15);
    array_free(&plain, &out);
}
END_TEST

/* Both sides of a cut fit: areas add up and the new vertices are the same bits. */
START_TEST(two_halves_fit)
{
    context_init(&plain);
    random_stream r = random_begin(61, 0, 0);
    vec2_array left = {0}, right = {0};
    for (int round = 0; round < 5000; round++) {
        vec2 v[OUTLINE_ROOM], n = {random_normal(&r), random_normal(&r)};
        polygon p = outline_star(&r, vec2_make(7, -3), round % 2 ? 8 : 3, 8, outline_count(&r, 3, 30), v);
        double d = vec2_dot(n, vec2_make(7, -3)) + random_uniform(&r, -3, 3) * vec2_length(n);
        ck_assert(polygon_clip_half_plane(&plain, p, n, d, &left));
        ck_assert(polygon_clip_half_plane(&plain, p, vec2_scale(n, -1), -d, &right));
        double area = polygon_area(p);
        assert_absolute(polygon_area(view(&left)) + polygon_area(view(&right)), area, 1e-14 * area);
        for (int32_t i = 0; i < left.count; i++) {
            bool old = false, shared = false;
            for (int32_t k = 0; k < p.count; k++)
                old |= vec2_equal(v[k], left.data[i]);
            for (int32_t k = 0; k < right.count; k++)
                shared |= vec2_equal(right.data[k], left.data[i]);
            ck_assert(old || shared);
        }
    }
    array_free(&plain, &left);
    array_free(&plain, &right);
}
END_TEST

/* The outlines of the next test: general ones, and ones that share edges, vertices, or everything. */
static void make_pair(random_stream *r, int kind, vec2 *a, int32_t *n, vec2 *b, int32_t *m)
{
    vec2_array hull = {0};
    *n = outline_count(r, 3, 9);
    *m = outline_count(r, 3, 9);
    outline_convex(r, vec2_make(0, 0), 3, *n, a);
    outline_convex(r, vec2_make(random_uniform(r, -4, 4), random_uniform(r, -4, 4)), 2.5, *m, b);
    if (kind == 1) { /* on a grid: shared lines, vertices on edges */
        outline_snap(a, *n, 0.5);
        outline_snap(b, *m, 0.5);
    } else if (kind == 2) { /* b shares an edge with a, and continues it */
        vec2 e = vec2_sub(a[1], a[0]);
        b[0] = a[1];
        b[1] = vec2_sub(a[0], vec2_scale(e, 0.25));
        b[2] = vec2_add(a[0], vec2_scale(vec2_perp(e), round(random_uniform(r, 0, 2)) == 1 ? 0.7 : -0.7));
        *m = 3;
    } else if (kind == 3) { /* nearly or exactly the same */
        double shift = random_bits(r) % 2 ? 0 : 1e-12;
        for (int32_t i = 0; i < *n; i++)
            b[i] = vec2_make(a[i].x + shift, a[i].y - shift);
        *m = *n;
    }
    context_init(&plain);
    ck_assert(polygon_convex_hull(&plain, (polygon){a, *n}, &hull));
    memcpy(a, hull.data, (size_t)hull.count * sizeof *a);
    *n = hull.count;
    ck_assert(polygon_convex_hull(&plain, (polygon){b, *m}, &hull));
    memcpy(b, hull.data, (size_t)hull.count * sizeof *b);
    *m = hull.count;
    array_free(&plain, &hull);
}

/* 140,000 pairs, 105,000 of them degenerate: the common area is the one that GEOS finds, either way round, and the
   result is convex. */
START_TEST(common_part_as_geos_finds_it)
{
    context_init(&plain);
    overlay *o = overlay_create(&plain);
    random_stream r = random_begin(62, 0, 0);
    vec2_array ab = {0}, ba = {0};
    polygon_list geos = {0};
    fram_error error;
    int cases = getenv("FRAM_TEST_SHORT") ? 10000 : 40000, overlapping = 0;
    for (int round = 0; round < cases; round++) {
        vec2 a[16], b[16];
        int32_t n, m;
        make_pair(&r, round % 4, a, &n, b, &m);
        polygon p = {a, n}, q = {b, m};
        if (polygon_area(p) <= 0 || polygon_area(q) <= 0)
            continue;
        polygon_list_clear(&geos);
        ck_assert(polygon_clip_convex(&plain, p, q, &ab));
        ck_assert(polygon_clip_convex(&plain, q, p, &ba));
        assert_ok(overlay_intersection(o, p, q, &geos, &error), error);
        double expected = list_area(&geos);
        assert_absolute(polygon_area(view(&ab)), expected, 1e-13);
        assert_absolute(polygon_area(view(&ba)), expected, 1e-13);
        if (ab.count > 0 && expected > 1e-9)
            ck_assert(polygon_is_convex(view(&ab)));
        ck_assert_int_le(ab.count, n + m);
        for (int32_t i = 0; i < ab.count; i++) {
            double past[2] = {-polygon_convex_depth(p, (polygon){&ab.data[i], 1}, NULL),
                              -polygon_convex_depth(q, (polygon){&ab.data[i], 1}, NULL)};
            ck_assert_double_le(testing_larger(past[0], past[1]), 1e-13);
        }
        overlapping += expected > 0;
    }
    ck_assert_int_gt(overlapping, cases / 3);
    polygon_list_free(&plain, &geos);
    array_free(&plain, &ab);
    array_free(&plain, &ba);
    overlay_free(o);
}
END_TEST

START_TEST(touching_polygons_have_nothing_in_common)
{
    context_init(&plain);
    const vec2 a[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, edge[] = {{2, 0}, {4, 0}, {4, 2}, {2, 2}};
    const vec2 corner[] = {{2, 2}, {4, 2}, {4, 4}, {2, 4}}, inside[] = {{0.5, 0.5}, {1, 0.5}, {1, 1}};
    vec2_array out = {0};
    ck_assert(polygon_clip_convex(&plain, (polygon){a, 4}, (polygon){edge, 4}, &out));
    ck_assert_int_eq(out.count, 0);
    ck_assert(polygon_clip_convex(&plain, (polygon){a, 4}, (polygon){corner, 4}, &out));
    ck_assert_int_eq(out.count, 0);
    ck_assert(polygon_clip_convex(&plain, (polygon){a, 4}, (polygon){inside, 3}, &out));
    ck_assert_int_eq(out.count, 3);
    ck_assert(polygon_clip_convex(&plain, (polygon){inside, 3}, (polygon){a, 4}, &out));
    ck_assert_int_eq(out.count, 3);
    ck_assert(polygon_clip_convex(&plain, (polygon){a, 4}, (polygon){a, 4}, &out));
    ck_assert_int_eq(out.count, 4);
    assert_array_bits(&out.data->x, &a->x, 8);
    ck_assert(polygon_clip_convex(&plain, (polygon){a, 2}, (polygon){a, 4}, &out));
    ck_assert_int_eq(out.count, 0);
    const vec2 repeated[] = {{1, 1}, {1, 1}, {3, 1}, {3, 3}, {3, 3}, {1, 3}};
    ck_assert(polygon_clip_convex(&plain, (polygon){a, 4}, (polygon){repeated, 6}, &out));
    assert_absolute(polygon_area(view(&out)), 1, 1e-15);
    array_free(&plain, &out);
}
END_TEST

/* More vertices than the function keeps on its stack. */
START_TEST(large_polygons)
{
    context_init(&plain);
    vec2 a[200], b[200];
    vec2_array out = {0};
    for (int i = 0; i < 200; i++) {
        a[i] = vec2_make(real_cos(2 * PI * i / 200), real_sin(2 * PI * i / 200));
        b[i] = vec2_make(a[i].x + 1, a[i].y);
    }
    ck_assert(polygon_clip_convex(&plain, (polygon){a, 200}, (polygon){b, 200}, &out));
    assert_absolute(polygon_area(view(&out)), 2 * PI / 3 - sqrt(3) / 2, 1e-3); /* lens of two unit discs */
    ck_assert(polygon_is_convex(view(&out)));
    array_free(&plain, &out);
}
END_TEST

START_TEST(memory_runs_out)
{
    vec2 a[40], b[40];
    for (int i = 0; i < 40; i++) {
        a[i] = vec2_make(real_cos(2 * PI * i / 40), real_sin(2 * PI * i / 40));
        b[i] = vec2_make(a[i].x + 1, a[i].y);
    }
    for (failing_turn turn = {0}; failing_next(&turn);) {
        vec2_array half = {0}, common = {0};
        bool done = polygon_clip_half_plane(&turn.ctx, (polygon){a, 40}, vec2_make(1, 0), 0, &half) &&
                    polygon_clip_convex(&turn.ctx, (polygon){a, 40}, (polygon){b, 40}, &common);
        array_free(&turn.ctx, &half);
        array_free(&turn.ctx, &common);
        turn.status = done ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
}
END_TEST

TEST_MAIN("polygon_clip", half_plane_of_a_square, two_halves_fit, common_part_as_geos_finds_it,
          touching_polygons_have_nothing_in_common, large_polygons, memory_runs_out)
