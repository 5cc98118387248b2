/* bindings/fmi: instances of both versions from one binary are the world that they carry, one call after another, in
   any order and with any arguments, and in threads.  The scripts beside this try whole units; here sanitizers see it.
 */
/* feenableexcept is of GNU */
#define _GNU_SOURCE
#include "../../bindings/fmi/fmi2.h"
#include "../../bindings/fmi/fmi3.h"
#include "base/random.h"
#include "fram/live.h"
#include "scratch.h"

#include <dlfcn.h>
#include <fenv.h>
#include <pthread.h>

enum { THREADS = 4, STEPS = 40, KEPT = 3, REFERENCES = 7 };
static const double dt = 0.05;
static const char token[] = "{11111111-2222-3333-4444-555555555555}";
static const char variables[] = "input wind_x\ninput positioning\ninput thruster_1_order\noutput position_x\n"
                                "output velocity_y\noutput kinetic_energy\ntime time\n";
enum { WIND, POSITIONING, ORDER, POSITION, VELOCITY, ENERGY, TIME }; /* value references */
static const char scene[] = "run: {duration: 10, time_step: 0.05}\n"
                            "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "  thrusters: [{x: 18}, {x: -18}]\n  positioning: {active: true}\n"
                            "ice: {source: voronoi, concentration: 0.5, mean_floe_area: 200}\n"
                            "domain: {x_min: -60, x_max: 60, y_min: -40, y_max: 40, boundary: open}\n"
                            "environment: {current_speed: 0.5}\n";

typedef void (*any_function)(void);

/* A function of the unit's binary, which no test is linked to. */
static any_function function_of(const char *name)
{
    static void *binary;
    char path[400];
    const char *build = getenv("FRAM_BUILD");
    if (!binary) {
        snprintf(path, sizeof path, "%s/fram_fmu.so", build ? build : ".");
        binary = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        ck_assert_msg(binary != NULL, "%s: %s", path, dlerror());
    }
    void *found = dlsym(binary, name);
    any_function function;
    ck_assert_msg(found != NULL, "%s", name);
    memcpy(&function, &found, sizeof function);
    return function;
}
#define CALL(name) ((__typeof__(&name))function_of(#name))

static char folder[SCRATCH_FOLDER];

static void write_text(const char *name, const char *text, const char *more)
{
    char all[4096];
    ck_assert_int_lt(snprintf(all, sizeof all, "%s%s", text, more), (int)sizeof all);
    scratch_put(folder, name, all);
}

/* A folder of resources, with a trailing slash as 3.0 wants it. */
static void make_resources(void)
{
    char list[400];
    scratch_folder(folder);
    write_text("scenario.yaml", scene, "");
    snprintf(list, sizeof list, "%s\n", token);
    write_text("variables.txt", list, variables);
}

static void remove_resources(void) { scratch_remove_folder(folder); }

static void log_3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String text)
{
    int *errors = environment;
    ck_assert(category && text && text[0]);
    *errors += status == fmi3Error;
}

static void log_2(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                  fmi2String form, ...)
{
    int *errors = environment;
    ck_assert(name && category && form);
    *errors += status == fmi2Error;
}

static fmi3Instance make_3(int *errors, fmi3IntermediateUpdateCallback look)
{
    static const fmi3ValueReference looked_at[] = {POSITION, TIME};
    char path[320];
    snprintf(path, sizeof path, "%s/", folder);
    return CALL(fmi3InstantiateCoSimulation)("ship #3", token, path, false, true, false, true, looked_at, 2, errors,
                                             log_3, look);
}

/* NOLINTNEXTLINE(readability-non-const-parameter): the log counts there */
static fmi2Component make_2(int *errors)
{
    char uri[320];
    snprintf(uri, sizeof uri, "file://%s", folder);
    const fmi2CallbackFunctions functions = {.logger = log_2, .componentEnvironment = errors};
    return CALL(fmi2Instantiate)("ship #2", fmi2CoSimulation, token, uri, &functions, fmi2False, fmi2True);
}

