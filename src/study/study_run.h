/* A study run on this machine: its folder, what is left to do, the processes that do it, and the tables at the end.

     DIR/study.yaml              the study file as it was read last
     DIR/effective.yaml          the same with every key and condition, versions and hashes (study/study_record.h)
     DIR/index.csv               the ID of each condition, the hashes of its scenario and of its files
     DIR/conditions/ID.yaml      the effective scenario of a condition, at seed 0
     DIR/runs/ID/SEED.row        the figures of a run that ended (study/run_row.h)
     DIR/runs/ID/SEED/           its folder, as far as it is kept; of a run that failed, all of it, with SEED.log beside
     DIR/worst/                  the worst runs with their playback (study/study_worst.h)
     DIR/slurm/                  scripts and lists of the arrays that were submitted to Slurm (study/slurm.h)
     DIR/summary.csv             a row a run, by condition and seed
     DIR/conditions.csv          a row a condition: number of seeds, means over them with their confidence intervals

     DIR/differences.csv, station.csv, extremes.csv, annual.csv, sensitivity.csv, study.nc, study.html
                                 (study/study_answers.h)

   ID names what decides a run's result: the effective scenario, the contents of its files and the version of Fram.  A
   study that is widened finds the runs that are there, and one whose inputs changed runs anew. */
#ifndef STUDY_STUDY_RUN_H
#define STUDY_STUDY_RUN_H

#include "study/run_row.h"
#include "study/slurm.h"
#include "study/study.h"

typedef struct study_progress {
    int32_t done, failed, planned; /* runs; more may be planned as intervals turn out wide */
    double wall, eta;              /* [s]; eta is 0 until it can be told */
    int32_t records_done, records; /* the worst runs, made again with a record when all have ended; 0 before */
    const char *waits;             /* what the scheduler says of tasks that wait, or NULL */
} study_progress;

typedef struct study_options {
    const char *folder;
    const char *program;                                   /* the command `fram`, which is run for each run */
    int jobs;                                              /* processes at a time; 0: the cores of this machine */
    bool retry;                                            /* run again what failed */
    void (*progress)(void *user, const study_progress *p); /* may be NULL */
    void *progress_user;
    const volatile int *stop;   /* may be NULL */
    const slurm_options *slurm; /* NULL: processes of this machine */
} study_options;

typedef struct study_result {
    int32_t conditions, runs, failed, made; /* made: runs that were not there before */
    int32_t failed_condition;               /* of the first run that failed, from 1 */
    int64_t failed_seed;
    char reason[ROW_REASON];
} study_result;

/* FRAM_INTERRUPTED when stopped: what ended is kept. */
fram_status study_run(context *ctx, const study *s, const study_options *options, study_result *result,
                      fram_error *error);

#endif
