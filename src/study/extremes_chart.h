/* Probability plots: levels over the mean time between their exceedances, of the data and of the fitted law (Coles
   2001, section 3.3.3), with the interval of the level that is asked.  Data on the line speak for the law. */
#ifndef STUDY_EXTREMES_CHART_H
#define STUDY_EXTREMES_CHART_H

#include "study/extremes.h"

/* A chart for each answered result, one below the other; a file without one is an error (FRAM_ERROR_INPUT), since there
   is nothing to draw.  quantity: "load [N]".  SVG when the name ends in .svg, else PNG. */
fram_status extremes_chart_write(context *ctx, const extreme_result *results, int32_t count, const char *quantity,
                                 double duration, const char *path, fram_error *error);

#endif
