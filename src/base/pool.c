/* Threads that share out the blocks of one job at a time.  Knows no work of its own.

   Whoever sets `busy` has the threads until its job is done.  A job of another caller meanwhile, for another world of
   the context, is done by that caller alone.

   Invariants.  `ticket` holds the job's number in its upper half and the blocks not yet taken in its lower half; a
   block is taken by decreasing it.  `unfinished` counts the blocks of the job not yet credited as done; a thread
   credits its blocks after its last one, and the caller does not return before all are credited.  Hence while a
   thread holds an uncredited block the job stays what it is, and fn, arg and blocks may be read without a lock; a
   thread that is late finds nothing to take, whichever job it looks at.

   Threads that find nothing look again for a moment and then sleep.  Both sides of going to sleep announce
   themselves first and look second, in sequentially consistent order, so that no wake-up is lost. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "base/pool.h"
#include "base/lent_threads.h"
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <string.h>
#include <unistd.h>

/* Looks before sleeping: about 10 to 40 microseconds, a few times what waking a sleeper costs.  Serial gaps between
   the colours of a solver are shorter than that. */
enum { LOOKS = 1000 };

typedef struct worker {
    pool *owner;
    int32_t thread; /* 1 .. threads - 1 */
    pthread_t handle;
} worker;

struct pool {
    _Atomic uint64_t ticket;
    atomic_int unfinished;
    atomic_int sleepers;        /* workers that wait for `work` or are about to */
    atomic_bool caller_waiting; /* the caller waits for `done` or is about to */
    atomic_bool stop;
    atomic_bool busy; /* somebody has a job */
    /* The job: written while `unfinished` is 0, published by `ticket`. */
    block_function fn;
    void *arg;
    int32_t blocks;
    int looks; /* LOOKS, or 0 when threads would take each other's core */
    int threads;
    pthread_mutex_t mutex;
    pthread_cond_t work, done;
    worker *workers; /* threads - 1 */
    pid_t process;   /* that has them */
};

