#include "io/png.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

/* Of zlib: pictures are a tenth larger than by level 3, and take two thirds of the time.  Range 1 to 9. */
enum { PICTURE_COMPRESSION = 1, COLOURS = 3 };

/* What a file is made of. */
typedef struct encoding {
    context *ctx;
    const png_pixels *pixels;
    text_buffer *text;
    unsigned char *row;
    char message[120];
} encoding;

/* Red, green and blue of each pixel of a row. */
static void fill_row(const png_pixels *p, int32_t y, unsigned char *to)
{
    const unsigned char *from = p->data + (size_t)y * p->stride;
    for (int32_t x = 0; x < p->width; x++) {
        uint32_t pixel;
        memcpy(&pixel, from + 4 * (size_t)x, sizeof pixel);
        *to++ = (unsigned char)(pixel >> 16);
        *to++ = (unsigned char)(pixel >> 8);
        *to++ = (unsigned char)pixel;
    }
}

/* libpng does not go on from here. */
static void keep_message(png_structp png, png_const_charp message)
{
    encoding *e = png_get_error_ptr(png);
    snprintf(e->message, sizeof e->message, "%s", message);
    png_longjmp(png, 1);
}

static void pass_warning(png_structp png, png_const_charp message) { (void)png, (void)message; }

static void put_bytes(png_structp png, png_bytep data, size_t size)
{
    encoding *e = png_get_io_ptr(png);
    text_add_bytes(e->ctx, e->text, (const char *)data, size);
    if (e->text->failed)
        png_error(png, "out of memory");
}

static void flush_nothing(png_structp png) { (void)png; }

/* False after an error, with its message. */
static bool write_file(png_structp png, png_infop info, encoding *e)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_write_fn(png, e, put_bytes, flush_nothing);
    png_set_IHDR(png, info, (png_uint_32)e->pixels->width, (png_uint_32)e->pixels->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_compression_level(png, PICTURE_COMPRESSION);
    png_write_info(png, info);
    for (int32_t y = 0; y < e->pixels->height; y++) {
        fill_row(e->pixels, y, e->row);
        png_write_row(png, e->row);
    }
    png_write_end(png, info);
    return true;
}

fram_status png_encode(context *ctx, const png_pixels *pixels, text_buffer *out, fram_error *error)
{
    text_buffer text = {0};
    encoding e = {.ctx = ctx, .pixels = pixels, .text = &text};
    e.row = memory_array(ctx, COLOURS * (size_t)pixels->width, 1);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &e, keep_message, pass_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    fram_status status = FRAM_OK;
    if (!e.row || !info)
        status = error_memory(error);
    else if (!write_file(png, info, &e))
        status = error_set(error, FRAM_ERROR_MEMORY, NULL, 0, NULL, "no picture of %d x %d pixels: %s",
                           (int)pixels->width, (int)pixels->height, e.message);
    else
        text_add_bytes(ctx, out, text.data, (size_t)text.count);
    if (status == FRAM_OK && out->failed)
        status = error_memory(error);
    png_destroy_write_struct(&png, &info);
    memory_free(ctx, e.row);
    text_free(ctx, &text);
    return status;
}
