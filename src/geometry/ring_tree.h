/* Boxes over runs of neighbouring items of a ring, its edges or corners, and over runs of runs: what lies near a place
   is found without a look at all of the ring.  Neighbours on a ring lie near one another, so nothing has to be sorted.
   Knows numbers and boxes only.  Inside geometry. */
#ifndef GEOMETRY_RING_TREE_H
#define GEOMETRY_RING_TREE_H

#include "geometry/polygon.h"

/* Items to a run: item i is in run i / RING_RUN. */
enum { RING_RUN = 8 };

/* A heap: node i has the nodes 2 i and 2 i + 1; the runs, in order, are the nodes from `leaves` on. */
typedef struct ring_tree {
    box2 *box;
    int32_t leaves; /* a power of two */
} ring_tree;

/* A tree over `items` items, none of which has a box yet.  false: no memory; nothing is to be freed then. */
bool ring_tree_init(context *ctx, ring_tree *t, int32_t items);
void ring_tree_free(context *ctx, ring_tree *t);

/* The box of an item, before ring_tree_close. */
void ring_tree_add(ring_tree *t, int32_t item, box2 box);
/* All items have their boxes: those over runs of runs are made. */
void ring_tree_close(ring_tree *t);
/* Nothing is looked for in this run any more. */
void ring_tree_leave_out(ring_tree *t, int32_t run);

/* The first run from `run` on whose box meets or touches `box`; -1: none does. */
int32_t ring_tree_find(const ring_tree *t, box2 box, int32_t run);

#endif
