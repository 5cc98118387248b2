/* Which prisms have so little drag for their mass that it needs no implicit treatment (response.h), eight at a time: a
   bound that is quick to find spares nearly all floes the closer one.  Inside fluid. */
#ifndef FLUID_WEAK_DRAG_KERNEL_H
#define FLUID_WEAK_DRAG_KERNEL_H

#include "base/kernel.h"
#include "bodies/body.h"
#include "bodies/shape.h"

typedef struct drag_limits {
    vec3 current;                                      /* of the water, global axes [m/s] */
    double form[MATERIAL_COUNT], skin[MATERIAL_COUNT]; /* rho Cd, rho Cf [kg/m3] */
    double rate;                                       /* drag's derivative over mass, at most [1/s] */
} drag_limits;

/* Bit i is set when the body of slot 8 group + i is a dynamic prism whose drag, if it is wet, grows with its velocity
   by less than `rate` of its mass and inertia in every direction.  Not set where one of them is not finite. */
KERNEL_DECLARE(unsigned, weak_drag,
               (const drag_limits *limits, const body_table *bodies, const shape_table *shapes, int32_t group));

#endif
