/* Measuring the steps of a world.  Inside sim's benchmarks. One module with bench, whose inside this is. */
#ifndef SIM_BENCH_MEASURE_H
#define SIM_BENCH_MEASURE_H

#include "sim/bench.h"
#include "sim/step.h"

/* warm_steps unmeasured steps, then `steps` measured ones; fills all of *out but floes.  ship: slot of the body whose
   ice load is wanted, -1: none. */
fram_status bench_measure(context *ctx, const model *m, world *w, int32_t ship, int64_t warm_steps, int64_t steps,
                          bench_result *out, fram_error *error);

#endif
