/* Growing arrays. */
#include "base/array.h"
#include "testing.h"

typedef struct point {
    double x;
    int32_t tag;
} point;
typedef ARRAY(point) point_array;
typedef ARRAY(int32_t) number_array;

START_TEST(pushed_elements_stay)
{
    failing_memory m;
    context ctx = failing_context(&m, 0);
    point_array a = {0};
    for (int32_t i = 0; i < 100000; i++)
        ck_assert(array_push(&ctx, &a, (point){i * 0.5, i}));
    ck_assert_int_eq(a.count, 100000);
    for (int32_t i = 0; i < a.count; i++) {
        ck_assert(a.data[i].x == i * 0.5);
        ck_assert_int_eq(a.data[i].tag, i);
    }
    ck_assert_int_lt(m.requests, 40); /* growth by half, not by one */
    array_clear(&a);
    ck_assert_int_eq(a.count, 0);
    ck_assert_int_ge(a.capacity, 100000);
    array_free(&ctx, &a);
    ck_assert_ptr_null(a.data);
    ck_assert_int_eq(a.capacity, 0);
    ck_assert_int_eq(m.live, 0);
}
END_TEST

START_TEST(resize_sets_the_count_and_keeps_elements)
{
    context ctx;
    context_init(&ctx);
    number_array a = {0};
    ck_assert(array_push(&ctx, &a, 7));
    ck_assert(array_resize(&ctx, &a, 1000));
    ck_assert_int_eq(a.count, 1000);
    ck_assert_int_eq(a.data[0], 7);
    int32_t capacity = a.capacity;
    ck_assert(array_resize(&ctx, &a, 3));
    ck_assert_int_eq(a.count, 3);
    ck_assert_int_eq(a.capacity, capacity);
    ck_assert(array_reserve(&ctx, &a, 10));
    ck_assert_int_eq(a.count, 3);
    array_free(&ctx, &a);
}
END_TEST

START_TEST(an_array_without_memory_is_unchanged)
{
    failing_memory m;
    context ctx = failing_context(&m, 2);
    number_array a = {0};
    int32_t pushed = 0;
    while (array_push(&ctx, &a, pushed))
        pushed++;
    ck_assert(m.failed);
    ck_assert_int_gt(pushed, 0);
    ck_assert_int_eq(a.count, pushed);
    ck_assert_int_eq(a.capacity, pushed);
    for (int32_t i = 0; i < pushed; i++)
        ck_assert_int_eq(a.data[i], i);
    ck_assert(array_push(&ctx, &a, pushed)); /* the next request succeeds */
    array_free(&ctx, &a);
    ck_assert_int_eq(m.live, 0);
}
END_TEST

/* A memory that has none and notes what was asked for. */
static void *note_size(void *user, void *ptr, size_t size)
{
    (void)ptr;
    *(size_t *)user = size;
    return NULL;
}

START_TEST(the_count_cannot_pass_its_type)
{
    size_t asked = 0;
    context ctx;
    context_init(&ctx);
    ctx.memory = note_size;
    ctx.memory_user = &asked;
    number_array a = {.count = INT32_MAX, .capacity = INT32_MAX};
    ck_assert(!array_push(&ctx, &a, 1));
    ck_assert_uint_eq(asked, 0);
    a = (number_array){.count = 2000000000, .capacity = 2000000000};
    ck_assert(!array_push(&ctx, &a, 1));
    ck_assert_uint_eq(asked, (size_t)INT32_MAX * sizeof(int32_t)); /* half as much again would not fit */
    int32_t capacity = 8;
    void *data = NULL;
    ck_assert(!array_reserve_raw(&ctx, &data, &capacity, 1000, SIZE_MAX / 100));
    ck_assert_int_eq(capacity, 8);
}
END_TEST

TEST_MAIN("array", pushed_elements_stay, resize_sets_the_count_and_keeps_elements, an_array_without_memory_is_unchanged,
          the_count_cannot_pass_its_type)
