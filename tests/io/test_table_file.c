/* io/table_file: what is written comes back to the bit; everything else is refused and changes nothing. */
#include "io/table_file.h"
#include "scratch.h"
#include <zlib.h>

static context ctx;
static fram_error error;

#define SAMPLE_FIELDS(X)                                     \
    X(place, vec3, FIELD_F64, 3, "m", "three doubles a row") \
    X(slot, int32_t, FIELD_I32, 1, "1", "an integer")        \
    X(flag, uint8_t, FIELD_U8, 1, "1", "a byte")             \
    X(key, uint64_t, FIELD_U64, 1, "1", "a long one")
TABLE_DECLARE(sample, SAMPLE_FIELDS)
#define TABLE_SELF sample_table
TABLE_DEFINE(sample, SAMPLE_FIELDS)
#undef TABLE_SELF

#define OTHER_FIELDS(X) X(value, double, FIELD_F64, 1, "1", "one double")
TABLE_DECLARE(other, OTHER_FIELDS)
#define TABLE_SELF other_table
TABLE_DEFINE(other, OTHER_FIELDS)
#undef TABLE_SELF

/* The same name and the same bytes a row, another field list. */
#define CHANGED_FIELDS(X) X(velocity, double, FIELD_F64, 1, "1", "another name")
TABLE_DECLARE(changed, CHANGED_FIELDS)
#define TABLE_SELF changed_table
TABLE_DEFINE(changed, CHANGED_FIELDS)
#undef TABLE_SELF

/* Tables, numbers and byte strings as one, with the lists that table_file points to. */
typedef struct content {
    sample_table sample;
    other_table other;
    world_table tables[2];
    table_file_number numbers[2];
    table_file_bytes bytes[2];
    table_file file;
} content;

static void content_begin(content *c)
{
    memset(c, 0, sizeof *c);
    c->tables[0] = (world_table){&sample_table_info, &c->sample};
    c->tables[1] = (world_table){&other_table_info, &c->other};
    c->numbers[0].name = "series_length";
    c->numbers[1].name = "record_length";
    c->bytes[0].name = "hash";
    c->bytes[1].name = "nothing";
    c->file = (table_file){c->tables, 2, c->numbers, 2, c->bytes, 2, false};
}

static void content_free(context *of, content *c)
{
    table_free(of, &c->sample, &sample_table_info);
    table_free(of, &c->other, &other_table_info);
}

static char hash_bytes_of_example[] = "0123abc";

static void content_fill(content *c)
{
    content_begin(c);
    ck_assert(table_resize(&ctx, &c->sample, &sample_table_info, 3));
    for (int32_t i = 0; i < 3; i++) {
        c->sample.place[i] = (vec3){0.1 * i, -0.0, (double)NAN};
        c->sample.slot[i] = -i;
        c->sample.flag[i] = (uint8_t)(255 - i);
        c->sample.key[i] = UINT64_MAX - (uint64_t)i;
    }
    c->numbers[0].value = 123456789012345;
    c->numbers[1].value = UINT64_MAX;
    c->bytes[0].data = hash_bytes_of_example;
    c->bytes[0].size = 7;
}

static void assert_same(const content *a, const content *b)
{
    ck_assert(table_hash(&a->sample, &sample_table_info, 1) == table_hash(&b->sample, &sample_table_info, 1));
    ck_assert(table_hash(&a->other, &other_table_info, 1) == table_hash(&b->other, &other_table_info, 1));
    for (int i = 0; i < 2; i++) {
        ck_assert(a->numbers[i].value == b->numbers[i].value);
        ck_assert_uint_eq(a->bytes[i].size, b->bytes[i].size);
        ck_assert(a->bytes[i].size == 0 || memcmp(a->bytes[i].data, b->bytes[i].data, a->bytes[i].size) == 0);
    }
}

/* The file, whole. */
static fram_status write_file(context *c, const char *path, const table_file *file)
{
    atomic_file out;
    fram_status status = table_file_begin(c, path, file, &out, &error);
    return status == FRAM_OK ? atomic_file_commit(&out, &error) : status;
}

