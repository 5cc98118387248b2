/* Whether measured ice loads were still building up: halves of runs, and which of them count.  Knows numbers only. */
#ifndef SIM_CAPABILITY_GROWTH_H
#define SIM_CAPABILITY_GROWTH_H

#include "sim/capability.h"

/* Sizes of the means of the first and the second half of a run, whatever their directions: a load that turned round was
   there before [N]. */
typedef struct load_halves {
    double first, second;
} load_halves;
/* Of what is after a time. */
load_halves load_halves_find(const double *time, const double *x, const double *y, int32_t count, double after);
/* The growth members of the loads, of the halves [direction * speeds + k] at the speed (k + 1) speed_step.  A speed
   counts whose loads are a tenth of the largest one's, and a direction whose load is a tenth of the largest one's at
   that speed: a single touch late in a run grows without end. */
void load_growth_find(const load_halves *half, int32_t directions, int32_t speeds, double speed_step,
                      capability_loads *l);

#endif
