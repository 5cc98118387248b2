/* Level and sunken floes of a block of body slots, eight at a time (level_kernel.h).  Inside fluid. */
#ifndef FLUID_LEVEL_H
#define FLUID_LEVEL_H

#include "fluid/fluid.h"
#include "fluid/held_drag.h"

/* Body slots that are worked on together. */
enum { LEVEL_BLOCK = 256 };

/* Where the loads of a block go, at [slot - first]. */
typedef struct level_output {
    wrench *total;    /* of water and air, without gravity */
    double *volume;   /* submerged [m3] */
    fluid_load *load; /* may be NULL */
    bool level_only;  /* sunken floes go to rest */
} level_output;

/* Loads of the floes that float level or lie wholly in the water among the slots first..end-1, at most LEVEL_BLOCK of
   them, first being a multiple of HELD_LANES.  The load of a floe depends on that floe alone, and on what of its drag
   is held: held, with rows for all slots, may be NULL, and must be where the split is wanted.  The other dynamic
   bodies' slots go to rest; returns how many they are. */
int32_t level_block(context *ctx, const media *m, const drag_coefficients coefficients[MATERIAL_COUNT],
                    const body_table *bodies, const shape_store *shapes, held_drag_table *held, int32_t first,
                    int32_t end, const level_output *out, int32_t rest[LEVEL_BLOCK]);

#endif
