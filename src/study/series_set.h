/* Sets of time series, their maxima and peaks: what laws of extremes are fitted to.  Knows numbers only. */
#ifndef STUDY_SERIES_SET_H
#define STUDY_SERIES_SET_H

#include "io/csv_read.h"

/* Values at equal distances in time, of one or of several realizations of the same process. */
typedef struct series_part {
    const double *value;
    int32_t count;
} series_part;
typedef struct series_set {
    const series_part *parts;
    int32_t count;
    double step; /* [s] */
} series_set;

/* Of all values: number, mean, and the integral time scale [s], which is the integral of the autocorrelation up to its
   first zero (Bartlett 1946); at least a step.  Of long series some pairs of values are looked at for it. */
typedef struct series_nature {
    int64_t values;
    double mean, deviation, least, greatest, time_scale;
} series_nature;
series_nature series_nature_of(const series_set *s);

/* How many values are over a level. */
int64_t series_values_over(const series_set *s, double level);

/* Greatest value of every whole block of `length` values, in time; blocks do not reach over the end of a part. */
bool block_maxima(context *ctx, const series_set *s, int32_t length, double_array *out);

/* Greatest value of every cluster over a threshold: values over it belong to one cluster until `apart` values in a row
   are not (runs declustering, Smith and Weissman 1994). */
bool cluster_peaks(context *ctx, const series_set *s, double threshold, int32_t apart, double_array *out);

/* Ascending. */
void values_sort(double_array *a);
/* The value that a part p of the ascending values lies below (linear between them). */
double sorted_quantile(const double *sorted, int32_t count, double p);

#endif
