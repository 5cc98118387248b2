/* Statistics of a channel over time: what reports, station results and capability plots tell of a load.  Knows numbers
   only. */
#ifndef BASE_CHANNEL_STATISTICS_H
#define BASE_CHANNEL_STATISTICS_H

#include <stdint.h>

/* Deviations of a normal distribution that hold 95 % of it between them and their opposite. */
#define NORMAL_95 1.959963984540054

/* Statistics of one channel after the transient. */
typedef struct channel_statistics {
    double mean, deviation, least, greatest;
    double significant; /* mean of the highest third of the peaks between crossings of the mean upwards; 0: no peak */
    int32_t peaks;
} channel_statistics;
channel_statistics channel_statistics_of(const double *time, const double *value, int32_t count, double transient);

#endif
