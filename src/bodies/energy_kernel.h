/* Kinetic energy of groups of eight body slots.  Inside bodies. */
#ifndef BODIES_ENERGY_KERNEL_H
#define BODIES_ENERGY_KERNEL_H

#include "base/kernel.h"
#include "bodies/body.h"

/* Of all dynamic bodies, added up in the order of their slots [J]. */
KERNEL_DECLARE(double, energy_sum, (const body_table *bodies));

#endif
