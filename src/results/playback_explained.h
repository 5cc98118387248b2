/* What a playback page tells of loads beside the record: the load of each vessel over time by mechanism, its largest
   peaks explained, and the ice pressure on a hull.  Blocks that stand in pages only (io/record_layout.h). */
#ifndef RESULTS_PLAYBACK_EXPLAINED_H
#define RESULTS_PLAYBACK_EXPLAINED_H

#include "io/text_buffer.h"

/* Whole blocks, each with its head, padded as in a record; nothing for a run without vessels, or whose series or peaks
   cannot be read, which the log is told.  pressure: a folder of fram pressure, NULL for none; FRAM_ERROR_INPUT when it
   is not one of this run. */
fram_status playback_explain(context *ctx, const char *folder, const char *pressure, text_buffer *blocks,
                             fram_error *error);

#endif
