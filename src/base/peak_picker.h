/* The largest peaks of a load that comes value by value: local maxima that stand apart in time.  Knows numbers only, so
   that a run and what reads its results pick the same ones. */
#ifndef BASE_PEAK_PICKER_H
#define BASE_PEAK_PICKER_H

#include <stdbool.h>
#include <stdint.h>

enum { PEAKS_KEPT = 10 };
/* Peaks stand apart by at least so many averaging windows of the load. */
#define PEAK_SEPARATION 4

typedef struct load_peak {
    double time, value;
} load_peak;

typedef struct peak_picker {
    double separation; /* [unit of time] */
    double from;       /* peaks up to it are not kept; what stands too near to a larger one of them is none */
    int32_t count;
    load_peak kept[PEAKS_KEPT]; /* by falling value */
    bool open;                  /* `candidate` may still be overtaken */
    load_peak candidate;
    double last; /* value */
} peak_picker;

void peak_picker_init(peak_picker *p, double separation, double from);
/* Whether the candidate, as it is, is among the largest. */
bool peak_picker_keeps(const peak_picker *p);
/* Before the value of `time`: the place in `kept` of the candidate, when nothing overtook it for the separation and it
   is among the largest; -1 otherwise.  What stood there and after moves on by one, the last of ten goes. */
int32_t peak_picker_settles(peak_picker *p, double time);
/* Whether this value is the new candidate, and would be kept as it is.  Times ascend. */
bool peak_picker_rises(peak_picker *p, double time, double value);
/* At the end of the values: as peak_picker_settles, whatever the time. */
int32_t peak_picker_ends(peak_picker *p);

#endif
