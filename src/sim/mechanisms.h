/* Which mechanism each contact of a vessel loads it by: the ordered decision of docs/theory.md, Mechanisms of an ice
   load.  Reads the world; what it writes is scratch, and no state depends on it. */
#ifndef SIM_MECHANISMS_H
#define SIM_MECHANISMS_H

#include "model/world.h"

/* A contact at its limit; the solver clamps, so equality is exact. */
bool contact_is_capped(const contact *c);

/* After the solve, before floes break, from scratch.load_contacts: fills scratch.shares, and the zones of
   scratch.ice_loads, which must be zero. */
fram_status mechanisms_find(context *ctx, const model *m, world *w, fram_error *error);
/* After floes broke: the loads on those that split are of splitting; sums the shares into scratch.ice_loads. */
void mechanisms_sum(world *w);

#endif
