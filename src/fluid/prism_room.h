/* Memory for the outlines of batches: each thread has a room, as long as the longest outline that a batch may take asks
   for. Inside fluid; knows no kernel. */
#ifndef FLUID_PRISM_ROOM_H
#define FLUID_PRISM_ROOM_H

#include "base/context.h"
#include "bodies/shape.h"
#include "fluid/prism_batch.h"

/* Outlines of a batch of tilted floes: their own, and the four parts of their caps. */
enum { PRISM_RINGS = 5 };

/* Room of one thread.  A kernel's own coordinates stand in two rooms of numbers, register by register. */
typedef struct prism_room {
    prism_corner *ring[PRISM_RINGS];
    prism_lane *depth;
    double *own[2];
} prism_room;

typedef struct prism_rooms {
    int32_t points; /* most of an outline, with its crossings and its first one again */
    void *memory;
} prism_rooms;

/* Points of the longest outline that a batch takes: a room has two megabytes then.  Floes of longer ones are walked
   over face by face. */
enum { PRISM_MOST_POINTS = 2048 };

/* Points that the outline of a tilted floe may have, crossings of its rims with the water plane among them.  It depends
   on the floe alone. */
int32_t prism_most_crossed(int32_t points);

/* A room for each thread of the context; false: no memory. */
bool prism_rooms_make(context *ctx, const shape_table *shapes, prism_rooms *out);
void prism_rooms_free(context *ctx, prism_rooms *r);
prism_room prism_room_of(const prism_rooms *r, int32_t thread);

#endif
