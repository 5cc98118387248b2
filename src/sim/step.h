/* One time step (SPEC 4): the stages in their order, each a function from world arrays to world arrays. */
#ifndef SIM_STEP_H
#define SIM_STEP_H

#include "fluid/columns.h"
#include "model/scenario.h"
#include "model/world.h"

/* Where external forces come from. */
typedef enum force_source {
    FORCES_NONE = 0, /* neither fluid nor gravity acts */
    FORCES_FLUID,    /* SPEC 5 */
    FORCES_COLUMNS   /* the water of the benchmark scenes, with weight */
} force_source;

/* What a step needs to know; made once from the scenario (build.h), never changed during a run. */
typedef struct step_settings {
    double time_step; /* [s] */
    force_source forces;
    media media;
    drag_coefficients drag[MATERIAL_COUNT];
    prism_response floe_response;
    const column_water *columns; /* of FORCES_COLUMNS, else NULL */
    collision_settings collision;
    pair_policies policies;
    crushing_settings crushing;
    fracture_settings fracture;
    bool brash; /* what fracture loses goes to the brash account */
    solver_settings solver;
    domain_boundary boundary;
    box2 domain;        /* [m] */
    bool drift_given;   /* an endless field goes with `drift`, otherwise with the current at the surface */
    vec2 drift;         /* [m/s] */
    double speed_limit; /* a faster body means that the run went wrong [m/s] */
} step_settings;

/* Advance the world by one time step.  FRAM_ERROR_SIMULATION names the first body whose state is not finite or that is
   faster than the speed limit; the world then stands as it went wrong. */
fram_status world_step(context *ctx, const step_settings *settings, world *w, fram_error *error);

/* The stages of a step in their order (SPEC 4). */
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
fram_status world_step_watched(context *ctx, const step_settings *settings, world *w, const step_watch *watch,
                               fram_error *error);

/* Add a wrench to a body for the next step only (an outside controller). */
fram_status world_add_wrench(context *ctx, world *w, int32_t slot, wrench load, fram_error *error);

#endif
