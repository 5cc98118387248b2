/* Threads that belong to the program: it runs a job's blocks on a task system of its own, and Fram holds it to the
   contract.  Results never depend on it, as blocks are cut by data alone (pool.h); a call that breaks the contract is
   not let in, what was left out is made up for on the calling thread, and the breach is told.  One module with pool.h.
 */
#ifndef BASE_LENT_THREADS_H
#define BASE_LENT_THREADS_H

#include "base/pool.h"

/* One block; worker from 0, no two at a time the same. */
typedef void (*lent_task)(void *task, int block, int worker);
/* Calls run(task, b, worker) once for each b from 0 to blocks - 1 and returns when all these calls have returned. */
typedef void (*lent_function)(void *user, int blocks, lent_task run, void *task);

/* threads: workers that there are at most, >= 1.  NULL: no memory. */
lent_threads *lent_threads_create(context *ctx, int threads, lent_function run, void *user);
/* lent may be NULL. */
void lent_threads_free(context *ctx, lent_threads *lent);
int lent_threads_count(const lent_threads *lent);
/* As pool_run, on the program's threads. */
void lent_threads_run(context *ctx, block_function fn, void *arg, int32_t blocks);
/* FRAM_ERROR_USAGE, with the key "parallel", once the contract was broken, and for ever after. */
fram_status lent_threads_check(const context *ctx, fram_error *error);

#endif
