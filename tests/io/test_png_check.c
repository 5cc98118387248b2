/* What passes as a PNG file: every byte of it counts. */
#include "io/png_check.h"

#include "testing.h"

#include <string.h>
#include <zlib.h>

/* One grey pixel: signature, header, data and end, as ISO/IEC 15948 lays them out. */
static size_t make_png(unsigned char *out)
{
    static const unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static const unsigned char header[] = {0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0}, row[] = {0, 128};
    unsigned char packed[32];
    uLongf length = sizeof packed;
    ck_assert_int_eq(compress(packed, &length, row, sizeof row), Z_OK);
    const struct {
        const char *name;
        const unsigned char *data;
        size_t size;
    } chunks[] = {{"IHDR", header, sizeof header}, {"IDAT", packed, length}, {"IEND", NULL, 0}};
    size_t at = sizeof signature;
    memcpy(out, signature, at);
    for (int i = 0; i < 3; i++) {
        unsigned char *begin = out + at, *body = begin + 8;
        size_t size = chunks[i].size;
        if (size > 0)
            memcpy(body, chunks[i].data, size);
        memcpy(begin + 4, chunks[i].name, 4);
        uLong sum = crc32(0, begin + 4, (uInt)size + 4);
        for (int k = 0; k < 4; k++) {
            begin[k] = (unsigned char)(size >> (24 - 8 * k));
            body[size + (size_t)k] = (unsigned char)(sum >> (24 - 8 * k));
        }
        at += size + 12;
    }
    return at;
}

START_TEST(only_a_whole_picture_passes)
{
    unsigned char png[128];
    size_t size = make_png(png);
    ck_assert(png_is_whole(png, size));
    for (size_t part = 0; part < size; part++)
        ck_assert_msg(!png_is_whole(png, part), "its first %zu bytes pass", part);
    for (size_t i = 0; i < size; i++) {
        png[i] ^= 1;
        ck_assert_msg(!png_is_whole(png, size), "byte %zu may be another", i);
        png[i] ^= 1;
    }
    ck_assert(png_is_whole(png, size));
    png[size] = 'x';
    ck_assert(!png_is_whole(png, size + 1));
    ck_assert(!png_is_whole("root:x:0:0", 10));
}
END_TEST

TEST_MAIN("png_check", only_a_whole_picture_passes)
