#include "bodies/energy.h"

#include "bodies/energy_kernel.h"

double body_kinetic_energy(const context *ctx, const body_table *b) { return KERNEL_PICK(ctx, energy_sum)(b); }
