/* What may have thrown a body that a step found to be too fast, or nowhere: words for the error. */
#ifndef SIM_ASTRAY_H
#define SIM_ASTRAY_H

#include "model/world.h"

/* What a user can do about it.  Of a world as the step left it, before forces for that step alone are dropped. */
const char *astray_remedy(const world *w, int32_t body);

#endif
