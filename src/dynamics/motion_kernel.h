/* Free motion of groups of eight body slots: loads into velocities, velocities into poses.  Inside dynamics. */
#ifndef DYNAMICS_MOTION_KERNEL_H
#define DYNAMICS_MOTION_KERNEL_H

#include "base/kernel.h"
#include "bodies/body.h"

/* Of the dynamic bodies among slots 8 first .. 8 end - 1; tables end with a whole group, `loads` has bodies->count
   rows. */
KERNEL_DECLARE(void, motion_accelerate,
               (body_table * bodies, const wrench *loads, double dt, int32_t first, int32_t end));
KERNEL_DECLARE(void, motion_advance, (body_table * bodies, double dt, int32_t first, int32_t end));

#endif
