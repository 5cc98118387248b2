/* The playback page of a run: the viewer's page with the run's record inside, one file that opens from disk. */
#ifndef SIM_PLAYBACK_H
#define SIM_PLAYBACK_H

#include "base/context.h"

/* Largest record that goes into one page [bytes]; of a longer one only every second, third, ... frame is kept. */
enum { PLAYBACK_LIMIT = 36 << 20 };

/* Put FOLDER/record.fram into a copy of the page `template` (viewer/build.mjs makes it) at `output`.  frames gets the
   number of frames kept, left_out how many were not.  FRAM_ERROR_INPUT when the record has no frame or the template is
   none. */
fram_status playback_write(context *ctx, const char *folder, const char *template, const char *output, int64_t *frames,
                           int64_t *left_out, fram_error *error);

#endif