static double order_of(int step) { return 2e4 * (step % 7 - 3); }

static const fmi3ValueReference orders[] = {POSITIONING, ORDER};
static const fmi3ValueReference seen[] = {POSITION, VELOCITY, ENERGY};

/* Time of the importer as a unit has it, whatever the importer rounds to. */
static double time_after(int steps)
{
    fenv_t own;
    fegetenv(&own);
    fesetenv(FE_DFL_ENV);
    volatile double time = steps * dt;
    time = 3 + time;
    fesetenv(&own);
    return time;
}

/* `steps` steps of an instance of 3.0, the outputs of each appended to out. */
static void run_3(fmi3Instance c, int steps, double *out)
{
    ck_assert_int_eq(CALL(fmi3EnterInitializationMode)(c, false, 0, 3, true, 3 + steps * dt), fmi3OK);
    ck_assert_int_eq(CALL(fmi3ExitInitializationMode)(c), fmi3OK);
    for (int i = 0; i < steps; i++) {
        const double values[] = {0, order_of(i)};
        bool event, end, early;
        double reached, time;
        ck_assert_int_eq(CALL(fmi3SetFloat64)(c, orders, 2, values, 2), fmi3OK);
        ck_assert_int_eq(CALL(fmi3DoStep)(c, 3 + i * dt, dt, true, &event, &end, &early, &reached), fmi3OK);
        ck_assert_int_eq(CALL(fmi3GetFloat64)(c, &(fmi3ValueReference){TIME}, 1, &time, 1), fmi3OK);
        ck_assert(!event && !end && !early && reached == time_after(i + 1) && time == reached);
        ck_assert_int_eq(CALL(fmi3GetFloat64)(c, seen, 3, out + (ptrdiff_t)3 * i, 3), fmi3OK);
    }
}

/* The same by a world of this program. */
static uint64_t run_world(int steps, double *out)
{
    fram_error e;
    fram_context *ctx;
    fram_scenario *s;
    fram_world *w;
    char path[340];
    snprintf(path, sizeof path, "%s/scenario.yaml", folder);
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    assert_ok(fram_scenario_load(ctx, path, NULL, 0, &s, &e), e);
    assert_ok(fram_world_create(s, &w, &e), e);
    static const char *const names[] = {"position_x", "velocity_y", "kinetic_energy"};
    for (int i = 0; i < steps; i++) {
        if (i == 0)
            assert_ok(fram_world_set_input(w, fram_world_find_input(w, "positioning"), 0, &e), e);
        assert_ok(fram_world_set_input(w, fram_world_find_input(w, "thruster_1_order"), order_of(i), &e), e);
        assert_ok(fram_world_step(w, &e), e);
        for (int k = 0; k < 3; k++)
            out[3 * i + k] = fram_world_value(w, fram_world_find_channel(w, names[k]));
    }
    uint64_t hash = fram_world_hash(w);
    fram_world_destroy(w);
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
    return hash;
}

static void begin_2(fmi2Component c, double start)
{
    ck_assert_int_eq(CALL(fmi2SetupExperiment)(c, fmi2False, 0, start, fmi2False, 0), fmi2OK);
    ck_assert_int_eq(CALL(fmi2EnterInitializationMode)(c), fmi2OK);
    ck_assert_int_eq(CALL(fmi2ExitInitializationMode)(c), fmi2OK);
}

