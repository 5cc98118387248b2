/* How a run stands, as run.json tells it: what a world and its scenario say of themselves, and what its recording
   knows. Its text is of io/run_note.h. */
#ifndef SIM_RUN_SUMMARY_H
#define SIM_RUN_SUMMARY_H

#include "base/hash.h"
#include "base/time_ranks.h"
#include "model/scenario.h"
#include "model/world.h"

typedef struct run_summary {
    const char *status;   /* "running", "stopped", "finished", "interrupted", "failed" */
    const char *message;  /* of a failure, or NULL */
    double recorded_from; /* when its recording began [s]; -1: not known */
    double good_until;    /* with a message: the end of the last step before the one that failed [s] */
    char scenario_hash[SHA256_TEXT_SIZE];
    const char *inputs;
    int threads;
    double wall;          /* of the last call [s] */
    double recording;     /* of it for what the run writes: series, frames, checkpoints, pictures, results [s] */
    double recording_end; /* of that at the end: the last checkpoint, pictures, results [s] */
    const time_ranks *step_times; /* of the last call */
    uint64_t state_hash;
} run_summary;
/* FOLDER/run.json. */
fram_status run_summary_write(context *ctx, const char *folder, const scenario *s, const world *w,
                              const run_summary *summary, fram_error *error);

#endif
