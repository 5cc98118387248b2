/* Pressure and drag on a solid of many triangles, by its tree (geometry/mesh_integrals.h): branches that are wholly wet
   or dry are settled at once, and only triangles that the water plane cuts are clipped.  Inside fluid. */
#ifndef FLUID_HULL_LOAD_H
#define FLUID_HULL_LOAD_H

#include "fluid/fluid.h"

/* Pressure is exact to rounding.  Drag is exact on large triangles, and by sample points elsewhere: on hulls it differs
   from fluid_load_mesh by up to 1e-3 of the drag at the largest speed, mostly because a point of a curved surface has
   one normal.  In parallel over fixed branches, summed in their order.  Writes the whole load. */
void fluid_load_solid(context *ctx, const media *m, const drag_coefficients *c, const solid *body,
                      const fluid_motion *state, fluid_load *load);

#endif
