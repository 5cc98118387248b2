/* A world that a call is changing is not touched by another call, from a callback or another thread; one that is being
   read as a whole is not changed. */
#include "fram/live.h"
#include "scratch.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

enum { STEPS = 8 };

static const char scene[] = "run: {duration: 5, time_step: 0.02, seed: 5}\n"
                            "vessel:\n  mode: towed\n  speed: 3\n"
                            "  hull: {form: icebreaker, length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice: {concentration: 0.8, mean_floe_area: 16, thickness: 0.3, breakable: true}\n"
                            "domain: {x_min: -120, x_max: 120, y_min: -80, y_max: 80}\n";

static fram_error e;
static fram_world *w; /* NULL: callbacks do nothing */
static int refused, loads, asked;
static bool on_a_thread, is_read;

static void assert_taken(fram_status status, const fram_error *error)
{
    ck_assert_int_eq(status, FRAM_ERROR_USAGE);
    ck_assert_str_eq(error->key, "world");
    ck_assert_ptr_nonnull(strstr(error->message, "another call on it has not returned"));
}

static void try_to_change(fram_body_id body)
{
    fram_error error;
    const double none[3] = {0};
    fram_record_definition d;
    fram_record_default(&d);
    d.folder = "/nowhere";
    assert_taken(fram_world_step(w, &error), &error);
    assert_taken(fram_world_load_memory(w, "state", 5, &error), &error);
    assert_taken(fram_world_record(w, &d, &error), &error);
    assert_taken(fram_world_checkpoint(w, &error), &error);
    assert_taken(fram_world_record_end(w, NULL, &error), &error);
    assert_taken(fram_world_set_input(w, 0, 0, &error), &error);
    assert_taken(fram_world_set_path(w, 0, NULL, NULL, 0, &error), &error);
    assert_taken(fram_body_apply_wrench(w, body, none, none, &error), &error);
    fram_world_destroy(w); /* not now */
}

static void try_to_read(fram_body_id body)
{
    fram_error error;
    fram_world *copy;
    void *data;
    size_t size;
    fram_body_state state;
    fram_ice_load load;
    fram_body_view view;
    double values[8] = {-77};
    int bodies = -77;
    assert_taken(fram_world_copy(w, &copy, &error), &error);
    assert_taken(fram_world_save_memory(w, &data, &size, &error), &error);
    assert_taken(fram_body_state_get(w, body, &state, &error), &error);
    assert_taken(fram_world_ice_load(w, body, &load, &error), &error);
    assert_taken(fram_world_view(w, &view, &error), &error);
    ck_assert(isnan(fram_world_value(w, 0)) && isnan(fram_world_input_value(w, 0)));
    ck_assert(fram_world_values(w, values, 8) == 0 && values[0] < -76 && fram_world_hash(w) == 0);
    ck_assert(fram_world_bodies(w, 0, NULL) == 0 && fram_world_outlines(w, 0, NULL, 0, NULL, 0, &bodies) == 0);
    ck_assert(bodies == 0 && fram_world_shapes(w, NULL, 0, NULL, 0) == 0 && fram_body_outline(w, body, NULL, 0) == 0);
    ck_assert(fram_world_contacts(w, NULL, 0) == 0 && fram_world_fractures(w, NULL, 0) == 0);
    ck_assert(!fram_world_vessel(w, &body) && !fram_world_body(w, 0, &body));
}

/* Who reads is not in the way of others who do. */
static void read_too(void)
{
    fram_world *copy;
    fram_error error;
    assert_ok(fram_world_copy(w, &copy, &error), error);
    ck_assert(fram_world_hash(copy) == fram_world_hash(w) && fram_world_bodies(w, 0, NULL) > 0);
    ck_assert(fram_world_shapes(w, NULL, 0, NULL, 0) == fram_world_outlines(w, 0, NULL, 0, NULL, 0, NULL));
    fram_world_destroy(copy);
}

static void *try_all(void *user)
{
    const fram_body_id *body = user;
    try_to_change(*body);
    if (is_read)
        read_too();
    else
        try_to_read(*body);
    refused++;
    return NULL;
}

static void try_now(void)
{
    fram_body_id body = {0, 0};
    pthread_t thread;
    if (!on_a_thread) {
        try_all(&body);
    } else {
        ck_assert_int_eq(pthread_create(&thread, NULL, try_all, &body), 0);
        pthread_join(thread, NULL);
    }
}

static void run_blocks(void *user, int blocks, fram_task_function run, void *task)
{
    (void)user;
    for (int block = 0; block < blocks; block++)
        run(task, block, 0);
    if (w && asked > 0) {
        asked--;
        try_now();
    }
}

