#include "io/image.h"

#include <math.h>

double image_round_step(double span, int parts)
{
    if (!(span > 0) || !isfinite(span) || parts < 1)
        return 1;
    double raw = span / parts, power = 1;
    while (power * 10 <= raw)
        power *= 10;
    while (power > raw)
        power /= 10;
    if (raw <= power)
        return power;
    if (raw <= 2 * power)
        return 2 * power;
    return raw <= 5 * power ? 5 * power : 10 * power;
}

#ifdef FRAM_HAVE_CAIRO

#include "base/array.h"
#include "io/atomic_file.h"

bool image_available(void) { return true; }

fram_status image_begin(int width, int height, cairo_t **page, fram_error *error)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t *made = cairo_create(surface);
    cairo_surface_destroy(surface); /* the page holds it */
    if (cairo_status(made) != CAIRO_STATUS_SUCCESS) {
        cairo_destroy(made);
        return error_memory(error);
    }
    cairo_set_source_rgb(made, 1, 1, 1);
    cairo_paint(made);
    *page = made;
    return FRAM_OK;
}

typedef ARRAY(unsigned char) byte_array;
typedef struct png_sink {
    context *ctx;
    byte_array bytes;
} png_sink;

static cairo_status_t collect(void *closure, const unsigned char *data, unsigned int length)
{
    png_sink *sink = closure;
    int32_t at = sink->bytes.count;
    if (length > (unsigned)(INT32_MAX - at) || !array_resize(sink->ctx, &sink->bytes, at + (int32_t)length))
        return CAIRO_STATUS_NO_MEMORY;
    for (unsigned i = 0; i < length; i++)
        sink->bytes.data[at + (int32_t)i] = data[i];
    return CAIRO_STATUS_SUCCESS;
}

fram_status image_write(context *ctx, cairo_t *page, const char *path, fram_error *error)
{
    png_sink sink = {.ctx = ctx};
    fram_status status = FRAM_OK;
    cairo_surface_flush(cairo_get_target(page));
    if (cairo_surface_write_to_png_stream(cairo_get_target(page), collect, &sink) != CAIRO_STATUS_SUCCESS)
        status = error_memory(error);
    else
        status = atomic_file_write(ctx, path, sink.bytes.data, (size_t)sink.bytes.count, error);
    array_free(ctx, &sink.bytes);
    cairo_destroy(page);
    return status;
}

void image_set_colour(cairo_t *page, image_colour c) { cairo_set_source_rgb(page, c.r, c.g, c.b); }

static void select_font(cairo_t *page, double size, bool bold)
{
    cairo_select_font_face(page, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(page, size);
}

double image_text_width(cairo_t *page, double size, bool bold, const char *text)
{
    cairo_text_extents_t extents;
    select_font(page, size, bold);
    cairo_text_extents(page, text, &extents);
    return extents.x_advance;
}

void image_text(cairo_t *page, double x, double y, double size, image_align align, bool bold, const char *text)
{
    double width = image_text_width(page, size, bold, text);
    cairo_move_to(page, align == ALIGN_LEFT ? x : align == ALIGN_CENTRE ? x - width / 2 : x - width, y);
    cairo_show_text(page, text);
}

#else

bool image_available(void) { return false; }

#endif
