/* The layout of files, byte for byte, against what is written about it: base64, blocks of records, whole tables, and
   what a feature keeps for itself. */
#include "io/atomic_file.h"
#include "io/base64.h"
#include "io/csv_read.h"
#include "io/geojson.h"
#include "io/outline_file.h"
#include "io/record_layout.h"
#include "scratch.h"

static context ctx;
static fram_error error;

/* RFC 4648, section 10; and bytes with all bits in all places. */
START_TEST(base64_of_the_standard)
{
    static const char *const vectors[][2] = {{"", ""},
                                             {"f", "Zg=="},
                                             {"fo", "Zm8="},
                                             {"foo", "Zm9v"},
                                             {"foob", "Zm9vYg=="},
                                             {"fooba", "Zm9vYmE="},
                                             {"foobar", "Zm9vYmFy"},
                                             {"\xff\xfe\xfd", "//79"},
                                             {"\xfb\xef\xbe", "++++"}};
    context_init(&ctx);
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        text_buffer text = {0};
        base64_text(&ctx, &text, vectors[i][0], strlen(vectors[i][0]));
        ck_assert_int_eq(text.count, (int)strlen(vectors[i][1]));
        ck_assert(text.count == 0 || strncmp(text.data, vectors[i][1], (size_t)text.count) == 0);
        text_free(&ctx, &text);
    }
}
END_TEST

/* A file of the same bytes in pieces of any size. */
START_TEST(base64_in_pieces)
{
    enum { SIZE = 20011 };
    static unsigned char bytes[SIZE];
    static const size_t piece[] = {1, 2, 3, 4, 5000, 3072, 0, 7};
    context_init(&ctx);
    for (size_t i = 0; i < SIZE; i++)
        bytes[i] = (unsigned char)(i * 37 + i / 256);
    text_buffer whole = {0};
    base64_text(&ctx, &whole, bytes, SIZE);
    scratch place = scratch_make();
    atomic_file file;
    assert_ok(atomic_file_begin(&ctx, scratch_path(&place, "b"), &file, &error), error);
    base64_writer writer = base64_begin(&file.writer);
    for (size_t at = 0, k = 0; at < SIZE; k++) {
        size_t left = SIZE - at, size = piece[k % 8] < left ? piece[k % 8] : left;
        assert_ok(base64_write(&writer, bytes + at, size, &error), error);
        at += size;
    }
    assert_ok(base64_end(&writer, &error), error);
    assert_ok(atomic_file_commit(&file, &error), error);
    size_t size;
    char *text = scratch_read(place.path, &size);
    ck_assert_uint_eq(size, (SIZE + 2) / 3 * 4);
    ck_assert_uint_eq(size, (size_t)whole.count);
    ck_assert_int_eq(memcmp(text, whole.data, size), 0);
    free(text);
    text_free(&ctx, &whole);
    scratch_remove(&place, "b");
}
END_TEST

/* CRC-32 as in zlib, bit by bit. */
static uint32_t crc_of(const unsigned char *data, size_t size)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < size; i++) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

/* A head of 24 bytes, then blocks of 24 bytes and a payload that is filled up to a multiple of 8: none where it is one.
 */