START_TEST(both_versions_are_the_world)
{
    make_resources();
    int errors = 0;
    double expected[3 * STEPS], found[3 * STEPS];
    run_world(STEPS, expected);
    ck_assert(expected[3 * STEPS - 1] != 0 && expected[0] != expected[3 * STEPS - 3]);
    fmi3Instance three = make_3(&errors, NULL);
    fmi2Component two = make_2(&errors);
    ck_assert(three && two);
    run_3(three, STEPS, found);
    ck_assert_mem_eq(found, expected, sizeof found);
    begin_2(two, 0);
    for (int i = 0; i < STEPS; i++) {
        const double values[] = {0, order_of(i)};
        ck_assert_int_eq(CALL(fmi2SetReal)(two, orders, 2, values), fmi2OK);
        ck_assert_int_eq(CALL(fmi2DoStep)(two, i * dt, dt, fmi2True), fmi2OK);
        ck_assert_int_eq(CALL(fmi2GetReal)(two, seen, 3, found + (ptrdiff_t)3 * i), fmi2OK);
    }
    ck_assert_mem_eq(found, expected, sizeof found);
    ck_assert_int_eq(errors, 0);
    CALL(fmi3FreeInstance)(three);
    CALL(fmi2FreeInstance)(two);
    remove_resources();
}
END_TEST

/* ---- an importer that computes in its own way ---- */

enum { TRAPPED = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW };

/* NOLINTBEGIN(readability-non-const-parameter): of the standard's type */
static void look_upward(fmi3InstanceEnvironment environment, fmi3Float64 time, fmi3Boolean may_set, fmi3Boolean may_get,
                        fmi3Boolean is_done, fmi3Boolean may_return, fmi3Boolean *wanted, fmi3Float64 *wanted_time)
{
    (void)environment, (void)time, (void)may_set, (void)may_get, (void)is_done, (void)may_return;
    (void)wanted, (void)wanted_time;
    ck_assert_int_eq(fegetround(), FE_UPWARD);
    ck_assert_int_eq(fegetexcept(), TRAPPED);
}
/* NOLINTEND(readability-non-const-parameter) */

/* A state through bytes, and back to it. */
static void there_and_back(fmi3Instance c)
{
    fmi3FMUState state = NULL, again = NULL;
    size_t size;
    ck_assert_int_eq(CALL(fmi3GetFMUState)(c, &state), fmi3OK);
    ck_assert_int_eq(CALL(fmi3SerializedFMUStateSize)(c, state, &size), fmi3OK);
    unsigned char *bytes = malloc(size);
    ck_assert_ptr_nonnull(bytes);
    ck_assert_int_eq(CALL(fmi3SerializeFMUState)(c, state, bytes, size), fmi3OK);
    ck_assert_int_eq(CALL(fmi3DeserializeFMUState)(c, bytes, size, &again), fmi3OK);
    ck_assert_int_eq(CALL(fmi3SetFMUState)(c, again), fmi3OK);
    free(bytes);
}

/* Refused, as no stop time is after or before it. */
static void stop_at_no_number(fmi3Instance three, fmi2Component two)
{
    ck_assert_int_eq(CALL(fmi3EnterInitializationMode)(three, false, 0, 3, true, (double)NAN), fmi3Error);
    ck_assert_int_eq(CALL(fmi3Reset)(three), fmi3OK);
    ck_assert_int_eq(CALL(fmi2SetupExperiment)(two, fmi2False, 0, 3, fmi2True, (double)NAN), fmi2Error);
    ck_assert_int_eq(CALL(fmi2Reset)(two), fmi2OK);
}

/* Importers that trap exceptions of floating point or round upwards neither end by a signal nor get other numbers. */
START_TEST(an_importer_has_its_own_arithmetic)
{
    make_resources();
    int errors = 0;
    double expected[3 * STEPS], found[3 * STEPS];
    run_world(STEPS, expected);
    fesetround(FE_UPWARD);
    feenableexcept(TRAPPED);
    fmi3Instance c = make_3(&errors, look_upward);
    fmi2Component two = make_2(&errors);
    ck_assert(c && two);
    stop_at_no_number(c, two);
    begin_2(two, 3);
    double reached;
    ck_assert_int_eq(CALL(fmi2DoStep)(two, 3, dt, fmi2True), fmi2OK);
    ck_assert_int_eq(CALL(fmi2GetRealStatus)(two, fmi2LastSuccessfulTime, &reached), fmi2OK);
    ck_assert(reached == time_after(1));
    CALL(fmi2FreeInstance)(two);
    for (int time = 0; time < 2; time++) {
        memset(found, 0, sizeof found);
        run_3(c, STEPS, found);
        ck_assert_mem_eq(found, expected, sizeof found);
        there_and_back(c);
        ck_assert_int_eq(CALL(fmi3Reset)(c), fmi3OK);
    }
    CALL(fmi3FreeInstance)(c);
    ck_assert_int_eq(fegetround(), FE_UPWARD);
    ck_assert_int_eq(fegetexcept(), TRAPPED);
    fesetenv(FE_DFL_ENV);
    ck_assert_int_eq(errors, 2); /* the stop times */
    remove_resources();
}
END_TEST

