/* What every test program shares: assertions that check lacks, a main(), and a context whose memory runs out on demand.
   Knows libcheck and base; must not know any other room.

   A test program is
       #include "testing.h"
       START_TEST(square_has_area_one) { assert_absolute(area(square), 1, 1e-15); } END_TEST
       TEST_MAIN("polygon", square_has_area_one)
   TEST_MAIN lists every START_TEST of the file: an unlisted one is an unused variable, which the compiler reports. */
#ifndef TESTING_H
#define TESTING_H

#include "base/context.h"
#include "base/vec.h"
#include <check.h>
#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Seconds after which a test counts as hung (check's own 4 are too few for a sanitizer on a busy machine). */
#define TEST_TIMEOUT 300

#define TEST_MAIN(name, ...)                                                 \
    int main(void)                                                           \
    {                                                                        \
        const TTest *const list[] = {__VA_ARGS__};                           \
        return testing_run((name), list, (int)(sizeof list / sizeof *list)); \
    }

/* Whether a test runs in this build.  ThreadSanitizer is slow and finds nothing without threads: where a file has tests
   with "thread" in their names, it runs these alone. */
static inline bool testing_runs(const TTest *test, bool named)
{
#ifdef __SANITIZE_THREAD__
    return !named || strstr(test->name, "thread") != NULL;
#else
    return test != NULL || named;
#endif
}

