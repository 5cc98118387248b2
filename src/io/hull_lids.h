/* Lids of the water plane, inside io: panels that suppress irregular frequencies and are no part of the wetted hull.
   Knows the surface alone, not whether its file may have any. */
#ifndef IO_HULL_LIDS_H
#define IO_HULL_LIDS_H

#include "geometry/mesh.h"

/* Lids in z = 0: whoever reads a GDF leaves them out. */
typedef struct hull_lids {
    bool any;
    double tolerance; /* [m] */
} hull_lids;
hull_lids hull_lids_of(const mesh *m);
bool hull_is_lid(const hull_lids *lids, const mesh *m, int32_t face);

/* The faces of lids that are off z = 0 by no more than HULL_REACH, and how many there are: level patches that close
   the surface there, all at one height, and end where sides go down.  None where there is doubt of any: parts of the
   wetted hull may be level and near the water too.  false: no memory; `lid` is to be freed even then. */
bool hull_find_lids_off(context *ctx, const mesh *m, int32_array *lid, int32_t *count);

#endif
