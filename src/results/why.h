/* Why a load was what it was: the explanation of a peak as text, as JSON and as a picture, from what a run recorded, or
   from what was computed again (the caller's, results know no world). */
#ifndef RESULTS_WHY_H
#define RESULTS_WHY_H

#include "model/scenario_vessel.h"
#include "results/peaks.h"

/* What a second computed again by other methods came to; sim/rerun.h. */
typedef struct why_method {
    double load;  /* largest averaged load of windows that begin with the fork or later [N] */
    double wrong; /* end of the step in which it went wrong by this method [s]; 0: it did not */
} why_method;
typedef struct why_check {
    bool done;
    char hindrance[512]; /* why it was not done though it was asked for, "": nothing hindered */
    bool told;           /* what hindered: a program told the run what stands in no file */
    double start, fork;
    double first, last; /* the largest loads are looked for from the one to the other [s] */
    double same;        /* load as the run was made [N] */
    why_method half_step, accurate;
} why_check;

typedef struct why {
    context *ctx;
    run_data run;
    int32_t vessel;
    peak_list peaks;   /* of the vessel */
    fram_error unread; /* why those of its file cannot be read; its status FRAM_OK: they can */
} why;

/* The run and its peaks; FRAM_ERROR_INPUT when the folder is not that of a run.  Peaks that cannot be read are none,
   and their moments can be computed again. */
fram_status why_open(context *ctx, const char *folder, const char *vessel, why *y, fram_error *error);
void why_close(why *y);
/* Peak 1 is the largest.  FRAM_ERROR_INPUT says how many there are, and what to do when there are none or
   they cannot be read. */
fram_status why_peak(const why *y, int64_t number, const peak_detail **d, fram_error *error);
/* The recorded peak whose window has the time in its middle half; NULL: the moment must be computed again. */
const peak_detail *why_recorded_at(const why *y, double time);
/* Refuses a time that the run does not have. */
fram_status why_check_time(const why *y, double time, fram_error *error);

/* The explanation; rank: of a recorded peak, 0 for a moment. */
fram_status why_text(const why *y, const peak_detail *d, int32_t rank, const why_check *check, text_buffer *out,
                     fram_error *error);
fram_status why_json(const why *y, const peak_detail *d, int32_t rank, const why_check *check, text_buffer *out,
                     fram_error *error);
/* Plan of the field near the vessel: the floes that carry the load by their part of it, the chains as lines, forces as
   arrows.  The field is that of the record, between frames by interpolation.  FRAM_ERROR_UNSUPPORTED without cairo. */
fram_status why_picture(const why *y, const peak_detail *d, int32_t rank, const char *path, fram_error *error);
/* Whether there is a frame to draw it from and a folder to write it into: asked before a moment is computed again. */
fram_status why_picture_check(const why *y, const char *path, fram_error *error);

#endif
