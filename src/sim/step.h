/* One time step: the stages in their order, each a function from the model and world arrays to world arrays. */
#ifndef SIM_STEP_H
#define SIM_STEP_H

#include "model/world.h"

/* Advance the world by one time step.  FRAM_ERROR_SIMULATION names the first body whose state is not finite or that is
   faster than the speed limit; the world then stands as it went wrong. */
fram_status world_step(context *ctx, const model *m, world *w, fram_error *error);

/* The stages of a step in their order.  Those with a number are the mechanics, as documents count them.  Of those
   without, that of loads keeps account of what the ice did, and that of the edge settles who is there in the next step,
   and who sleeps. */
typedef enum step_stage {
    STAGE_FORCES,      /* 1: forces from outside, at the old state */
    STAGE_DETECTION,   /* 2: broad phase, narrow phase */
    STAGE_CRUSHING,    /* 3: patches, and the most that contacts carry */
    STAGE_SOLVE,       /* 4: the new velocities */
    STAGE_LOADS,       /* what the ice did to the vessels, from the solved contacts, before floes break */
    STAGE_FRACTURE,    /* 5: floes that break under the solved contacts */
    STAGE_INTEGRATION, /* 6: the new places, then their correction; whether all is still sound is looked at here */
    STAGE_EDGE,        /* what leaves the domain and what is fed, shapes that nobody has, what falls asleep */
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
