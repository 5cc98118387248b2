/* Assertions about tables stop a build that has them. */
#include "base/table.h"
#include "testing.h"

#define SAMPLE_FIELDS(X)                           \
    X(place, vec3, FIELD_F64, 3, "m", "somewhere") \
    X(number, int32_t, FIELD_I32, 1, "1", "of the row")

TABLE_DECLARE(sample, SAMPLE_FIELDS)
#define TABLE_SELF sample_table
TABLE_DEFINE(sample, SAMPLE_FIELDS)
#undef TABLE_SELF

typedef struct broken {
    context ctx;
    sample_table table, other;
    int32_t rows;
} broken;

static broken sound(void)
{
    broken b = {.rows = 5};
    context_init(&b.ctx);
    ck_assert(table_resize(&b.ctx, &b.table, &sample_table_info, 3));
    return b;
}

static void resize(void *user)
{
    broken *b = user;
    (void)table_resize(&b->ctx, &b->table, &sample_table_info, b->rows);
}

static void hash(void *user) { (void)table_hash(&((broken *)user)->table, &sample_table_info, 1); }

static void copy(void *user)
{
    broken *b = user;
    (void)table_copy(&b->ctx, &b->other, &b->table, &sample_table_info);
}

static void move(void *user)
{
    table_move_row(&((broken *)user)->table, &sample_table_info, 0, ((broken *)user)->rows);
}

static void free_sound(broken *b)
{
    table_free(&b->ctx, &b->table, &sample_table_info);
    table_free(&b->ctx, &b->other, &sample_table_info);
}

START_TEST(a_table_that_is_not_sound_stops_the_program)
{
    broken b = sound();
    int32_t count = b.table.count, capacity = b.table.capacity;
    ck_assert(!testing_aborts(resize, &b) && !testing_aborts(hash, &b) && !testing_aborts(copy, &b));
    b.table.count = capacity + 1;
    assert_aborts(resize, &b);
    assert_aborts(hash, &b);
    assert_aborts(copy, &b);
    b.table.count = -1;
    assert_aborts(hash, &b);
    b.table.count = count;
    b.table.capacity = capacity - 1;
    assert_aborts(hash, &b);
    b.table.capacity = capacity;
    int32_t *number = b.table.number;
    b.table.number = NULL;
    assert_aborts(hash, &b);
    b.table.number = number + 1;
    assert_aborts(copy, &b);
    b.table.number = number;
    b.rows = -1;
    assert_aborts(resize, &b);
    assert_aborts(move, &b);
    b.rows = capacity;
    assert_aborts(move, &b);
    b.rows = 2;
    ck_assert(!testing_aborts(move, &b));
    free_sound(&b);
}
END_TEST

TEST_MAIN_OF_ASSERTIONS("assertions", a_table_that_is_not_sound_stops_the_program)
