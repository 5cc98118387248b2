/* Charts of channels of a run. */
#ifndef RESULTS_PLOT_H
#define RESULTS_PLOT_H

#include "io/text_buffer.h"

enum { PLOT_CHANNELS_MOST = 64 };

/* Channels of series.csv over time, 1 to PLOT_CHANNELS_MOST, those of one unit in one panel, panels below each other;
   from, to: times that are shown [s], a NaN for the run's own.  SVG when the name ends in .svg, else PNG.
   FRAM_ERROR_INPUT names a channel that the run does not have, with the nearest one it has; FRAM_ERROR_UNSUPPORTED
   without cairo. */
fram_status plot_channels(context *ctx, const char *folder, const char *const *channels, int32_t count, double from,
                          double to, const char *output, fram_error *error);
/* "name [unit]" of every channel, a line each. */
fram_status plot_list(context *ctx, const char *folder, text_buffer *out, fram_error *error);

#endif
