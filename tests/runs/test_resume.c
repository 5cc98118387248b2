/* Every scene runs straight, and through a checkpoint at half time, to the same hash, on 1 and 4 threads (on one of
   them, in turn, where tests are short). */
#include "scratch.h"
#include "sim/scene.h"

#include "base/pool.h"
#include "results/run_results.h"
#include "sim/run.h"
#include "sim/run_folder.h"

#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *const scenes[] = {
    /* a towed hull in a managed field between walls */
    "run:\n  duration: 4\n  time_step: 0.02\n  seed: 2\n"
    "vessel:\n  mode: towed\n  x: -30\n  speed: 2\n  ramp: 0.5\n"
    "  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "ice:\n  concentration: 0.85\n  mean_floe_area: 64\n"
    "domain:\n  x_min: -64\n  x_max: 64\n  y_min: -40\n  y_max: 40\n"
    "output:\n  checkpoint_interval: 0.5\n  frame_interval: 0.3\n",
    /* a free hull, ice that drifts out of an open domain */
    "run:\n  duration: 4\n  time_step: 0.02\n  seed: 3\n"
    "vessel:\n  mode: free\n  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "ice:\n  concentration: 0.7\n  mean_floe_area: 64\n"
    "domain:\n  x_min: -64\n  x_max: 64\n  y_min: -40\n  y_max: 40\n  boundary: open\n"
    "environment:\n  current_speed: 3\n  current_direction_deg: 160\n",
    /* a hull on dynamic positioning with a line that is let go and a thruster that fails, noise and all */
    "run:\n  duration: 4\n  time_step: 0.02\n  seed: 3\n"
    "vessel:\n  mode: free\n  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "  mooring:\n    depth: 60\n    lines:\n      - {count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5, "
    "release_time: 2.5}\n"
    "  thrusters:\n    - {x: 18}\n    - {x: -18, kind: main, rudder_deg: 25, failure_time: 1}\n"
    "    - {x: -15, kind: tunnel}\n"
    "  positioning: {active: true, observer: kalman, heading: vaning, vaning_load: 0, feed_forward: measured}\n"
    "  station: {offset_limit: 0.01}\n"
    "ice:\n  concentration: 0.7\n  mean_floe_area: 64\n"
    "domain:\n  x_min: -64\n  x_max: 64\n  y_min: -40\n  y_max: 40\n  boundary: open\n"
    "environment:\n  current_speed: 1\n  current_direction_deg: 160\n",
    /* an endless field that drifts past a moored hull, against the current, and breaks */
    "run:\n  duration: 4\n  time_step: 0.02\n  seed: 4\n"
    "vessel:\n  mode: free\n  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "  mooring:\n    depth: 60\n    lines:\n      - {count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}\n"
    "ice:\n  concentration: 0.85\n  mean_floe_area: 64\n  thickness: 0.4\n  breakable: true\n"
    "  strength: {flexural_variation: 0.3, crushing_variation: 0.3, common: 0.5}\n"
    "domain:\n  x_min: -64\n  x_max: 64\n  y_min: -40\n  y_max: 40\n  boundary: feeding\n  drift_speed: 3\n"
    "  drift_direction_deg: 200\n"
    "environment:\n  current_speed: 1\n  current_direction_deg: 40\n",
    /* an endless field whose pattern comes again while floes of it linger before a hull */
    "run:\n  duration: 10\n  time_step: 0.05\n  seed: 4\n"
    "vessel:\n  mode: prescribed\n  hull: {form: box, length: 8, beam: 16, draught: 4, freeboard: 2}\n"
    "ice:\n  concentration: 0.8\n  mean_floe_area: 12\n  thickness: 0.4\n"
    "domain:\n  x_min: -20\n  x_max: 20\n  y_min: -20\n  y_max: 20\n  boundary: feeding\n  drift_speed: 8\n"
    "  drift_direction_deg: 180\n",
    /* level ice that drifts onto a moored hull, is driven with a limit and comes and goes */
    "run:\n  duration: 4\n  time_step: 0.02\n"
    "vessel:\n  mode: free\n  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "  mooring:\n    depth: 60\n    lines:\n      - {count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}\n"
    "ice:\n  source: level\n  thickness: 0.4\n  breakable: true\n  keep_out_margin: 0.1\n"
    "  strength: {flexural_variation: 0.3, crushing_variation: 0.3}\n"
    "  fracture: {edge_inertia: true}\n"
    "  level: {tile_size: 9, line_load: 20000, mass: 2.0e6, openings: [{x: 50, y: 3, length: 30, width: 7}]}\n"
    "domain:\n  x_min: -40\n  x_max: 40\n  y_min: -30\n  y_max: 30\n  boundary: feeding\n  drift_speed: 5\n"
    "  drift_direction_deg: 200\n"
    "environment:\n  current_speed: 1\n  current_direction_deg: 40\n"
    "output:\n  checkpoint_interval: 0.5\n  frame_interval: 0.3\n",
    /* floes that break, level ice among them */
    "run:\n  duration: 4\n  time_step: 0.02\n"
    "vessel:\n  mode: towed\n  x: -26\n  speed: 3\n  ramp: 0.5\n"
    "  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "ice:\n  source: floes\n  thickness: 0.5\n  breakable: true\n  floes:\n"
    "    - {length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}\n"
    "    - {length: 40, width: 20, x: 20.5, y: -11}\n"
    "domain:\n  x_min: -64\n  x_max: 64\n  y_min: -40\n  y_max: 44\n"
    "environment: {floe_ventilation: true}\n"
    "output:\n  checkpoint_interval: 0.5\n  frame_interval: 0.3\n",
    /* all at once: lines, thrusters on dynamic positioning and floes that break under the hull */
    "run:\n  duration: 4\n  time_step: 0.02\n  seed: 5\n"
    "vessel:\n  mode: free\n  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "  mooring:\n    depth: 60\n    lines:\n      - {count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}\n"
    "  thrusters:\n    - {x: 18}\n    - {x: -18, kind: main, rudder_deg: 25}\n"
    "  positioning: {active: true}\n"
    "ice:\n  concentration: 0.8\n  mean_floe_area: 64\n  thickness: 0.3\n  breakable: true\n"
    "domain:\n  x_min: -64\n  x_max: 64\n  y_min: -40\n  y_max: 40\n  boundary: open\n"
    "environment:\n  current_speed: 3\n  current_direction_deg: 180\n"
    "output:\n  frame_interval: 0.3\n",
    /* several vessels of different kinds, two with stations, in ice that breaks */
    "run:\n  duration: 2\n  time_step: 0.02\n  seed: 6\n"
    "vessels:\n"
    "  - {name: breaker, mode: towed, x: -90, speed: 3, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}\n"
    "  - {name: ship, mode: free, x: 40, y: 20, hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2},\n"
    "     thrusters: [{x: 15}, {x: -15}], positioning: {active: true, feed_forward: measured, interval: 0.1}}\n"
    "  - {name: barge, mode: free, x: 40, y: -20, hull: {form: box, length: 40, beam: 14, draught: 3, freeboard: 2},\n"
    "     mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}}\n"
    "ice:\n  concentration: 0.8\n  mean_floe_area: 64\n  thickness: 0.3\n  breakable: true\n"
    "domain:\n  x_min: -120\n  x_max: 80\n  y_min: -40\n  y_max: 40\n  boundary: open\n"
    "environment:\n  current_speed: 2\n  current_direction_deg: 180\n"
    "output:\n  frame_interval: 0.3\n",
    /* a tug pushes a barge with its fenders, and another that has none */
    "run:\n  duration: 3\n  time_step: 0.02\n"
    "vessels:\n"
    "  - {name: tug, mode: free, x: -31, speed: 1, hydrodynamics: {source: estimate}, fender_stiffness: 1.0e6,\n"
    "     hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}, thrusters: [{kind: main, setting: 1}]}\n"
    "  - {name: barge, mode: free, hydrodynamics: {source: estimate},\n"
    "     hull: {form: box, length: 40, beam: 12, draught: 3, freeboard: 2}}\n"
    "  - {name: lighter, mode: free, x: 30, y: 7, heading_deg: 30, hydrodynamics: {source: estimate},\n"
    "     hull: {form: box, length: 16, beam: 8, draught: 2, freeboard: 2}}\n"
    "ice:\n  concentration: 0.5\n  mean_floe_area: 64\n  thickness: 0.3\n"
    "domain:\n  x_min: -60\n  x_max: 60\n  y_min: -30\n  y_max: 30\n"
    "output:\n  frame_interval: 0.3\n",
    /* floes that fall asleep and are woken by a hull */
    "run:\n  duration: 4\n  time_step: 0.02\n  seed: 7\n"
    "vessel:\n  mode: towed\n  x: -40\n  speed: 3\n  ramp: 0.5\n"
    "  hull:\n    length: 48\n    beam: 12\n    draught: 4\n    freeboard: 2\n"
    "ice:\n  concentration: 0.8\n  mean_floe_area: 64\n  sleep_speed: 0.05\n  sleep_time: 0.3\n"
    "domain:\n  x_min: -80\n  x_max: 64\n  y_min: -40\n  y_max: 40\n"
    "output:\n  checkpoint_interval: 0.5\n  frame_interval: 0.3\n",
    /* floes without a vessel, crushing each other and the walls */
    "run:\n  duration: 2\n  time_step: 0.01\nvessel:\n  present: false\n"
    "ice:\n  concentration: 0.9\n  mean_floe_area: 30\n  cap_ice_ice: true\n  cap_ice_wall: true\n"
    "domain:\n  x_min: 0\n  x_max: 60\n  y_min: 0\n  y_max: 40\n"
    "environment:\n  current_speed: 0.5\n",
};
enum { SCENES = sizeof scenes / sizeof *scenes, PATH = 512 };

