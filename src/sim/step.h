/* One time step (SPEC 4): the stages in their order, each a function from world arrays to world arrays. */
#ifndef SIM_STEP_H
#define SIM_STEP_H

#include "model/scenario.h"
#include "model/world.h"

/* What a step needs to know; made once from the scenario (build.h), never changed during a run. */
typedef struct step_settings {
    double time_step; /* [s] */
    bool fluid;       /* false: neither fluid nor gravity acts */
    media media;
    drag_coefficients drag[MATERIAL_COUNT];
    collision_settings collision;
    pair_policies policies;
    crushing_settings crushing;
    solver_settings solver;
    domain_boundary boundary;
    box2 domain;        /* [m] */
    double speed_limit; /* a faster body means that the run went wrong [m/s] */
} step_settings;

/* Advance the world by one time step.  FRAM_ERROR_SIMULATION names the first body whose state is not finite or that is
   faster than the speed limit; the world then stands as it went wrong. */
fram_status world_step(context *ctx, const step_settings *settings, world *w, fram_error *error);

/* Add a wrench to a body for the next step only (an outside controller). */
fram_status world_add_wrench(context *ctx, world *w, int32_t slot, wrench load, fram_error *error);

#endif
