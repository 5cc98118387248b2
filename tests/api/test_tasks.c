/* fram_context_definition.parallel: a program runs Fram's tasks on threads of its own, to the same bits, and is held to
   the contract. */
#include "fram/live.h"
#include "testing.h"

#include <pthread.h>

enum { STEPS = 12, WORKERS_MOST = 5 };

/* Enough floes that every stage has more than one block, and floes that break. */
static const char scene[] = "run: {duration: 5, time_step: 0.02, seed: 5}\n"
                            "vessel:\n  mode: towed\n  speed: 3\n"
                            "  hull: {form: icebreaker, length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice: {concentration: 0.8, mean_floe_area: 16, thickness: 0.3, breakable: true}\n"
                            "domain: {x_min: -120, x_max: 120, y_min: -80, y_max: 80}\n";

static fram_error e;

/* ---- a pool of a program ---- */

typedef struct program_pool {
    pthread_t thread[WORKERS_MOST];
    int workers, started;
    pthread_mutex_t mutex;
    pthread_cond_t work, done;
    fram_task_function run;
    void *task;
    int blocks, next, unfinished;
    bool stop;
    long jobs, calls;
} program_pool;

/* Called with the mutex held, which it gives up while a block runs. */
static void take_blocks(program_pool *p, int worker)
{
    while (p->next < p->blocks) {
        int block = p->next++;
        pthread_mutex_unlock(&p->mutex);
        p->run(p->task, block, worker);
        pthread_mutex_lock(&p->mutex);
        p->calls++;
        if (--p->unfinished == 0)
            pthread_cond_broadcast(&p->done);
    }
}

static void *work(void *arg)
{
    program_pool *p = arg;
    pthread_mutex_lock(&p->mutex);
    int worker = ++p->started;
    while (!p->stop) {
        take_blocks(p, worker);
        if (!p->stop)
            pthread_cond_wait(&p->work, &p->mutex);
    }
    pthread_mutex_unlock(&p->mutex);
    return NULL;
}

/* The calling thread is worker 0, the others go from 1. */
static void run_on_pool(void *user, int blocks, fram_task_function run, void *task)
{
    program_pool *p = user;
    pthread_mutex_lock(&p->mutex);
    p->run = run;
    p->task = task;
    p->next = 0;
    p->blocks = p->unfinished = blocks;
    p->jobs++;
    pthread_cond_broadcast(&p->work);
    take_blocks(p, 0);
    while (p->unfinished > 0)
        pthread_cond_wait(&p->done, &p->mutex);
    p->blocks = 0;
    pthread_mutex_unlock(&p->mutex);
}

static void start_pool(program_pool *p, int workers)
{
    *p = (program_pool){.workers = workers};
    pthread_mutex_init(&p->mutex, NULL);
    pthread_cond_init(&p->work, NULL);
    pthread_cond_init(&p->done, NULL);
    for (int i = 1; i < workers; i++)
        ck_assert_int_eq(pthread_create(&p->thread[i], NULL, work, p), 0);
}

static void stop_pool(program_pool *p)
{
    pthread_mutex_lock(&p->mutex);
    p->stop = true;
    pthread_cond_broadcast(&p->work);
    pthread_mutex_unlock(&p->mutex);
    for (int i = 1; i < p->workers; i++)
        pthread_join(p->thread[i], NULL);
    pthread_cond_destroy(&p->done);
    pthread_cond_destroy(&p->work);
    pthread_mutex_destroy(&p->mutex);
}

/* The state hash after some steps, with the program's task system or, with NULL, one thread of Fram's. */
static uint64_t hash_with(int threads, fram_parallel_function parallel, void *user)
{
    fram_context *ctx;
    fram_scenario *s;
    fram_world *w;
    failing_memory memory;
    (void)failing_context(&memory, 0);
    fram_context_definition d;
    fram_context_default(&d);
    d.threads = threads;
    d.parallel = parallel;
    d.parallel_user = user;
    d.memory = failing_memory_resize;
    d.memory_user = &memory;
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, scene, NULL, NULL, 0, &s, &e), e);
    assert_ok(fram_world_create(s, &w, &e), e);
    for (int i = 0; i < STEPS; i++)
        assert_ok(fram_world_step(w, &e), e);
    uint64_t hash = fram_world_hash(w);
    fram_world_destroy(w);
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
    ck_assert_int_eq(memory.live, 0);
    return hash;
}

static void one_after_the_other(void *user, int blocks, fram_task_function run, void *task)
{
    (*(long *)user)++;
    for (int block = 0; block < blocks; block++)
        run(task, block, 0);
}

static void backwards_by_three(void *user, int blocks, fram_task_function run, void *task)
{
    (*(long *)user)++;
    for (int block = blocks; block-- > 0;)
        run(task, block, block % 3);
}

