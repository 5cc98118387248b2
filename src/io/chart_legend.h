/* Which line of a chart is which: their colours, dashes and names.  One module with chart. */
#ifndef IO_CHART_LEGEND_H
#define IO_CHART_LEGEND_H

#include "io/chart.h"

#ifdef FRAM_HAVE_CAIRO
#include "io/image.h"

#define CHART_INK ((image_colour){0.2, 0.2, 0.2})
#define CHART_BAND_OPACITY 0.18

/* Of the line at this place of the list; place: from 0. */
image_colour chart_colour_of(const chart_line *line, int32_t place);
/* Lines whose colour others have already are dashed; cairo_set_dash ends it. */
void chart_set_dashes(cairo_t *page, const chart_line *line, int32_t place);
/* What charts under each other show, in words: "Title: roll, pitch [deg]; force [kN] over time [s]". */
enum { CHART_WORDS = 512 };
void chart_stack_words(const chart *charts, int32_t count, char out[CHART_WORDS]);
/* Names above a plot, whose upper edge is at `top`, from its right end on; in rows where one is too long for it. */
void chart_draw_legend(cairo_t *page, const chart *c, double left, double right, double top);
/* What its rows beyond the first take of the height of a plot that has `high` without them; a sixth of it stays for the
   lines [pixels]. */
double chart_legend_more(cairo_t *page, const chart *c, double wide, double high);
#endif

#endif
