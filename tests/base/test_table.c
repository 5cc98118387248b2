/* State tables, by a sample with every kind of field. */
#include "base/table.h"
#include "base/vec.h"
#include "testing.h"

#define SAMPLE_FIELDS(X)                                            \
    X(position, vec3, FIELD_F64, 3, "m", "where it is")             \
    X(mass, double, FIELD_F64, 1, "kg", "how heavy it is")          \
    X(shape, int32_t, FIELD_I32, 1, "-", "what it looks like")      \
    X(generation, uint32_t, FIELD_U32, 1, "-", "which one it is")   \
    X(born, int64_t, FIELD_I64, 1, "-", "step of birth")            \
    X(counter, uint64_t, FIELD_U64, 1, "-", "random numbers drawn") \
    X(flags, uint8_t, FIELD_U8, 1, "-", "what it may do")
TABLE_DECLARE(sample, SAMPLE_FIELDS)
#define TABLE_SELF sample_table
TABLE_DEFINE(sample, SAMPLE_FIELDS)
#undef TABLE_SELF

/* A table of `rows` rows with something in every field. */
static sample_table sample_make(context *ctx, int32_t rows)
{
    sample_table t = {0};
    ck_assert(table_resize(ctx, &t, &sample_table_info, rows));
    for (int32_t i = 0; i < rows; i++) {
        t.position[i] = vec3_make(i, 2.0 * i, -i);
        t.mass[i] = 1.0 / (i + 1);
        t.shape[i] = -i;
        t.generation[i] = (uint32_t)i * 3u;
        t.born[i] = (int64_t)i << 33;
        t.counter[i] = (uint64_t)i << 35;
        t.flags[i] = (uint8_t)(i & 255);
    }
    return t;
}

START_TEST(the_descriptor_says_what_was_declared)
{
    const table_info *info = &sample_table_info;
    ck_assert_str_eq(info->name, "sample");
    ck_assert_int_eq(info->field_count, 7);
    ck_assert_str_eq(info->fields[0].name, "position");
    ck_assert_str_eq(info->fields[0].unit, "m");
    ck_assert_str_eq(info->fields[0].meaning, "where it is");
    ck_assert_int_eq(info->fields[0].components, 3);
    ck_assert_uint_eq(info->fields[6].offset, offsetof(sample_table, flags));
    for (int f = 0; f < info->field_count; f++) {
        const field_info *field = &info->fields[f];
        ck_assert_uint_eq(field->size, (size_t)field->components * field_kind_size(field->kind));
    }
    ck_assert_uint_eq(field_kind_size(FIELD_F64), 8);
    ck_assert_uint_eq(field_kind_size(FIELD_I32), 4);
    ck_assert_uint_eq(field_kind_size(FIELD_U8), 1);
}
END_TEST

START_TEST(fields_are_aligned_apart_and_whole_lanes_wide)
{
    context ctx;
    context_init(&ctx);
    for (int32_t rows = 1; rows < 40; rows += 3) {
        sample_table t = sample_make(&ctx, rows);
        ck_assert_int_eq(t.capacity % 8, 0);
        for (int f = 0; f < sample_table_info.field_count; f++) {
            const field_info *field = &sample_table_info.fields[f];
            char *data = table_field(&t, field);
            ck_assert_uint_eq((uintptr_t)data % 64, 0);
            if (f + 1 < sample_table_info.field_count)
                ck_assert(data + (size_t)t.capacity * field->size <=
                          (char *)table_field(&t, &sample_table_info.fields[f + 1]));
        }
        ck_assert_ptr_eq(table_field(&t, &sample_table_info.fields[1]), t.mass);
        table_free(&ctx, &t, &sample_table_info);
    }
}
END_TEST

START_TEST(growth_keeps_rows_and_zeroes_new_ones)
{
    failing_memory m;
    context ctx = failing_context(&m, 0);
    sample_table t = sample_make(&ctx, 100);
    ck_assert(table_resize(&ctx, &t, &sample_table_info, 50));
    ck_assert(table_resize(&ctx, &t, &sample_table_info, 60)); /* in the memory that held rows 50..59 */
    ck_assert(t.mass[50] == 0 && t.shape[59] == 0 && t.flags[55] == 0);
    ck_assert(table_resize(&ctx, &t, &sample_table_info, 50));
    ck_assert(table_resize(&ctx, &t, &sample_table_info, 1000));
    ck_assert_int_eq(t.count, 1000);
    ck_assert(t.position[49].y == 98 && t.born[49] == (int64_t)49 << 33);
    for (int32_t i = 50; i < 1000; i++) { /* 50..99 held something before */
        ck_assert(t.position[i].x == 0 && t.position[i].y == 0 && t.position[i].z == 0);
        ck_assert(t.mass[i] == 0 && t.shape[i] == 0 && t.generation[i] == 0);
        ck_assert(t.born[i] == 0 && t.counter[i] == 0 && t.flags[i] == 0);
    }
    long before = m.requests;
    for (int32_t rows = 1000; rows <= 100000; rows++)
        ck_assert(table_resize(&ctx, &t, &sample_table_info, rows));
    ck_assert_int_lt(m.requests - before, 15);
    table_free(&ctx, &t, &sample_table_info);
    ck_assert_ptr_null(t.position);
    ck_assert_ptr_null(t.flags);
    ck_assert_int_eq(t.count, 0);
    ck_assert_int_eq(t.capacity, 0);
    ck_assert_int_eq(m.live, 0);
    table_free(&ctx, &t, &sample_table_info); /* twice is no harm */
}
END_TEST

