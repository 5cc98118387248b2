/* Probability plots: levels over the mean time between their exceedances, of the data and of the fitted law (Coles
   2001, section 3.3.3), with the interval of the level that is asked.  Data on the line speak for the law. */
#ifndef STUDY_EXTREMES_CHART_H
#define STUDY_EXTREMES_CHART_H

#include "io/chart.h"
#include "study/extremes.h"

/* The plot of one answered result, its levels times a factor; all that the chart points to lies in `room`. */
enum { EXTREMES_LAW_POINTS = 64, EXTREMES_PLOT_LINES = 4 };
typedef struct extremes_plot {
    double period[EXTREME_POINTS_MOST], level[EXTREME_POINTS_MOST];
    double law_period[EXTREMES_LAW_POINTS], law_level[EXTREMES_LAW_POINTS];
    double at[2], interval[2], most_probable[1];
    chart_line lines[EXTREMES_PLOT_LINES];
    char title[200];
} extremes_plot;
chart extremes_chart_make(const extreme_result *r, const char *quantity, double factor, double duration,
                          extremes_plot *room);

/* A chart for each answered result, one below the other, and below that of peaks over a threshold its stability; a file
   without one is an error (FRAM_ERROR_INPUT), since there
   is nothing to draw.  quantity: "load [N]".  SVG when the name ends in .svg, else PNG. */
fram_status extremes_chart_write(context *ctx, const extreme_result *results, int32_t count, const char *quantity,
                                 double duration, const char *path, fram_error *error);

#endif
