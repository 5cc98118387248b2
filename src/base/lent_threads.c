/* Invariants.  A call from outside counts itself in `running` before it looks at `open`, and the job is closed and then
   awaited until nobody runs: hence while a call sees the job open, fn, arg and blocks stay what they are.  A block is
   run by whoever sets its byte of `taken` first, under a worker number that nobody else uses meanwhile. */
#include "base/lent_threads.h"
#include <sched.h>
#include <stdatomic.h>
#include <sys/types.h>
#include <unistd.h>

typedef enum breach {
    BREACH_NONE,
    BREACH_LATE,    /* a call outside of its job, or with a block that there is not */
    BREACH_WORKER,  /* a worker number that there is not */
    BREACH_SHARED,  /* two calls at a time with one worker number */
    BREACH_TWICE,   /* a block a second time */
    BREACH_MISSING, /* a block not at all */
    BREACH_COUNT
} breach;

struct lent_threads {
    lent_function run;
    void *user;
    int threads;
    pid_t process; /* that has them: a child of fork() has none */
    /* The job: written while it is closed. */
    block_function fn;
    void *arg;
    int32_t blocks;
    atomic_bool busy; /* somebody has a job: another caller does its own alone */
    atomic_bool open;
    atomic_int running;   /* calls from outside that have not returned */
    atomic_int left;      /* blocks that nobody took */
    atomic_uchar *taken;  /* of each block */
    int32_t room;         /* of taken */
    atomic_bool *working; /* of each worker number */
    atomic_int breach;    /* the first */
};

lent_threads *lent_threads_create(context *ctx, int threads, lent_function run, void *user)
{
    lent_threads *lent = memory_array(ctx, 1, sizeof *lent);
    atomic_bool *working = memory_array(ctx, (size_t)threads, sizeof *working);
    if (!lent || !working) {
        memory_free(ctx, lent);
        memory_free(ctx, working);
        return NULL;
    }
    lent->run = run;
    lent->user = user;
    lent->threads = threads;
    lent->process = getpid();
    lent->working = working;
    for (int i = 0; i < threads; i++)
        atomic_init(&working[i], false);
    atomic_init(&lent->busy, false);
    atomic_init(&lent->open, false);
    atomic_init(&lent->running, 0);
    atomic_init(&lent->left, 0);
    atomic_init(&lent->breach, BREACH_NONE);
    return lent;
}

void lent_threads_free(context *ctx, lent_threads *lent)
{
    if (!lent)
        return;
    memory_free(ctx, lent->taken);
    memory_free(ctx, lent->working);
    memory_free(ctx, lent);
}

int lent_threads_count(const lent_threads *lent) { return lent->threads; }

static void note_breach(lent_threads *lent, breach found)
{
    int none = BREACH_NONE;
    (void)atomic_compare_exchange_strong(&lent->breach, &none, (int)found);
}

/* True for the one who runs the block. */
static bool take_block(lent_threads *lent, int32_t block)
{
    if (atomic_exchange(&lent->taken[block], 1) != 0)
        return false;
    atomic_fetch_sub(&lent->left, 1);
    return true;
}

static void run_as_worker(lent_threads *lent, int32_t block, int worker)
{
    if (atomic_exchange(&lent->working[worker], true)) {
        note_breach(lent, BREACH_SHARED);
        return;
    }
    if (take_block(lent, block))
        lent->fn(lent->arg, block, worker);
    else
        note_breach(lent, BREACH_TWICE);
    atomic_store(&lent->working[worker], false);
}

static void run_lent(void *task, int block, int worker)
{
    lent_threads *lent = task;
    if (!lent)
        return;
    atomic_fetch_add(&lent->running, 1);
    if (!atomic_load(&lent->open) || block < 0 || block >= lent->blocks)
        note_breach(lent, BREACH_LATE);
    else if (worker < 0 || worker >= lent->threads)
        note_breach(lent, BREACH_WORKER);
    else
        run_as_worker(lent, block, worker);
    atomic_fetch_sub(&lent->running, 1);
}

static bool make_room(context *ctx, lent_threads *lent, int32_t blocks)
{
    if (blocks > lent->room) {
        atomic_uchar *taken = memory_resize(ctx, lent->taken, (size_t)blocks * sizeof *taken);
        if (!taken)
            return false;
        lent->taken = taken;
        lent->room = blocks;
    }
    for (int32_t i = 0; i < blocks; i++)
        atomic_init(&lent->taken[i], 0);
    return true;
}

static void run_job(lent_threads *lent, block_function fn, void *arg, int32_t blocks)
{
    lent->fn = fn;
    lent->arg = arg;
    lent->blocks = blocks;
    atomic_store(&lent->left, blocks);
    atomic_store(&lent->open, true);
    lent->run(lent->user, blocks, run_lent, lent);
    atomic_store(&lent->open, false);
    if (atomic_load(&lent->running) != 0)
        note_breach(lent, BREACH_LATE);
    while (atomic_load(&lent->running) != 0)
        sched_yield();
    if (atomic_load(&lent->left) == 0)
        return;
    note_breach(lent, BREACH_MISSING);
    for (int32_t block = 0; block < blocks; block++) {
        if (take_block(lent, block))
            fn(arg, block, 0);
    }
}

void lent_threads_run(context *ctx, block_function fn, void *arg, int32_t blocks)
{
    lent_threads *lent = ctx->lent;
    bool has_threads = blocks > 1 && lent->process == getpid() && !atomic_exchange(&lent->busy, true);
    if (has_threads && make_room(ctx, lent, blocks)) {
        run_job(lent, fn, arg, blocks);
    } else {
        for (int32_t block = 0; block < blocks; block++)
            fn(arg, block, 0);
    }
    if (has_threads)
        atomic_store(&lent->busy, false);
}

fram_status lent_threads_check(const context *ctx, fram_error *error)
{
    static const char *const texts[BREACH_COUNT] = {
        [BREACH_LATE] = "called a task outside of its job, or with a block that there is not",
        [BREACH_WORKER] = "called a task with a worker number that is not from 0 to threads - 1",
        [BREACH_SHARED] = "called two tasks at a time with one worker number",
        [BREACH_TWICE] = "called a block twice",
        [BREACH_MISSING] = "returned before every block was called",
    };
    int found = ctx->lent ? atomic_load(&ctx->lent->breach) : BREACH_NONE;
    if (found == BREACH_NONE)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "parallel", "the program's task system %s", texts[found]);
}
