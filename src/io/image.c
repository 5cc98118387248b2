#include "io/image.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The shortest step: of less the powers below round to zero, and ends of axes are divided by it. */
#define STEP_LEAST 1e-300

double image_round_step(double span, int parts)
{
    if (!(span > 0) || !isfinite(span) || parts < 1)
        return 1;
    double raw = fmax(span / parts, STEP_LEAST), power = 1;
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

void image_ramp(double t, double rgb[3])
{
    static const double low[3] = {0.96, 0.97, 0.96}, middle[3] = {0.98, 0.72, 0.30}, high[3] = {0.42, 0.05, 0.35};
    double x = fmin(fmax(t, 0), 1), part = x < 0.5 ? 2 * x : 2 * x - 1;
    const double *from = x < 0.5 ? low : middle, *to = x < 0.5 ? middle : high;
    for (int k = 0; k < 3; k++)
        rgb[k] = from[k] + part * (to[k] - from[k]);
}

fram_status image_or_skip(context *ctx, const char *name, fram_status status, const fram_error *reason,
                          fram_error *error)
{
    if (status == FRAM_ERROR_UNSUPPORTED) {
        log_write(ctx, LOG_WARNING, "%s is skipped: %s", name, reason->message);
        return FRAM_OK;
    }
    if (status != FRAM_OK && error)
        *error = *reason;
    return status;
}

#ifdef FRAM_HAVE_CAIRO

#include "io/atomic_file.h"
#include "io/png.h"
#include "io/utf8.h"

#include <cairo-svg.h>
#include <strings.h>

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

fram_status image_png(context *ctx, cairo_t *page, text_buffer *out, fram_error *error)
{
    cairo_surface_t *surface = cairo_get_target(page);
    cairo_surface_flush(surface);
    const png_pixels pixels = {cairo_image_surface_get_data(surface), (size_t)cairo_image_surface_get_stride(surface),
                               cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface)};
    fram_status status = pixels.data ? png_encode(ctx, &pixels, out, error) : error_memory(error);
    cairo_destroy(page);
    return status;
}

fram_status image_write(context *ctx, cairo_t *page, const char *path, fram_error *error)
{
    text_buffer bytes = {0};
    fram_status status = image_png(ctx, page, &bytes, error);
    if (status == FRAM_OK)
        status = atomic_file_put(ctx, path, bytes.data, (size_t)bytes.count, error);
    text_free(ctx, &bytes);
    return status;
}

static cairo_status_t collect_text(void *closure, const unsigned char *data, unsigned int length)
{
    image_vector *v = closure;
    text_add_bytes(v->ctx, &v->text, (const char *)data, length);
    return v->text.failed ? CAIRO_STATUS_NO_MEMORY : CAIRO_STATUS_SUCCESS;
}

fram_status image_vector_begin(context *ctx, const char *title, int width, int height, image_vector *v,
                               fram_error *error)
{
    *v = (image_vector){.ctx = ctx, .title = title};
    cairo_surface_t *surface = cairo_svg_surface_create_for_stream(collect_text, v, width, height);
    v->page = cairo_create(surface);
    cairo_surface_destroy(surface); /* the page holds it */
    if (cairo_status(v->page) == CAIRO_STATUS_SUCCESS) {
        cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
        return FRAM_OK;
    }
    cairo_destroy(v->page);
    return error_memory(error);
}

/* A picture that is opened alone is to shrink with a narrow window, in the proportions of its viewBox; and it says what
   it is. */
static void add_told(image_vector *v, text_buffer *out)
{
    static const char mark[] = "<svg ", told[] = "style=\"max-width:100%;height:auto\" role=\"img\" ";
    text_add_bytes(v->ctx, &v->text, "", 1);
    const char *begin = v->text.failed ? NULL : v->text.data, *at = begin ? strstr(begin, mark) : NULL;
    const char *inside = at ? strchr(at, '>') : NULL;
    if (!inside) {
        out->failed = true;
        return;
    }
    at += sizeof mark - 1;
    inside++;
    text_add_bytes(v->ctx, out, begin, (size_t)(at - begin));
    text_add_bytes(v->ctx, out, told, sizeof told - 1);
    text_add_bytes(v->ctx, out, at, (size_t)(inside - at));
    text_add(v->ctx, out, "\n<title>");
    text_add_escaped(v->ctx, out, v->title);
    text_add(v->ctx, out, "</title>");
    text_add_bytes(v->ctx, out, inside, (size_t)v->text.count - 1 - (size_t)(inside - begin));
}

