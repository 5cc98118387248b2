/* The thread pool: every block once, whatever the threads do. */
#include "base/pool.h"
#include "testing.h"
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

enum { BLOCKS = 1000 };

typedef struct job {
    int times[BLOCKS]; /* plain: a block taken twice is also a data race */
    double value[BLOCKS];
    atomic_int per_thread[64];
    int32_t threads;
    int slow; /* the block that takes long, or -1 */
} job;

static void pause_for(long microseconds)
{
    nanosleep(&(struct timespec){.tv_sec = 0, .tv_nsec = microseconds * 1000}, NULL);
}

static void count_block(void *arg, int32_t block, int32_t thread)
{
    job *j = arg;
    if (thread < 0 || thread >= j->threads)
        abort();
    if (block == j->slow)
        pause_for(3000);
    j->times[block]++;
    double x = block;
    for (int i = 0; i < 20; i++)
        x = x * 0.75 + 1 / (1 + x);
    j->value[block] = x;
    atomic_fetch_add(&j->per_thread[thread], 1);
}

static context pool_context(int threads)
{
    context ctx;
    context_init(&ctx);
    ctx.threads = pool_create(&ctx, threads);
    ck_assert_ptr_nonnull(ctx.threads);
    ck_assert_int_eq(pool_threads(ctx.threads), threads);
    ck_assert_int_eq(context_threads(&ctx), threads);
    return ctx;
}

static void run_and_check(context *ctx, int32_t blocks, int slow)
{
    job j = {.threads = context_threads(ctx), .slow = slow};
    pool_run(ctx, count_block, &j, blocks);
    int sum = 0;
    for (int i = 0; i < 64; i++)
        sum += atomic_load(&j.per_thread[i]);
    ck_assert_int_eq(sum, blocks);
    for (int32_t i = 0; i < BLOCKS; i++)
        ck_assert_int_eq(j.times[i], i < blocks ? 1 : 0);
}

START_TEST(every_block_runs_once)
{
    static const int thread_counts[] = {1, 2, 3, 8, 16}; /* more than there are cores, too */
    for (size_t t = 0; t < sizeof thread_counts / sizeof *thread_counts; t++) {
        context ctx = pool_context(thread_counts[t]);
        for (int32_t blocks = 0; blocks < 40; blocks++)
            run_and_check(&ctx, blocks, -1);
        for (int i = 0; i < 20; i++)
            run_and_check(&ctx, BLOCKS, -1);
        pool_free(&ctx, ctx.threads);
    }
}
END_TEST

START_TEST(many_small_jobs_follow_each_other)
{
    context ctx = pool_context(4);
    job j = {.threads = 4, .slow = -1};
    for (int i = 0; i < 5000; i++)
        pool_run(&ctx, count_block, &j, 5);
    for (int i = 0; i < 5; i++)
        ck_assert_int_eq(j.times[i], 5000);
    pool_free(&ctx, ctx.threads);
}
END_TEST

START_TEST(sleepers_wake_and_the_caller_waits)
{
    static const int thread_counts[] = {2, 6};
    for (size_t t = 0; t < 2; t++) {
        context ctx = pool_context(thread_counts[t]);
        for (int i = 0; i < 10; i++) {
            pause_for(2000); /* long enough for workers to fall asleep; nothing depends on whether they do */
            run_and_check(&ctx, i + 2, i % 3); /* the slow block is now the caller's, now another's */
        }
        pause_for(2000);
        pool_free(&ctx, ctx.threads); /* while they sleep */
    }
}
END_TEST

START_TEST(results_do_not_depend_on_threads)
{
    job expected = {.threads = 1, .slow = -1};
    context alone;
    context_init(&alone);
    ck_assert_int_eq(context_threads(&alone), 1);
    pool_run(&alone, count_block, &expected, BLOCKS);
    for (int threads = 1; threads <= 5; threads++) {
        context ctx = pool_context(threads);
        job j = {.threads = threads, .slow = -1};
        pool_run(&ctx, count_block, &j, BLOCKS);
        assert_array_bits(j.value, expected.value, BLOCKS);
        pool_free(&ctx, ctx.threads);
    }
}
END_TEST

typedef struct where {
    pthread_t thread;
    int32_t number;
} where;

static void note_thread(void *arg, int32_t block, int32_t thread)
{
    ((where *)arg)[block] = (where){pthread_self(), thread};
}

