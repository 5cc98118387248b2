/* Level and sunken floes of a block of body slots, eight at a time (level_kernel.h).  Inside fluid. */
#ifndef FLUID_LEVEL_H
#define FLUID_LEVEL_H

#include "fluid/prism_pack.h"
#include "fluid/prism_room.h"

/* Loads of the floes that float level or lie wholly in the water among the slots first..end-1, at most PRISM_BLOCK of
   them, first being a multiple of HELD_LANES.  The load of a floe depends on that floe alone, and on what of its drag
   is held, in rows for all slots; nothing may be held where the split is wanted.  The other dynamic bodies' slots go to
   rest, those of floes of like numbers of vertices together; returns how many they are. */
int32_t level_block(context *ctx, const prism_work *w, int32_t first, int32_t end, const prism_room *room,
                    const prism_output *out, int32_t rest[PRISM_BLOCK]);

#endif
