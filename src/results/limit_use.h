/* How far a vessel used a limit of its station after the transient: by the rows of the series, and by the run's own
   events in steps that have none. */
#ifndef RESULTS_LIMIT_USE_H
#define RESULTS_LIMIT_USE_H

#include "results/run_data.h"

typedef struct limit_use {
    double most, part; /* largest value; part of the time beyond */
    double first;      /* [s] when it was first passed; HUGE_VAL: not that it is known */
    double since;      /* [s] since when it was beyond as the transient ended; HUGE_VAL: it was not, that it is known */
    bool unsure;       /* it may have been, in steps without a row */
} limit_use;

/* Of the size of one channel, or of a vector of two: the heading without a second one, else the position. */
limit_use limit_use_of(const run_data *d, int32_t vessel, const char *x_name, const char *y_name, double limit);
/* Where a time lies that has no row, in words. */
const char *limit_use_between_rows(const run_data *d, double time);

#endif
