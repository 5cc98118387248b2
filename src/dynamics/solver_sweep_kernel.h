/* Arithmetic of the fast solver on batches of contacts (solver_batch.h), one copy per instruction set.  Ranges are of
   batches and are worked in ascending order. */
#ifndef DYNAMICS_SOLVER_SWEEP_KERNEL_H
#define DYNAMICS_SOLVER_SWEEP_KERNEL_H

#include "base/kernel.h"
#include "dynamics/solver_batch.h"

/* energy: minus the sum of changes of impulses times the velocities that asked for them, never negative, zero when
   nothing is left to do.  wanted: the work of impulses at the velocities that are wanted: those of normals, less what
   bodies bring that nothing can move. */
typedef struct sweep_sums {
    double energy, wanted;
} sweep_sums;

/* Search directions that an acceleration combines: that of the last sweeps and three earlier ones. */
enum { SEARCH_DIRECTIONS = 4 };

/* Of direction 0 with each, of the velocity with each, and of the velocity with itself. */
typedef struct direction_products {
    double direction[SEARCH_DIRECTIONS], velocity[SEARCH_DIRECTIONS], square;
} direction_products;

/* Masses and slips of the points from arms and the velocities before the step. */
KERNEL_DECLARE(void, solver_prepare, (const batch_view *view, int32_t first, int32_t end));
/* Impulses in the global frame, as they stand in `impulse`, become those along normal and tangents, within this step's
   bounds. */
KERNEL_DECLARE(void, solver_recall, (const batch_view *view, int32_t first, int32_t end));
/* work[8 batch + lane] = sum over the lane's points of impulse . (velocity - wanted one). */
KERNEL_DECLARE(void, solver_work, (const batch_view *view, int32_t first, int32_t end, double *work));
/* Applies share[8 batch + lane] of the impulses to the bodies; share NULL: all. */
KERNEL_DECLARE(void, solver_push, (const batch_view *view, int32_t first, int32_t end, const double *share));
/* The sum `wanted` of the impulses as they stand. */
KERNEL_DECLARE(double, solver_wanted, (const batch_view *view, int32_t first, int32_t end));
/* One sweep of projected Gauss-Seidel.  weigh: `wanted` is summed up, as by solver_wanted to the bit; otherwise it is
   0. */
KERNEL_DECLARE(sweep_sums, solver_sweep, (const batch_view *view, int32_t first, int32_t end, bool weigh));
/* Largest complementarity residual of the normal rows [m/s]. */
KERNEL_DECLARE(double, solver_residual, (const batch_view *view, int32_t first, int32_t end));
/* A sweep of the position correction: normal rows only, `bias` and `impulse` of one row of lanes per point, no cap. */
KERNEL_DECLARE(sweep_sums, solver_correct,
               (const batch_view *view, int32_t first, int32_t end, const double *bias, double *impulse));

/* ---- for solver_accelerate.c ---- */

/* The first `directions` of the SEARCH_DIRECTIONS are looked at, the others give zeros.  Direction 0 is that from
   `start` to what the sweeps have made of it, the others are given; all are laid out like the vector they belong to. */
/* sum[k] = velocity . direction k of the impulses, over the tangents of sliding contacts and the normals at their cap.
 */
KERNEL_DECLARE(void, solver_slide,
               (const batch_view *view, int32_t first, int32_t end, const double *start, double *const *direction,
                int32_t directions, double sum[SEARCH_DIRECTIONS]));
/* Products of bodies [first, end), eight at a time, weighted by their mass and inertia.  Directions as above, rows of
   velocities. */
KERNEL_DECLARE(direction_products, solver_products,
               (const double *velocity, const double *start, double *const *direction, int32_t directions,
                const double *mass, const double *inertia, int32_t first, int32_t end));
/* x, start and directions are vectors alike.  x goes on by share[k] of direction k; `kept` becomes the old x, start the
   new one; the direction from the old start to the new one takes the place of the last of SEARCH_DIRECTIONS. */
KERNEL_DECLARE(void, solver_combine,
               (double *x, double *start, double *kept, double *const *direction, int32_t directions,
                const double share[SEARCH_DIRECTIONS], int64_t first, int64_t end));

#endif
