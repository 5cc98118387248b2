/* Kinetic energy of all bodies, which every row of a series tells. */
#ifndef BODIES_ENERGY_H
#define BODIES_ENERGY_H

#include "bodies/body.h"

/* That of the books (body_books_add) of all bodies in the order of their slots, to the same bits, sooner [J]. */
double body_kinetic_energy(const context *ctx, const body_table *b);

#endif
