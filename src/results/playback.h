/* The playback page of a run: the viewer's page with the run's record inside, one file that opens from disk.  When that
   would be too large, frames go into files beside it (results/playback_chunks.h). */
#ifndef RESULTS_PLAYBACK_H
#define RESULTS_PLAYBACK_H

#include "base/context.h"

typedef struct playback_options {
    const char *viewer;   /* the page without a record (viewer/build.mjs makes it) */
    const char *output;   /* the page to write */
    uint64_t page_limit;  /* largest single page [bytes]; 0: 50 MB */
    uint64_t total_limit; /* page and files beside it [bytes]; above, only every n-th frame is kept; 0: 500 MB */
    const char *pressure; /* folder of fram pressure on this run; NULL: none */
} playback_options;

typedef struct playback_report {
    int64_t frames, left_out; /* kept and not */
    int64_t files;            /* beside the page */
} playback_report;

/* Put FOLDER/record.fram into a page.  FRAM_ERROR_INPUT when the record has no frame, the viewer's page is none, or
   the pressure is not of this run. */
fram_status playback_write(context *ctx, const char *folder, const playback_options *options, playback_report *report,
                           fram_error *error);
/* The viewer's page that follows a record at a relative address, in memory of ctx. */
fram_status playback_live_page(context *ctx, const char *viewer, const char *address, char **page, size_t *size,
                               fram_error *error);

#endif
