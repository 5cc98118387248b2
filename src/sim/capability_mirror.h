/* Whether ice that comes from port loads a vessel as that from starboard does, seen from the middle.  Must not know how
   loads are measured. */
#ifndef SIM_CAPABILITY_MIRROR_H
#define SIM_CAPABILITY_MIRROR_H

#include "model/scenario.h"

/* Of a single vessel in a field that drifts through its domain: whether hull, ice and domain are their own mirror image
   in the vessel's centre plane.  Floes that are drawn count as such: chance draws either side alike. */
bool capability_is_mirrored(const scenario *s);

#endif
