/* Assertions about pools of polygons stop a build that has them. */
#include "geometry/polygon.h"
#include "testing.h"

typedef struct broken {
    context ctx;
    polygon_list list;
    int32_t index;
} broken;

static void get(void *user) { (void)polygon_list_get(&((broken *)user)->list, ((broken *)user)->index); }

static void push(void *user)
{
    broken *b = user;
    const vec2 corner[3] = {{0, 0}, {1, 0}, {0, 1}};
    (void)polygon_list_push(&b->ctx, &b->list, (polygon){corner, b->index});
}

START_TEST(a_pool_that_is_not_sound_stops_the_program)
{
    broken b = {.index = 3};
    context_init(&b.ctx);
    for (int i = 0; i < 2; i++)
        push(&b);
    for (b.index = 0; b.index < 2; b.index++)
        ck_assert(!testing_aborts(get, &b));
    assert_aborts(get, &b); /* the third of two */
    b.index = -1;
    assert_aborts(get, &b);
    assert_aborts(push, &b);
    b.index = 1;
    b.list.start.data[2] = 7; /* behind the last vertex */
    assert_aborts(get, &b);
    b.list.start.data[2] = 2; /* before its beginning */
    assert_aborts(get, &b);
    assert_aborts(push, &b);
    b.list.start.data[2] = 6;
    ck_assert(!testing_aborts(get, &b) && !testing_aborts(push, &b));
    polygon_list_free(&b.ctx, &b.list);
}
END_TEST

TEST_MAIN_OF_ASSERTIONS("assertions", a_pool_that_is_not_sound_stops_the_program)
