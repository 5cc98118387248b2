/* How often a load is exceeded, and how sure that is. */
#ifndef RESULTS_LOAD_STATISTICS_H
#define RESULTS_LOAD_STATISTICS_H

#include "io/csv_read.h"

/* The band is Wilson's score interval (Wilson 1927) at 95 %, with the number of independent values that the series is
   worth in place of its length: duration over twice the integral time scale (Bartlett 1946), the integral of the
   autocorrelation up to its first zero.  Of values that are means over a window, half of it is the least scale: that of
   a mean of white noise, where the series itself tells less. */
typedef struct load_distribution {
    double_array level;               /* ascending, from the least to the greatest value */
    double_array exceeded, low, high; /* part of the time above each level, and its band */
    double_array bar, density;        /* histogram: left edges (the last one ends it) and part of the time in each */
    double time_scale;                /* integral time scale [unit of step] */
    double independent;               /* values, at least 1 */
} load_distribution;

enum { LOAD_WORTH_SIZE = 80 };

/* Which values of single steps a picture does not show. */
typedef enum load_cut {
    LOAD_CUT_NONE = 0,
    LOAD_CUT_SOME, /* but that of largest size */
    LOAD_CUT_LARGEST
} load_cut;

/* Where values of single steps lie beyond the axis of a chart that shows them as far as the averaged values and zero,
   and a tenth of that range beyond, they run out of it: they end only where nobody sees it, for where they end inside
   they look like values that stay the same.  axis: of that chart, from which value to which; 0 and 0 where all is
   shown.  averaged: `lines` arrays of `count` values.  Returns the value of largest size before that, 0 without any. */
double load_spikes_cut(double *raw, const double *const *averaged, int32_t lines, int32_t count, load_cut *cut,
                       double axis[2]);

/* Values at equal distances `step` in time, each a mean over a window that ends there, 0: none.  Without values all is
   empty.  false: no memory. */
bool load_distribution_of(context *ctx, const double *value, int32_t count, double step, double window,
                          load_distribution *out);
/* "12 independent values"; and how far they lie apart, unless the series is shorter than that. */
void load_distribution_tell(const load_distribution *d, bool with_distance, char out[LOAD_WORTH_SIZE]);
void load_distribution_free(context *ctx, load_distribution *d);

#endif
