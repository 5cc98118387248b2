/* The scenario as it will be computed, in sentences: what moves whither, what keeps each vessel, what the ice is made
   of; files of histories are read and told.  One module with notes, which tells it. */
#ifndef SIM_EFFECTIVE_H
#define SIM_EFFECTIVE_H

#include "sim/sanity.h"

/* A file that cannot be read is told as that: a report may be made where the inputs of its run are gone.  made: the
   world that was made of it, before its first step; NULL: none, and where a vessel begins that is moored is not told.
 */
void effective_tell(context *ctx, const scenario *s, const world *made, sanity_teller tell, const void *to);

#endif
