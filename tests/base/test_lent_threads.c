/* Threads that the program lends: every block once, and no breach of the contract goes unseen or does harm. */
#include "base/lent_threads.h"
#include "testing.h"
#include <pthread.h>
#include <sched.h>
#include <time.h>

enum { BLOCKS = 200, THREADS = 3 };

typedef struct job {
    int times[BLOCKS]; /* plain: a block run twice is also a data race */
    atomic_int working[THREADS];
    pthread_barrier_t *both; /* block 0 waits here for the one who breaks the contract; NULL: it does not */
    bool first_is_over;
    const context *early; /* ... and then until a breach is noted, or, with NULL, at `both` again */
} job;

typedef struct program {
    void (*how)(int blocks, lent_task run, void *task, struct program *p);
    lent_task run; /* of the last job, for calls that come late */
    void *task;
    job *job;
    pthread_t other;
} program;

static void call_how(void *user, int blocks, lent_task run, void *task)
{
    program *p = user;
    p->run = run;
    p->task = task;
    p->how(blocks, run, task, p);
}

static void count_block(void *arg, int32_t block, int32_t thread)
{
    job *j = arg;
    ck_assert(thread >= 0 && thread < THREADS && block >= 0 && block < BLOCKS);
    ck_assert_int_eq(atomic_fetch_add(&j->working[thread], 1), 0); /* nobody else has this number */
    j->times[block]++;
    if (block == 0 && j->both) {
        pthread_barrier_wait(j->both);
        while (j->early && lent_threads_check(j->early, NULL) == FRAM_OK)
            sched_yield();
        if (j->early)
            nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL);
        j->first_is_over = true;
        if (!j->early)
            pthread_barrier_wait(j->both);
    }
    atomic_fetch_sub(&j->working[thread], 1);
}

static context lend(program *p, void (*how)(int, lent_task, void *, program *))
{
    context ctx;
    context_init(&ctx);
    p->how = how;
    ctx.lent = lent_threads_create(&ctx, THREADS, call_how, p);
    ck_assert_ptr_nonnull(ctx.lent);
    ck_assert_int_eq(context_threads(&ctx), THREADS);
    return ctx;
}

/* Every block once, whatever `how` does; the word of its breach in the message, NULL: there is none. */
static void run_and_check(void (*how)(int, lent_task, void *, program *), const char *word)
{
    fram_error e = {0};
    job j = {0};
    program p = {.job = &j};
    context ctx = lend(&p, how);
    pool_run(&ctx, count_block, &j, BLOCKS);
    for (int i = 0; i < BLOCKS; i++)
        ck_assert_int_eq(j.times[i], 1);
    if (!word) {
        assert_ok(lent_threads_check(&ctx, &e), e);
    } else {
        ck_assert_int_eq(lent_threads_check(&ctx, &e), FRAM_ERROR_USAGE);
        ck_assert_str_eq(e.key, "parallel");
        ck_assert_msg(strstr(e.message, word), "%s", e.message);
    }
    pool_run(&ctx, count_block, &j, 1); /* a single block goes past the program */
    ck_assert_int_eq(j.times[0], 2);
    lent_threads_free(&ctx, ctx.lent);
}

static void backwards(int blocks, lent_task run, void *task, program *p)
{
    (void)p;
    for (int block = blocks; block-- > 0;)
        run(task, block, block % THREADS);
}

static void twice(int blocks, lent_task run, void *task, program *p)
{
    backwards(blocks, run, task, p);
    run(task, 7, 0);
}

static void with_a_gap(int blocks, lent_task run, void *task, program *p)
{
    (void)p;
    for (int block = 0; block < blocks; block++) {
        if (block != 13)
            run(task, block, 0);
    }
}

static void not_at_all(int blocks, lent_task run, void *task, program *p)
{
    (void)blocks, (void)run, (void)task, (void)p;
}

static void strange_worker(int blocks, lent_task run, void *task, program *p)
{
    for (int block = 0; block < blocks; block++)
        run(task, block, block % 2 ? THREADS : -1);
    backwards(blocks, run, task, p);
}

