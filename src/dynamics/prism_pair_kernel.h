/* Separating axes of two convex prisms, all sides of one at a time.  Inside dynamics. */
#ifndef DYNAMICS_PRISM_PAIR_KERNEL_H
#define DYNAMICS_PRISM_PAIR_KERNEL_H

#include "base/kernel.h"
#include "dynamics/prism_contact.h"

/* Both prisms are single pieces without seams, of at most PIECE_MOST_VERTICES vertices.  axis: remembered separating
   axis or zero.  The results are those of prism_contact.c's plain loops, but that the widest gap is the one returned.
 */
KERNEL_DECLARE(void, prism_pair_test,
               (const prism *a, const prism *b, double slack, const vec3 *axis, prism_meeting *out));

#endif
