/* What a hull's triangles are of a ship, inside io: its outer skin, or half of it.  Knows the surface alone, not how it
   came about nor what is said about it. */
#ifndef IO_HULL_SKIN_H
#define IO_HULL_SKIN_H

#include "geometry/mesh.h"

/* Closed parts of a surface that lie inside another part. */
typedef struct hull_inside {
    int32_t parts;
    double volume; /* by which the hull encloses more without them [m3] */
} hull_inside;

/* Leave out the closed parts that lie inside of others: cavities, and what stands in them.  No water comes there: they
   are tanks, or the inner face of a plating.  The surface must be sound; faces and vertices that stay keep their order.
   false: no memory. */
bool hull_keep_outer_skin(context *ctx, mesh *m, hull_inside *inside);

/* Planes of symmetry in which a surface ends, bits: half a hull, or with both a quarter of one. */
typedef enum hull_half { HULL_WHOLE = 0, HULL_HALF_X = 1, HULL_HALF_Y = 2, HULL_QUARTER = 3 } hull_half;
/* "half a hull, open along its centre plane y = 0" */
const char *hull_half_words(hull_half half);

/* Those of a surface that is half of a ship's, or a quarter: all of it lies on one side of each, it is open there, and
   at most there and at its top.  HULL_WHOLE: it is none.  Heights and breadths are equal to `tolerance` [m].  false: no
   memory. */
bool hull_find_half(context *ctx, const mesh *m, double tolerance, hull_half *half);

/* Part of what the section at the waterline goes round that is a hole in it, as a moonpool: nearly all of it where the
   surface is an open boat, plating without a deck, which is full of water.  At z = 0, or half the height where that
   does not cut the surface, which must be sound.  false: no memory. */
bool hull_find_well(context *ctx, const mesh *m, double *part);

#endif
