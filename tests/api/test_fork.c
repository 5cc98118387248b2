/* A child of fork() has its parent's worlds without the parent's threads: they go on in it, to the same bits, and are
   destroyed, whatever these threads were at when it came to be. */
#include "fram/live.h"
#include "testing.h"

#include <pthread.h>
#include <time.h>

enum { BEFORE = 2, STEPS = 8, CHILDREN = 12 };
/* Exit codes of a child. */
enum { CHILD_GOOD, CHILD_BAD_STEP, CHILD_OTHER_BITS, CHILD_NO_NEW_CONTEXT };

/* Enough floes that every stage has more than one block, and floes that break. */
static const char scene[] = "run: {duration: 5, time_step: 0.02, seed: 5}\n"
                            "vessel:\n  mode: towed\n  speed: 3\n"
                            "  hull: {form: icebreaker, length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice: {concentration: 0.8, mean_floe_area: 16, thickness: 0.3, breakable: true}\n"
                            "domain: {x_min: -120, x_max: 120, y_min: -80, y_max: 80}\n";

static fram_error e;

static void pause_for(long microseconds) { nanosleep(&(struct timespec){.tv_nsec = microseconds * 1000}, NULL); }

typedef struct set {
    fram_context *ctx;
    fram_scenario *scenario;
    fram_world *world;
} set;

static fram_status make_set(int threads, fram_parallel_function parallel, void *user, set *out)
{
    fram_context_definition d;
    fram_context_default(&d);
    d.threads = threads;
    d.parallel = parallel;
    d.parallel_user = user;
    fram_status status = fram_context_create(&d, &out->ctx, &e);
    if (status == FRAM_OK)
        status = fram_scenario_parse(out->ctx, scene, NULL, NULL, 0, &out->scenario, &e);
    return status == FRAM_OK ? fram_world_create(out->scenario, &out->world, &e) : status;
}

static void destroy_set(set *all)
{
    fram_world_destroy(all->world);
    fram_scenario_destroy(all->scenario);
    fram_context_destroy(all->ctx);
}

static fram_status step(fram_world *w, int steps)
{
    fram_status status = FRAM_OK;
    for (int i = 0; i < steps && status == FRAM_OK; i++)
        status = fram_world_step(w, &e);
    return status;
}

static uint64_t hash_alone(void)
{
    set one;
    assert_ok(make_set(1, NULL, NULL, &one), e);
    assert_ok(step(one.world, BEFORE + STEPS), e);
    uint64_t hash = fram_world_hash(one.world);
    destroy_set(&one);
    return hash;
}

/* Contexts of the child's own have threads.  ThreadSanitizer starts none there. */
static bool new_context_works(uint64_t expected)
{
#ifdef __SANITIZE_THREAD__
    return expected != 0;
#else
    set fresh;
    bool good = make_set(3, NULL, NULL, &fresh) == FRAM_OK && step(fresh.world, BEFORE + STEPS) == FRAM_OK &&
                fram_world_hash(fresh.world) == expected;
    destroy_set(&fresh);
    return good;
#endif
}

static int go_on(set *all, uint64_t expected, bool whole)
{
    if (step(all->world, STEPS) != FRAM_OK)
        return CHILD_BAD_STEP;
    if (fram_world_hash(all->world) != expected)
        return CHILD_OTHER_BITS;
    /* A world that another thread stepped stays half done. */
    if (whole)
        destroy_set(all);
    return new_context_works(expected) ? CHILD_GOOD : CHILD_NO_NEW_CONTEXT;
}

static void fork_and_check(set *all, uint64_t expected, bool whole)
{
    pid_t child = fork();
    ck_assert_int_ge(child, 0);
    if (child == 0) {
        signal(SIGALRM, SIG_DFL); /* not that of libcheck, which ends the test */
        alarm(60);
        _exit(go_on(all, expected, whole));
    }
    int state = 0;
    ck_assert_int_eq(waitpid(child, &state, 0), child);
    ck_assert_msg(WIFEXITED(state) && WEXITSTATUS(state) == CHILD_GOOD, "the child ended with %d", state);
}

START_TEST(worlds_go_on_in_a_child_whose_parent_has_threads)
{
    uint64_t expected = hash_alone();
    for (int i = 0; i < CHILDREN; i++) {
        set all;
        assert_ok(make_set(2 + i % 3, NULL, NULL, &all), e);
        assert_ok(step(all.world, BEFORE), e);
        if (i % 2 == 0)
            pause_for(3000); /* so that they sleep */
        fork_and_check(&all, expected, true);
        /* The parent's own go on as if nothing had been. */
        assert_ok(step(all.world, STEPS), e);
        ck_assert_uint_eq(fram_world_hash(all.world), expected);
        destroy_set(&all);
    }
}
END_TEST

/* ---- while another thread of the parent has these threads at work ---- */

/* AddressSanitizer's allocator does not let go of its locks in a child of fork, where another thread held one. */
#ifdef __SANITIZE_ADDRESS__
enum { FORKS_BESIDE_STEPS = 0 };
#else
enum { FORKS_BESIDE_STEPS = CHILDREN };
#endif

typedef struct stepper {
    fram_world *world;
    atomic_bool stop;
    atomic_int steps;
} stepper;

static void *step_until_told(void *user)
{
    stepper *s = user;
    while (!atomic_load(&s->stop) && fram_world_step(s->world, NULL) == FRAM_OK)
        atomic_fetch_add(&s->steps, 1);
    return NULL;
}

START_TEST(other_threads_may_step_when_a_child_comes_to_be)
{
    uint64_t expected = hash_alone();
    set all;
    pthread_t thread;
    assert_ok(make_set(4, NULL, NULL, &all), e);
    stepper other = {0};
    assert_ok(fram_world_create(all.scenario, &other.world, &e), e);
    assert_ok(step(all.world, BEFORE), e);
    ck_assert_int_eq(pthread_create(&thread, NULL, step_until_told, &other), 0);
    for (int i = 0; i < FORKS_BESIDE_STEPS; i++) {
        int begun = atomic_load(&other.steps);
        while (i < 3 && atomic_load(&other.steps) == begun)
            pause_for(100);
        fork_and_check(&all, expected, false);
    }
    atomic_store(&other.stop, true);
    pthread_join(thread, NULL);
    fram_world_destroy(other.world);
    destroy_set(&all);
}
END_TEST

/* ---- a task system of the program's, whose threads are the parent's too ---- */

static pid_t owner;

static void run_in_owner(void *user, int blocks, fram_task_function run, void *task)
{
    (void)user;
    while (getpid() != owner)
        pause();
    for (int block = 0; block < blocks; block++)
        run(task, block, 0);
}

START_TEST(a_task_system_is_not_called_in_a_child)
{
    uint64_t expected = hash_alone();
    set all;
    owner = getpid();
    assert_ok(make_set(2, run_in_owner, NULL, &all), e);
    assert_ok(step(all.world, BEFORE), e);
    fork_and_check(&all, expected, true);
    destroy_set(&all);
}
END_TEST

TEST_MAIN("fork", worlds_go_on_in_a_child_whose_parent_has_threads, other_threads_may_step_when_a_child_comes_to_be,
          a_task_system_is_not_called_in_a_child)