static void strange_block(int blocks, lent_task run, void *task, program *p)
{
    run(task, blocks, 0);
    run(task, -1, 0);
    run(NULL, 0, 0);
    backwards(blocks, run, task, p);
}

START_TEST(every_block_is_run_once)
{
    run_and_check(backwards, NULL);
    run_and_check(twice, "twice");
    run_and_check(with_a_gap, "before every block");
    run_and_check(not_at_all, "before every block");
    run_and_check(strange_worker, "worker number");
    run_and_check(strange_block, "outside of its job");
}
END_TEST

static void *call_first_block(void *arg)
{
    const program *p = arg;
    p->run(p->task, 0, 1);
    return NULL;
}

/* Another thread is in block 0 while this one calls a block with its number; then it is let go. */
static void share_a_number(int blocks, lent_task run, void *task, program *p)
{
    ck_assert_int_eq(pthread_create(&p->other, NULL, call_first_block, p), 0);
    pthread_barrier_wait(p->job->both);
    run(task, 1, 1);
    pthread_barrier_wait(p->job->both);
    pthread_join(p->other, NULL);
    for (int block = 1; block < blocks; block++)
        run(task, block, 2);
}

/* Returns while another thread is in block 0. */
static void return_early(int blocks, lent_task run, void *task, program *p)
{
    ck_assert_int_eq(pthread_create(&p->other, NULL, call_first_block, p), 0);
    pthread_barrier_wait(p->job->both);
    for (int block = 1; block < blocks; block++)
        run(task, block, 0);
}

static void run_two(void (*how)(int, lent_task, void *, program *), bool early, const char *word)
{
    pthread_barrier_t both;
    fram_error e = {0};
    job j = {.both = &both};
    program p = {.job = &j};
    pthread_barrier_init(&both, NULL, 2);
    context ctx = lend(&p, how);
    j.early = early ? &ctx : NULL;
    pool_run(&ctx, count_block, &j, BLOCKS);
    ck_assert(j.first_is_over);
    for (int i = 0; i < BLOCKS; i++)
        ck_assert_int_eq(j.times[i], 1);
    if (early)
        pthread_join(p.other, NULL);
    ck_assert_int_eq(lent_threads_check(&ctx, &e), FRAM_ERROR_USAGE);
    ck_assert_msg(strstr(e.message, word), "%s", e.message);
    p.run(p.task, 0, 0); /* long after the job: nothing happens */
    ck_assert_int_eq(j.times[0], 1);
    lent_threads_free(&ctx, ctx.lent);
    pthread_barrier_destroy(&both);
}

START_TEST(calls_that_meet_are_kept_apart) { run_two(share_a_number, false, "one worker number"); }
END_TEST

START_TEST(a_job_is_awaited_when_the_program_returns_early) { run_two(return_early, true, "outside of its job"); }
END_TEST

/* Without memory for the job it is run here. */
START_TEST(no_memory_is_no_harm)
{
    failing_memory m;
    job j = {0};
    program p = {.job = &j};
    context ctx = failing_context(&m, 0);
    p.how = not_at_all;
    ctx.lent = lent_threads_create(&ctx, THREADS, call_how, &p);
    ck_assert_ptr_nonnull(ctx.lent);
    lent_threads *lent = ctx.lent;
    m.fail_at = atomic_load(&m.requests) + 1;
    pool_run(&ctx, count_block, &j, BLOCKS);
    for (int i = 0; i < BLOCKS; i++)
        ck_assert_int_eq(j.times[i], 1);
    ck_assert_int_eq(lent_threads_check(&ctx, NULL), FRAM_OK);
    ck_assert(m.failed);
    lent_threads_free(&ctx, lent);
    lent_threads_free(&ctx, NULL);
    ck_assert_int_eq(m.live, 0);
    ctx.lent = NULL;
    for (long n = 1; n <= 2; n++) {
        m.fail_at = atomic_load(&m.requests) + n;
        ck_assert_ptr_null(lent_threads_create(&ctx, THREADS, call_how, &p));
        ck_assert_int_eq(m.live, 0);
    }
}
END_TEST

TEST_MAIN("lent_threads", every_block_is_run_once, calls_that_meet_are_kept_apart,
          a_job_is_awaited_when_the_program_returns_early, no_memory_is_no_harm)