START_TEST(any_task_system_gives_the_same_bits)
{
    long jobs = 0;
    uint64_t own = hash_with(1, NULL, NULL);
    ck_assert_uint_eq(hash_with(3, NULL, NULL), own);
    ck_assert_uint_eq(hash_with(1, one_after_the_other, &jobs), own);
    ck_assert_int_gt(jobs, 4L * STEPS);
    ck_assert_uint_eq(hash_with(3, backwards_by_three, &jobs), own);
    for (int workers = 1; workers <= WORKERS_MOST; workers += 2) {
        program_pool p;
        start_pool(&p, workers);
        ck_assert_uint_eq(hash_with(workers, run_on_pool, &p), own);
        ck_assert_int_gt(p.calls, 2 * p.jobs); /* jobs of a single block are not handed out */
        stop_pool(&p);
    }
}
END_TEST

/* ---- several worlds of one context, each on a thread of its own ---- */

static void *step_world(void *world)
{
    for (int i = 0; i < STEPS; i++) {
        if (fram_world_step(world, NULL) != FRAM_OK)
            return NULL;
    }
    return world;
}

static void step_side_by_side(int threads, fram_parallel_function parallel, void *user, uint64_t expected)
{
    enum { WORLDS = 4 };
    fram_context *ctx;
    fram_scenario *s;
    fram_world *w[WORLDS];
    pthread_t thread[WORLDS];
    fram_context_definition d;
    fram_context_default(&d);
    d.threads = threads;
    d.parallel = parallel;
    d.parallel_user = user;
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, scene, NULL, NULL, 0, &s, &e), e);
    for (int i = 0; i < WORLDS; i++)
        assert_ok(fram_world_create(s, &w[i], &e), e);
    for (int i = 0; i < WORLDS; i++)
        ck_assert_int_eq(pthread_create(&thread[i], NULL, step_world, w[i]), 0);
    for (int i = 0; i < WORLDS; i++) {
        void *good;
        pthread_join(thread[i], &good);
        ck_assert_ptr_nonnull(good);
        ck_assert_uint_eq(fram_world_hash(w[i]), expected);
        fram_world_destroy(w[i]);
    }
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
}

START_TEST(worlds_of_a_context_may_be_stepped_side_by_side)
{
    uint64_t own = hash_with(1, NULL, NULL);
    program_pool p;
    step_side_by_side(1, NULL, NULL, own);
    step_side_by_side(2, NULL, NULL, own);
    start_pool(&p, 2);
    step_side_by_side(2, run_on_pool, &p, own);
    stop_pool(&p);
}
END_TEST

/* ---- misuse ---- */

typedef struct breaker {
    int kind; /* of breach */
    fram_task_function run;
    void *task;
} breaker;

static void break_the_contract(void *user, int blocks, fram_task_function run, void *task)
{
    breaker *b = user;
    for (int block = b->kind == 0; block < blocks; block++)
        run(task, block, b->kind == 1 ? 2 : 0);
    if (b->kind == 2)
        run(task, 0, 1);
    if (b->kind == 3)
        run(task, blocks, 1);
    b->run = run;
    b->task = task;
}

START_TEST(a_broken_contract_is_refused_and_harms_nothing)
{
    static const char *const words[] = {"before every block", "worker number", "twice", "outside of its job"};
    for (int kind = 0; kind < 5; kind++) {
        breaker b = {.kind = kind};
        fram_context *ctx;
        fram_scenario *s;
        fram_world *w;
        fram_context_definition d;
        fram_context_default(&d);
        d.threads = 2;
        d.parallel = break_the_contract;
        d.parallel_user = &b;
        assert_ok(fram_context_create(&d, &ctx, &e), e);
        assert_ok(fram_scenario_parse(ctx, scene, NULL, NULL, 0, &s, &e), e);
        assert_ok(fram_world_create(s, &w, &e), e);
        if (kind == 4) { /* a call between two steps */
            assert_ok(fram_world_step(w, &e), e);
            b.run(b.task, 0, 0);
        }
        ck_assert_int_eq(fram_world_step(w, &e), FRAM_ERROR_USAGE);
        ck_assert_str_eq(e.key, "parallel");
        ck_assert_msg(strstr(e.message, words[kind < 4 ? kind : 3]), "%s", e.message);
        ck_assert(isfinite(fram_world_value(w, fram_world_find_channel(w, "ice_force_x"))));
        ck_assert_int_eq(fram_world_step(w, &e), FRAM_ERROR_USAGE);
        fram_world_destroy(w);
        fram_scenario_destroy(s);
        fram_context_destroy(ctx);
    }
}
END_TEST

START_TEST(the_definition_is_checked)
{
    long jobs = 0;
    fram_context *ctx;
    fram_context_definition d;
    fram_context_default(&d);
    ck_assert(!d.parallel);
    d.parallel = one_after_the_other;
    d.parallel_user = &jobs;
    static const int wrong[] = {0, -1, 257};
    for (int i = 0; i < 3; i++) {
        d.threads = wrong[i];
        ck_assert_int_eq(fram_context_create(&d, &ctx, &e), FRAM_ERROR_USAGE);
        ck_assert_str_eq(e.key, "threads");
    }
    /* An older program knows no such member, whatever stands behind its definition. */
    d.threads = 2;
    d.size = offsetof(fram_context_definition, parallel);
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    fram_context_destroy(ctx);
}
END_TEST

TEST_MAIN("tasks", any_task_system_gives_the_same_bits, worlds_of_a_context_may_be_stepped_side_by_side,
          a_broken_contract_is_refused_and_harms_nothing, the_definition_is_checked)
