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

/* Threshold stability of an answer by peaks over a threshold (Coles 2001, section 4.3.1): the shape with 95 %
   intervals, and the scale less shape x threshold, over the threshold.  From the threshold on from which the law holds,
   both stay the same within their scatter.  Points into `room`, and into the result.  false: fewer than two thresholds.
 */
enum { STABILITY_CHARTS = 2, STABILITY_LINES = 3 };
typedef struct stability_plot {
    double threshold[STABILITY_MOST], value[STABILITY_CHARTS][STABILITY_MOST];
    double bar_x[3 * STABILITY_MOST], bar_y[3 * STABILITY_MOST];
    double taken[2], taken_y[STABILITY_CHARTS][2];
    chart_line lines[STABILITY_CHARTS][STABILITY_LINES];
    char across[200], scale[200];
} stability_plot;
bool stability_chart_make(const extreme_result *r, const char *quantity, stability_plot *room,
                          chart out[STABILITY_CHARTS]);

/* A chart for each answered result, one below the other, and below that of peaks over a threshold its stability; a file
   without one is an error (FRAM_ERROR_INPUT), since there
   is nothing to draw.  quantity: "load [N]".  SVG when the name ends in .svg, else PNG. */
fram_status extremes_chart_write(context *ctx, const extreme_result *results, int32_t count, const char *quantity,
                                 double duration, const char *path, fram_error *error);

#endif