START_TEST(content_comes_back)
{
    context_init(&ctx);
    scratch s = scratch_make();
    content a, b;
    content_fill(&a);
    assert_ok(write_file(&ctx, scratch_path(&s, "t"), &a.file), error);
    content_begin(&b);
    ck_assert(table_resize(&ctx, &b.other, &other_table_info, 5)); /* rows of before are forgotten, */
    ck_assert(table_resize(&ctx, &b.sample, &sample_table_info, 3));
    table_row_taken(&b.sample, 2); /* and which of them were free */
    assert_ok(table_file_read(&ctx, s.path, &b.file, &error), error);
    assert_same(&a, &b);
    ck_assert_int_eq(b.other.count, 0);
    ck_assert_int_eq(b.sample.taken, 0);
    ck_assert_ptr_null(b.bytes[1].data);
    table_file_free_bytes(&ctx, &b.file);
    /* Writing again gives the same file. */
    size_t size, again;
    char *first = scratch_read(s.path, &size);
    assert_ok(write_file(&ctx, s.path, &a.file), error);
    char *second = scratch_read(s.path, &again);
    ck_assert_uint_eq(size, again);
    ck_assert_int_eq(memcmp(first, second, size), 0);
    free(first);
    free(second);
    content_free(&ctx, &a);
    content_free(&ctx, &b);
    scratch_remove(&s, "t");
}
END_TEST

/* The file of the example, in memory of malloc. */
static char *example_file(size_t *size)
{
    scratch s = scratch_make();
    content a;
    content_fill(&a);
    assert_ok(write_file(&ctx, scratch_path(&s, "t"), &a.file), error);
    char *data = scratch_read(s.path, size);
    content_free(&ctx, &a);
    scratch_remove(&s, "t");
    return data;
}

/* Reads into tables that hold something: refused, they must be as before. */
static fram_status decode(const void *data, size_t size)
{
    content b, before;
    content_begin(&b);
    content_fill(&before);
    content_free(&ctx, &before);
    content_fill(&b);
    b.sample.slot[1] = 77;
    uint64_t hash = table_hash(&b.sample, &sample_table_info, 1);
    fram_status status = table_file_decode(&ctx, "test", data, size, &b.file, &error);
    if (status == FRAM_OK) {
        table_file_free_bytes(&ctx, &b.file);
    } else {
        ck_assert(table_hash(&b.sample, &sample_table_info, 1) == hash);
        ck_assert(b.numbers[0].value == 123456789012345);
        ck_assert_ptr_null(b.bytes[0].data);
        ck_assert_str_eq(error.file, "test");
    }
    content_free(&ctx, &b);
    return status;
}

START_TEST(every_flipped_bit_is_refused)
{
    context_init(&ctx);
    size_t size;
    char *data = example_file(&size);
    ck_assert_int_eq(decode(data, size), FRAM_OK);
    for (size_t bit = 0; bit < 8 * size; bit++) {
        data[bit / 8] ^= (char)(1 << bit % 8);
        ck_assert_msg(decode(data, size) == FRAM_ERROR_INPUT, "bit %zu", bit);
        data[bit / 8] ^= (char)(1 << bit % 8);
    }
    free(data);
}
END_TEST

START_TEST(every_other_length_is_refused)
{
    context_init(&ctx);
    size_t size;
    char *data = example_file(&size);
    for (size_t length = 0; length < size; length++)
        ck_assert_int_eq(decode(data, length), FRAM_ERROR_INPUT);
    ck_assert_int_eq(decode(data, size + 1), FRAM_ERROR_INPUT);
    free(data);
}
END_TEST

/* Both checksums made to fit, as a hostile writer would: no crash, no wild allocation, whatever a word says. */
static void mend(char *data, size_t size)
{
    uint64_t length = size;
    memcpy(data + 16, &length, 8);
    uint32_t crc = (uint32_t)crc32_z(0, (const unsigned char *)data + 32, size - 32);
    memcpy(data + 24, &crc, 4);
    crc = (uint32_t)crc32_z(0, (const unsigned char *)data, 28);
    memcpy(data + 28, &crc, 4);
}

