/* One page of charts and lines of text, as PNG. */
#ifndef IO_PAGE_H
#define IO_PAGE_H

#include "io/chart.h"

typedef struct page_panel {
    chart chart;
    int x, y, width, height; /* on the page [pixels] */
    bool equal;              /* the same scale on both axes */
} page_panel;

typedef struct page {
    const char *title;
    const char *title_end; /* where the part of it begins that is whole when the title is cut; NULL: none is */
    const page_panel *panels;
    int32_t panel_count;
    const char *text;               /* lines, each ended by a newline */
    int text_x, text_y, text_width; /* lines that are longer go on below [pixels] */
    int width, height;
} page;

/* FRAM_ERROR_UNSUPPORTED without cairo. */
fram_status page_write(context *ctx, const page *p, const char *path, fram_error *error);

#endif
