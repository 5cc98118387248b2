/* Stepping a world without output, and measuring it. */
#ifndef SIM_BENCH_H
#define SIM_BENCH_H

#include "model/scenario.h"

typedef struct bench_result {
    int64_t steps;
    int32_t floes;
    double cpu_median, wall_median; /* of a step, process CPU time and wall time [s] */
    double real_time_factor;
    double contact_points, pairs; /* mean per step */
    double mean_depth, max_depth; /* mean over steps of the mean overlap, largest overlap [m] */
    double ship_force;            /* mean ice load on the first vessel along its x axis [N] */
    double kinetic_energy;        /* at the end [J] */
    double residual;              /* mean over steps [m/s] */
    uint64_t state_hash;
} bench_result;

/* warm seconds of simulated time unmeasured, then `time` seconds measured. */
fram_status bench_scenario(context *ctx, const scenario *s, double warm, double time, bench_result *out,
                           fram_error *error);

#endif
