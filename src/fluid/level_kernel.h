/* Fluid on eight floes at once: level ones, prisms that stand upright and whose sides alone the water plane cuts, one
   cap wholly wet and the other wholly dry, as nearly all floes of a field are; and sunken ones in any pose, as pieces
   under a hull are.  Inside fluid; knows no tables.

   Everything is done in the body's axes, where the wet part of a side is a trapezium between the wet cap and the
   waterline, or the whole side, and the caps are the outline itself.

   Hydrostatics are exact, from the second moments of the outline (docs/oracles.md, section 5).
   Drag is that of prism_drag.h. */
#ifndef FLUID_LEVEL_KERNEL_H
#define FLUID_LEVEL_KERNEL_H

#include "base/kernel.h"
#include "fluid/prism_batch.h"

/* The floes as their drag was computed, body axes: what held_drag.h keeps. */
typedef struct level_state {
    prism_lane moments[6]; /* of the outline: 1, x, y, xx, yy, xy */
    prism_lane line[3];    /* waterline: height at the axis [m], slopes */
    prism_lane spin[3];
    prism_lane through_water[3], through_air[3]; /* velocity relative to the medium [m/s] */
    prism_wrench water_drag, air_drag;           /* zero where it is not wanted */
} level_state;

typedef struct level_batch {
    int32_t sides; /* edges of the longest outline; shorter ones are padded with their last point */
    bool sunken;   /* all of them are; otherwise all are level */
    prism_batch floes;
    prism_corner *corner; /* outline, closed by its first vertex: sides + 1 */
    double *own;          /* the kernel's: two lanes of numbers for each of these */

    level_state state; /* out; of level floes */
} level_batch;

KERNEL_DECLARE(void, level_loads, (level_batch * batch));

#endif
