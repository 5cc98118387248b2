/* Runs as processes of their own on this machine: started, waited for, stopped.  Knows programs, not studies. */
#ifndef STUDY_PROCESSES_H
#define STUDY_PROCESSES_H

#include "base/array.h"

#include <sys/types.h>

typedef struct process {
    pid_t id;
    int32_t task; /* the caller's number for it */
} process;
typedef struct process_pool {
    ARRAY(process) running;
} process_pool;

/* Cores that this process may use. */
int processes_cores(void);
/* Memory that programs can still take without anything being swapped [bytes]; 0: not known. */
double processes_memory(void);
/* How many at a time on so many cores, when each takes so many bytes of the memory: one at least. */
int processes_that_fit(int cores, double memory, double bytes);
/* Start `words` (ended by NULL; the first is the program's path) without input, standard output and error into the file
   `log`. */
fram_status processes_start(context *ctx, process_pool *all, const char *const *words, const char *log, int32_t task,
                            fram_error *error);
/* Whether one has ended; then its task and exit code, 128 + signal for one that a signal ended. */
bool processes_ended(process_pool *all, int32_t *task, int *exit_code);
/* Exit code of a run that was interrupted, which is none of its own. */
enum { PROCESS_INTERRUPTED = 130 };
/* Whether it is the exit code of a program that did not start, as shells and the system's loader tell it: it is not
   there, may not be run, or lacks a library. */
bool process_not_started(int exit_code);
/* Waits until the next look at them: far less than a run, far more than a look.  While none ends, progress is told
   after so many seconds. */
void processes_pause(void);
#define PROCESSES_TELL 1.0
/* Ask all to stop, and wait until they have. */
void processes_stop(process_pool *all);
void processes_free(context *ctx, process_pool *all);

#endif
