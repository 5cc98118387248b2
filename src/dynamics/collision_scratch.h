/* Memory of both phases of collision detection, kept between steps for its size only.  Inside dynamics. */
#ifndef DYNAMICS_COLLISION_SCRATCH_H
#define DYNAMICS_COLLISION_SCRATCH_H

#include "dynamics/collision.h"

/* A body in the grid of its level, filed by the middle of its fat box. */
typedef struct grid_entry {
    int64_t column, row;
    int32_t slot, level;
} grid_entry;

/* What the broad phase found of a slot in this update. */
enum { BOX_KEPT = 0, BOX_MOVED, BOX_NEW };

struct collision_scratch {
    ARRAY(uint8_t) change;     /* of each slot, BOX_... */
    ARRAY(grid_entry) entries; /* in the order of their buckets */
    int32_array bucket;        /* of each slot */
    int32_array bucket_start;
    ARRAY(uint64_t) fresh; /* new pairs, a << 32 | b */
    pair_table merged;
    polyhedron piece_a, piece_b; /* convex pieces in the global axes, about body a's centre of mass */
    int32_array near_a, near_b;  /* pieces that reach into the common part of two boxes */
};

/* Box of a body's shape in the global frame. */
box3 body_box(const body_table *bodies, const shape_store *shapes, int32_t slot);

#endif