START_TEST(the_hash_depends_on_every_byte_and_nothing_else)
{
    context ctx;
    context_init(&ctx);
    sample_table a = sample_make(&ctx, 37), b = sample_make(&ctx, 37);
    ck_assert(table_reserve(&ctx, &b, &sample_table_info, 5000));
    memset(b.mass + 37, 1, 8 * 8); /* beyond count */
    uint64_t hash = table_hash(&a, &sample_table_info, 1);
    ck_assert_uint_eq(table_hash(&b, &sample_table_info, 1), hash);
    ck_assert_uint_ne(table_hash(&a, &sample_table_info, 2), hash);
    for (int f = 0; f < sample_table_info.field_count; f++) {
        const field_info *field = &sample_table_info.fields[f];
        unsigned char *bytes = table_field(&a, field);
        for (size_t i = 0; i < 37 * field->size; i++) {
            bytes[i] ^= 0x10;
            ck_assert_uint_ne(table_hash(&a, &sample_table_info, 1), hash);
            bytes[i] ^= 0x10;
        }
    }
    ck_assert_uint_eq(table_hash(&a, &sample_table_info, 1), hash);
    a.count = 36;
    ck_assert_uint_ne(table_hash(&a, &sample_table_info, 1), hash);
    sample_table empty = {0};
    ck_assert_uint_ne(table_hash(&empty, &sample_table_info, 1), table_hash(&empty, &sample_table_info, 2));
    table_free(&ctx, &a, &sample_table_info);
    table_free(&ctx, &b, &sample_table_info);
}
END_TEST

START_TEST(a_copy_is_equal_and_apart)
{
    context ctx;
    context_init(&ctx);
    sample_table a = sample_make(&ctx, 20), b = sample_make(&ctx, 300), empty = {0};
    uint64_t hash = table_hash(&a, &sample_table_info, 0);
    table_row_taken(&b, 7);
    ck_assert(table_copy(&ctx, &b, &a, &sample_table_info));
    ck_assert_int_eq(table_first_zero(&b, b.flags), 0);
    ck_assert_int_eq(b.count, 20);
    ck_assert_uint_eq(table_hash(&b, &sample_table_info, 0), hash);
    b.mass[3] = 9;
    ck_assert_uint_eq(table_hash(&a, &sample_table_info, 0), hash);
    ck_assert(table_copy(&ctx, &a, &a, &sample_table_info));
    ck_assert_uint_eq(table_hash(&a, &sample_table_info, 0), hash);
    ck_assert(table_copy(&ctx, &b, &empty, &sample_table_info));
    ck_assert_int_eq(b.count, 0);
    table_free(&ctx, &a, &sample_table_info);
    table_free(&ctx, &b, &sample_table_info);
}
END_TEST

START_TEST(a_row_moves_with_all_fields)
{
    context ctx;
    context_init(&ctx);
    sample_table t = sample_make(&ctx, 20);
    table_move_row(&t, &sample_table_info, 2, 19);
    ck_assert(t.position[2].y == 38 && t.mass[2] == 1.0 / 20 && t.shape[2] == -19 && t.generation[2] == 57);
    ck_assert(t.born[2] == (int64_t)19 << 33 && t.counter[2] == (uint64_t)19 << 35 && t.flags[2] == 19);
    ck_assert(t.shape[1] == -1 && t.shape[3] == -3 && t.shape[19] == -19);
    uint64_t hash = table_hash(&t, &sample_table_info, 0);
    table_move_row(&t, &sample_table_info, 5, 5);
    ck_assert_uint_eq(table_hash(&t, &sample_table_info, 0), hash);
    table_free(&ctx, &t, &sample_table_info);
}
END_TEST

START_TEST(a_table_without_memory_is_unchanged)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        sample_table t = {0}, copy = {0};
        bool made = table_resize(&turn.ctx, &t, &sample_table_info, 10);
        if (made)
            t.shape[9] = 5;
        bool grown = made && table_resize(&turn.ctx, &t, &sample_table_info, 1000);
        bool copied = grown && table_copy(&turn.ctx, &copy, &t, &sample_table_info);
        if (made) {
            ck_assert_int_eq(t.count, grown ? 1000 : 10);
            ck_assert_int_eq(t.shape[9], 5);
        }
        ck_assert_int_eq(copy.count, copied ? 1000 : 0);
        table_free(&turn.ctx, &t, &sample_table_info);
        table_free(&turn.ctx, &copy, &sample_table_info);
        turn.status = copied ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
    failing_memory m;
    context ctx = failing_context(&m, 0);
    sample_table t = {0};
    ck_assert(!table_resize(&ctx, &t, &sample_table_info, INT32_MAX)); /* no whole group of 8 rows */
    ck_assert_int_eq(m.requests, 0);
}
END_TEST

TEST_MAIN("table", the_descriptor_says_what_was_declared, fields_are_aligned_apart_and_whole_lanes_wide,
          growth_keeps_rows_and_zeroes_new_ones, the_hash_depends_on_every_byte_and_nothing_else,
          a_copy_is_equal_and_apart, a_row_moves_with_all_fields, a_table_without_memory_is_unchanged)