/* ---- any call, in any order ---- */

typedef struct caller {
    fmi3Instance c;
    int errors, looks; /* the log is handed the address of errors */
    random_stream rng;
    fmi3FMUState kept[KEPT]; /* some of them are no states */
    unsigned char bytes[1 << 18];
    size_t size;
    double now; /* where the unit stands, unless an error told otherwise */
} caller;

static double draw(caller *a, double most) { return random_unit(&a->rng) * most; }
static size_t pick(caller *a, size_t count) { return (size_t)draw(a, (double)count); }

static double some_number(caller *a)
{
    const double numbers[] = {0, 1, -1, dt, 3 * dt, 1e5, -1e300, (double)NAN, (double)INFINITY, a->now};
    return numbers[pick(a, sizeof numbers / sizeof *numbers)];
}

static fmi3Status some_values(caller *a, bool set)
{
    fmi3ValueReference references[4];
    double values[4];
    size_t count = pick(a, 5);
    bool is_odd = pick(a, 6) == 0;
    for (size_t i = 0; i < 4; i++) {
        references[i] = is_odd ? (fmi3ValueReference)(pick(a, 9) - 1) : (fmi3ValueReference)(set ? i % 3 : pick(a, 7));
        values[i] = is_odd ? some_number(a) : references[i] == POSITIONING ? 0 : draw(a, 5);
    }
    const fmi3ValueReference *from = pick(a, 30) == 0 ? NULL : references;
    size_t values_count = pick(a, 20) == 0 ? count + 1 : count;
    return set ? CALL(fmi3SetFloat64)(a->c, from, count, pick(a, 30) == 0 ? NULL : values, values_count)
               : CALL(fmi3GetFloat64)(a->c, from, count, pick(a, 30) == 0 ? NULL : values, values_count);
}

static fmi3Status some_step(caller *a)
{
    bool event, end, early;
    bool is_odd = pick(a, 5) == 0;
    double now = is_odd ? some_number(a) : a->now, step = is_odd ? some_number(a) : dt * (double)(1 + pick(a, 3));
    double reached = a->now;
    fmi3Status status =
        CALL(fmi3DoStep)(a->c, now, step, pick(a, 2) == 0, &event, &end, pick(a, 30) == 0 ? NULL : &early, &reached);
    if (isfinite(reached))
        a->now = reached;
    return status;
}

static fmi3Status some_state(caller *a)
{
    fmi3FMUState *state = &a->kept[pick(a, KEPT)];
    switch (pick(a, 8)) {
    case 0:
    case 1:
        return CALL(fmi3GetFMUState)(a->c, state);
    case 2:
    case 3:
        return CALL(fmi3SetFMUState)(a->c, *state);
    case 4:
        return pick(a, 3) == 0 ? CALL(fmi3FreeFMUState)(a->c, state) : fmi3OK;
    case 5: {
        a->size = 0;
        fmi3Status status = CALL(fmi3SerializedFMUStateSize)(a->c, *state, &a->size);
        ck_assert_uint_le(a->size, sizeof a->bytes);
        if (status == fmi3OK)
            status = CALL(fmi3SerializeFMUState)(a->c, *state, a->bytes, a->size - (pick(a, 10) == 0));
        if (pick(a, 4) == 0 && a->size > 0) /* damage */
            a->bytes[pick(a, a->size)] ^= (unsigned char)(1U << pick(a, 8));
        return status;
    }
    case 6:
        return CALL(fmi3DeserializeFMUState)(a->c, a->bytes, a->size, state);
    default: { /* a handle that was freed: refused, never followed */
        fmi3FMUState other = *state;
        if (CALL(fmi3FreeFMUState)(a->c, state) == fmi3OK && other)
            ck_assert_int_eq(CALL(fmi3SetFMUState)(a->c, other), fmi3Error);
        return fmi3OK;
    }
    }
}

