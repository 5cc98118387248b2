/* Control allocation among thrusters that turn: the thrusts of each lie in a circle, a sector or on a line.  Pure
   functions; knows neither kinds of thrusters nor which of several sets one of them is in. */
#ifndef VESSEL_ALLOCATION_SET_H
#define VESSEL_ALLOCATION_SET_H

#include "vessel/allocation.h"

/* The thrusts one thruster may give: the sector of a circle about the direction `along`, with all that lies between it
   and the end of a stretch the other way.  Convex for half an angle up to a right one, and for the whole circle. */
typedef struct allocation_set {
    vec3 along, across;  /* surge, sway [1] and yaw moment [m] of a unit thrust in the middle of the sector, and 90
                            degrees counter-clockwise of it; a line has no effect across */
    double weight;       /* cost of a unit thrust squared; positive */
    double most, back;   /* largest thrust of the sector, and the other way [N]; 0 or more, not both 0 */
    double cosine, sine; /* of half the sector's angle: 1, 0 of a line and -1, 0 of a circle */
} allocation_set;

/* Thrusts (along, across) that minimise sum weight |f|^2 + MISS weight |tau - B f|^2, each in its set; the second sum
   with moments over `lever` [m] and the largest weight, and so dear that it is of rounding where tau can be reached
   (*reached).  Returns that cost.  residual: tau - B f. */
double allocation_solve_sets(const allocation_set *sets, int32_t count, double lever, vec3 tau, vec2 *thrust,
                             vec3 *residual, bool *reached);

#endif
