/* Contacts of hulls with hulls and walls: which they are, and what a hull's fenders carry where it meets another hull
 * or a wall. */
#ifndef SIM_FENDERS_H
#define SIM_FENDERS_H

#include "model/world.h"

/* Whether one side of a contact is ice; others are between hulls and walls. */
bool contact_is_of_ice(const world *w, const contact *c);
/* Limits the contacts of hulls with hulls and walls, which the narrow phase has found: with stiffness k the normal
   force of a pair is at most k times its greatest overlap, shared among its points by their overlaps.  Fenders of two
   hulls yield in series, 1/k = 1/k1 + 1/k2.  Below the limit the contact is rigid, so that fenders take energy, k d^2 /
   2 at an overlap d, and do not give it back; what has yielded is not pushed apart.  Rigid pairs stay without limit. */
void fenders_limit(const model *m, world *w);

#endif