static fmi3Status some_life(caller *a)
{
    switch (pick(a, 5)) {
    case 0:
        a->now = pick(a, 4) == 0 ? some_number(a) : 0;
        return CALL(fmi3EnterInitializationMode)(a->c, false, 0, a->now, pick(a, 4) == 0, some_number(a));
    case 1:
        return CALL(fmi3ExitInitializationMode)(a->c);
    case 2:
        return pick(a, 4) == 0 ? CALL(fmi3Terminate)(a->c) : fmi3OK;
    case 3: {
        const fmi3String names[] = {"logAll", pick(a, 2) == 0 ? NULL : "logStatusError"};
        return CALL(fmi3SetDebugLogging)(a->c, pick(a, 2) == 0, pick(a, 3), pick(a, 5) == 0 ? NULL : names);
    }
    default:
        a->now = 0;
        return pick(a, 2) == 0 ? CALL(fmi3Reset)(a->c) : fmi3OK;
    }
}

static fmi3Status some_call(caller *a)
{
    switch (pick(a, 8)) {
    case 0:
    case 1:
        return some_life(a);
    case 2:
        return some_values(a, true);
    case 3:
        return some_values(a, false);
    case 4:
    case 5:
        return some_step(a);
    default:
        return some_state(a);
    }
}

static void look(fmi3InstanceEnvironment environment, fmi3Float64 time, fmi3Boolean set_requested,
                 fmi3Boolean get_allowed, fmi3Boolean step_finished, fmi3Boolean can_return_early,
                 fmi3Boolean *return_requested, fmi3Float64 *return_time)
{
    caller *a = (caller *)((char *)environment - offsetof(caller, errors)); /* the log's environment is the errors */
    ck_assert(!set_requested && get_allowed && step_finished && time >= 0);
    a->looks++;
    if (pick(a, 10) == 0) {
        double now = a->now;
        some_call(a);
        a->now = now;
    }
    if (pick(a, 4) == 0 && can_return_early) {
        *return_requested = true;
        *return_time = some_number(a);
    }
}

START_TEST(any_call_in_any_order_has_a_status)
{
    make_resources();
    int calls = getenv("FRAM_TEST_SHORT") ? 800 : 4000, good = 0, refused = 0, steps = 0;
    static caller a; /* too large for a stack */
    a.rng = random_begin(5, 0, 0);
    a.c = make_3(&a.errors, look);
    ck_assert_ptr_nonnull(a.c);
    for (int i = 0; i < calls; i++) {
        fmi3Status status = some_call(&a);
        ck_assert_msg(status == fmi3OK || status == fmi3Error || status == fmi3Warning, "call %d: %d", i, status);
        good += status == fmi3OK;
        refused += status == fmi3Error;
        if (status == fmi3Error && pick(&a, 3) > 0) { /* on from the start, so that there is more than refusals */
            ck_assert_int_eq(CALL(fmi3Reset)(a.c), fmi3OK);
            ck_assert_int_eq(CALL(fmi3EnterInitializationMode)(a.c, false, 0, 0, false, 0), fmi3OK);
            ck_assert_int_eq(CALL(fmi3ExitInitializationMode)(a.c), fmi3OK);
            a.now = 0;
        }
        steps += a.now > 0;
    }
    ck_assert_msg(good > calls / 4 && refused > calls / 20 && a.errors > refused / 4 && a.looks > calls / 40 &&
                      steps > calls / 10,
                  "%d good, %d refused, %d told, %d looks, %d on the way", good, refused, a.errors, a.looks, steps);
    CALL(fmi3FreeInstance)(a.c);
    remove_resources();
}
END_TEST

