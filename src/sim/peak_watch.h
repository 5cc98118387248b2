/* Watches the ice load on each vessel for its largest peaks, with the contacts of the last averaging window at hand (a
   ring of its steps, or of blocks of steps where it is long), so that what carried a peak can be told when it is over.
   Reads the world only. */
#ifndef SIM_PEAK_WATCH_H
#define SIM_PEAK_WATCH_H

#include "base/peak_picker.h"
#include "io/peak_block.h"
#include "sim/floe_trims.h"

typedef ARRAY(ice_share) ice_share_array;

typedef struct vessel_peaks {
    peak_picker picker;
    ARRAY(peak_detail) detail; /* by the rooms of the picker's peaks: as many as ever waited together */
} vessel_peaks;

typedef struct peak_watch {
    context *ctx;
    double time_step, from, window; /* [s] */
    vec2 origin;                    /* of the places that are written: that of the run's record [m] */
    int64_t steps;                  /* of the window */
    int32_t block;                  /* steps that a row of the ring tells of: 1, or their sums */
    ARRAY(ice_share_array) ring;    /* rows that hold each step of the window, WINDOW_ROWS_MOST at most */
    int32_t next, filled;           /* rows */
    int32_t within;                 /* steps in the newest row */
    floe_trim_array trims;          /* of the steps that the ring tells of */
    ARRAY(vessel_peaks) vessels;
} peak_watch;

void peak_watch_init(context *ctx, double time_step, double from, peak_watch *p);
void peak_watch_free(peak_watch *p);
/* On the first call with a world: rooms for its window and vessels.  false: no memory. */
bool peak_watch_begin(peak_watch *p, const world *w);
/* Where the watch begins beside a world that has come some way, or has lost what it knew: peaks count from when it
   knows each step of their window.  The same before and after a resume.  false: no memory. */
bool peak_watch_await(peak_watch *p, const world *w);
/* The steps that it knows are none of this world, which was copied: what it has of them goes. */
void peak_watch_forget(peak_watch *p);
/* Keeps the contacts of the step that was just done. */
fram_status peak_watch_keep(peak_watch *p, const world *w, fram_error *error);
/* What carries the load of a vessel now: after peak_watch_keep. */
fram_status peak_watch_explain(peak_watch *p, world *w, int32_t vessel, peak_detail *d, fram_error *error);

/* Each step of a run, in place of both: keeps what explains the largest peaks so far. */
fram_status peak_watch_step(peak_watch *p, world *w, fram_error *error);

/* The peaks so far as FOLDER/peaks.fram (results/peaks.h reads it), the ones that are not over too.  A failure leaves
   the file of before. */
fram_status peak_watch_write(peak_watch *p, const char *folder, fram_error *error);

#endif
