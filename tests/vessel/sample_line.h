/* A chain of a mooring in 105 m of water, for the tests of moorings. */
#ifndef SAMPLE_LINE_H
#define SAMPLE_LINE_H

#include "vessel/mooring.h"

/* Outward along `direction` [rad]. */
static inline line_definition sample_line(double direction)
{
    return (line_definition){.kind = LINE_CATENARY,
                             .centre = {0, 0, -5},
                             .fairlead_distance = 10,
                             .direction = direction,
                             .distance = 600,
                             .depth = 105,
                             .length = (double)NAN,
                             .pretension = 4e5,
                             .weight = 1000,
                             .stiffness = 6e8,
                             .breaking_load = 5e6,
                             .release_time = HUGE_VAL};
}

#endif