/* ---- what the importer must not do, and is told ---- */

typedef struct freer {
    int errors; /* the log's environment */
    fmi3Instance c;
} freer;

/* NOLINTBEGIN(readability-non-const-parameter): of the standard's type */
static void free_after_error(fmi3InstanceEnvironment environment, fmi3Float64 time, fmi3Boolean set_requested,
                             fmi3Boolean get_allowed, fmi3Boolean step_finished, fmi3Boolean can_return_early,
                             fmi3Boolean *return_requested, fmi3Float64 *return_time)
{
    (void)time, (void)set_requested, (void)get_allowed, (void)step_finished, (void)can_return_early;
    (void)return_requested, (void)return_time;
    const freer *f = environment;
    static const fmi3ValueReference not_looked_at[] = {VELOCITY};
    double value;
    ck_assert_int_eq(CALL(fmi3GetFloat64)(f->c, not_looked_at, 1, &value, 1), fmi3Error);
    CALL(fmi3FreeInstance)(f->c);
}
/* NOLINTEND(readability-non-const-parameter) */

static void begin_3(fmi3Instance c, double stop)
{
    ck_assert_int_eq(CALL(fmi3EnterInitializationMode)(c, false, 0, 0, true, stop), fmi3OK);
    ck_assert_int_eq(CALL(fmi3ExitInitializationMode)(c), fmi3OK);
}

static fmi3Status step_3(fmi3Instance c, int from)
{
    bool event, end, early;
    double reached;
    return CALL(fmi3DoStep)(c, from * dt, dt, true, &event, &end, &early, &reached);
}

START_TEST(an_instance_is_not_freed_in_its_step)
{
    make_resources();
    freer f = {0};
    f.c = make_3(&f.errors, free_after_error);
    begin_3(f.c, 10 * dt);
    ck_assert_int_eq(step_3(f.c, 0), fmi3Error);
    ck_assert_int_eq(f.errors, 3); /* the value, the freeing, the step */
    ck_assert_int_eq(CALL(fmi3Reset)(f.c), fmi3OK);
    CALL(fmi3FreeInstance)(f.c);
    remove_resources();
}
END_TEST

/* As 2.0 has it: the start time is told before. */
START_TEST(version_2_is_set_up_before_it_is_initialized)
{
    make_resources();
    int errors = 0;
    fmi2FMUstate fresh = NULL, told = NULL;
    fmi2Component c = make_2(&errors);
    ck_assert_int_eq(CALL(fmi2GetFMUstate)(c, &fresh), fmi2OK);
    ck_assert_int_eq(CALL(fmi2EnterInitializationMode)(c), fmi2Error);
    ck_assert_int_eq(CALL(fmi2Reset)(c), fmi2OK);
    ck_assert_int_eq(CALL(fmi2SetupExperiment)(c, fmi2False, 0, 1, fmi2False, 0), fmi2OK);
    ck_assert_int_eq(CALL(fmi2GetFMUstate)(c, &told), fmi2OK);
    ck_assert_int_eq(CALL(fmi2Reset)(c), fmi2OK);
    ck_assert_int_eq(CALL(fmi2EnterInitializationMode)(c), fmi2Error);
    ck_assert_int_eq(CALL(fmi2SetFMUstate)(c, told), fmi2OK);
    ck_assert_int_eq(CALL(fmi2EnterInitializationMode)(c), fmi2OK);
    ck_assert_int_eq(CALL(fmi2SetFMUstate)(c, fresh), fmi2OK);
    ck_assert_int_eq(CALL(fmi2EnterInitializationMode)(c), fmi2Error);
    ck_assert_int_eq(errors, 3);
    CALL(fmi2FreeInstance)(c);
    remove_resources();
}
END_TEST

