/* Memory that runs out while a world is made, stepped or run is a status, and nothing leaks. */
#include "scratch.h"
#include "sim/scene.h"

#include "results/run_results.h"
#include "sim/run.h"

#include <stdio.h>

static const char text[] = "run:\n  duration: 0.1\n  time_step: 0.02\n"
                           "vessel:\n  mode: towed\n  x: -10\n  speed: 2\n"
                           "  hull:\n    length: 24\n    beam: 6\n    draught: 2\n"
                           "    freeboard: 1\n    parallel_midbody: 0.3\n"
                           "ice:\n  concentration: 0.8\n  mean_floe_area: 40\n"
                           "domain:\n  x_min: -24\n  x_max: 24\n  y_min: -16\n  y_max: 16\n"
                           "output:\n  frame_interval: 0.04\n  checkpoint_interval: 0.06\n";

/* Held by lines that are let go and thrusters that fail: events are booked as memory runs out. */
static const char held[] =
    "run:\n  duration: 0.1\n  time_step: 0.02\n"
    "vessel:\n  mode: free\n"
    "  hull:\n    length: 24\n    beam: 6\n    draught: 2\n    freeboard: 1\n    parallel_midbody: 0.3\n"
    "  mooring:\n    lines:\n      - {count: 3, spacing_deg: 120, distance: 400, "
    "pretension: 2.0e5, release_time: 0.05}\n"
    "  thrusters:\n    - {x: 9, failure_time: 0.03}\n    - {x: -9}\n"
    "  positioning: {active: true, waypoints: [{time: 0.05}]}\n"
    "ice:\n  source: none\n";

static fram_status build_and_step(context *ctx, const scenario *s)
{
    fram_error error = {0};
    model m;
    world w;
    field_report report;
    fram_status status = build_model(ctx, s, &m, &error);
    if (status == FRAM_OK) {
        status = build_world(ctx, s, &m, &w, &report, &error);
        if (status != FRAM_OK)
            model_free(ctx, &m);
    }
    if (status != FRAM_OK)
        return status;
    for (int i = 0; i < 5 && status == FRAM_OK; i++)
        status = world_step(ctx, &m, &w, &error);
    world_free(ctx, &w);
    model_free(ctx, &m);
    return status;
}

/* The scenario is read once with memory that never fails. */
static void read_scenario(context *ctx, const char *from, scenario *s)
{
    fram_error error = {0};
    context_init(ctx);
    assert_ok(scenario_parse(ctx, "scene.yaml", from, strlen(from), NULL, s, &error), error);
}

static void check_world(const char *from)
{
    context plain;
    scenario s = {0};
    read_scenario(&plain, from, &s);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        turn.status = build_and_step(&turn.ctx, &s);
        if (!turn.memory.failed)
            ck_assert_int_gt(turn.n, 50);
    }
    scenario_free(&plain, &s);
}

START_TEST(world_without_memory)
{
    check_world(text);
    check_world(held);
}
END_TEST

/* How a run stands at its end is written twice if need be, so that run.json does not stay at "running": a request that
   fails there is made good, and the file says that the run is finished. */
static void check_made_good(const char *folder, long n)
{
    char path[64], summary[4096] = "";
    snprintf(path, sizeof path, "%s/run.json", folder);
    FILE *file = fopen(path, "rb");
    ck_assert_msg(file != NULL, "request %ld: no run.json", n);
    size_t length = fread(summary, 1, sizeof summary - 1, file);
    fclose(file);
    ck_assert_msg(length > 0 && strstr(summary, "\"status\": \"finished\""), "request %ld: %s", n, summary);
}

/* A whole run with files: every seventh request, for there are many. */
static void check_run(const char *from)
{
    context plain;
    scenario s = {0};
    read_scenario(&plain, from, &s);
    char folder[SCRATCH_FOLDER];
    scratch_folder(folder);
    for (failing_turn turn = {.stride = 7}; failing_next(&turn);) {
        run_result result = {0};
        run_options options = {.folder = folder, .force = true, .finish = run_results_write};
        turn.status = run_start(&turn.ctx, &s, &options, &result, &turn.error);
        if (turn.memory.failed && turn.status == FRAM_OK) {
            check_made_good(folder, turn.n);
            turn.status = FRAM_ERROR_MEMORY; /* as the turn expects */
        }
    }
    scratch_remove_folder(folder);
    scenario_free(&plain, &s);
}

START_TEST(run_without_memory)
{
    check_run(text);
    check_run(held);
}
END_TEST

TEST_MAIN("memory", world_without_memory, run_without_memory)
