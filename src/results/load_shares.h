/* What makes the mean load: parts of it by mechanism or by zone of the hull.  Knows the series of a run. */
#ifndef RESULTS_LOAD_SHARES_H
#define RESULTS_LOAD_SHARES_H

#include "results/run_data.h"

enum { LOAD_PARTS_MOST = 16 };

/* x, y: of each of `parts` a column of the run's series [N].  share: of the mean horizontal load from the end of the
   transient on the part that each makes along it; they add up to 1, and one that pushes against the load is negative.
   false, with shares of 0: the run has no load then. */
bool load_shares(const run_data *run, const double *const *x, const double *const *y, int32_t parts, double *share);

#endif