START_TEST(a_single_block_runs_on_the_caller)
{
    context ctx = pool_context(3);
    for (int i = 0; i < 100; i++) {
        where w[1];
        pool_run(&ctx, note_thread, w, 1);
        ck_assert(pthread_equal(w[0].thread, pthread_self()));
        ck_assert_int_eq(w[0].number, 0);
    }
    where w[BLOCKS];
    pool_run(&ctx, note_thread, w, BLOCKS);
    for (int i = 0; i < BLOCKS; i++) /* number 0 is the caller and nobody else */
        ck_assert_int_eq(w[i].number == 0, pthread_equal(w[i].thread, pthread_self()) != 0);
    pool_free(&ctx, ctx.threads);
}
END_TEST

static void *run_jobs(void *arg)
{
    for (int i = 0; i < 100; i++)
        run_and_check(arg, i % 40, -1);
    return NULL;
}

START_TEST(several_threads_may_have_jobs_at_a_time)
{
    enum { OTHERS = 3 };
    context ctx = pool_context(3);
    pthread_t others[OTHERS];
    for (int i = 0; i < OTHERS; i++)
        ck_assert_int_eq(pthread_create(&others[i], NULL, run_jobs, &ctx), 0);
    run_jobs(&ctx);
    for (int i = 0; i < OTHERS; i++)
        pthread_join(others[i], NULL);
    pool_free(&ctx, ctx.threads);
}
END_TEST

typedef struct jobs_of_another {
    context *ctx;
    atomic_bool stop;
} jobs_of_another;

/* Without the assertions of libcheck, which have a lock of their own. */
static bool every_block_ran(context *ctx)
{
    job j = {.threads = context_threads(ctx), .slow = -1};
    bool good = true;
    pool_run(ctx, count_block, &j, BLOCKS);
    for (int32_t i = 0; i < BLOCKS; i++)
        good = good && j.times[i] == 1;
    return good;
}

static void *run_jobs_until_told(void *arg)
{
    jobs_of_another *other = arg;
    while (!atomic_load(&other->stop) && every_block_ran(other->ctx))
        ;
    return NULL;
}

/* A child of fork() has none of the workers, and the pool as they and others left it at that moment: held, perhaps. */
START_TEST(a_child_runs_its_blocks_and_frees_the_pool)
{
    enum { CHILDREN = 30 };
    context ctx = pool_context(4);
    jobs_of_another other = {&ctx, false};
    pthread_t thread;
    for (int i = 0; i < CHILDREN; i++) {
        if (i == CHILDREN / 2)
            ck_assert_int_eq(pthread_create(&thread, NULL, run_jobs_until_told, &other), 0);
        pause_for(i % 2 * 1000); /* the workers sleep, or look for work */
        pid_t child = fork();
        ck_assert_int_ge(child, 0);
        if (child == 0) {
            signal(SIGALRM, SIG_DFL); /* not libcheck's, which ends the whole test */
            alarm(60);
            bool good = every_block_ran(&ctx);
            good = every_block_ran(&ctx) && good; /* once more, after the first */
            pool_free(&ctx, ctx.threads);
            _exit(good ? 0 : 1);
        }
        int state = 0;
        ck_assert_int_eq(waitpid(child, &state, 0), child);
        ck_assert_msg(state == 0, "child %d ended with %d", i, state);
        run_and_check(&ctx, 40, -1);
    }
    atomic_store(&other.stop, true);
    pthread_join(thread, NULL);
    pool_free(&ctx, ctx.threads);
}
END_TEST

START_TEST(a_pool_without_memory_is_null)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        pool *p = pool_create(&turn.ctx, 3);
        turn.status = p ? FRAM_OK : FRAM_ERROR_MEMORY;
        pool_free(&turn.ctx, p);
    }
    context ctx;
    context_init(&ctx);
    pool *p = pool_create(&ctx, 0); /* the caller is always there */
    ck_assert_int_eq(pool_threads(p), 1);
    pool_free(&ctx, p);
    pool_free(&ctx, NULL);
}
END_TEST

