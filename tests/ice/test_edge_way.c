/* Ways along a boundary, and what loads make of each other's places, against closed forms. */
#include "ice/edge_way.h"

#include "base/transcendental.h"
#include "testing.h"

/* A ring, counter-clockwise around ice, in an order of its own. */
static void push_ring(context *ctx, tile_segment_array *line, const vec2 *corner, int count, int stride)
{
    for (int i = 0; i < count; i++) {
        int k = i * stride % count;
        vec2 a = corner[k], b = corner[(k + 1) % count], e = vec2_sub(b, a);
        double length = vec2_length(e);
        ck_assert(array_push(ctx, line, ((tile_segment){a, b, {-e.y / length, e.x / length}})));
    }
}

static double way_to(context *ctx, const tile_segment_array *line, vec2 start, double reach, vec2 place)
{
    edge_arc_array arcs = {0};
    int32_t segment;
    ck_assert(edge_arcs(ctx, line, start, 1e-6, reach, &arcs));
    double way = edge_way(line, &arcs, place, &segment);
    array_free(ctx, &arcs);
    return way;
}

/* On with the ice to the left, back, around corners, the shorter way round a ring, and no farther than asked. */
START_TEST(around_a_floe)
{
    static const vec2 FLOE[] = {{0, 0}, {10, 0}, {10, 6}, {0, 6}};
    context ctx;
    context_init(&ctx);
    for (int stride = 1; stride <= 3; stride += 2) {
        tile_segment_array line = {0};
        push_ring(&ctx, &line, FLOE, 4, stride);
        vec2 start = {4, 0};
        assert_absolute(way_to(&ctx, &line, start, 50, (vec2){4, -1}), 0, 1e-12);
        assert_absolute(way_to(&ctx, &line, start, 50, (vec2){7, 0.5}), 3, 1e-12);
        assert_absolute(way_to(&ctx, &line, start, 50, (vec2){1, 0.5}), -3, 1e-12);
        assert_absolute(way_to(&ctx, &line, start, 50, (vec2){9.9, 2}), 8, 1e-12);
        assert_absolute(way_to(&ctx, &line, start, 50, (vec2){0.1, 2}), -6, 1e-12);
        assert_absolute(way_to(&ctx, &line, start, 50, (vec2){8, 5.9}), 14, 1e-12);
        assert_absolute(way_to(&ctx, &line, start, 50, (vec2){1, 6}), -11, 1e-12);
        ck_assert(isinf(way_to(&ctx, &line, start, 5.5, (vec2){8, 5.9})));
        assert_absolute(way_to(&ctx, &line, FLOE[1], 50, (vec2){8, 0}), -2, 1e-12);
        assert_absolute(way_to(&ctx, &line, FLOE[1], 50, (vec2){10, 2}), 2, 1e-12);
        array_free(&ctx, &line);
    }
    tile_segment_array none = {0};
    ck_assert(isinf(way_to(&ctx, &none, FLOE[0], 50, FLOE[1])));
}
END_TEST

/* Two floes that touch in a corner, and a hole: the edge goes on around the ice that it came along, and does not lead
   to the other's. */
START_TEST(at_a_pinch)
{
    static const vec2 ONE[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, OTHER[] = {{4, 4}, {8, 4}, {8, 8}, {4, 8}};
    context ctx;
    context_init(&ctx);
    for (int turn = 0; turn < 2; turn++) {
        tile_segment_array line = {0};
        push_ring(&ctx, &line, turn ? OTHER : ONE, 4, 1);
        push_ring(&ctx, &line, turn ? ONE : OTHER, 4, 1);
        assert_absolute(way_to(&ctx, &line, (vec2){4, 2}, 50, (vec2){2, 4}), 4, 1e-12);
        assert_absolute(way_to(&ctx, &line, (vec2){2, 4}, 50, (vec2){4, 2}), -4, 1e-12);
        ck_assert(isinf(way_to(&ctx, &line, (vec2){4, 2}, 50, (vec2){6, 4})));
        ck_assert(isinf(way_to(&ctx, &line, (vec2){2, 4}, 50, (vec2){4, 6})));
        array_free(&ctx, &line);
    }
}
END_TEST

/* A load in parts bends the edge as it did whole; in its middle by what its width bears. */
START_TEST(parts_and_whole)
{
    const edge_strength e = {312e3, 12.5e3};
    for (double width = 0.5; width < 60; width *= 3) {
        assert_relative(edge_share(e, width, 0), 1 / (e.wedges + e.metre * width), 1e-14);
        for (double way = -50; way <= 50; way += 3.7) {
            double sum = 0;
            for (int i = 0; i < 5; i++)
                sum += edge_share(e, width / 5, way - width * (i - 2) / 5) / 5;
            assert_relative(sum, edge_share(e, width, way), 1e-12);
            ck_assert_double_le(edge_share(e, width, way), edge_share(e, width, 0));
            /* A narrow load is the limit. */
            assert_relative(edge_share(e, 1e-4, way), edge_share(e, 0, way), 1e-6);
        }
    }
    /* Of ice without wedges beams side by side know nothing of each other. */
    const edge_strength beams = {0, 12.5e3};
    assert_relative(edge_share(beams, 10, 4.9), 1 / (10 * 12.5e3), 1e-12);
    assert_absolute(edge_share(beams, 10, 5.1), 0, 1e-20);
    assert_absolute(edge_share(beams, 0, 1), 0, 1e-20);
    assert_absolute(edge_share(beams, 0, 0), 0, 1e-20);
}
END_TEST

TEST_MAIN("edge_way", around_a_floe, at_a_pinch, parts_and_whole)
