/* Memory of both phases of collision detection.  Wide boxes, their grid and pairs, and which chunks stand, are kept
   from step to step and belong to one state (collision_scratch_forget); all else is kept for its size only.  Inside
   dynamics. */
#ifndef DYNAMICS_COLLISION_SCRATCH_H
#define DYNAMICS_COLLISION_SCRATCH_H

#include "dynamics/box_grid.h"
#include "dynamics/collision.h"

/* Slots that are passed over together where all of them stand still (broad_boxes.c): few enough that some chunks stand
   beside what moves; blocks of work are whole chunks. */
enum { BOX_CHUNK = 64 };

/* What the broad phase found of a slot in this update. */
enum { BOX_KEPT = 0, BOX_MOVED, BOX_NEW };

/* A box around a fat box and what it was made for. */
typedef struct wide_box {
    box3 box;
    uint32_t generation; /* 0: none */
    uint8_t fixed;
    bool renewed; /* in this update */
} wide_box;

/* Pairs, the lower slot << 32 | the higher one. */
typedef ARRAY(uint64_t) pair_key_array;
/* What a thread found. */
typedef struct found_pairs {
    pair_key_array keys;
    bool memory_failed;
} found_pairs;

/* What a block of bodies or pairs found; every block writes its own. */
typedef struct box_block {
    bool changed; /* some body left its box, appeared or disappeared */
    int32_t lost; /* slot of the first body whose position is no place, -1 */
} box_block;
typedef struct pair_block {
    contact_array contacts;
    index_array patch_pairs;
    int32_t first_contact, first_patch; /* where they go */
    bool memory_failed;
} pair_block;

typedef ARRAY(box3) box3_array;

/* Of each thread. */
typedef struct narrow_room {
    polyhedron piece_a, piece_b; /* convex pieces in the global axes, about body a's centre of mass */
    box3_array box_a, box_b;     /* of the pieces of two bodies */
    int32_array near_a, near_b;  /* pieces that reach into the common part of two boxes */
} narrow_room;

struct collision_scratch {
    ARRAY(uint8_t) change;         /* of each slot, BOX_... */
    ARRAY(uint8_t) standing;       /* of each chunk of slots: its fat boxes are those of the last update */
    ARRAY(wide_box) wide;          /* of each slot */
    int32_array renewed;           /* slots whose wide boxes are others since the last change of any, or gone */
    int32_t renewed_of[BOX_GRIDS]; /* those in each grid, without the gone */
    box_grid grid;                 /* of wide boxes */
    ARRAY(found_pairs) found;      /* of each thread, in any order */
    pair_key_array fresh;          /* ascending */
    int32_array kept;              /* places of candidates that stay */
    pair_key_array spare_keys;     /* candidates while they are made, fresh ones while they are sorted */
    pair_key_array candidates;     /* pairs whose wide boxes met when the later one was made, ascending */
    index_array chosen;            /* of each candidate, see broad_phase.c */
    index_array chosen_end;        /* pairs up to the end of each block of candidates */
    pair_table merged;
    ARRAY(box_block) box_blocks;
    ARRAY(pair_block) pair_blocks; /* beyond count: empty, but with their memory */
    int32_t pair_blocks_made;
    ARRAY(narrow_room) rooms; /* of each thread */
};

/* ---- broad_boxes.c ---- */

/* Brings travels up to date and renews fat boxes: of bodies that left theirs, and then of all that have used up half of
   the room in theirs, so that the next one to leave is a while off.  *any: something changed; change[slot] says what.
   FRAM_ERROR_SIMULATION names a body whose position is no place. */
fram_status broad_boxes_update(context *ctx, const body_table *bodies, const shape_store *shapes,
                               const collision_settings *settings, broad_table *boxes, collision_scratch *s, bool *any,
                               fram_error *error);

/* ---- broad_candidates.c ---- */

/* Brings wide boxes and the pairs of them up to date with fat boxes, after broad_boxes_update said that some changed:
   every two bodies whose fat boxes meet, not both fixed, are a candidate.  false: no memory. */
bool broad_candidates_update(context *ctx, const collision_settings *settings, const broad_table *boxes,
                             collision_scratch *s);

static inline box3 fat_box(const broad_table *boxes, int32_t slot) { return (box3){boxes->lo[slot], boxes->hi[slot]}; }

#endif
