/* Rows of the fast solver's bodies, eight at a time.  Inside dynamics. */
#ifndef DYNAMICS_SOLVER_BODIES_KERNEL_H
#define DYNAMICS_SOLVER_BODIES_KERNEL_H

#include "base/kernel.h"
#include "dynamics/solver_batch.h"

/* Where the rows of eight bodies begin. */
typedef struct body_rows {
    double *inverse, *tensor, *mass, *inertia;
} body_rows;

/* Rows of the bodies in `slot` (-1: none), zero for what nothing can move.  factor: of their inverse masses; other than
   1 for copies of a hub, whose `mass` and `inertia` are zero since the hub's own count. */
KERNEL_DECLARE(void, solver_masses,
               (const body_table *bodies, const int32_t slot[BATCH_LANES], double factor, const body_rows *rows));

#endif
