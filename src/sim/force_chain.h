/* What stands behind a contact of a vessel: the floe that it pushes, what that leans on, and so on, to where the chain
   ends.  Read from the solved impulses and the external loads of the step (docs/theory.md, Mechanisms of an ice load).
 */
#ifndef SIM_FORCE_CHAIN_H
#define SIM_FORCE_CHAIN_H

#include "model/world.h"

enum { CHAIN_MOST_LINKS = 256 };

/* A body of the chain: what pushes it, and what holds it against that.  Along the push; the three parts add up to it
   for a body that moves, and are zero for one that does not. */
typedef struct chain_link {
    int32_t body;  /* slot */
    vec3 push;     /* on it, from the body before, mean over the step, global frame [N] */
    vec3 point;    /* where that acts, weighted by the sizes of the impulses; of the body without a push [m] */
    double others; /* held back by its other contacts [N] */
    double water;  /* by water, air and weight [N] */
    double inertia;
} chain_link;

typedef struct force_chain {
    int32_t count;
    chain_end end; /* of the last link */
    chain_link link[CHAIN_MOST_LINKS];
} force_chain;

/* Makes the list of each body's contacts of this step, scratch.web_first and web_next.  false: no memory. */
bool contact_web_make(context *ctx, world *w);
/* The chain behind `body`, which `from` pushes, once the web is made.  A link goes on to the body that holds it most
   while its contacts hold more of the push than water and inertia each do; back at the vessel itself it ends. */
void force_chain_follow(const world *w, double time_step, int32_t from, int32_t body, force_chain *chain);
/* The same bodies and the same end, of links only the first push: for what is asked in every step. */
void force_chain_end(const world *w, double time_step, int32_t from, int32_t body, force_chain *chain);

#endif