fram_status image_vector_end(image_vector *v, text_buffer *out, fram_error *error)
{
    cairo_surface_finish(cairo_get_target(v->page));
    bool good = cairo_status(v->page) == CAIRO_STATUS_SUCCESS && !v->text.failed;
    cairo_destroy(v->page);
    if (good && out)
        add_told(v, out);
    text_free(v->ctx, &v->text);
    return good && (!out || !out->failed) ? FRAM_OK : error_memory(error);
}

static bool wants_svg(const char *path)
{
    size_t length = strlen(path);
    return length >= 4 && strcasecmp(path + length - 4, ".svg") == 0;
}

fram_status image_page_begin(context *ctx, const char *path, const char *title, int width, int height, image_page *page,
                             fram_error *error)
{
    *page = (image_page){.is_vector = wants_svg(path)};
    if (!page->is_vector)
        return image_begin(width, height, &page->pen, error);
    fram_status status = image_vector_begin(ctx, title, width, height, &page->vector, error);
    if (status != FRAM_OK)
        return status;
    page->pen = page->vector.page;
    cairo_set_source_rgb(page->pen, 1, 1, 1);
    cairo_paint(page->pen);
    return FRAM_OK;
}

fram_status image_page_end(context *ctx, image_page *page, const char *path, fram_error *error)
{
    if (!page->is_vector)
        return image_write(ctx, page->pen, path, error);
    text_buffer text = {0};
    fram_status status = image_vector_end(&page->vector, &text, error);
    if (status == FRAM_OK)
        status = atomic_file_put(ctx, path, text.data, (size_t)text.count, error);
    text_free(ctx, &text);
    return status;
}

void image_page_drop(image_page *page)
{
    if (page->is_vector)
        (void)image_vector_end(&page->vector, NULL, NULL);
    else
        cairo_destroy(page->pen);
}

void image_set_colour(cairo_t *page, image_colour c) { cairo_set_source_rgb(page, c.r, c.g, c.b); }

/* [pixels] */
#define LEAST_ARROW 2

void image_arrow(cairo_t *page, double x0, double y0, double x1, double y1, double width, double head)
{
    double length = sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0));
    if (!(length > LEAST_ARROW))
        return;
    double ux = (x1 - x0) / length, uy = (y1 - y0) / length, along = fmin(head, 0.45 * length), across = 0.5 * along;
    cairo_set_line_width(page, width);
    cairo_move_to(page, x0, y0);
    cairo_line_to(page, x1 - ux * along, y1 - uy * along);
    cairo_stroke(page);
    cairo_move_to(page, x1, y1);
    cairo_line_to(page, x1 - ux * along - uy * across, y1 - uy * along + ux * across);
    cairo_line_to(page, x1 - ux * along + uy * across, y1 - uy * along - ux * across);
    cairo_close_path(page);
    cairo_fill(page);
}

void image_arrow_halo(cairo_t *page, double x0, double y0, double x1, double y1, double width, double head)
{
    double length = sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0));
    if (!(length > LEAST_ARROW))
        return;
    double ux = IMAGE_HALO * (x1 - x0) / length, uy = IMAGE_HALO * (y1 - y0) / length;
    cairo_set_source_rgb(page, 1, 1, 1);
    image_arrow(page, x0 - ux, y0 - uy, x1 + 2 * ux, y1 + 2 * uy, width + 2 * IMAGE_HALO, head + 4 * IMAGE_HALO);
}

