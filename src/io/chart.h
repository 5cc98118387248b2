/* Line charts over a common axis, as PNG. */
#ifndef IO_CHART_H
#define IO_CHART_H

#include "base/context.h"

typedef struct chart_line {
    const char *name;
    const double *x, *y; /* count values each; values that are no numbers break the line */
    int32_t count;
    bool thick;
} chart_line;

typedef struct chart {
    const char *title;
    const char *subtitle;
    const char *x_label, *y_label; /* with unit */
    const chart_line *lines;
    int32_t line_count;
} chart;

/* Dense lines are drawn as the envelope of their values within each pixel column, so that no peak is lost.
   FRAM_ERROR_UNSUPPORTED without cairo. */
#ifdef FRAM_HAVE_CAIRO
#include <cairo.h>
/* The same into a part of a page, width x height from its origin; equal: a metre is as long across as upwards. */
void chart_draw(cairo_t *page, const chart *c, int width, int height, bool equal);
#endif
fram_status chart_write(context *ctx, const chart *c, const char *path, int width, int height, fram_error *error);

#endif
