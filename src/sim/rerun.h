/* A moment of a finished run computed again, from its nearest checkpoint or from the start: what carried the load then,
   and how much of it hangs on the time step and on the solver.  Reads the run's folder, writes nothing. */
#ifndef SIM_RERUN_H
#define SIM_RERUN_H

#include "io/peak_block.h"
#include "model/scenario.h"
#include "model/world.h"

typedef struct rerun_method {
    double load;  /* largest averaged load of windows that begin with the fork or later [N] */
    double wrong; /* end of the step in which the simulation went wrong by this method [s]; 0: it did not */
} rerun_method;

typedef struct rerun_result {
    peak_detail detail; /* of the vessel at that time, as peak_watch_explain */
    double start;       /* of the state that was gone on from [s] */
    double fork;        /* from here on the others differ: a second and a window before the time [s] */
    double first, last; /* the largest loads are those of windows that end from the one to the other [s] */
    rerun_method half_step, accurate; /* with half the time step, with the accurate solver */
    rerun_method same;                /* as the run was made */
    bool untold; /* it could not be computed as it was: what a program told the run stands in no file */
} rerun_result;

/* The state of a run at or before a time, of its nearest checkpoint or as it was built, into an empty world.
   FRAM_ERROR_INPUT when the folder's scenario or its inputs were changed since the run. */
fram_status rerun_start(context *ctx, const char *folder, const scenario *s, double time, const model *m, world *w,
                        fram_error *error);

/* vessel: row.  known_from: a state before it is not gone on from, since what a program told the run until then stands
   in no file [s]; 0: from any.  FRAM_ERROR_INPUT for a folder that is not of a run, a time outside it, a vessel that is
   not there, and for inputs that were changed since.  FRAM_INTERRUPTED when the context's stop flag is set. */
fram_status rerun_moment(context *ctx, const char *folder, double time, double known_from, int32_t vessel,
                         rerun_result *out, fram_error *error);

#endif