static inline int testing_run(const char *name, const TTest *const *tests, int count)
{
    Suite *suite = suite_create(name);
    TCase *group = tcase_create(name);
    tcase_set_timeout(group, TEST_TIMEOUT);
    bool named = false;
    for (int i = 0; i < count; i++)
        named = named || strstr(tests[i]->name, "thread") != NULL;
    for (int i = 0; i < count; i++) {
        if (testing_runs(tests[i], named))
            tcase_add_test(group, tests[i]);
    }
    suite_add_tcase(suite, group);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

/* ---- assertions of the library, in builds that have them: debug, sanitizers, fuzzing ---- */

#ifdef NDEBUG
enum { TESTING_ASSERTIONS = 0 };
#else
enum { TESTING_ASSERTIONS = 1 };
#endif

/* Whether a call ends by a failed assertion; made in a process of its own. */
static inline bool testing_aborts(void (*call)(void *), void *user)
{
    pid_t child = fork();
    ck_assert_int_ge(child, 0);
    if (child == 0) {
        struct rlimit no_core = {0, 0};
        (void)setrlimit(RLIMIT_CORE, &no_core);
        (void)!freopen("/dev/null", "w", stderr);
        signal(SIGABRT, SIG_DFL);
        call(user);
        _exit(0);
    }
    int state = 0;
    ck_assert_int_eq(waitpid(child, &state, 0), child);
    return WIFSIGNALED(state) && WTERMSIG(state) == SIGABRT;
}

#define assert_aborts(call, user) \
    ck_assert_msg(testing_aborts((call), (user)), "%s(%s) fails no assertion", #call, #user)

/* As TEST_MAIN, skipped in builds without assertions. */
#define TEST_MAIN_OF_ASSERTIONS(name, ...)                                       \
    int main(void)                                                               \
    {                                                                            \
        const TTest *const list[] = {__VA_ARGS__};                               \
        if (TESTING_ASSERTIONS)                                                  \
            return testing_run((name), list, (int)(sizeof list / sizeof *list)); \
        puts("skipped: a build without assertions");                             \
        return 77;                                                               \
    }

/* ---- doubles.  A NaN on either side fails every closeness assertion; equal infinities are close. ---- */

static inline bool testing_close(double actual, double expected, double tolerance)
{
    return actual == expected || (isfinite(tolerance) && fabs(actual - expected) <= tolerance);
}

/* The larger and the smaller of two, and a NaN where either is one: fmax and fmin pass over it, and the worst of many
   errors would be that of the others. */
static inline double testing_larger(double a, double b) { return isnan(a) || a > b ? a : b; }
static inline double testing_smaller(double a, double b) { return isnan(a) || a < b ? a : b; }

static inline bool testing_same_bits(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }

/* Kinds of comparison of testing_first_apart. */
enum { TESTING_ABSOLUTE, TESTING_RELATIVE, TESTING_BITS };

/* Index of the first pair that differs, or -1. */
static inline long testing_first_apart(const double *actual, const double *expected, long n, int kind, double tolerance)
{
    for (long i = 0; i < n; i++) {
        double bound = kind == TESTING_RELATIVE ? tolerance * fabs(expected[i]) : tolerance;
        bool same = kind == TESTING_BITS ? testing_same_bits(actual[i], expected[i])
                                         : testing_close(actual[i], expected[i], bound);
        if (!same)
            return i;
    }
    return -1;
}

#define TESTING_ARRAY(actual, expected, n, kind, tolerance)                                                          \
    do {                                                                                                             \
        const double *actual_values_ = (actual), *expected_values_ = (expected);                                     \
        double bound_ = (tolerance);                                                                                 \
        long apart_ = testing_first_apart(actual_values_, expected_values_, (long)(n), (kind), bound_);              \
        ck_assert_msg(apart_ < 0, "%s[%ld] is %.17g (%a), expected %.17g (%a), tolerance %g", #actual, apart_,       \
                      actual_values_[apart_ < 0 ? 0 : apart_], actual_values_[apart_ < 0 ? 0 : apart_],              \
                      expected_values_[apart_ < 0 ? 0 : apart_], expected_values_[apart_ < 0 ? 0 : apart_], bound_); \
    } while (0)

#define TESTING_DOUBLE(actual, expected, kind, tolerance)                                                           \
    do {                                                                                                            \
        double actual_value_ = (actual), expected_value_ = (expected), bound_ = (tolerance);                        \
        ck_assert_msg(testing_first_apart(&actual_value_, &expected_value_, 1, (kind), bound_) < 0,                 \
                      "%s is %.17g (%a), expected %.17g (%a), tolerance %g", #actual, actual_value_, actual_value_, \
                      expected_value_, expected_value_, bound_);                                                    \
    } while (0)

/* |actual - expected| <= tolerance */
#define assert_absolute(actual, expected, tolerance) TESTING_DOUBLE(actual, expected, TESTING_ABSOLUTE, tolerance)
/* |actual - expected| <= tolerance |expected| */
#define assert_relative(actual, expected, tolerance) TESTING_DOUBLE(actual, expected, TESTING_RELATIVE, tolerance)
/* The same 64 bits: -0 is not 0, and a NaN equals itself. */
#define assert_bits(actual, expected) TESTING_DOUBLE(actual, expected, TESTING_BITS, 0)

/* The same for arrays of n doubles (any struct of doubles too, by the address of its first member). */
#define assert_array_absolute(actual, expected, n, tolerance) \
    TESTING_ARRAY(actual, expected, n, TESTING_ABSOLUTE, tolerance)
#define assert_array_relative(actual, expected, n, tolerance) \
    TESTING_ARRAY(actual, expected, n, TESTING_RELATIVE, tolerance)
#define assert_array_bits(actual, expected, n) TESTING_ARRAY(actual, expected, n, TESTING_BITS, 0)

/* Every component within the absolute tolerance. */
#define assert_vec2_close(actual, expected, tolerance)                                                       \
    do {                                                                                                     \
        vec2 actual_vec_ = (actual), expected_vec_ = (expected);                                             \
        double tolerance_ = (tolerance);                                                                     \
        ck_assert_msg(testing_close(actual_vec_.x, expected_vec_.x, tolerance_) &&                           \
                          testing_close(actual_vec_.y, expected_vec_.y, tolerance_),                         \
                      "%s is (%.17g, %.17g), expected (%.17g, %.17g), tolerance %g", #actual, actual_vec_.x, \
                      actual_vec_.y, expected_vec_.x, expected_vec_.y, tolerance_);                          \
    } while (0)

#define assert_vec3_close(actual, expected, tolerance)                                                                \
    do {                                                                                                              \
        vec3 actual_vec_ = (actual), expected_vec_ = (expected);                                                      \
        double tolerance_ = (tolerance);                                                                              \
        ck_assert_msg(testing_close(actual_vec_.x, expected_vec_.x, tolerance_) &&                                    \
                          testing_close(actual_vec_.y, expected_vec_.y, tolerance_) &&                                \
                          testing_close(actual_vec_.z, expected_vec_.z, tolerance_),                                  \
                      "%s is (%.17g, %.17g, %.17g), expected (%.17g, %.17g, %.17g), tolerance %g", #actual,           \
                      actual_vec_.x, actual_vec_.y, actual_vec_.z, expected_vec_.x, expected_vec_.y, expected_vec_.z, \
                      tolerance_);                                                                                    \
    } while (0)

/* ---- statuses ---- */

/* The call returned FRAM_OK; otherwise shows what `error` (a fram_error, not a pointer) says. */
#define assert_ok(call, error)                                                                                \
    do {                                                                                                      \
        fram_status status_ = (call);                                                                         \
        ck_assert_msg(status_ == FRAM_OK, "%s returned %d: %s:%d: %s: %s", #call, (int)status_, (error).file, \
                      (error).line, (error).key, (error).message);                                            \
    } while (0)

/* The call returned `expected` and the error's message contains `part`. */
#define assert_fails(call, error, expected, part)                                                                      \
    do {                                                                                                               \
        fram_status status_ = (call);                                                                                  \
        ck_assert_msg(status_ == (expected) && (error).status == status_, "%s returned %d (error says %d): %s", #call, \
                      (int)status_, (int)(error).status, (error).message);                                             \
        ck_assert_msg(strstr((error).message, (part)) != NULL, "%s: message '%s' lacks '%s'", #call, (error).message,  \
                      (part));                                                                                         \
    } while (0)

/* ---- a context whose n-th request for memory fails ---- */

/* Counters are atomic, because threads of a pool may allocate. */
typedef struct failing_memory {
    atomic_long requests; /* allocations and resizes so far */
    atomic_long live;     /* blocks handed out and not freed */
    long fail_at;         /* the request that fails, from 1; 0: none */
    atomic_bool failed;   /* it did */
} failing_memory;

static inline void *failing_memory_resize(void *user, void *ptr, size_t size)
{
    failing_memory *m = user;
    if (size == 0) {
        if (ptr)
            atomic_fetch_sub(&m->live, 1);
        free(ptr);
        return NULL;
    }
    if (atomic_fetch_add(&m->requests, 1) + 1 == m->fail_at) {
        atomic_store(&m->failed, true);
        return NULL;
    }
    void *moved = realloc(ptr, size);
    if (moved && !ptr)
        atomic_fetch_add(&m->live, 1);
    return moved;
}

/* A default context that draws from `m`, which must outlive it.  fail_at 0 never fails and only counts. */
static inline context failing_context(failing_memory *m, long fail_at)
{
    context ctx;
    context_init(&ctx);
    m->fail_at = fail_at;
    atomic_init(&m->requests, 0);
    atomic_init(&m->live, 0);
    atomic_init(&m->failed, false);
    ctx.memory = failing_memory_resize;
    ctx.memory_user = m;
    return ctx;
}

/* Every function that allocates is tested with each of its requests failing in turn:
       for (failing_turn turn = {0}; failing_next(&turn);) {
           turn.status = ...;                            (the call with &turn.ctx, then free what it made)
       }
   Nothing may be left, and the status says whether a request failed; the turn in which none did is the last. */
typedef struct failing_turn {
    long n;                /* the request that fails, from 1 */
    long stride;           /* from it to that of the next turn; 0: 1 */
    failing_memory memory; /* what `ctx` draws from */
    context ctx;
    fram_error error;   /* for the call; empty at first */
    fram_status status; /* what the call returned; the test sets it */
} failing_turn;

/* Judges the turn that ended, if one did; false: it was the last. */
static inline bool failing_next(failing_turn *t)
{
    if (t->n > 0) {
        fram_status expected = t->memory.failed ? FRAM_ERROR_MEMORY : FRAM_OK;
        ck_assert_msg(t->memory.live == 0, "request %ld: %ld blocks not freed", t->n, (long)t->memory.live);
        ck_assert_msg(t->status == expected, "request %ld: status %d, expected %d: %s", t->n, (int)t->status,
                      (int)expected, t->error.message);
        if (!t->memory.failed)
            return false;
    }
    t->n += t->n > 0 && t->stride > 0 ? t->stride : 1;
    t->ctx = failing_context(&t->memory, t->n);
    t->error = (fram_error){0};
    t->status = FRAM_ERROR_INTERNAL;
    return true;
}

#endif
