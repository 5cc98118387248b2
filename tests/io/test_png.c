/* io/png: what stands in a file are the pixels that were given, in chunks with right checksums. */
#include "io/png.h"
#include "testing.h"

#include <stdlib.h>
#include <zlib.h>

static uint32_t u32_at(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Walks the chunks, checks each one's sum, and inflates the data: the rows with their filter bytes. */
static void read_png(const text_buffer *file, unsigned char *rows, uLongf size, int32_t width, int32_t height)
{
    const unsigned char *at = (const unsigned char *)file->data, *end = at + file->count;
    unsigned char *packed = malloc((size_t)file->count);
    size_t filled = 0;
    bool ended = false;
    ck_assert_ptr_nonnull(packed);
    ck_assert_mem_eq(at, "\x89PNG\r\n\x1a\n", 8);
    for (at += 8; at < end;) {
        uint32_t length = u32_at(at);
        ck_assert(!ended && (size_t)(end - at) >= length + 12);
        ck_assert_uint_eq(crc32_z(0, at + 4, length + 4), u32_at(at + 8 + length));
        if (memcmp(at + 4, "IHDR", 4) == 0) {
            ck_assert_uint_eq(u32_at(at + 8), (uint32_t)width);
            ck_assert_uint_eq(u32_at(at + 12), (uint32_t)height);
            ck_assert_mem_eq(at + 16, "\x08\x02\0\0\0", 5);
        } else if (memcmp(at + 4, "IDAT", 4) == 0) {
            memcpy(packed + filled, at + 8, length);
            filled += length;
        }
        ended = memcmp(at + 4, "IEND", 4) == 0;
        at += length + 12;
    }
    uLongf found = size;
    ck_assert(ended);
    ck_assert_int_eq(uncompress(rows, &found, packed, (uLong)filled), Z_OK);
    ck_assert_uint_eq(found, size);
    free(packed);
}

/* `noise`: every n-th pixel is of any colour. */
static void check_picture(int32_t width, int32_t height, uint32_t noise)
{
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    size_t stride = 4 * (size_t)width + 12, row = 1 + 3 * (size_t)width;
    unsigned char *data = calloc((size_t)height, stride), *rows = malloc(row * (size_t)height);
    ck_assert(data && rows);
    uint32_t random = 1;
    for (int32_t i = 0; i < width * height; i++) {
        random = random * 1664525u + 1013904223u;
        uint32_t pixel = random / 65536 % noise == 0 ? random & 0xffffff : 0x295d85;
        memcpy(data + (size_t)(i / width) * stride + 4 * (size_t)(i % width), &pixel, sizeof pixel);
    }
    text_buffer file = {0};
    const png_pixels pixels = {data, stride, width, height};
    assert_ok(png_encode(&ctx, &pixels, &file, &error), error);
    read_png(&file, rows, (uLongf)(row * (size_t)height), width, height);
    for (int32_t i = 0; i < width * height; i++) {
        uint32_t pixel;
        memcpy(&pixel, data + (size_t)(i / width) * stride + 4 * (size_t)(i % width), sizeof pixel);
        const unsigned char *rgb = rows + (size_t)(i / width) * row + 1 + 3 * (size_t)(i % width);
        ck_assert_uint_eq((uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2], pixel);
        ck_assert_uint_eq(rows[(size_t)(i / width) * row], 0);
    }
    text_free(&ctx, &file);
    free(data);
    free(rows);
}

START_TEST(pixels_come_back)
{
    check_picture(1, 1, 1);
    check_picture(640, 480, 50);
    check_picture(301, 257, 1); /* more than one chunk of data that nothing makes shorter */
}
END_TEST

static const unsigned char grey[4 * 64 * 64] = {[77] = 0x80};

START_TEST(memory_runs_out)
{
    const png_pixels pixels = {grey, 4 * 64, 64, 64};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        text_buffer file = {0};
        turn.status = png_encode(&turn.ctx, &pixels, &file, &turn.error);
        ck_assert_int_eq(file.count == 0, turn.memory.failed);
        ck_assert_int_eq(turn.error.message[0] != '\0', turn.memory.failed);
        text_free(&turn.ctx, &file);
    }
}
END_TEST

START_TEST(what_the_library_refuses_is_told_with_its_reason)
{
    enum { WIDTH = 1000001 };
    unsigned char *data = calloc(WIDTH, 4);
    ck_assert_ptr_nonnull(data);
    const png_pixels pixels = {data, 4 * (size_t)WIDTH, WIDTH, 1};
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    text_buffer file = {0};
    ck_assert_int_eq(png_encode(&ctx, &pixels, &file, &error), FRAM_ERROR_MEMORY);
    ck_assert_ptr_nonnull(strstr(error.message, "1000001 x 1 pixels: "));
    ck_assert_ptr_nonnull(strstr(error.message, "IHDR"));
    ck_assert_int_eq(file.count, 0);
    free(data);
}
END_TEST

TEST_MAIN("png", pixels_come_back, memory_runs_out, what_the_library_refuses_is_told_with_its_reason)
