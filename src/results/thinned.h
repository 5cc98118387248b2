/* Values of a whole run in bounded memory: of more than there is room for every second one, every fourth, ..., so that
   the beginning counts no more than the end.  Knows numbers only. */
#ifndef RESULTS_THINNED_H
#define RESULTS_THINNED_H

#include "io/csv_read.h"

enum { THINNED_MOST = 400000 };

/* Begins as {0}; free value with array_free. */
typedef struct thinned {
    double_array value;
    int64_t seen, step; /* every step-th of those seen is kept; step 0 at the start */
} thinned;

/* false: no memory. */
bool thinned_add(context *ctx, thinned *t, double value);
/* The value that so many per cent of those kept are not above; 0 without any.  It sorts them: nothing is added after.
 */
double thinned_percentile(thinned *t, int percent);

#endif
