/* Looks at a run on its way: what its steps take at its start, and after more and more computing. */
#ifndef SIM_BENCH_LOOKS_H
#define SIM_BENCH_LOOKS_H

#include "sim/build.h"

typedef struct bench_look {
    double time;     /* of a step, median processor time [s] */
    double contacts; /* points that overlap, mean */
    int32_t floes;
    double drift;      /* that the ice has throughout the run; 0: none, or it changes [m/s] */
    int64_t at, steps; /* since the start before it, and of its own */
} bench_look;

/* out[i]: the look at the steps that come when those before have taken after[i] seconds of processor time, ascending;
   the first after some steps that settle.  The run is made once, so that all takes little more than the last of
   `after`, however dear its steps become.  A run that ends before has its last look again.  build: processor time of
   making the world [s].  made: looks at that, and where it cannot be made at neither model nor world; NULL: nobody. */
fram_status bench_looks(context *ctx, const scenario *s, build_look made, const double *after, int count,
                        bench_look *out, double *build, fram_error *error);

#endif
