/* Raster images of drawings: a cairo surface, written as PNG through a temporary file.  Without cairo in the build
   every call returns FRAM_ERROR_UNSUPPORTED. */
#ifndef IO_IMAGE_H
#define IO_IMAGE_H

#include "io/text_buffer.h"

/* True when this build can make pictures. */
bool image_available(void);
/* Pictures of a run are a service: where the build cannot draw one (status is FRAM_ERROR_UNSUPPORTED), the log says
   that it is skipped, by its name, and that is FRAM_OK.  Any other status is returned, with its reason in `error`. */
fram_status image_or_skip(context *ctx, const char *name, fram_status status, const fram_error *reason,
                          fram_error *error);

#ifdef FRAM_HAVE_CAIRO
#include <cairo.h>

typedef struct image_colour {
    double r, g, b;
} image_colour;

/* A white page of width x height pixels. */
fram_status image_begin(int width, int height, cairo_t **page, fram_error *error);
/* Write the page to `path` and free it; frees it on failure too. */
fram_status image_write(context *ctx, cairo_t *page, const char *path, fram_error *error);
/* A page drawn as SVG text, as a picture that is called as its title says to who cannot see it.  Struct and title must
   stay where they are between the two calls; image_vector_end appends the text to out (nothing when it is NULL) and
   frees the page. */
typedef struct image_vector {
    cairo_t *page;
    const char *title;
    text_buffer text;
    context *ctx;
} image_vector;
fram_status image_vector_begin(context *ctx, const char *title, int width, int height, image_vector *v,
                               fram_error *error);
fram_status image_vector_end(image_vector *v, text_buffer *out, fram_error *error);
/* A page for a file: SVG when its name ends in .svg, otherwise PNG, which has no title.  Not to be moved between begin
   and end, which writes the file; both end and drop free the page. */
typedef struct image_page {
    cairo_t *pen;
    bool is_vector;
    image_vector vector;
} image_page;
fram_status image_page_begin(context *ctx, const char *path, const char *title, int width, int height, image_page *page,
                             fram_error *error);
fram_status image_page_end(context *ctx, image_page *page, const char *path, fram_error *error);
void image_page_drop(image_page *page);
/* The page as PNG, appended to out; frees the page, also on failure. */
fram_status image_png(context *ctx, cairo_t *page, text_buffer *out, fram_error *error);
void image_set_colour(cairo_t *page, image_colour c);
/* From x0, y0 to its tip at x1, y1 [pixels], in the colour that is set; lines `width` and head `head` pixels long at
   most. Nothing where it is shorter than two pixels. */
void image_arrow(cairo_t *page, double x0, double y0, double x1, double y1, double width, double head);
/* White round that arrow, to be drawn before it, so that it is seen on water, ice and hull alike: so wide [px]. */
#define IMAGE_HALO 2.0
void image_arrow_halo(cairo_t *page, double x0, double y0, double x1, double y1, double width, double head);
typedef enum image_align { ALIGN_LEFT, ALIGN_CENTRE, ALIGN_RIGHT } image_align;
/* Text with its baseline at (x, y), UTF-8; a byte that is none is shown as a question mark. */
void image_text(cairo_t *page, double x, double y, double size, image_align align, bool bold, const char *text);
double image_text_width(cairo_t *page, double size, bool bold, const char *text);
/* What of a text fits in `room` pixels: all of it, or its beginning with dots, and what begins at `end` in it, as a
   unit, whole in any case.  Written to part where it is not the text itself. */
enum { IMAGE_FITTED_SIZE = 512 };
const char *image_fit(cairo_t *page, double size, bool bold, double room, const char *text, const char *end,
                      char part[IMAGE_FITTED_SIZE]);
/* Text that begins at (x, y) and goes on for `room` pixels at most: what is cut off ends in dots. */
void image_text_fitted(cairo_t *page, double x, double y, double size, bool bold, double room, const char *text);
/* Text of many lines, the first with its baseline at (x, y); those that are longer than `room` pixels go on below,
   set in, from word to word. */
void image_text_lines(cairo_t *page, double x, double y, double size, double room, const char *text);
#endif

/* Colours of a scale from 0 (the white of ice) over 0.5 (amber) to 1 (dark purple), none of which is that of water or a
   hull; the same as in the playback page.  r g b from 0 to 1. */
void image_ramp(double t, double rgb[3]);

/* A round step (1, 2 or 5 times a power of ten) that divides `span` into about `parts`. */
double image_round_step(double span, int parts);

#endif