START_TEST(records_are_laid_out_as_told)
{
    scratch place = scratch_make();
    record_writer w;
    context_init(&ctx);
    const char *path = scratch_path(&place, "a.fram");
    assert_ok(record_create(&ctx, path, &w, &error), error);
    uint64_t expected = 24;
    ck_assert_uint_eq(record_length(&w), expected);
    for (size_t size = 0; size <= 17; size++) {
        const record_part part = {"0123456789abcdefg", size};
        assert_ok(record_append(&w, 7, &part, 1, &error), error);
        expected += 24 + (size + 7) / 8 * 8;
        ck_assert_uint_eq(record_length(&w), expected);
    }
    assert_ok(record_close(&w, &error), error);

    /* The head's fields: magic, version, byte order, zero, and the checksum of these. */
    size_t size;
    unsigned char *data = (unsigned char *)scratch_read(path, &size);
    uint32_t version, crc;
    memcpy(&version, data + 8, 4);
    memcpy(&crc, data + 20, 4);
    ck_assert_uint_eq(version, RECORD_VERSION);
    ck_assert_uint_eq(crc, crc_of(data, 20));
    /* Older and newer versions are refused, whatever their checksum says. */
    for (int change = -1; change <= 1; change += 2) {
        record_reader r;
        uint32_t other = (uint32_t)(RECORD_VERSION + change);
        memcpy(data + 8, &other, 4);
        crc = crc_of(data, 20);
        memcpy(data + 20, &crc, 4);
        scratch_write(path, data, size);
        assert_fails(record_open(&ctx, path, &r, &error), error, FRAM_ERROR_INPUT, "version");
    }
    free(data);
    scratch_remove(&place, "a.fram");
}
END_TEST

/* An origin of 0 takes no block, so that ordinary records are as they were; another one is found again. */
START_TEST(an_origin_is_told_where_there_is_one)
{
    static const vec2 origins[] = {{0, 0}, {-1400000, 2000000}};
    static const double bad[2] = {0, HUGE_VAL};
    scratch place = scratch_make();
    const char *path = scratch_path(&place, "a.fram");
    record_writer w;
    vec2 found;
    bool lost;
    context_init(&ctx);
    for (int i = 0; i < 2; i++) {
        uint64_t length;
        assert_ok(record_create(&ctx, path, &w, &error), error);
        assert_ok(record_append_origin(&w, origins[i], &error), error);
        length = record_length(&w);
        ck_assert_uint_eq(length, 24 + 40 * (uint64_t)i);
        assert_ok(record_close(&w, &error), error);
        assert_ok(record_check_layout(&ctx, path, length, &found, &lost, &error), error);
        ck_assert(found.x == origins[i].x && found.y == origins[i].y && !lost);
    }
    /* Damage in that block hides it, damage behind it hides nothing. */
    for (int block = 0; block < 2; block++) {
        const record_part part = {&origins[1], sizeof origins[1]};
        assert_ok(record_create(&ctx, path, &w, &error), error);
        assert_ok(record_append_origin(&w, origins[1], &error), error);
        assert_ok(record_append(&w, BLOCK_SCENARIO, &part, 1, &error), error);
        assert_ok(record_close(&w, &error), error);
        size_t size;
        char *data = scratch_read(path, &size);
        data[24 + 40 * block + 24] ^= 1;
        scratch_write(path, data, size);
        free(data);
        assert_ok(record_check_layout(&ctx, path, 24 + 2 * 40, &found, &lost, &error), error);
        ck_assert(lost == (block == 0) && found.x == block * origins[1].x);
    }
    for (size_t size = 8; size <= sizeof bad; size += 8) {
        const record_part part = {bad, size};
        assert_ok(record_create(&ctx, path, &w, &error), error);
        assert_ok(record_append(&w, BLOCK_ORIGIN, &part, 1, &error), error);
        assert_ok(record_close(&w, &error), error);
        assert_fails(record_check_layout(&ctx, path, 64, &found, &lost, &error), error, FRAM_ERROR_INPUT, "origin");
    }
    scratch_remove(&place, "a.fram");
}
END_TEST

/* A table of all columns: as many values as names, and a last row without its end is one that is still being written.
 */
