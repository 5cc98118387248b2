/* Pairs of boxes that overlap, by a sweep along their longer side.  Knows boxes only. */
#ifndef GEOMETRY_BOX_PAIRS_H
#define GEOMETRY_BOX_PAIRS_H

#include "base/context.h"
#include "geometry/polygon.h"

/* Told of a pair, a before b along the sweep; another status than FRAM_OK ends the search. */
typedef fram_status (*box_pair_function)(void *user, int32_t a, int32_t b, fram_error *error);

/* Every pair of boxes whose insides overlap, once, in an order that the boxes alone decide: by their left edges, or
   lower ones where all of them reach farther along y than along x, then by number.  Boxes without area are in no pair.
   what: for work_continue.  FRAM_ERROR_MEMORY, FRAM_INTERRUPTED, and what the function returns. */
fram_status box_pairs(context *ctx, const box2 *box, int32_t count, const char *what, box_pair_function function,
                      void *user, fram_error *error);

#endif
