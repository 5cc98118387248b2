/* Control allocation: from a force and moment demanded to the thrusts of single thrusters.  Pure functions; knows
   thrusters as directions with limits only. */
#ifndef VESSEL_ALLOCATION_H
#define VESSEL_ALLOCATION_H

#include "vessel/plane_motion.h"

#include <stdbool.h>
#include <stdint.h>

enum { ALLOCATION_MOST = 64 };
/* Where the demand is out of reach, a newton missed costs as much as a thrust of this many newtons, squared. */
#define ALLOCATION_MISS_COST 1e8
/* A demand is reached when no more than this part of it is missed. */
#define ALLOCATION_REACHED 1e-6
/* Up to this part of it may be missed because a newton missed has a price, and not an infinite one. */
#define ALLOCATION_NEAR 1e-3

/* One thrust of fixed direction. */
typedef struct allocation_column {
    vec3 effect;   /* surge, sway [1] and yaw moment [m] of a unit thrust */
    double weight; /* cost of a unit thrust squared; positive */
    double lo, hi; /* limits [N]; lo <= hi */
} allocation_column;

/* Thrusts u that minimise sum weight u^2 subject to B u = tau and to the limits (Fossen 2011, section 12.3).  Where tau
   is out of reach, the u within the limits that comes nearest to it, moments divided by `lever` [m] (bounded least
   squares with an active set, after Stark and Parker 1995); *reached is then false.  residual: tau - B u, of rounding
   where reached. */
vec3 allocation_solve(const allocation_column *columns, int32_t count, double lever, vec3 tau, double *u,
                      bool *reached);

/* The y whose thrusts W^-1 B' y serve `want` best, (reach + softness) y = want; reach: B W^-1 B' of what is free. */
vec3 allocation_multiplier(sym3 reach, double softness, vec3 want);

#endif
