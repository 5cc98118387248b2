/* geometry/polygon: pools of polygons. */
#include "geometry/polygon.h"
#include "testing.h"

START_TEST(a_polygon_of_the_list_itself_can_be_added)
{
    failing_memory memory;
    context ctx = failing_context(&memory, 0);
    polygon_list list = {0};
    vec2 corner[5] = {{0, 0}, {3, 0}, {3, 2}, {1, 4}, {0, 2}};
    ck_assert(polygon_list_push(&ctx, &list, (polygon){corner, 5}));
    /* Each is a copy of the one before it, wherever the list lies when it grows. */
    for (int32_t i = 0; i < 1000; i++) {
        ck_assert(polygon_list_push(&ctx, &list, polygon_list_get(&list, i)));
        polygon last = polygon_list_get(&list, i + 1);
        ck_assert_int_eq(last.count, 5);
        assert_array_bits(&last.vertex[0].x, &corner[0].x, 10);
    }
    ck_assert(polygon_list_push(&ctx, &list, (polygon){NULL, 0}));
    ck_assert_int_eq(polygon_list_count(&list), 1002);
    polygon_list_free(&ctx, &list);
    ck_assert_int_eq(memory.live, 0);
}
END_TEST

TEST_MAIN("polygon_list", a_polygon_of_the_list_itself_can_be_added)