START_TEST(tables_of_whole_rows)
{
    static const struct {
        const char *text;
        int rows;          /* -1: refused */
        const char *words; /* NULL: whatever they are */
    } cases[] = {{"a,b\n1,2\n3,4\n", 2, NULL},
                 {"a,b\n1,2\n3,4", 1, NULL},
                 {"a,b\n1,2\n3", 1, NULL},
                 {"a,b\n1,2,3\n", -1, NULL},
                 {"a,b\n1\n", -1, NULL},
                 {"a,b\n1,2\n3,\n", -1, NULL},
                 {"a\n1\n2\n3\n", 3, NULL},
                 {"a[m],b,a [s]\n1,2,3\n", -1, "one column of this name, found columns 1 and 3"},
                 {"b,a,c,a,b,a\n1,2,3,4,5,6\n", -1, "one column of this name, found columns 2 and 4"},
                 {"a,b\n1,nan\n", -1, "column 2: expected a number, found \"nan\""},
                 {"a,b\n-inf,1\n", -1, "column 1: expected a number, found \"-inf\""},
                 {"a,b\n1,1e999\n", -1, "column 2: expected a number, found \"1e999\""},
                 {"a,b\n1,0x10\n", -1, "column 2: expected a number, found \"0x10\""}};
    context_init(&ctx);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scratch place = scratch_make();
        csv_table table;
        const char *path = scratch_path(&place, "a.csv");
        scratch_write(path, cases[i].text, strlen(cases[i].text));
        fram_status status = csv_table_read(&ctx, path, NULL, &table, &error);
        ck_assert_msg(status == (cases[i].rows < 0 ? FRAM_ERROR_INPUT : FRAM_OK), "table %zu: %d", i, (int)status);
        if (cases[i].words)
            assert_fails(status, error, FRAM_ERROR_INPUT, cases[i].words);
        if (status == FRAM_OK) {
            ck_assert_int_eq(table.rows, cases[i].rows);
            csv_table_free(&ctx, &table);
        }
        scratch_remove(&place, "a.csv");
    }
}
END_TEST

#define RING "\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[4,0],[4,3],[0,0]]]}}"
#define FEATURE(properties) "{\"type\":\"Feature\",\"properties\":" properties "," RING
#define TWO(a, b) "{\"type\":\"FeatureCollection\",\"features\":[" FEATURE(a) "," FEATURE(b) "]}"

/* Each feature has its own thickness; without one it has none, whatever the feature before said; none is under 0. */
START_TEST(thickness_is_the_features_own)
{
    import_rings rings = {0};
    context_init(&ctx);
    static const char two[] = TWO("{\"thickness\":0.75}", "{}");
    assert_ok(geojson_parse(&ctx, "two", two, strlen(two), &rings, &error), error);
    ck_assert_int_eq(rings.place.count, 2);
    ck_assert(rings.place.data[0].thickness == 0.75 && isnan(rings.place.data[1].thickness));
    import_rings_free(&ctx, &rings);
    static const char *const bad[] = {TWO("{}", "{\"thickness\":0}"), TWO("{\"thickness\":-1}", "{}")};
    for (int i = 0; i < 2; i++) {
        rings = (import_rings){0};
        assert_fails(geojson_parse(&ctx, "bad", bad[i], strlen(bad[i]), &rings, &error), error, FRAM_ERROR_INPUT,
                     "thickness over 0 m");
    }
}
END_TEST

/* A written ring ends where it began, as the format asks. */
START_TEST(written_rings_are_closed)
{
    scratch place = scratch_make();
    polygon_list outlines = {0};
    import_rings rings = {0};
    const vec2 corner[3] = {{0, 0}, {4, 0}, {4, 3}};
    context_init(&ctx);
    ck_assert(polygon_list_push(&ctx, &outlines, (polygon){corner, 3}));
    const char *path = scratch_path(&place, "a.geojson");
    assert_ok(geojson_write(&ctx, path, &outlines, NULL, &error), error);
    assert_ok(outline_file_read(&ctx, path, &rings, &error), error);
    ck_assert_int_eq(rings.place.count, 1);
    ck_assert(!rings.place.data[0].open);
    ck_assert_int_eq(polygon_list_get(&rings.rings, 0).count, 3);
    import_rings_free(&ctx, &rings);
    polygon_list_free(&ctx, &outlines);
    scratch_remove(&place, "a.geojson");
}
END_TEST

TEST_MAIN("layout", written_rings_are_closed, base64_of_the_standard, base64_in_pieces, records_are_laid_out_as_told,
          an_origin_is_told_where_there_is_one, tables_of_whole_rows, thickness_is_the_features_own)
