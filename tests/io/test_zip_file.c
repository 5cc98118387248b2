/* io/zip_file: archives that others open; tests/fmi opens them with Python's zipfile. */
#include "io/zip_file.h"
#include "testing.h"

#include <stdio.h>
#include <unistd.h>
#include <zlib.h>

static fram_error error;

static uint32_t number(const char *at, int bytes)
{
    uint32_t value = 0;
    for (int i = bytes - 1; i >= 0; i--)
        value = value << 8 | (unsigned char)at[i];
    return value;
}

START_TEST(entries_are_found_by_the_directory)
{
    context ctx;
    context_init(&ctx);
    zip_file zip = {.ctx = &ctx};
    char text[5000];
    for (size_t i = 0; i < sizeof text; i++)
        text[i] = (char)('a' + i * i % 7);
    assert_ok(zip_add(&zip, "empty", "", 0, false, &error), error);
    assert_ok(zip_add(&zip, "folder/text.txt", text, sizeof text, true, &error), error);
    const char *entry = zip.directory.data + 46 + 5;
    ck_assert_uint_eq(number(entry, 4), 0x02014b50);
    ck_assert_uint_eq(number(entry + 38, 4) >> 16, 0100755);
    uint32_t packed = number(entry + 20, 4), size = number(entry + 24, 4), offset = number(entry + 42, 4);
    ck_assert_uint_eq(size, sizeof text);
    ck_assert_uint_lt(packed, size / 4);
    ck_assert_uint_eq(number(entry + 16, 4), (uint32_t)crc32(0, (const Bytef *)text, sizeof text));
    const char *local = zip.body.data + offset;
    ck_assert_uint_eq(number(local, 4), 0x04034b50);
    ck_assert(memcmp(local + 30, "folder/text.txt", 15) == 0);
    char back[sizeof text];
    z_stream z = {
        .next_in = (Bytef *)(local + 45), .avail_in = packed, .next_out = (Bytef *)back, .avail_out = sizeof back};
    ck_assert_int_eq(inflateInit2(&z, -15), Z_OK);
    ck_assert_int_eq(inflate(&z, Z_FINISH), Z_STREAM_END);
    inflateEnd(&z);
    ck_assert(memcmp(back, text, sizeof text) == 0);
    ck_assert_uint_eq(number(entry + 8, 2), 0);
    assert_ok(zip_add(&zip, "Größe", "", 0, false, &error), error);
    ck_assert_uint_eq(number(zip.directory.data + zip.directory.count - 7 - 46 + 8, 2), 1 << 11); /* a name in UTF-8 */
    char path[] = "/tmp/fram_zip_XXXXXX";
    int made = mkstemp(path);
    ck_assert_int_ge(made, 0);
    close(made);
    assert_ok(zip_write(&zip, path, &error), error);
    const char *end = zip.body.data + zip.body.count - 22;
    ck_assert_uint_eq(number(end, 4), 0x06054b50);
    ck_assert_uint_eq(number(end + 10, 2), 3);
    ck_assert(memcmp(zip.body.data + number(end + 16, 4), zip.directory.data, number(end + 12, 4)) == 0);
    unlink(path);
    assert_fails(zip_write(&zip, "/no/such/folder/a.zip", &error), error, FRAM_ERROR_INPUT, "");
    zip_free(&zip);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        zip_file zip = {.ctx = &turn.ctx};
        turn.status = zip_add(&zip, "a", "some text", 9, false, &error);
        zip_free(&zip);
    }
}
END_TEST

TEST_MAIN("zip_file", entries_are_found_by_the_directory, memory_runs_out)
