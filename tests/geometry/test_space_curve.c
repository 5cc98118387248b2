/* geometry/space_curve: a permutation whose neighbours are neighbours. */
#include "base/random.h"
#include "geometry/space_curve.h"
#include "testing.h"

START_TEST(a_full_grid_is_walked_cell_by_cell)
{
    enum { SIDE = 16, COUNT = SIDE * SIDE };
    context ctx;
    context_init(&ctx);
    vec2 point[COUNT];
    int32_t order[COUNT];
    for (int i = 0; i < COUNT; i++) /* scattered: 97 is odd */
        point[i] = vec2_make(100 + 3.0 * (i * 97 % COUNT % SIDE), -50 + 3.0 * (i * 97 % COUNT / SIDE));
    ck_assert(space_curve_order(&ctx, point, COUNT, order));
    for (int i = 1; i < COUNT; i++)
        assert_absolute(vec2_length(vec2_sub(point[order[i]], point[order[i - 1]])), 3, 1e-12);
}
END_TEST

START_TEST(every_index_comes_once)
{
    enum { COUNT = 1000 };
    context ctx;
    context_init(&ctx);
    random_stream draw = random_begin(5, 0, 0);
    vec2 point[COUNT];
    int32_t order[COUNT];
    bool seen[COUNT] = {false};
    double way = 0;
    for (int i = 0; i < COUNT; i++) {
        double x = random_uniform(&draw, -1, 1);
        point[i] = vec2_make(x, 1e-3 * random_uniform(&draw, 0, 1));
    }
    ck_assert(space_curve_order(&ctx, point, COUNT, order));
    for (int i = 0; i < COUNT; i++) {
        ck_assert(!seen[order[i]]);
        seen[order[i]] = true;
        way += i > 0 ? vec2_length(vec2_sub(point[order[i]], point[order[i - 1]])) : 0;
    }
    ck_assert_double_lt(way, 20); /* about 670 unsorted */
}
END_TEST

START_TEST(equal_points_stay_in_order)
{
    context ctx;
    context_init(&ctx);
    vec2 point[5] = {{2, 2}, {2, 2}, {2, 2}, {2, 2}, {2, 2}};
    int32_t order[5];
    ck_assert(space_curve_order(&ctx, point, 5, order));
    for (int i = 0; i < 5; i++)
        ck_assert_int_eq(order[i], i);
    ck_assert(space_curve_order(&ctx, point, 0, order));
    failing_memory memory;
    context poor = failing_context(&memory, 1);
    ck_assert(!space_curve_order(&poor, point, 5, order));
}
END_TEST

TEST_MAIN("space_curve", a_full_grid_is_walked_cell_by_cell, every_index_comes_once, equal_points_stay_in_order)
