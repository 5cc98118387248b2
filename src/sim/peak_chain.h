/* The chain of contacts behind a floe that carries a peak, as the peak's detail tells it.  Reads the world only. */
#ifndef SIM_PEAK_CHAIN_H
#define SIM_PEAK_CHAIN_H

#include "io/peak_block.h"
#include "sim/floe_trims.h"
#include "sim/force_chain.h"

/* Adds that behind a floe of `d` to its links, once the web is made (sim/force_chain.h); none behind what broke in this
   step or does not touch the vessel now.  chain: room to work in. */
void peak_chain_add(const world *w, double time_step, const floe_trim_array *trims, force_chain *chain, peak_floe *f,
                    peak_detail *d);

#endif