/* Leaves this process `bytes` of address space for thread stacks; false where that cannot be told. */
static bool address_space_limit(size_t bytes)
{
    FILE *f = fopen("/proc/self/statm", "r");
    unsigned long pages = 0;
    if (!f || getenv("FRAM_TEST_SANITIZE")) { /* sanitizers map terabytes */
        if (f)
            fclose(f);
        return false;
    }
    bool known = fscanf(f, "%lu", &pages) == 1;
    fclose(f);
    size_t used = (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
    struct rlimit limit = {used + bytes, used + bytes};
    return known && setrlimit(RLIMIT_AS, &limit) == 0;
}

START_TEST(a_pool_makes_do_with_the_threads_there_are)
{
    context ctx;
    context_init(&ctx);
    if (!address_space_limit(40 << 20))
        return;
    ctx.threads = pool_create(&ctx, 64); /* stacks of 2 or 8 MB: some fit, not all */
    ck_assert_ptr_nonnull(ctx.threads);
    ck_assert_int_gt(pool_threads(ctx.threads), 1);
    ck_assert_int_lt(pool_threads(ctx.threads), 64);
    run_and_check(&ctx, BLOCKS, -1);
    pool_free(&ctx, ctx.threads);
}
END_TEST

START_TEST(a_pool_without_any_thread_is_null)
{
    failing_memory m;
    context ctx = failing_context(&m, 0);
    if (!address_space_limit(0))
        return;
    ck_assert_ptr_null(pool_create(&ctx, 2));
    ck_assert_int_eq(m.live, 0);
}
END_TEST

START_TEST(small_jobs_have_blocks_for_several_threads)
{
    for (int32_t count = 0; count < 20000; count += 7) {
        int32_t block = pool_block(count, 32, 512), blocks = count / block + (count % block != 0);
        ck_assert(block >= 32 && block <= 512 && block % 32 == 0);
        ck_assert_int_le(blocks, count < 8192 ? 16 : count / 512 + 1);
        ck_assert(count < 1024 || blocks >= 8);
    }
}
END_TEST

/* Looks for multiples of *arg beyond zero. */
static int32_t find_multiple(const void *arg, int32_t first, int32_t end)
{
    const int32_t *step = arg;
    for (int32_t i = first; i < end; i++)
        if (i > 0 && i % *step == 0)
            return i;
    return end;
}

START_TEST(the_least_is_found_on_any_threads)
{
    for (int threads = 1; threads <= 4; threads += 3) {
        context ctx;
        context_init(&ctx);
        ctx.threads = pool_create(&ctx, threads);
        static const int32_t steps[] = {1, 7, 1023, 1024, 1025, 2048, 30001, 49999};
        for (size_t k = 0; k < sizeof steps / sizeof *steps; k++)
            for (int again = 0; again < 20; again++)
                ck_assert_int_eq(pool_find(&ctx, find_multiple, &steps[k], 50000), steps[k]);
        int32_t none = 50000;
        ck_assert_int_eq(pool_find(&ctx, find_multiple, &none, 50000), 50000);
        ck_assert_int_eq(pool_find(&ctx, find_multiple, &none, 0), 0);
        pool_free(&ctx, ctx.threads);
    }
}
END_TEST

/* Picks multiples of *arg. */
static int32_t pick_multiples(const void *arg, int32_t first, int32_t end, int32_t *out)
{
    const int32_t *step = arg;
    int32_t found = 0;
    for (int32_t i = first; i < end; i++)
        if (i % *step == 0)
            out[found++] = i;
    return found;
}

START_TEST(what_is_picked_is_ascending_on_any_threads)
{
    enum { COUNT = 50000 };
    for (int threads = 1; threads <= 4; threads += 3) {
        context ctx;
        context_init(&ctx);
        ctx.threads = pool_create(&ctx, threads);
        int32_array picked = {0};
        static const int32_t steps[] = {1, 7, 2047, 2048, 2049, COUNT + 1};
        for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
            ck_assert(pool_pick(&ctx, pick_multiples, &steps[k], COUNT, &picked));
            ck_assert_int_eq(picked.count, (COUNT - 1) / steps[k] + 1);
            for (int32_t i = 0; i < picked.count; i++)
                ck_assert_int_eq(picked.data[i], steps[k] * i);
        }
        ck_assert(pool_pick(&ctx, pick_multiples, steps, 0, &picked));
        ck_assert_int_eq(picked.count, 0);
        array_free(&ctx, &picked);
        pool_free(&ctx, ctx.threads);
    }
}
END_TEST

TEST_MAIN("pool", what_is_picked_is_ascending_on_any_threads, the_least_is_found_on_any_threads, every_block_runs_once,
          many_small_jobs_follow_each_other, sleepers_wake_and_the_caller_waits, results_do_not_depend_on_threads,
          small_jobs_have_blocks_for_several_threads, a_single_block_runs_on_the_caller,
          several_threads_may_have_jobs_at_a_time, a_child_runs_its_blocks_and_frees_the_pool,
          a_pool_without_memory_is_null, a_pool_makes_do_with_the_threads_there_are, a_pool_without_any_thread_is_null)
