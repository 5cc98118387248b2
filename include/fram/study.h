/* Studies: one scenario under many conditions with several seeds each, run as processes of the command `fram` on the
   cores of this machine or as job arrays of Slurm.  What a study leaves does not depend on the number of processes nor
   on the order in which they end. */
#ifndef FRAM_STUDY_H
#define FRAM_STUDY_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fram_study fram_study;

/* Read a study file and check every condition as a scenario.  The context must outlive the study. */
FRAM_API fram_status fram_study_load(fram_context *context, const char *path, fram_study **study, fram_error *error);
FRAM_API void fram_study_destroy(fram_study *study);

/* What a study will take. */
typedef struct fram_study_extent {
    int conditions;
    int64_t runs_least, runs_most; /* equal unless seeds go on until an interval is narrow; those of conditions that are
                                      the same scenario are made once */
    double run_seconds;            /* processor time of one run, told by steps of the first and the last condition on
                                      this machine, some seconds of computing into it, or at the end of a shorter run;
                                      0.1 s of it for the program */
    double run_bytes;              /* on disk, that stay of a run */
    double
        run_seconds_packed; /* the same if the ice were packed all the time, or went on breaking: jams cost as much */
    int64_t records;        /* of the worst runs, which are made again for them */
    double record_bytes;    /* of each, with its playback */
    double seen; /* part of a run that was looked at to tell this, 0 to 1, the less of the two conditions: some seconds
                    of computing, so that steps that grow later are not known */
    int jobs;    /* processes at a time, as fram_study_run takes by itself: cores, as far as free memory holds them */
    int differ;  /* conditions that are different scenarios */
} fram_study_extent;
FRAM_API fram_status fram_study_measure(const fram_study *study, fram_study_extent *extent, fram_error *error,
                                        size_t size);
#define fram_study_measure(...) fram_study_measure(__VA_ARGS__, sizeof(fram_study_extent))

typedef struct fram_study_progress {
    int64_t done, failed, planned; /* runs; more may be planned as intervals turn out wide */
    double wall, eta;              /* [s]; eta is 0 until it can be told */
    int64_t records_done, records; /* of the worst runs, which are made again for them at the end; 0 before */
    const char *waits; /* what the scheduler says of tasks that wait, until the function returns; NULL: nothing */
} fram_study_progress;
typedef void (*fram_study_progress_function)(void *user, const fram_study_progress *progress);

enum { FRAM_STUDY_JOBS = 4096 }; /* the most processes at a time that may be asked for */

typedef struct fram_study_definition {
    size_t size;         /* of this struct, set by fram_study_default */
    const char *folder;  /* of the results; one that holds this study, earlier or smaller, is gone on with */
    const char *program; /* the command `fram`, path */
    int jobs;            /* processes at a time, 0: as many as this process may use cores; by Slurm tasks of an array
                            at a time, 0: as many as there is room for */
    bool retry;          /* run again what failed */
    fram_study_progress_function progress; /* may be NULL; called from the caller's thread */
    void *progress_user;
    const volatile int *stop;         /* may be NULL; set it to stop: what ended is kept */
    const char *on;                   /* NULL or "local": processes of this machine; "slurm": job arrays of Slurm */
    const char *slurm_partition;      /* NULL: the cluster's default */
    const char *slurm_time;           /* limit of a task as sbatch takes it, "1:00:00"; NULL: the partition's */
    const char *const *slurm_options; /* further options of sbatch, "--account=ice" */
    int slurm_option_count;
    int slurm_runs_per_task; /* 0: such that there are 200 tasks at most */
    double slurm_poll;       /* between questions to the scheduler [s], 0: 30 */
    bool dry_run;            /* print the script of the array on standard output, and run nothing */
} fram_study_definition;
FRAM_API void fram_study_default(fram_study_definition *definition, size_t size);
#define fram_study_default(definition) fram_study_default((definition), sizeof *(definition))

typedef struct fram_study_result {
    int64_t conditions, runs, failed, made; /* made: runs of this call, the others were there */
    int64_t failed_condition, failed_seed;  /* of the first run that failed, conditions from 1; 0: none */
    char reason[512];                       /* of that failure */
} fram_study_result;
/* Leaves summary.csv (a row a run) and conditions.csv (a row a condition) in the folder.  A run that fails is a row
   with its reason and stops nothing.  FRAM_INTERRUPTED when stopped. */
FRAM_API fram_status fram_study_run(const fram_study *study, const fram_study_definition *definition,
                                    fram_study_result *result, fram_error *error, size_t size);
#define fram_study_run(...) fram_study_run(__VA_ARGS__, sizeof(fram_study_result))

/* How a condition of a study stands. */
typedef struct fram_study_standing {
    size_t size;   /* of this struct, as the library has it */
    int condition; /* from 1 */
    int64_t runs, failed, wanted;
    double load_mean, load_mean_half, load_largest; /* over the runs [N]: mean, half its interval, largest; or NaN */
    const char *keys;                               /* "ice.thickness=0.6 vessel.speed=1", until the function returns */
    const char *id; /* of FOLDER/conditions/ID.yaml and FOLDER/runs/ID, until the function returns */
} fram_study_standing;
typedef void (*fram_study_standing_function)(void *user, const fram_study_standing *standing);
/* Tell how each condition of the study in a folder stands, in their order, whether or not it is being run.  Nothing is
   run, written or locked. */
FRAM_API fram_status fram_study_list(fram_context *context, const char *folder, fram_study_standing_function function,
                                     void *user, fram_error *error);

#ifdef __cplusplus
}
#endif

#endif
