/* Floes that lie anyhow in the water, eight at a time (tilted_kernel.h).  Inside fluid. */
#ifndef FLUID_TILTED_H
#define FLUID_TILTED_H

#include "fluid/prism_pack.h"
#include "fluid/prism_room.h"

/* Loads of the floes among count slots of a block that begins at `first`; of like numbers of vertices together they
   fill batches best.  The load of a floe depends on that floe alone.  Slots of what is no prism, or one of too many
   corners or crossings (prism_room.h), go to rest; returns how many they are. */
int32_t tilted_block(context *ctx, const prism_work *w, int32_t first, const int32_t *slots, int32_t count,
                     const prism_room *room, const prism_output *out, int32_t rest[PRISM_BLOCK]);

#endif