/* realloc's contract; a state that is loaded needs memory. */
static void *resize(void *user, void *ptr, size_t size)
{
    (void)user;
    if (w && loads > 0 && size > 0) {
        loads--;
        try_now();
    }
    if (size == 0) {
        free(ptr);
        return NULL;
    }
    return realloc(ptr, size);
}

static void try_while_it_is_read(fram_context *ctx, fram_world *tried)
{
    fram_world *copy;
    void *data;
    size_t size;
    int before = refused;
    is_read = true;
    w = tried;
    loads = 1;
    assert_ok(fram_world_copy(w, &copy, &e), e);
    loads = 1;
    on_a_thread = true;
    assert_ok(fram_world_save_memory(w, &data, &size, &e), e);
    w = NULL;
    is_read = false;
    ck_assert_int_eq(refused, before + 2);
    ck_assert(fram_world_hash(copy) == fram_world_hash(tried));
    assert_ok(fram_world_load_memory(copy, data, size, &e), e);
    ck_assert(fram_world_hash(copy) == fram_world_hash(tried));
    fram_data_free(ctx, data);
    fram_world_destroy(copy);
    assert_ok(fram_world_step(tried, &e), e);
}

START_TEST(a_world_in_a_call_refuses_another)
{
    fram_context *ctx;
    fram_scenario *s;
    fram_context_definition d;
    fram_context_default(&d);
    d.memory = resize;
    d.parallel = run_blocks;
    d.threads = 2;
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, scene, NULL, NULL, 0, &s, &e), e);
    fram_world *tried, *left;
    assert_ok(fram_world_create(s, &tried, &e), e);
    assert_ok(fram_world_create(s, &left, &e), e);
    for (int i = 0; i < STEPS; i++) {
        assert_ok(fram_world_step(left, &e), e);
        w = tried;
        asked = 1;
        on_a_thread = i % 2 != 0;
        assert_ok(fram_world_step(tried, &e), e);
        w = NULL;
        ck_assert_int_eq(refused, i + 1);
        ck_assert(fram_world_hash(tried) == fram_world_hash(left));
    }
    void *data;
    size_t size;
    assert_ok(fram_world_save_memory(left, &data, &size, &e), e);
    w = tried;
    loads = 1;
    assert_ok(fram_world_load_memory(tried, data, size, &e), e);
    w = NULL;
    ck_assert(refused == STEPS + 1 && fram_world_hash(tried) == fram_world_hash(left));
    assert_ok(fram_world_step(tried, &e), e);
    try_while_it_is_read(ctx, tried);
    /* One that is refused for another reason is free again. */
    ck_assert_int_eq(fram_world_load_memory(tried, data, size / 2, &e), FRAM_ERROR_INPUT);
    ck_assert_int_eq(fram_world_checkpoint(tried, &e), FRAM_ERROR_USAGE);
    ck_assert_str_eq(e.message, "it is not recorded");
    ck_assert_int_eq(fram_world_record(tried, NULL, &e), FRAM_ERROR_USAGE);
    assert_ok(fram_world_step(tried, &e), e);
    fram_data_free(ctx, data);
    fram_world_destroy(tried);
    fram_world_destroy(left);
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
}
END_TEST

/* While a run with a stop flag of its own is made, another call in its context goes on when that flag is set. */
static int runs_stop, others;
static const fram_scenario *others_scene;

static void make_another(void *user, const char *what, double done, double total)
{
    (void)user, (void)what, (void)done, (void)total;
    if (others++ > 0)
        return;
    fram_stop_set(&runs_stop, 1);
    fram_world *other;
    assert_ok(fram_world_create(others_scene, &other, &e), e);
    fram_world_destroy(other);
}

START_TEST(a_runs_stop_stops_nothing_else)
{
    fram_context *ctx;
    fram_scenario *s;
    fram_context_definition d;
    fram_context_default(&d);
    d.work = make_another;
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, scene, NULL, NULL, 0, &s, &e), e);
    others_scene = s;
    fram_run_definition run;
    fram_run_default(&run);
    char folder[SCRATCH_FOLDER];
    scratch_folder(folder);
    run.folder = folder;
    run.stop = &runs_stop;
    ck_assert_int_eq(fram_run(s, &run, NULL, &e), FRAM_INTERRUPTED);
    ck_assert_int_gt(others, 1);
    ck_assert_int_eq(rmdir(folder), 0); /* it is left as it was */
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
}
END_TEST

TEST_MAIN("one call", a_world_in_a_call_refuses_another, a_runs_stop_stops_nothing_else)
