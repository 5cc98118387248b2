/* Covers with fewer vertices: they cover, stay simple, and add no more area than they may. */
#include "base/random.h"
#include "base/transcendental.h"
#include "geometry/polygon.h"
#include "testing.h"

static context ctx;

/* A ragged ring of n vertices: radii at random about 1, smooth on the whole. */
static void ragged(uint64_t seed, int32_t n, double roughness, vec2_array *out)
{
    random_stream r = random_begin(seed, 1, 0);
    array_clear(out);
    for (int32_t i = 0; i < n; i++) {
        double angle = 2 * PI * i / n, radius = 1 + 0.3 * real_cos(3 * angle) + roughness * random_unit(&r);
        ck_assert(array_push(&ctx, out, ((vec2){radius * real_cos(angle), radius * real_sin(angle)})));
    }
}

static void check_cover(polygon p, double part, const vec2_array *cover)
{
    polygon c = {cover->data, cover->count};
    ck_assert_int_ge(c.count, 3);
    ck_assert_int_le(c.count, p.count);
    ck_assert(!polygon_self_intersects(&ctx, c, NULL, NULL));
    double area = polygon_area(p);
    ck_assert_double_le(polygon_area(c), area * (1 + part) * (1 + 1e-12));
    assert_relative(polygon_overlap_area(p, c), area, 1e-12);
}

START_TEST(ragged_rings)
{
    vec2_array ring = {0}, cover = {0};
    context_init(&ctx);
    for (uint64_t seed = 0; seed < 200; seed++) {
        int32_t n = 5 + (int32_t)(seed % 60);
        ragged(seed, n, seed % 2 ? 0.1 : 0.6, &ring);
        polygon p = {ring.data, ring.count};
        int32_t before = p.count;
        for (int k = 0; k < 4; k++) {
            static const double part[4] = {0, 0.01, 0.05, 0.5};
            ck_assert(polygon_cover(&ctx, p, part[k], &cover));
            check_cover(p, part[k], &cover);
            ck_assert_int_le(cover.count, before);
            before = cover.count + (k == 0 ? p.count : 2); /* more room is seldom a few vertices worse */
        }
    }
    array_free(&ctx, &ring);
    array_free(&ctx, &cover);
}
END_TEST

START_TEST(bays_and_short_edges)
{
    vec2_array cover = {0};
    context_init(&ctx);
    static const vec2 notched[] = {{0, 0}, {4, 0}, {4, 4}, {2.1, 4}, {2, 3.9}, {1.9, 4}, {0, 4}};
    ck_assert(polygon_cover(&ctx, (polygon){notched, 7}, 0.001, &cover));
    ck_assert_int_eq(cover.count, 4);
    assert_relative(polygon_area((polygon){cover.data, cover.count}), 16, 1e-12);
    static const vec2 clipped[] = {{0, 0}, {4, 0}, {4, 3.9}, {3.9, 4}, {0, 4}};
    ck_assert(polygon_cover(&ctx, (polygon){clipped, 5}, 0.001, &cover));
    ck_assert_int_eq(cover.count, 4);
    /* A triangle stays one. */
    ck_assert(polygon_cover(&ctx, (polygon){clipped, 3}, 1, &cover));
    ck_assert_int_eq(cover.count, 3);
    /* A ring whose arms nearly meet: the bay between them must not be closed over an arm. */
    static const vec2 hook[] = {{0, 0}, {6, 0}, {6, 5}, {2, 5}, {2, 2}, {4, 2}, {4, 3},
                                {3, 3}, {3, 4}, {5, 4}, {5, 1}, {1, 1}, {1, 6}, {0, 6}};
    ck_assert(polygon_cover(&ctx, (polygon){hook, 14}, 1, &cover));
    check_cover((polygon){hook, 14}, 1, &cover);
    array_free(&ctx, &cover);
}
END_TEST

START_TEST(memory_runs_out)
{
    static const vec2 notched[] = {{0, 0}, {4, 0}, {4, 4}, {2, 3.9}, {0, 4}};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        vec2_array cover = {0};
        bool good = polygon_cover(&turn.ctx, (polygon){notched, 5}, 0.1, &cover);
        array_free(&turn.ctx, &cover);
        turn.status = good ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
}
END_TEST

/* Sides that converge far beyond a short edge do not grow into a spike, though there is area enough to spend. */
START_TEST(no_spikes)
{
    const vec2 blunt[] = {{0, 0}, {10, 1}, {10, 2}, {0, 3}}; /* the sides would meet at x = 15: five edges farther */
    const vec2 sharp[] = {{0, 0}, {10, 4.5}, {10, 5.5}, {0, 10}}; /* at x = 11.1: about an edge farther */
    vec2_array cover = {0};
    context_init(&ctx);
    ck_assert(polygon_cover(&ctx, (polygon){blunt, 4}, 0.5, &cover));
    ck_assert_int_eq(cover.count, 4);
    ck_assert(polygon_cover(&ctx, (polygon){sharp, 4}, 0.5, &cover));
    ck_assert_int_eq(cover.count, 4);                          /* 1.2 edges */
    const vec2 wide[] = {{0, 0}, {10, 4}, {10, 6}, {0, 10}};   /* 5 over 2: and a shorter way */
    const vec2 steep[] = {{0, 0}, {10, 9}, {10, 11}, {0, 20}}; /* 1.1 over 2 */
    ck_assert(polygon_cover(&ctx, (polygon){wide, 4}, 0.5, &cover));
    ck_assert_int_eq(cover.count, 4);
    ck_assert(polygon_cover(&ctx, (polygon){steep, 4}, 0.5, &cover));
    ck_assert_int_eq(cover.count, 3);
    array_free(&ctx, &cover);
}
END_TEST

TEST_MAIN("polygon_cover", no_spikes, ragged_rings, bays_and_short_edges, memory_runs_out)
