/* Floes that lost crushed ice in a step and nothing else: each is a floe with a new number, and the same ice
   (ice/fracture_trim.c).  Reads the world only. */
#ifndef SIM_FLOE_TRIMS_H
#define SIM_FLOE_TRIMS_H

#include "model/world.h"

typedef struct floe_trim {
    int64_t step;     /* that was done then */
    int32_t from, to; /* running numbers */
    int32_t had;      /* slot in the contacts of that step, -1: no vessel touched it */
    int32_t slot;     /* since then */
} floe_trim;
typedef ARRAY(floe_trim) floe_trim_array;

/* Adds those of the step that was just done.  false: no memory. */
bool floe_trims_note(context *ctx, const world *w, floe_trim_array *trims);
/* The trim of a step that made a floe; NULL: none. */
const floe_trim *floe_trims_find(const floe_trim_array *trims, int64_t step, int32_t to);
/* The one of the floe that stood in a slot; NULL: none. */
const floe_trim *floe_trims_find_slot(const floe_trim_array *trims, int64_t step, int32_t had);

#endif
