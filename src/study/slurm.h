/* Runs of a study as job arrays of Slurm, over a shared file system: no program of ours waits on the nodes.

     DIR/slurm/N.sh     script of the N-th array, N.list its runs, "ID SEED" a line; each task takes the same number
     DIR/slurm/N.job    number that Slurm gave it
     DIR/slurm/exit-JOB-TASK  exit code of a run that a task has just ended, until it has its name below
     DIR/runs/ID/SEED.exit    exit code of a run and the node that it was on, put there by its task when it ended;
                              DIR/worst/ID-SEED.exit of one that is made again with a record

   What ended is seen by these files; the scheduler is asked every half minute at most, which tasks it still has.  Runs
   whose task is gone without an exit code are submitted again, and so are those of a node that cannot start the
   program, for other nodes. */
#ifndef STUDY_SLURM_H
#define STUDY_SLURM_H

#include "study/slurm_script.h"

typedef struct slurm_run {
    int32_t task; /* the caller's number */
    char id[16];
    int64_t seed;
    double frames;        /* of its record [s]; 0: an ordinary run */
    int32_t array, place; /* submitted as this; array -1: not yet */
    int tries, missed;    /* submissions; questions in a row whose answer lacks it */
    bool excused;         /* another run of its task has ended since it was submitted */
} slurm_run;

enum { SLURM_NODE = 256 };
typedef struct slurm_pool {
    context *ctx;
    const slurm_options *options;
    const char *program;
    char *folder; /* absolute */
    ARRAY(slurm_run) runs;
    ARRAY(int64_t) jobs;   /* Slurm's numbers of the arrays of this call */
    int32_t arrays;        /* number of the last script in the folder */
    int32_t earlier;       /* number of the last one of earlier calls */
    int32_t looked;        /* runs that slurm_ended has looked at since it last said that none ended */
    double asked;          /* when the scheduler was asked last [s] */
    double refused;        /* since when sbatch refuses [s]; 0: it does not */
    double offered;        /* when it refused last [s] */
    int silent;            /* questions in a row that it did not answer */
    char waits[96];        /* what it said of tasks that wait; "" */
    char node[SLURM_NODE]; /* of the run that ended last; "": not told */
    text_buffer without;   /* nodes that cannot start the program, divided by commas */
    bool again;            /* a run may be made twice: submitted again, or met by another */
    bool unstopped;        /* the scheduler did not take that one of them is cancelled */
} slurm_pool;

/* FRAM_ERROR_USAGE when sbatch is not there.  Arrays that an earlier call left in the queue are cancelled. */
fram_status slurm_begin(context *ctx, const slurm_options *options, const char *folder, const char *program,
                        slurm_pool *all, fram_error *error);
/* A run to be submitted next; frames > 0: one that is made again with a record, and a frame so often [s]. */
bool slurm_add(slurm_pool *all, const char *id, int64_t seed, int32_t task, double frames);
/* Submits what was added and what was lost. */
fram_status slurm_submit(slurm_pool *all, fram_error *error);
/* One run that ended, if any did: until it says no, each run is looked at once. */
bool slurm_ended(slurm_pool *all, int32_t *task, int *exit_code);
/* Between questions to the scheduler [s]. */
double slurm_poll(const slurm_pool *all);
/* Asks the scheduler, when it is time. */
void slurm_look(slurm_pool *all);
/* How many tasks the scheduler has not begun yet, and the reasons that it gives, as it said last; NULL: none. */
const char *slurm_waits(const slurm_pool *all);
/* Cancels what is submitted and may go on; whole: all runs have ended. */
void slurm_end(slurm_pool *all, bool whole);
void slurm_free(slurm_pool *all);

/* Whose runs are followed. */
typedef struct slurm_follower {
    void *user;
    /* Adds what is wanted by now: at first, and after each look. */
    fram_status (*add)(void *user, slurm_pool *all, fram_error *error);
    /* A run that ended; node: "" where it is not told. */
    fram_status (*take)(void *user, int32_t task, int exit_code, const char *node, fram_error *error);
    void (*tell)(void *user, const char *waits); /* waits: as slurm_waits */
    const volatile int *stop;                    /* may be NULL */
    const int32_t *held;                         /* runs that are to be added when others let go of them */
} slurm_follower;
/* Submits runs and takes what ended, until none is left or held or the follower is asked to stop: all of the above from
   its beginning to its end.  A dry run ends with what it would submit. */
fram_status slurm_follow(context *ctx, const slurm_options *options, const char *folder, const char *program,
                         const slurm_follower *f, fram_error *error);

#endif