static uint64_t run_to(context *ctx, const scenario *s, const char *folder, double until)
{
    fram_error error = {0};
    run_result result = {0};
    run_options options = {.folder = folder, .until = until, .finish = run_results_write};
    assert_ok(run_start(ctx, s, &options, &result, &error), error);
    return result.state_hash;
}

static uint64_t resume(context *ctx, const char *folder)
{
    fram_error error = {0};
    run_result result = {0};
    run_options options = {.folder = folder, .finish = run_results_write};
    assert_ok(run_resume(ctx, &options, &result, &error), error);
    ck_assert(result.finished);
    return result.state_hash;
}

static bool same_files(const char *a, const char *b, const char *name)
{
    char command[3 * PATH];
    snprintf(command, sizeof command, "cmp -s '%s/%s' '%s/%s'", a, name, b, name);
    return system(command) == 0;
}

static bool access_in(const char *folder, const char *name)
{
    char path[PATH + 64];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return access(path, R_OK) == 0;
}

/* A new run takes away what the one before wrote, whatever it is, but for the scenario, which it writes over. */
static void check_cleared(context *ctx, const char *folder)
{
    char path[PATH + 64];
    int lock = -1;
    fram_error error = {0};
    assert_ok(run_folder_prepare(ctx, folder, true, NULL, &lock, &error), error);
    run_folder_unlock(lock);
    snprintf(path, sizeof path, "%s/scenario.yaml", folder);
    ck_assert_int_eq(unlink(path), 0);
    ck_assert_msg(rmdir(folder) == 0, "files of a run stay in %s", folder);
}