START_TEST(a_state_holds_the_stop_time)
{
    make_resources();
    int errors = 0;
    fmi3FMUState kept = NULL, read = NULL;
    unsigned char bytes[1 << 16];
    size_t size;
    fmi3Instance c = make_3(&errors, NULL);
    begin_3(c, 2 * dt);
    ck_assert_int_eq(CALL(fmi3GetFMUState)(c, &kept), fmi3OK);
    ck_assert_int_eq(CALL(fmi3SerializedFMUStateSize)(c, kept, &size), fmi3OK);
    ck_assert_uint_le(size, sizeof bytes);
    ck_assert_int_eq(CALL(fmi3SerializeFMUState)(c, kept, bytes, size), fmi3OK);
    for (int way = 0; way < 2; way++) {
        ck_assert_int_eq(CALL(fmi3Reset)(c), fmi3OK);
        if (way == 1)
            ck_assert_int_eq(CALL(fmi3DeserializeFMUState)(c, bytes, size, &read), fmi3OK);
        ck_assert_int_eq(CALL(fmi3SetFMUState)(c, way == 0 ? kept : read), fmi3OK);
        ck_assert_int_eq(step_3(c, 0), fmi3OK);
        ck_assert_int_eq(step_3(c, 1), fmi3OK);
        ck_assert_int_eq(step_3(c, 2), fmi3Error);
    }
    CALL(fmi3FreeInstance)(c);
    remove_resources();
}
END_TEST

enum { PUSH = 7 }; /* value reference */

/* The bytes of a state in place of the state. */
static void through_bytes(fmi3Instance c, fmi3FMUState *state)
{
    size_t size;
    ck_assert_int_eq(CALL(fmi3SerializedFMUStateSize)(c, *state, &size), fmi3OK);
    unsigned char *bytes = malloc(size);
    ck_assert_ptr_nonnull(bytes);
    ck_assert_int_eq(CALL(fmi3SerializeFMUState)(c, *state, bytes, size), fmi3OK);
    ck_assert_int_eq(CALL(fmi3DeserializeFMUState)(c, bytes, size, state), fmi3OK);
    free(bytes);
}

/* A force that throws the vessel: 3.0 is told how many time steps were good, 2.0 how many communication steps.  States
   know it too. */
