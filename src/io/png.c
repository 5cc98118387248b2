#include "io/png.h"

#include <png.h>
#include <string.h>

enum { COLOURS = 3 };

/* Red, green and blue of each pixel, row after row. */
static void fill_colours(const png_pixels *p, unsigned char *to)
{
    for (int32_t y = 0; y < p->height; y++) {
        const unsigned char *from = p->data + (size_t)y * p->stride;
        for (int32_t x = 0; x < p->width; x++) {
            uint32_t pixel;
            memcpy(&pixel, from + 4 * (size_t)x, sizeof pixel);
            *to++ = (unsigned char)(pixel >> 16);
            *to++ = (unsigned char)(pixel >> 8);
            *to++ = (unsigned char)pixel;
        }
    }
}

fram_status png_encode(context *ctx, const png_pixels *pixels, text_buffer *out, fram_error *error)
{
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)pixels->width,
                       .height = (png_uint_32)pixels->height,
                       .format = PNG_FORMAT_RGB,
                       .flags = PNG_IMAGE_FLAG_FAST};
    size_t colours_size = COLOURS * (size_t)pixels->width * (size_t)pixels->height;
    /* The most that the file can take, so that the picture is compressed once and not to learn its size before. */
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    unsigned char *colours = memory_array(ctx, colours_size, 1), *file = memory_array(ctx, size, 1);
    fram_status status = FRAM_OK;
    if (colours && file) {
        fill_colours(pixels, colours);
        if (png_image_write_to_memory(&image, file, &size, 0, colours, 0, NULL))
            text_add_bytes(ctx, out, (const char *)file, size);
        else
            status = error_set(error, FRAM_ERROR_MEMORY, NULL, 0, NULL, "no picture of %d x %d pixels: %s",
                               (int)pixels->width, (int)pixels->height, image.message);
    } else {
        status = error_memory(error);
    }
    memory_free(ctx, colours);
    memory_free(ctx, file);
    return status == FRAM_OK && out->failed ? error_memory(error) : status;
}
