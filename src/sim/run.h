/* A run: the loop around world_step with its outputs, its checkpoints and its ends. */
#ifndef SIM_RUN_H
#define SIM_RUN_H

#include "model/scenario.h"
#include "sim/recording.h"

typedef struct run_progress {
    double time, end; /* simulated [s] */
    double wall, eta; /* [s] */
    double real_time_factor;
} run_progress;

typedef struct run_options {
    const char *folder;
    bool force;
    bool with_paths;           /* the record tells where input files lie; otherwise their names alone */
    double until;              /* stop there with a checkpoint; <= 0: the scenario's end [s] */
    void (*begun)(void *user); /* the streams in the folder are those of this run; may be NULL */
    void *begun_user;
    void (*progress)(void *user, const run_progress *p); /* may be NULL */
    void *progress_user;
    const volatile int *stop; /* may be NULL */
    recording_finish finish;  /* its time counts as recording; may be NULL */
} run_options;

/* From the start into an empty folder (or any with force). */
fram_status run_start(context *ctx, const scenario *s, const run_options *options, run_result *result,
                      fram_error *error);
/* From the newest good checkpoint of options->folder on. */
fram_status run_resume(context *ctx, const run_options *options, run_result *result, fram_error *error);

#endif