static inline void look_pause(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

static int cores_online(void)
{
#ifdef __linux__
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
#endif
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores > 0 ? (int)cores : 1;
}

static bool job_open(pool *p) { return (uint32_t)atomic_load(&p->ticket) != 0; }

/* Takes blocks in ascending order and runs them until none is left. */
static void blocks_run(pool *p, int32_t thread)
{
    int credit = 0;
    uint64_t ticket = atomic_load(&p->ticket);
    while ((uint32_t)ticket != 0) {
        if (!atomic_compare_exchange_weak(&p->ticket, &ticket, ticket - 1))
            continue;
        p->fn(p->arg, p->blocks - (int32_t)(uint32_t)ticket, thread);
        credit++;
        ticket = atomic_load(&p->ticket);
    }
    if (credit > 0 && atomic_fetch_sub(&p->unfinished, credit) == credit && atomic_load(&p->caller_waiting)) {
        pthread_mutex_lock(&p->mutex);
        pthread_cond_signal(&p->done);
        pthread_mutex_unlock(&p->mutex);
    }
}

static void work_await(pool *p)
{
    for (int i = 0; i < p->looks; i++) {
        if (job_open(p) || atomic_load(&p->stop))
            return;
        look_pause();
    }
    pthread_mutex_lock(&p->mutex);
    atomic_fetch_add(&p->sleepers, 1);
    while (!job_open(p) && !atomic_load(&p->stop))
        pthread_cond_wait(&p->work, &p->mutex);
    atomic_fetch_sub(&p->sleepers, 1);
    pthread_mutex_unlock(&p->mutex);
}

static void *worker_main(void *arg)
{
    worker *w = arg;
    while (!atomic_load(&w->owner->stop)) {
        work_await(w->owner);
        blocks_run(w->owner, w->thread);
    }
    return NULL;
}

/* Starts workers until one fails; p->threads says how many there are. */
static void workers_start(pool *p, int threads)
{
    /* Signals are for the threads of the host program. */
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    for (p->threads = 1; p->threads < threads; p->threads++) {
        worker *w = &p->workers[p->threads - 1];
        w->owner = p;
        w->thread = p->threads;
        if (pthread_create(&w->handle, NULL, worker_main, w) != 0)
            break;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

/* In a child of fork() nothing of this can be done: there is nobody to join, and the variables are waited for by
   workers that are not there. */
static void workers_end(pool *p)
{
    pthread_mutex_lock(&p->mutex);
    atomic_store(&p->stop, true);
    pthread_cond_broadcast(&p->work);
    pthread_mutex_unlock(&p->mutex);
    for (int i = 0; i < p->threads - 1; i++)
        pthread_join(p->workers[i].handle, NULL);
    pthread_cond_destroy(&p->done);
    pthread_cond_destroy(&p->work);
    pthread_mutex_destroy(&p->mutex);
}

pool *pool_create(context *ctx, int threads)
{
    if (threads < 1)
        threads = 1;
    pool *p = memory_array(ctx, 1, sizeof *p);
    worker *workers = memory_array(ctx, (size_t)threads - 1, sizeof *workers);
    if (!p || !workers) {
        memory_free(ctx, p);
        memory_free(ctx, workers);
        return NULL;
    }
    p->workers = workers;
    p->process = getpid();
    p->looks = threads <= cores_online() ? LOOKS : 0;
    atomic_init(&p->ticket, 0);
    atomic_init(&p->unfinished, 0);
    atomic_init(&p->sleepers, 0);
    atomic_init(&p->caller_waiting, false);
    atomic_init(&p->stop, false);
    atomic_init(&p->busy, false);
    pthread_mutex_init(&p->mutex, NULL);
    pthread_cond_init(&p->work, NULL);
    pthread_cond_init(&p->done, NULL);
    workers_start(p, threads);
    if (threads > 1 && p->threads == 1) {
        pool_free(ctx, p);
        return NULL;
    }
    return p;
}

void pool_free(context *ctx, pool *p)
{
    if (!p)
        return;
    if (p->process == getpid())
        workers_end(p);
    memory_free(ctx, p->workers);
    memory_free(ctx, p);
}

int pool_threads(const pool *p) { return p->threads; }

int context_threads(const context *ctx)
{
    if (ctx->lent)
        return lent_threads_count(ctx->lent);
    return ctx->threads ? pool_threads(ctx->threads) : 1;
}

/* Lets workers know of a published job of `blocks` blocks: no more than it can feed, and none that is awake. */
static void workers_wake(pool *p, int32_t blocks)
{
    int sleepers = atomic_load(&p->sleepers);
    if (sleepers == 0)
        return;
    pthread_mutex_lock(&p->mutex);
    if (blocks > sleepers) {
        pthread_cond_broadcast(&p->work);
    } else {
        for (int32_t i = 1; i < blocks; i++)
            pthread_cond_signal(&p->work);
    }
    pthread_mutex_unlock(&p->mutex);
}

static void job_await(pool *p)
{
    for (int i = 0; i < p->looks; i++) {
        if (atomic_load(&p->unfinished) == 0)
            return;
        look_pause();
    }
    pthread_mutex_lock(&p->mutex);
    atomic_store(&p->caller_waiting, true);
    while (atomic_load(&p->unfinished) != 0)
        pthread_cond_wait(&p->done, &p->mutex);
    atomic_store(&p->caller_waiting, false);
    pthread_mutex_unlock(&p->mutex);
}

int32_t pool_block(int32_t count, int32_t least, int32_t most)
{
    enum { BLOCKS = 16 }; /* four threads then end within a fifth of each other */
    int32_t block = (count / BLOCKS / least + 1) * least;
    return block < most ? block : most;
}

/* Not in a child of fork(): there are no workers there, and what they held when it came to be stays held. */
static bool has_workers(const pool *p) { return p && p->threads > 1 && p->process == getpid(); }

void pool_run(context *ctx, block_function fn, void *arg, int32_t blocks)
{
    if (ctx->lent) {
        lent_threads_run(ctx, fn, arg, blocks);
        return;
    }
    pool *p = ctx->threads;
    if (blocks <= 1 || !has_workers(p) || atomic_exchange(&p->busy, true)) {
        for (int32_t block = 0; block < blocks; block++)
            fn(arg, block, 0);
        return;
    }
    p->fn = fn;
    p->arg = arg;
    p->blocks = blocks;
    atomic_store(&p->unfinished, blocks);
    uint64_t job = (atomic_load(&p->ticket) >> 32) + 1;
    atomic_store(&p->ticket, job << 32 | (uint32_t)blocks);
    workers_wake(p, blocks);
    blocks_run(p, 0);
    job_await(p);
    atomic_store(&p->busy, false);
}

/* ---- what is looked for ---- */

typedef struct search {
    find_function fn;
    const void *arg;
    int32_t count;
    _Atomic int32_t least; /* found so far */
} search;
enum { FIND_BLOCK = 1024 };

static void find_in_block(void *arg, int32_t block, int32_t thread)
{
    search *s = arg;
    int32_t first = FIND_BLOCK * block, end = pool_block_end(block, FIND_BLOCK, s->count);
    (void)thread;
    int32_t found = s->fn(s->arg, first, end), least = atomic_load(&s->least);
    while (found < end && found < least)
        if (atomic_compare_exchange_weak(&s->least, &least, found))
            break;
}

int32_t pool_find(context *ctx, find_function fn, const void *arg, int32_t count)
{
    search s = {fn, arg, count, count};
    pool_run(ctx, find_in_block, &s, pool_blocks(count, FIND_BLOCK));
    return atomic_load(&s.least);
}

/* ---- what is picked ---- */

typedef struct picking {
    pick_function fn;
    const void *arg;
    int32_t count;
    int32_t *out;   /* of each block from the place of its first on */
    int32_t *found; /* by each block */
} picking;
enum { PICK_BLOCK = 2048 };

static void pick_in_block(void *arg, int32_t block, int32_t thread)
{
    const picking *p = arg;
    int32_t first = PICK_BLOCK * block;
    (void)thread;
    p->found[block] = p->fn(p->arg, first, pool_block_end(block, PICK_BLOCK, p->count), p->out + first);
}

bool pool_pick(context *ctx, pick_function fn, const void *arg, int32_t count, int32_array *picked)
{
    int32_t blocks = pool_blocks(count, PICK_BLOCK), found = 0;
    if (blocks > INT32_MAX - count || !array_resize(ctx, picked, count + blocks))
        return false;
    if (count > 0) { /* else there may be no memory to point to */
        picking p = {fn, arg, count, picked->data, picked->data + count};
        pool_run(ctx, pick_in_block, &p, blocks);
        for (int32_t b = 0; b < blocks; b++) {
            memmove(p.out + found, p.out + PICK_BLOCK * b, (size_t)p.found[b] * sizeof *p.out);
            found += p.found[b];
        }
    }
    picked->count = found;
    return true;
}