static void select_font(cairo_t *page, double size, bool bold)
{
    cairo_select_font_face(page, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(page, size);
}

/* Longer than any line of a picture. */
enum { SHOWN_MOST = 1024 };

/* What cairo shows: a page with text that is no UTF-8, as names of files may be, is lost to it.  A question mark for
   each byte that is none, and what a buffer cut in its middle. */
static void make_shown(const char *text, char out[SHOWN_MOST])
{
    const char *end = text + strlen(text);
    size_t length = 0;
    while (text < end && length + 4 < SHOWN_MOST) {
        const char *begin = text;
        if (utf8_next(&text, end) < 0) {
            out[length++] = '?';
            text++;
        } else {
            memcpy(out + length, begin, (size_t)(text - begin));
            length += (size_t)(text - begin);
        }
    }
    out[length] = '\0';
}

static double width_of(cairo_t *page, const char *shown)
{
    cairo_text_extents_t extents;
    cairo_text_extents(page, shown, &extents);
    return extents.x_advance;
}

double image_text_width(cairo_t *page, double size, bool bold, const char *text)
{
    char shown[SHOWN_MOST];
    make_shown(text, shown);
    select_font(page, size, bold);
    return width_of(page, shown);
}

void image_text(cairo_t *page, double x, double y, double size, image_align align, bool bold, const char *text)
{
    char shown[SHOWN_MOST];
    make_shown(text, shown);
    select_font(page, size, bold);
    double width = width_of(page, shown);
    cairo_move_to(page, align == ALIGN_LEFT ? x : align == ALIGN_CENTRE ? x - width / 2 : x - width, y);
    cairo_show_text(page, shown);
}

const char *image_fit(cairo_t *page, double size, bool bold, double room, const char *text, const char *end,
                      char part[IMAGE_FITTED_SIZE])
{
    double width = image_text_width(page, size, bold, text), kept = image_text_width(page, size, bold, end);
    size_t length = (size_t)(end - text), taken = sizeof "..." + strlen(end);
    size_t most = taken < IMAGE_FITTED_SIZE ? IMAGE_FITTED_SIZE - taken : 0;
    if (width <= room)
        return text;
    /* What would fit of letters that are all alike, and a quarter more. */
    size_t likely = room > kept ? (size_t)(1.25 * (room - kept) / (width - kept) * (double)length) + 1 : 0;
    for (size_t n = likely < most ? likely : most; n > 0; n--) {
        if (n >= length || ((unsigned char)text[n] & 0xC0U) == 0x80U)
            continue; /* within a character of UTF-8 */
        snprintf(part, IMAGE_FITTED_SIZE, "%.*s...%s", (int)n, text, end);
        if (image_text_width(page, size, bold, part) <= room)
            return part;
    }
    snprintf(part, IMAGE_FITTED_SIZE, "%s", end);
    return part;
}

void image_text_fitted(cairo_t *page, double x, double y, double size, bool bold, double room, const char *text)
{
    char part[IMAGE_FITTED_SIZE];
    const char *fitting = image_fit(page, size, bold, room, text, text + strlen(text), part);
    image_text(page, x, y, size, ALIGN_LEFT, bold, fitting);
}

/* From one line to the next, and how far lines that go on are set in [pixels]. */
enum { LINE_HEIGHT = 19, SET_IN = 14 };

/* How many bytes of a line of `length` fit in the room: whole words, one at least. */
static size_t words_that_fit(cairo_t *page, double size, double room, const char *line, size_t length)
{
    char part[SHOWN_MOST];
    size_t fitting = 0;
    for (size_t n = 0; n < length; fitting = n) {
        n += strspn(line + n, " ");
        n += strcspn(line + n, " \n");
        snprintf(part, sizeof part, "%.*s", (int)n, line);
        if (fitting > 0 && image_text_width(page, size, false, part) > room)
            break;
    }
    return fitting;
}

void image_text_lines(cairo_t *page, double x, double y, double size, double room, const char *text)
{
    double in = 0;
    for (const char *line = text; *line; y += LINE_HEIGHT) {
        char one[SHOWN_MOST];
        size_t length = strcspn(line, "\n"), n = words_that_fit(page, size, room - in, line, length);
        snprintf(one, sizeof one, "%.*s", (int)n, line);
        image_text_fitted(page, x + in, y, size, false, room - in, one);
        in = n < length ? SET_IN : 0;
        line += n;
        line += n < length ? strspn(line, " ") : *line == '\n';
    }
}

#else

bool image_available(void) { return false; }

#endif
