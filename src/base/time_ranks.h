/* Ranks of many durations in memory that does not grow: counts in bins, 64 to each doubling, so that a rank is told to
   1.6 % of itself. Knows no clock. */
#ifndef BASE_TIME_RANKS_H
#define BASE_TIME_RANKS_H

#include <stdint.h>

/* From 2^-24 s, 60 ns, to 2^12 s; what is shorter or longer counts in the first or last bin. */
enum { TIME_OCTAVE_LEAST = -24, TIME_OCTAVE_MOST = 12, TIME_OCTAVE_BINS = 64 };

/* Begins all zero. */
typedef struct time_ranks {
    int64_t count;
    double longest; /* [s] */
    int64_t bin[(TIME_OCTAVE_MOST - TIME_OCTAVE_LEAST) * TIME_OCTAVE_BINS];
} time_ranks;

/* One more duration [s]. */
void time_ranks_add(time_ranks *t, double seconds);

/* The nearest rank for a share in thousandths (500: the median): the least duration that so many are not longer than,
   or at most 1.6 % more, and never more than the longest; 0 without any [s]. */
double time_ranks_at(const time_ranks *t, int thousandths);

#endif
