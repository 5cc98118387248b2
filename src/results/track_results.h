/* How well ships that drive themselves kept their tracks, as run.json has it: for the report and the page of ice
   management.  Knows neither world nor files. */
#ifndef RESULTS_TRACK_RESULTS_H
#define RESULTS_TRACK_RESULTS_H

#include "io/html_page.h"
#include "results/run_data.h"

/* Whether a ship was within its limit wherever the track error counts; a ship that never came to its track was not. */
bool track_was_kept(const run_track *t);
/* "Vessel icebreaker kept its track: 18 m off at most, 9 m r.m.s., 3 rounds." */
void track_text(const run_track *t, char *out, size_t size);
/* What to do about one that was not kept. */
const char *track_remedy(const run_track *t);
/* A section with a row for each; nothing without any. */
void track_table(html_page *page, const run_note *note);

#endif
