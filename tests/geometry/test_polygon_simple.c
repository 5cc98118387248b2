/* Self-intersection: crossings, touches, repeated vertices; the sweep against all pairs. */
#include "geometry/outlines.h"

#include "geometry/predicate.h"

static context plain;

static void expect(const vec2 *v, int32_t n, int32_t a, int32_t b)
{
    int32_t edge[2] = {-1, -1};
    context_init(&plain);
    bool found = polygon_self_intersects(&plain, (polygon){v, n}, &edge[0], &edge[1]);
    ck_assert_int_eq(found, a >= 0);
    ck_assert_int_eq(edge[0], a);
    ck_assert_int_eq(edge[1], b);
    ck_assert_int_eq(polygon_self_intersects(&plain, (polygon){v, n}, NULL, NULL), found);
}

START_TEST(known_rings)
{
    const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    expect(square, 4, -1, -1);
    expect(square, 3, -1, -1);
    expect(square, 0, -1, -1);
    const vec2 bow[] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
    expect(bow, 4, 0, 2);
    const vec2 vertex_on_edge[] = {{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}};
    expect(vertex_on_edge, 5, 0, 2);
    const vec2 vertex_on_vertex[] = {{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}};
    expect(vertex_on_vertex, 6, 0, 3);
    const vec2 spike[] = {{0, 0}, {4, 0}, {4, 2}, {4, 6}, {4, 2}, {0, 2}};
    expect(spike, 6, 1, 3);
    const vec2 folded[] = {{0, 0}, {4, 0}, {4, 4}, {4, -2}};
    expect(folded, 4, 0, 2);
    const vec2 close_miss[] = {{0, 0}, {4, 0}, {4, 4}, {2, 0x1p-60}, {0, 4}};
    expect(close_miss, 5, -1, -1);
}
END_TEST

START_TEST(repeated_vertices_do_no_harm)
{
    const vec2 v[] = {{0, 0}, {0, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 1}, {0, 0}};
    expect(v, 8, -1, -1);
    const vec2 point[] = {{1, 1}, {1, 1}, {1, 1}, {1, 1}};
    expect(point, 4, -1, -1);
    const vec2 bow[] = {{0, 0}, {2, 2}, {2, 2}, {2, 0}, {2, 0}, {0, 2}};
    expect(bow, 6, 0, 4);
}
END_TEST

/* Whether a memory failure sends it to all pairs or not, the answer is the same: and that is the literal definition. */
START_TEST(sweep_is_all_pairs)
{
    random_stream r = random_begin(31, 0, 0);
    int found = 0, clear = 0;
    for (int round = 0; round < 1500; round++) {
        vec2 v[OUTLINE_ROOM];
        int32_t n = outline_count(&r, 32, 90);
        outline_star(&r, vec2_make(0, 0), round % 3 == 0 ? 8.9 : 7, 9, n, v);
        if (round % 3 == 1)
            outline_snap(v, n, 0.25);
        for (int k = 0; k < round % 4; k++) { /* exchange two neighbours, or repeat one */
            int32_t i = outline_count(&r, 0, n - 2);
            vec2 t = v[i];
            v[i] = v[i + 1];
            v[i + 1] = random_unit(&r) < 0.5 ? t : v[i];
        }
        failing_memory memory;
        context none = failing_context(&memory, 1);
        int32_t a[2] = {-1, -1}, b[2] = {-1, -1};
        context_init(&plain);
        bool swept = polygon_self_intersects(&plain, (polygon){v, n}, &a[0], &a[1]);
        bool paired = polygon_self_intersects(&none, (polygon){v, n}, &b[0], &b[1]);
        ck_assert(memory.failed);
        ck_assert_int_eq(swept, paired);
        ck_assert_int_eq(a[0], b[0]);
        ck_assert_int_eq(a[1], b[1]);
        if (swept)
            ck_assert(segments_touch(v[a[0]], v[(a[0] + 1) % n], v[a[1]], v[(a[1] + 1) % n]));
        found += swept;
        clear += !swept;
    }
    ck_assert_int_gt(found, 200);
    ck_assert_int_gt(clear, 200);
}
END_TEST

/* Rough rings whose teeth come near one another or not; memory that fails makes it look at all pairs. */
START_TEST(clearance_is_that_of_all_pairs)
{
    int near = 0, clear = 0;
    for (uint32_t seed = 0; seed < 400; seed++) {
        random_stream r = random_begin(seed, 7, 0);
        int32_t n = 32 + (int32_t)(random_unit(&r) * 60);
        vec2 v[92];
        for (int32_t i = 0; i < n; i++) {
            double angle = 2 * PI * i / n, radius = random_uniform(&r, 2, 4);
            v[i] = vec2_make(radius * real_cos(angle), (seed % 2 ? 3 : 0.4) * radius * real_sin(angle));
        }
        double reach = random_uniform(&r, 0, 0.3);
        failing_memory memory;
        context none = failing_context(&memory, 1);
        context_init(&plain);
        bool swept = polygon_has_clearance(&plain, (polygon){v, n}, reach);
        ck_assert_int_eq(swept, polygon_has_clearance(&none, (polygon){v, n}, reach));
        ck_assert(memory.failed);
        clear += swept;
        near += !swept;
    }
    ck_assert_int_gt(near, 50);
    ck_assert_int_gt(clear, 50);
    static const vec2 slot[6] = {{0, 0}, {4, 0}, {4, 3}, {2, 0.1}, {1.9, 3}, {0, 3}};
    context_init(&plain);
    ck_assert(polygon_has_clearance(&plain, (polygon){slot, 6}, 0.099));
    ck_assert(!polygon_has_clearance(&plain, (polygon){slot, 6}, 0.101));
}
END_TEST

TEST_MAIN("polygon_simple", known_rings, repeated_vertices_do_no_harm, sweep_is_all_pairs,
          clearance_is_that_of_all_pairs)
