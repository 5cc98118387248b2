/* Charts over a common axis, as PNG or SVG: lines, bands, bars, points, on plain or logarithmic axes. */
#ifndef IO_CHART_H
#define IO_CHART_H

#include "io/text_buffer.h"

typedef enum chart_style {
    CHART_LINE = 0,
    CHART_BAND,  /* between y and y2 */
    CHART_BARS,  /* from the axis to y, each from its x to the next row's; the last row only ends the last bar */
    CHART_POINTS /* a dot each */
} chart_style;

typedef struct chart_line {
    const char *name;    /* "": not in the legend */
    const double *x, *y; /* count values each; values that are no numbers break the line */
    int32_t count;
    bool thick;
    chart_style style;
    const double *y2; /* of a band */
    bool solid;       /* a band that hides what is behind it */
    int colour;       /* number in the palette, from 1, beyond it dashed; 0: by the place in the list */
} chart_line;

typedef struct chart {
    const char *title;
    const char *subtitle;
    const char *x_label, *y_label; /* with unit */
    const chart_line *lines;
    int32_t line_count;
    bool log_x, log_y; /* values that are not positive are left out */
    bool free_y;       /* the y axis need not begin at zero */
    /* Of a plain y axis, where the second is larger: lines that go on beyond it run out of the frame. */
    double y_from, y_to;
} chart;

/* How far a plain y axis goes on beyond its values, to each side of zero on which there are some, in parts of its
   length without that. */
#define CHART_PAD 0.05

static inline chart_line chart_line_make(const char *name, const double *x, const double *y, int32_t count, bool thick)
{
    return (chart_line){.name = name, .x = x, .y = y, .count = count, .thick = thick};
}
static inline chart chart_make(const char *title, const char *subtitle, const char *x_label, const char *y_label,
                               const chart_line *lines, int32_t count)
{
    return (chart){.title = title,
                   .subtitle = subtitle,
                   .x_label = x_label,
                   .y_label = y_label,
                   .lines = lines,
                   .line_count = count};
}

enum { CHART_COLOURS = 8 };
/* Of a number in the palette, as pages write it: "#99b3cc". */
enum { CHART_COLOUR_TEXT = 8 };
void chart_colour_text(int number, char out[CHART_COLOUR_TEXT]);

/* Dense lines are drawn as the envelope of their values within each pixel column, so that no peak is lost.
   FRAM_ERROR_UNSUPPORTED without cairo. */
#ifdef FRAM_HAVE_CAIRO
#include <cairo.h>
/* Into a part of a page, width x height from its origin; equal: a metre is as long across as upwards, and both axes
 * have the same ticks. */
void chart_draw(cairo_t *page, const chart *c, int width, int height, bool equal);
#endif
/* To a file, SVG when its name ends in .svg, else PNG. */
fram_status chart_write(context *ctx, const chart *c, const char *path, int width, int height, fram_error *error);
/* As SVG text, appended to out. */
fram_status chart_svg(context *ctx, const chart *c, int width, int height, text_buffer *out, fram_error *error);
/* Charts below each other, of equal height, as one file. */
fram_status chart_stack_write(context *ctx, const chart *charts, int32_t count, const char *path, int width, int height,
                              fram_error *error);

#endif
