/* How long a run still takes, from its pace of late: the first steps, which fetch memory and find contacts, tell
   nothing of those to come. */
#ifndef SIM_PACE_H
#define SIM_PACE_H

#include <stdbool.h>

typedef struct pace {
    bool begun;
    double wall[2], time[2]; /* two moments of before, the older first: since the start [s], simulated [s] */
} pace;

/* A pace begins all zero, and counts from the first call on, which follows the first step.  Expected wall time from the
   simulated `time` to `end` [s], asked at `wall_time` seconds after the start; NaN as long as it is not known, which is
   in the second after. */
double pace_left(pace *p, double wall_time, double time, double end);

#endif
