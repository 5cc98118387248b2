#include "study/extent.h"

#include <math.h>

/* Pairs to a floe times points to a pair. */
#define POINTS_OF_FLOE 6.0

double packed_step_time(const step_look *early, const step_look *late)
{
    double more = late->contacts - early->contacts, left = POINTS_OF_FLOE * late->floes - late->contacts;
    double most = fmax(early->time, late->time);
    if (!(more > 0) || !(left > 0))
        return most;
    return fmax(most, late->time + fmax(late->time - early->time, 0) / more * left);
}

double breaking_step_time(const step_look *early, const step_look *late, double steps, double stay)
{
    double between = late->at - early->at, more = late->time - early->time, left = steps - late->at;
    if (!(late->floes > early->floes && between > 0 && more > 0 && left > 0))
        return late->time;
    /* Above the later look by a straight line until pieces leave as fast as they are made, and by its end from there.
     */
    double grows = fmin(left, stay), extra = more / between * (0.5 * grows * grows + grows * (left - grows));
    return late->time + extra / steps;
}
