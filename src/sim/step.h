/* One time step: the stages in their order, each a function from the model and world arrays to world arrays. */
#ifndef SIM_STEP_H
#define SIM_STEP_H

#include "model/world.h"

/* Advance the world by one time step.  FRAM_ERROR_SIMULATION names the first body whose state is not finite or that is
   faster than the speed limit; the world then stands as it went wrong. */
fram_status world_step(context *ctx, const model *m, world *w, fram_error *error);

/* The stages of a step in their order. */
typedef enum step_stage {
    STAGE_FORCES,
    STAGE_DETECTION,
    STAGE_CRUSHING,
    STAGE_SOLVE,
    STAGE_LOADS,
    STAGE_FRACTURE,
    STAGE_INTEGRATION,
    STAGE_STRAYS,
    STAGE_COUNT
} step_stage;

/* Who wants to know when a stage is done: for clocks, which have no place in the step itself. */
typedef struct step_watch {
    void (*done)(void *user, step_stage stage);
    void *user;
} step_watch;

/* world_step, watched. */
fram_status world_step_watched(context *ctx, const model *m, world *w, const step_watch *watch, fram_error *error);

/* Add a wrench to a body for the next step only (an outside controller). */
fram_status world_add_wrench(context *ctx, world *w, int32_t slot, wrench load, fram_error *error);

#endif