START_TEST(hostile_words_are_survived)
{
    context_init(&ctx);
    size_t size;
    char *data = example_file(&size);
    static const uint32_t words[] = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000000};
    char *copy = malloc(size);
    int refused = 0, taken = 0;
    for (size_t at = 32; at + 4 <= size; at++) {
        for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
            memcpy(copy, data, size);
            memcpy(copy + at, &words[w], 4);
            mend(copy, size);
            fram_status status = decode(copy, size);
            ck_assert(status == FRAM_OK || status == FRAM_ERROR_INPUT);
            refused += status != FRAM_OK;
            taken += status == FRAM_OK;
        }
    }
    ck_assert_int_gt(refused, 0);
    ck_assert_int_gt(taken, 0); /* changed values are values */
    for (size_t length = 32; length < size; length++) {
        memcpy(copy, data, length);
        mend(copy, length);
        ck_assert_int_eq(decode(copy, length), FRAM_ERROR_INPUT);
    }
    free(copy);
    free(data);
}
END_TEST

START_TEST(other_versions_and_machines_are_refused_by_name)
{
    context_init(&ctx);
    size_t size;
    char *data = example_file(&size);
    uint32_t version = 2;
    memcpy(data + 8, &version, 4);
    mend(data, size);
    ck_assert_int_eq(decode(data, size), FRAM_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "version 1, found version 2: another version of Fram wrote it: go on"));
    const uint32_t swapped = 0x04030201;
    memcpy(data + 12, &swapped, 4);
    ck_assert_int_eq(decode(data, size), FRAM_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "byte order"));
    data[0] = 'X';
    ck_assert_int_eq(decode(data, size), FRAM_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "another kind"));
    free(data);
}
END_TEST

START_TEST(other_contents_are_refused_by_name)
{
    context_init(&ctx);
    size_t size;
    char *data = example_file(&size);
    content b;
#define EXPECT(change, part)                                                                                       \
    do {                                                                                                           \
        content_begin(&b);                                                                                         \
        change;                                                                                                    \
        assert_fails(table_file_decode(&ctx, "test", data, size, &b.file, &error), error, FRAM_ERROR_INPUT, part); \
    } while (0)
    EXPECT(b.numbers[1].name = "else", "the number else");
    EXPECT(b.numbers[1].name = "record_length_and_more", "the number record_length_and_more");
    EXPECT(b.file.number_count = 1, "the count of numbers");
    EXPECT(b.bytes[0].name = "has", "the byte string has");
    EXPECT(b.file.bytes_count = 1, "the count of byte strings");
    EXPECT(b.file.table_count = 1, "the count of tables");
    EXPECT(b.tables[1].info = &sample_table_info, "the table sample");
    table_info renamed = {"other", 1, changed_table_info.fields};
    EXPECT(b.tables[1].info = &renamed, "the field velocity");
    field_info retyped = other_table_info.fields[0];
    retyped.kind = FIELD_I64;
    renamed.fields = &retyped;
    EXPECT(b.tables[1].info = &renamed, "of another, in which the type of the field value");
    renamed = (table_info){"other", 0, other_table_info.fields};
    EXPECT(b.tables[1].info = &renamed, "the number of fields of a table");
    free(data);
}
END_TEST

START_TEST(files_that_are_not_there)
{
    context_init(&ctx);
    content b;
    content_begin(&b);
    assert_fails(table_file_read(&ctx, "/no/such/file", &b.file, &error), error, FRAM_ERROR_INPUT, "No such file");
    assert_fails(write_file(&ctx, "/no/such/file", &b.file), error, FRAM_ERROR_INPUT,
                 "the folder /no/such is not there");
    if (access("/dev/full", W_OK) == 0) {
        ck_assert_int_ne(write_file(&ctx, "/dev/full/x", &b.file), FRAM_OK);
    }
}
END_TEST

START_TEST(memory_runs_out)
{
    context_init(&ctx);
    size_t size;
    char *data = example_file(&size);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        content b;
        content_begin(&b);
        turn.status = table_file_decode(&turn.ctx, "test", data, size, &b.file, &error);
        table_file_free_bytes(&turn.ctx, &b.file);
        content_free(&turn.ctx, &b);
    }
    free(data);
    scratch s = scratch_make();
    content a;
    content_fill(&a);
    for (failing_turn turn = {0}; failing_next(&turn);)
        turn.status = write_file(&turn.ctx, scratch_path(&s, "t"), &a.file);
    content_free(&ctx, &a);
    scratch_remove(&s, "t");
}
END_TEST

TEST_MAIN("table_file", content_comes_back, every_flipped_bit_is_refused, every_other_length_is_refused,
          hostile_words_are_survived, other_versions_and_machines_are_refused_by_name,
          other_contents_are_refused_by_name, files_that_are_not_there, memory_runs_out)
