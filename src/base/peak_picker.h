/* The largest peaks of a load that comes value by value: local maxima that stand apart in time, chosen by falling
   value, so that the same ones are peaks whichever way time goes.  Knows numbers only, so that a run and what reads its
   results pick the same ones. */
#ifndef BASE_PEAK_PICKER_H
#define BASE_PEAK_PICKER_H

#include "base/array.h"

enum { PEAKS_KEPT = 10 };
/* Peaks stand apart by at least so many averaging windows of the load. */
#define PEAK_SEPARATION 4
/* Maxima that may become peaks yet.  No two are within a window, and while they wait each separation has a larger one
   than the one before, so that one which 32 separations follow is none of the ten largest, nor decides on any of these
   (docs/decisions/0156). */
enum { PEAKS_AWAITED = 32 * PEAK_SEPARATION };
/* `room` is less than this. */
enum { PEAK_ROOMS = PEAKS_KEPT + PEAKS_AWAITED + 1 };

typedef struct load_peak {
    double time, value;
    int32_t room; /* a number that no other peak of the picker has, and that stays with it */
} load_peak;

typedef struct load_value {
    double time, value;
} load_value;

typedef struct peak_picker {
    double separation; /* [unit of time] */
    double from; /* maxima up to it are no peaks, and keep none from being one; values up to it count as neighbours */
    int32_t count;
    load_peak kept[PEAKS_KEPT]; /* by falling value */
    int32_t awaited_count;
    load_peak awaited[PEAKS_AWAITED]; /* by rising time */
    bool open;                        /* `candidate` may still be overtaken within a window */
    load_peak candidate;
    ARRAY(load_value) recent; /* a ring: values of the last window which none after them exceeds, the last one always */
    int32_t first, recent_count;
} peak_picker;

/* steps: values in an averaging window, at most.  false: no memory. */
bool peak_picker_init(context *ctx, double separation, double from, int32_t steps, peak_picker *p);
void peak_picker_free(context *ctx, peak_picker *p);
/* Whether one that waits, or the candidate, is among the largest as it is: what is not now will not be. */
bool peak_picker_may_keep(const peak_picker *p, const load_peak *peak);
/* The same of the candidate, if there is one. */
bool peak_picker_keeps(const peak_picker *p);
/* Whether this value is the new candidate, and would be kept as it is.  Times ascend. */
bool peak_picker_rises(peak_picker *p, double time, double value);
/* At the end of the values: all that wait are chosen from, and none waits then. */
void peak_picker_ends(peak_picker *p);
/* A value of `recent`, from the oldest on. */
load_value *peak_picker_recent(const peak_picker *p, int32_t i);

#endif
