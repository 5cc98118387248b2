/* Stepping a world without output, and measuring it. */
#ifndef SIM_BENCH_H
#define SIM_BENCH_H

#include "io/scene_file.h"
#include "model/scenario.h"
#include "sim/step.h"

/* How long steps took [s]: nearest ranks, so that each is a step that there was. */
typedef struct step_times {
    double mean, p99, p999, longest;
} step_times;

typedef struct bench_result {
    int64_t steps;
    int32_t floes;
    double cpu_median, wall_median;                     /* of a step, process CPU time and wall time [s] */
    double forces_median, collide_median, solve_median; /* CPU time of the parts of a step [s] */
    step_times cpu, wall;
    double share[STAGE_COUNT]; /* of the stages in the CPU time of all steps; what they leave is bookkeeping */
    double real_time_factor;
    double contact_points, pairs; /* overlapping points and pairs of bodies with such points, mean per step */
    double loaded_pairs;          /* pairs of bodies with an impulse between them, mean per step */
    double mean_depth, max_depth; /* mean over steps of the mean overlap, largest overlap [m] */
    double ship_force;            /* mean ice load against the first vessel's x axis [N] */
    double kinetic_energy;        /* at the end [J] */
    double residual;              /* mean over steps [m/s] */
    uint64_t state_hash;
} bench_result;

/* warm seconds of simulated time unmeasured, then `time` seconds measured. */
fram_status bench_scenario(context *ctx, const scenario *s, double warm, double time, bench_result *out,
                           fram_error *error);

/* How a scene of the peers is run. */
typedef struct bench_scene_options {
    double time_step, warm, time; /* [s]; as the peers count: warm-up included in time */
    int32_t iterations;           /* of velocities and of positions */
    solver_kind solver;
    const char *dump; /* file of the final poses in the order of the scene, NULL: none */
    bool exact_water; /* Fram's own hydrostatics and drag (fluid/fluid.h) in place of the scene's columns */
} bench_scene_options;

/* A scene with its own water (fluid/columns.h) or with Fram's, every floe awake. */
fram_status bench_scene(context *ctx, const scene_text *scene, const bench_scene_options *options, bench_result *out,
                        fram_error *error);

#endif