static void check_scene(const char *text, int threads, uint64_t *hash)
{
    char straight[PATH], halves[PATH];
    scratch_folder(straight);
    scratch_folder(halves);
    context ctx;
    context_init(&ctx);
    if (threads > 1)
        ck_assert_ptr_nonnull(ctx.threads = pool_create(&ctx, threads));
    scenario s = {0};
    fram_error error = {0};
    assert_ok(scenario_parse(&ctx, "scene.yaml", text, strlen(text), NULL, &s, &error), error);

    *hash = run_to(&ctx, &s, straight, 0);
    run_to(&ctx, &s, halves, s.run.duration / 2);
    ck_assert_uint_eq(resume(&ctx, halves), *hash);
    ck_assert(same_files(straight, halves, "record.fram"));
    ck_assert(same_files(straight, halves, "fractures.csv"));
    ck_assert(s.vessel.thrusters.count == 0 || access_in(straight, "station.json"));
    ck_assert(s.vessels.count == 0 || !access_in(straight, "station.json"));
    ck_assert(s.vessels.count == 0 || access_in(straight, "station-ship.json") != (strstr(text, "name: ship") == NULL));

    check_cleared(&ctx, straight);
    scenario_free(&ctx, &s);
    if (ctx.threads)
        pool_free(&ctx, ctx.threads);
    scratch_remove_folder(halves);
}

START_TEST(straight_and_resumed_runs_agree)
{
    const bool quick = getenv("FRAM_TEST_SHORT");
    for (int i = 0; i < SCENES; i++) {
        uint64_t one = 0, four = 0;
        if (!quick || i % 2 == 0)
            check_scene(scenes[i], 1, &one);
        if (!quick || i % 2 == 1)
            check_scene(scenes[i], 4, &four);
        ck_assert(quick || one == four);
    }
}
END_TEST

TEST_MAIN("resume", straight_and_resumed_runs_agree)
