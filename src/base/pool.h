/* A small thread pool with fixed work order.  Work is split into blocks by data alone; which thread runs
   a block is free, so a block must write only to places of its own.  Reductions are made afterwards over
   blocks in ascending order.  That is why results never depend on the number of threads. */
#ifndef BASE_POOL_H
#define BASE_POOL_H

#include "base/array.h"

typedef void (*block_function)(void *arg, int32_t block, int32_t thread);

/* threads >= 1 counts the caller.  Fewer when the system gives no more (see pool_threads); NULL when there is no memory
   or no thread could be started.  Idle threads sleep; signals are left to the threads of the host program. */
pool *pool_create(context *ctx, int threads);
/* No job may be running; p may be NULL.  In a child of fork() its memory alone is freed. */
void pool_free(context *ctx, pool *p);
int pool_threads(const pool *p);
/* Run fn for block 0..blocks-1 and wait.  thread is 0..context_threads-1 (for per-thread scratch).  On the program's
   threads where it lent some; with neither these nor ctx->threads, a single block, while another thread has a job of
   the same context, or in a child of fork(), on the caller, as thread 0.  Not re-entrant. */
void pool_run(context *ctx, block_function fn, void *arg, int32_t blocks);
/* How many of `count` things make a block: `most`, or so few in a small job that there are about sixteen blocks, but a
   multiple of `least`.  By the count alone. */
int32_t pool_block(int32_t count, int32_t least, int32_t most);
/* How many blocks of `size` things `count` things make, and where one of them ends. */
static inline int32_t pool_blocks(int32_t count, int32_t size) { return count / size + (count % size != 0); }
static inline int32_t pool_block_end(int32_t block, int32_t size, int32_t count)
{
    return count - block * size < size ? count : (block + 1) * size;
}
/* The least of 0..count-1 that is looked for, `count` without: fn looks for it in [first, end) and returns `end`
   without. */
typedef int32_t (*find_function)(const void *arg, int32_t first, int32_t end);
int32_t pool_find(context *ctx, find_function fn, const void *arg, int32_t count);
/* Those of 0..count-1 that are picked, ascending: fn writes those of [first, end) to `out`, which has room for as many,
   and returns how many they are.  false: no memory. */
typedef int32_t (*pick_function)(const void *arg, int32_t first, int32_t end, int32_t *out);
bool pool_pick(context *ctx, pick_function fn, const void *arg, int32_t count, int32_array *picked);
/* Of the pool or the program; 1 without both. */
int context_threads(const context *ctx);

#endif
