/* A world goes on with a fraction of its time step: what is counted in steps is so in the new ones.  Knows no runs and
   no folders. */
#ifndef SIM_RERUN_STEP_H
#define SIM_RERUN_STEP_H

#include "model/world.h"

/* w: a copy of from, whose steps become `parts` each; m: the model of such steps.  The load window is as long as it was
   and has the loads that it had, each `parts` times; impulses of the last step, and means of those of a step, are as
   much smaller as the steps are; controllers act and measure at the instants at which they would have, with the same
   noise. */
fram_status rerun_divide_step(context *ctx, const world *from, int32_t parts, model *m, world *w, fram_error *error);

#endif
