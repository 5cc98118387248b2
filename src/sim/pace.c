#include "sim/pace.h"

#include <math.h>

/* The pace is that of the last one to two spans. */
#define SPAN 15.0
#define FIRST 1.0

double pace_left(pace *p, double wall_time, double time, double end)
{
    if (!p->begun)
        *p = (pace){true, {wall_time, wall_time}, {time, time}};
    if (wall_time - p->wall[1] >= SPAN) {
        p->wall[0] = p->wall[1], p->time[0] = p->time[1];
        p->wall[1] = wall_time, p->time[1] = time;
    }
    if (time >= end)
        return 0;
    double gone = wall_time - p->wall[0], way = time - p->time[0];
    return gone >= FIRST && way > 0 ? (end - time) * gone / way : (double)NAN;
}
