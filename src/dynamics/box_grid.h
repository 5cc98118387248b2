/* Boxes of slots, filed in grids of the plane to be found by place: one grid for each power of two of box size, so that
   a hull of 200 m and walls of a kilometre stand in coarse grids of their own and cost the floes nothing.  A box stays
   filed until it is taken out: a change costs what changes, however many others there are.  Knows no bodies. */
#ifndef DYNAMICS_BOX_GRID_H
#define DYNAMICS_BOX_GRID_H

#include "base/array.h"
#include "geometry/mesh.h"

/* Grids, from the finest. */
enum { BOX_GRIDS = 64 };

/* Where a slot is filed: by the middle of its box. */
typedef struct grid_place {
    int64_t column, row;
    int32_t grid;         /* -1: nowhere */
    int32_t next, before; /* slots in the same bucket, -1 without */
    int32_t member;       /* place in the list of its grid */
} grid_place;

typedef struct box_grid {
    ARRAY(grid_place) place; /* of each slot */
    int32_array bucket;      /* the first slot of each, -1 without; a power of two of them */
    int32_array member[BOX_GRIDS];
    int32_t count; /* slots that are filed */
} box_grid;

void box_grid_free(context *ctx, box_grid *g);
/* All are taken out. */
void box_grid_clear(box_grid *g);
/* Files a slot by a box, anew if it was filed before.  false: no memory, and the slot is filed nowhere. */
bool box_grid_put(context *ctx, box_grid *g, int32_t slot, box3 box);
/* Takes a slot out, if it is there. */
void box_grid_take(box_grid *g, int32_t slot);
/* Number of the grid in which a slot is filed. */
static inline int32_t box_grid_of(const box_grid *g, int32_t slot) { return g->place.data[slot].grid; }

/* Calls meet(user, other) for each slot of one grid whose box may overlap this one in the plane, in no certain order
   and with some whose box does not, until a call returns false; returns whether none did. */
typedef bool (*box_grid_meet)(void *user, int32_t other);
bool box_grid_search(const box_grid *g, int32_t grid, box3 box, box_grid_meet meet, void *user);

#endif
