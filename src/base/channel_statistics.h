/* Statistics of a channel over time: what reports, station results and capability plots tell of a load.  Knows numbers
   only. */
#ifndef BASE_CHANNEL_STATISTICS_H
#define BASE_CHANNEL_STATISTICS_H

#include <stdbool.h>
#include <stdint.h>

/* Deviations of a normal distribution that hold 95 % of it between them and their opposite. */
#define NORMAL_95 1.959963984540054

/* Whether what is of `time` is after `from`, as the transient of a run.  A row of a series has the end of its step:
   that of `from` itself is before it, with a slack for times that a file has rounded.  Nothing is before 0: from there
   on all counts. */
bool time_is_after(double time, double from);
/* The first of rising times that is after `from`; count: none is. */
int32_t first_time_after(const double *time, int32_t count, double from);

/* Statistics of one channel after the transient; NaN where it has no value there.  A peak is the outermost value
   between two crossings of the mean, and the significant one the mean of the highest third of the peaks.  Both are told
   of the side on which the channel goes farthest from zero, with their sign: a load against its axis peaks downwards.
 */
typedef struct channel_statistics {
    double mean, deviation, least, greatest;
    double peak;              /* least or greatest, whichever is larger in size */
    double significant;       /* on the side of `peak`; the value where all are equal, 0 where there is none */
    double significant_above; /* the same upwards, whatever the side of `peak` */
    int32_t peaks;            /* on the side of `peak` */
} channel_statistics;
channel_statistics channel_statistics_of(const double *time, const double *value, int32_t count, double transient);

/* Covariance of a series with itself so many values later. */
typedef double lag_covariance(const void *of, int32_t lag);
/* Integral of a correlation over the lags below `lags`, up to its first zero (Bartlett 1946) [values]; a half where it
   has none.  sparse: of a long series only the first 512 lags are all looked at; those beyond are a 512th of themselves
   apart, as what is correlated over so many values allows. */
double correlation_integral(lag_covariance *covariance, const void *of, int32_t lags, bool sparse);

#endif
