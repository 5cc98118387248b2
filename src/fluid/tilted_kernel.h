/* Fluid on eight floes at once that lie anyhow: the water plane may cut their caps, or miss them.  Inside fluid; knows
   no tables.

   Everything is done in the body's axes.  Each outline has corners of its own where the water plane crosses the rim of
   a cap, so that between two corners the depth of the water over the lower cap, from none to the whole thickness, is
   linear: the wet and the dry part of a side are trapezia.  The wet part of a cap is an outline of its own, of those of
   the corners that are in the water there, and so is the dry part.

   Hydrostatics are exact: pressure on caps by the moments of their wet parts, on sides by two Gauss points along each
   edge, since what depends on the place there is of the third degree (docs/oracles.md, section 5).
   Drag is that of prism_drag.h. */
#ifndef FLUID_TILTED_KERNEL_H
#define FLUID_TILTED_KERNEL_H

#include "base/kernel.h"
#include "fluid/prism_batch.h"

/* The four parts of the caps. */
enum { TILTED_WET_LOWER, TILTED_WET_UPPER, TILTED_DRY_LOWER, TILTED_DRY_UPPER, TILTED_CAPS };

/* Outlines, each closed by its first point and padded with that to the longest. */
typedef struct tilted_ring {
    int32_t sides; /* of the longest; 0: none has any */
    prism_corner *corner;
} tilted_ring;

typedef struct tilted_batch {
    prism_batch floes;
    tilted_ring outline;
    prism_lane *depth; /* of the wet part of a side at each corner, from the lower cap on [m] */
    tilted_ring cap[TILTED_CAPS];
    double *own[2]; /* the kernel's: each has two lanes of numbers for a point of the longest ring */
} tilted_batch;

KERNEL_DECLARE(void, tilted_loads, (tilted_batch * batch));

#endif