START_TEST(a_step_that_failed_was_no_success)
{
    make_resources();
    char list[400];
    snprintf(list, sizeof list, "%s\n%s", token, variables);
    write_text("variables.txt", list, "input outside_force_x\n");
    int errors = 0, good = 0;
    const fmi3ValueReference push[] = {POSITIONING, PUSH};
    const double told[] = {0, 1.5e9};
    bool event, end, early;
    double reached;
    fmi2FMUstate failed = NULL;
    fmi3FMUState failed_3 = NULL;
    fmi2Component two = make_2(&errors);
    begin_2(two, 3);
    ck_assert_int_eq(CALL(fmi2SetReal)(two, push, 2, told), fmi2OK);
    while (good < STEPS && CALL(fmi2DoStep)(two, 3 + good * dt, dt, fmi2True) == fmi2OK)
        good++;
    ck_assert(good > 0 && good < STEPS);
    ck_assert_int_eq(CALL(fmi2GetFMUstate)(two, &failed), fmi2OK);
    for (int way = 0; way < 3; way++) { /* as it failed, anew, by the state */
        if (way == 1)
            ck_assert_int_eq(CALL(fmi2Reset)(two), fmi2OK);
        if (way == 2)
            ck_assert_int_eq(CALL(fmi2SetFMUstate)(two, failed), fmi2OK);
        ck_assert_int_eq(CALL(fmi2GetRealStatus)(two, fmi2LastSuccessfulTime, &reached), fmi2OK);
        ck_assert_msg(reached == (way == 1 ? 0 : time_after(good)), "%d: %.17g", way, reached);
    }
    ck_assert_int_eq(CALL(fmi2Reset)(two), fmi2OK);
    begin_2(two, 3);
    ck_assert_int_eq(CALL(fmi2SetReal)(two, push, 2, told), fmi2OK);
    ck_assert_int_eq(CALL(fmi2DoStep)(two, 3, STEPS * dt, fmi2True), fmi2Error);
    ck_assert_int_eq(CALL(fmi2GetRealStatus)(two, fmi2LastSuccessfulTime, &reached), fmi2OK);
    ck_assert(reached == 3);
    CALL(fmi2FreeInstance)(two);
    fmi3Instance three = make_3(&errors, NULL);
    ck_assert_int_eq(CALL(fmi3EnterInitializationMode)(three, false, 0, 3, false, 0), fmi3OK);
    ck_assert_int_eq(CALL(fmi3ExitInitializationMode)(three), fmi3OK);
    ck_assert_int_eq(CALL(fmi3SetFloat64)(three, push, 2, told, 2), fmi3OK);
    ck_assert_int_eq(CALL(fmi3DoStep)(three, 3, STEPS * dt, true, &event, &end, &early, &reached), fmi3Error);
    ck_assert_msg(reached == time_after(good), "%.17g", reached);
    ck_assert_int_eq(CALL(fmi3GetFMUState)(three, &failed_3), fmi3OK);
    through_bytes(three, &failed_3);
    ck_assert_int_eq(CALL(fmi3Reset)(three), fmi3OK);
    ck_assert_int_eq(CALL(fmi3SetFMUState)(three, failed_3), fmi3OK);
    ck_assert_int_eq(CALL(fmi3DoStep)(three, 3, dt, true, &event, &end, &early, &reached), fmi3Error);
    ck_assert(reached == time_after(good));
    CALL(fmi3FreeInstance)(three);
    remove_resources();
}
END_TEST

START_TEST(why_there_is_no_instance_is_told_to_a_silent_log)
{
    make_resources();
    static const fmi3ValueReference none[] = {9999};
    int errors = 0;
    char path[320];
    snprintf(path, sizeof path, "%s/", folder);
    ck_assert_ptr_null(CALL(fmi3InstantiateCoSimulation)("ship", token, path, false, false, false, true, none, 1,
                                                         &errors, log_3, free_after_error));
    ck_assert_int_eq(errors, 1);
    remove_resources();
}
END_TEST

/* ---- threads ---- */

typedef struct lane {
    int errors;
    double out[3 * STEPS];
} lane;

static void *run_lane(void *user)
{
    lane *l = user;
    fmi3Instance c = make_3(&l->errors, NULL);
    if (c)
        run_3(c, STEPS, l->out);
    CALL(fmi3FreeInstance)(c);
    return NULL;
}

START_TEST(instances_in_threads_are_as_alone)
{
    make_resources();
    static lane lanes[THREADS], alone;
    pthread_t threads[THREADS];
    run_lane(&alone);
    for (int i = 0; i < THREADS; i++)
        ck_assert_int_eq(pthread_create(&threads[i], NULL, run_lane, &lanes[i]), 0);
    for (int i = 0; i < THREADS; i++)
        ck_assert_int_eq(pthread_join(threads[i], NULL), 0);
    ck_assert(alone.out[3 * STEPS - 1] != 0);
    for (int i = 0; i < THREADS; i++)
        ck_assert_mem_eq(lanes[i].out, alone.out, sizeof alone.out);
    remove_resources();
}
END_TEST

TEST_MAIN("instances", both_versions_are_the_world, an_importer_has_its_own_arithmetic,
          any_call_in_any_order_has_a_status, an_instance_is_not_freed_in_its_step,
          version_2_is_set_up_before_it_is_initialized, a_state_holds_the_stop_time, a_step_that_failed_was_no_success,
          why_there_is_no_instance_is_told_to_a_silent_log, instances_in_threads_are_as_alone)
