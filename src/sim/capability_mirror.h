/* Whether ice that comes from port loads a vessel as that from starboard does, seen from the middle.  Must not know how
   loads are measured. */
#ifndef SIM_CAPABILITY_MIRROR_H
#define SIM_CAPABILITY_MIRROR_H

#include "model/scenario.h"

/* Of a single vessel in a field that drifts through its domain: which of "vessel", "domain" and "ice" is not known to
   be its own mirror image in the vessel's centre plane; NULL: all are.  Floes that are drawn count as such: chance
   draws either side alike. */
const char *capability_one_sided(const scenario *s);

#endif
