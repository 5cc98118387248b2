/* Every function of include/fram with arguments that cannot be: NULL, NaN, infinities, numbers below and beyond all
   use. Each is refused with a word for it; none is undefined (the sanitizers look on). */
#include "fram/field.h"
#include "fram/hull.h"
#include "fram/ice.h"
#include "fram/live.h"
#include "fram/results.h"
#include "fram/version.h"
#include "scratch.h"

#include <limits.h>
#include <stdio.h>
#include <unistd.h>

static const double nan_value = (double)NAN, infinite = (double)INFINITY;
/* What no length, time or number may be. */
static const double wild[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, -1, 1e300, -1e300};
enum { WILD = sizeof wild / sizeof *wild };

static fram_error e;
static fram_context *context_of_test;
static fram_scenario *scenario_of_test;
static char folder[SCRATCH_FOLDER], run[260], scene[260], page[260], output[300];

/* Refused, with words and the name of what is wrong. */
static void assert_refused(fram_status status, const char *call)
{
    ck_assert_msg(status == FRAM_ERROR_USAGE || status == FRAM_ERROR_INPUT || status == FRAM_ERROR_UNSUPPORTED,
                  "%s: status %s", call, fram_status_name(status));
    ck_assert_msg(e.status == status && e.message[0] != '\0', "%s: no message", call);
    e = (fram_error){0};
}
#define REFUSED(call) assert_refused((call), #call)
#define REFUSED_KEY(call, name)        \
    ck_assert_int_ne((call), FRAM_OK); \
    ck_assert_str_eq(e.key, name)
/* With a NULL for the error too. */
#define REFUSED_NULL(call_with_error, call_without) \
    REFUSED(call_with_error);                       \
    ck_assert_int_ne((call_without), FRAM_OK)

static void open_all(void)
{
    static const char text[] = "run: {duration: 0.4, time_step: 0.1}\n"
                               "vessel:\n  mode: towed\n  x: -20\n  speed: 1\n"
                               "  hull: {form: box, length: 20, beam: 8, draught: 2, freeboard: 2}\n"
                               "ice: {mean_floe_area: 64}\n"
                               "domain: {x_min: -40, x_max: 40, y_min: -20, y_max: 20}\n"
                               "output: {frame_interval: 0.1}\n";
    scratch_folder(folder);
    snprintf(scene, sizeof scene, "%s/scene.yaml", folder);
    snprintf(run, sizeof run, "%s/run", folder);
    snprintf(page, sizeof page, "%s/page.html", folder);
    snprintf(output, sizeof output, "%s/output", folder);
    scratch_text(scene, text);
    scratch_text(page, "<html></html>");
    assert_ok(fram_context_create(NULL, &context_of_test, &e), e);
    assert_ok(fram_scenario_load(context_of_test, scene, NULL, 0, &scenario_of_test, &e), e);
}

static void close_all(void)
{
    fram_scenario_destroy(scenario_of_test);
    fram_context_destroy(context_of_test);
    scratch_remove_folder(folder);
}

START_TEST(words_and_contexts)
{
    ck_assert_str_eq(fram_version(), FRAM_VERSION);
    ck_assert_ptr_nonnull(fram_features());
    ck_assert_str_eq(fram_status_name((fram_status)-1), "unknown");
    ck_assert_str_eq(fram_status_name((fram_status)INT_MAX), "unknown");
    (fram_context_default)(NULL, sizeof(size_t));
    REFUSED_NULL(fram_context_create(NULL, NULL, &e), fram_context_create(NULL, NULL, NULL));
    fram_context *made;
    fram_context_definition d = {0};
    REFUSED(fram_context_create(&d, &made, &e));
    fram_context_default(&d);
    for (int threads = -1; threads <= 257; threads += 129) {
        d.threads = threads == 128 ? INT_MAX : threads;
        REFUSED(fram_context_create(&d, &made, &e));
    }
    fram_context_default(&d);
    for (int i = 0; i < 2; i++) {
        d.verbosity = (fram_log_level)(i == 0 ? -1 : FRAM_LOG_DEBUG + 1);
        REFUSED_KEY(fram_context_create(&d, &made, &e), "verbosity");
    }
    fram_context_default(&d);
    d.isa = "";
    REFUSED(fram_context_create(&d, &made, &e));
    fram_context_destroy(NULL);
    fram_text_free(NULL, NULL);
    assert_ok(fram_context_create(NULL, &made, NULL), e);
    fram_text_free(made, NULL);
    fram_context_destroy(made);
}
END_TEST

START_TEST(scenarios)
{
    open_all();
    fram_context *c = context_of_test;
    fram_scenario *s;
    static const char *const no_text[] = {NULL};
    REFUSED_NULL(fram_scenario_load(NULL, scene, NULL, 0, &s, &e), fram_scenario_load(NULL, scene, NULL, 0, &s, NULL));
    REFUSED(fram_scenario_load(c, NULL, NULL, 0, &s, &e));
    REFUSED(fram_scenario_load(c, scene, NULL, 0, NULL, &e));
    REFUSED(fram_scenario_load(c, "", NULL, 0, &s, &e));
    REFUSED(fram_scenario_load(c, scene, NULL, 3, &s, &e));
    REFUSED(fram_scenario_load(c, scene, no_text, 1, &s, &e));
    REFUSED(fram_scenario_load(c, scene, NULL, INT_MIN, &s, &e));
    ck_assert_str_eq(fram_scenario_text(NULL), "");
    ck_assert_str_eq(fram_scenario_notes(NULL), "");
    ck_assert_str_eq(fram_scenario_hash(NULL), "");
    ck_assert(isnan(fram_scenario_duration(NULL)) && isnan(fram_scenario_time_step(NULL)));
    ck_assert(strlen(fram_scenario_hash(scenario_of_test)) == 64 && *fram_scenario_text(scenario_of_test) &&
              *fram_scenario_notes(scenario_of_test));
    REFUSED(fram_scenario_check(NULL, &e));
    assert_ok(fram_scenario_check(scenario_of_test, &e), e);
    fram_scenario_destroy(NULL);
    char *text;
    REFUSED(fram_scenario_reference(NULL, &text, &e));
    REFUSED(fram_scenario_reference(c, NULL, &e));
    assert_ok(fram_scenario_reference(c, &text, &e), e);
    fram_text_free(c, text);
    close_all();
}
END_TEST

START_TEST(worlds)
{
    open_all();
    fram_world *w;
    fram_body_id id = {0}, wrong[] = {{-1, 0}, {INT32_MAX, 0}, {INT32_MIN, 0}, {0, UINT32_MAX}};
    fram_body_state state;
    fram_ice_load load;
    double xy[8], zero[3] = {0, 0, 0};
    REFUSED_NULL(fram_world_create(NULL, &w, &e), fram_world_create(NULL, &w, NULL));
    REFUSED(fram_world_create(scenario_of_test, NULL, &e));
    assert_ok(fram_world_create(scenario_of_test, &w, &e), e);
    char *told;
    REFUSED_NULL(fram_world_notes(NULL, &told, &e), fram_world_notes(NULL, &told, NULL));
    REFUSED(fram_world_notes(w, NULL, &e));
    assert_ok(fram_world_notes(w, &told, &e), e);
    ck_assert_str_eq(told, fram_scenario_notes(scenario_of_test));
    fram_text_free(context_of_test, told);
    REFUSED(fram_world_step(NULL, &e));
    assert_ok(fram_world_step(w, NULL), e);
    ck_assert(isnan(fram_world_time(NULL)) && fram_world_steps(NULL) == 0 && fram_world_hash(NULL) == 0 &&
              fram_world_slots(NULL) == 0);
    ck_assert(fram_world_time(w) > 0 && fram_world_steps(w) == 1 && fram_world_hash(w) != 0);
    ck_assert(!fram_world_body(NULL, 0, &id) && !fram_world_body(w, 0, NULL) && !fram_world_body(w, -1, &id) &&
              !fram_world_body(w, INT_MAX, &id) && !fram_world_body(w, fram_world_slots(w), &id));
    ck_assert(!fram_world_vessel(NULL, &id) && !fram_world_vessel(w, NULL) && fram_world_vessel(w, &id));
    ck_assert(fram_world_vessels(NULL) == 0 && fram_world_vessels(w) == 1);
    ck_assert(!fram_world_vessel_at(NULL, 0, &id) && !fram_world_vessel_at(w, 0, NULL) &&
              !fram_world_vessel_at(w, -1, &id) && !fram_world_vessel_at(w, 1, &id) && fram_world_vessel_at(w, 0, &id));
    ck_assert(!fram_world_vessel_named(NULL, "a", &id) && !fram_world_vessel_named(w, NULL, &id) &&
              !fram_world_vessel_named(w, "", &id) && !fram_world_vessel_named(w, "a", &id));
    ck_assert(!fram_world_vessel_name(NULL, 0) && !fram_world_vessel_name(w, -1) && !fram_world_vessel_name(w, 1));
    ck_assert_str_eq(fram_world_vessel_name(w, 0), "");
    REFUSED(fram_body_state_get(NULL, id, &state, &e));
    REFUSED(fram_body_state_get(w, id, NULL, &e));
    REFUSED(fram_world_ice_load(NULL, id, &load, &e));
    REFUSED(fram_world_ice_load(w, id, NULL, &e));
    REFUSED(fram_body_apply_wrench(NULL, id, zero, zero, &e));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        REFUSED(fram_body_state_get(w, wrong[i], &state, &e));
        REFUSED(fram_world_ice_load(w, wrong[i], &load, &e));
        REFUSED(fram_body_apply_wrench(w, wrong[i], zero, zero, &e));
        ck_assert_int_eq(fram_body_outline(w, wrong[i], xy, 4), 0);
    }
    ck_assert_int_eq(fram_body_outline(NULL, id, xy, 4), 0);
    int floes = 0;
    for (int slot = 0; slot < fram_world_slots(w) && floes == 0; slot++) {
        if (!fram_world_body(w, slot, &id) || fram_body_state_get(w, id, &state, &e) != FRAM_OK ||
            state.kind != FRAM_BODY_FLOE)
            continue;
        floes++;
        int count = fram_body_outline(w, id, NULL, INT_MAX);
        ck_assert(count >= 3 && fram_body_outline(w, id, xy, INT_MIN) == count);
        REFUSED(fram_body_apply_wrench(w, id, NULL, zero, &e));
        REFUSED(fram_body_apply_wrench(w, id, zero, NULL, &e));
        for (int i = 0; i < 3; i++) {
            double force[3] = {0, 0, 0};
            force[i] = i == 0 ? nan_value : i == 1 ? infinite : -infinite;
            REFUSED_KEY(fram_body_apply_wrench(w, id, force, zero, &e), "force");
            REFUSED_KEY(fram_body_apply_wrench(w, id, zero, force, &e), "moment");
            ck_assert_int_eq(e.status, FRAM_ERROR_INPUT); /* as of inputs by name */
        }
        const double opposite[3] = {1e300, -1e300, 0};
        REFUSED(fram_body_apply_wrench(w, id, opposite, zero, &e));
        assert_ok(fram_body_apply_wrench(w, id, zero, zero, &e), e);
        REFUSED(fram_world_ice_load(w, id, &load, &e));
    }
    ck_assert_int_eq(floes, 1);
    REFUSED_KEY(fram_world_save(w, scene, &e), "path");
    fram_world_destroy(w);
    fram_world_destroy(NULL);
    close_all();
}
END_TEST

START_TEST(runs_and_benchmarks)
{
    open_all();
    fram_context *c = context_of_test;
    fram_run_definition d = {0};
    fram_run_result result;
    (fram_run_default)(NULL, sizeof(size_t));
    REFUSED_NULL(fram_run(scenario_of_test, NULL, &result, &e), fram_run(scenario_of_test, NULL, NULL, NULL));
    REFUSED(fram_run(scenario_of_test, &d, &result, &e));
    REFUSED(fram_resume(c, &d, &result, &e));
    fram_run_default(&d);
    REFUSED(fram_run(scenario_of_test, &d, &result, &e));
    REFUSED(fram_resume(c, &d, &result, &e));
    d.folder = "";
    REFUSED(fram_run(scenario_of_test, &d, &result, &e));
    d.folder = run;
    REFUSED(fram_run(NULL, &d, &result, &e));
    REFUSED(fram_resume(NULL, &d, &result, &e));
    memset(&result, 0x55, sizeof result);
    const fram_run_result before = result;
    REFUSED(fram_resume(c, &d, &result, &e)); /* not there */
    ck_assert_mem_eq(&result, &before, sizeof result);
    for (int i = 0; i < 2; i++) {
        d.until = wild[i];
        REFUSED(fram_run(scenario_of_test, &d, &result, &e));
        REFUSED(fram_resume(c, &d, &result, &e));
    }
    d.until = 0;
    ck_assert_int_ne(access(run, F_OK), 0);

    fram_bench_result bench;
    REFUSED_NULL(fram_bench(NULL, 0, 1, &bench, &e), fram_bench(NULL, 0, 1, &bench, NULL));
    REFUSED(fram_bench(scenario_of_test, 0, 1, NULL, &e));
    for (int i = 0; i < WILD; i++) {
        REFUSED(fram_bench(scenario_of_test, wild[i], 1, &bench, &e));
        REFUSED(fram_bench(scenario_of_test, 0, wild[i], &bench, &e));
    }
    fram_bench_scene_definition s = {0};
    (fram_bench_scene_default)(NULL, sizeof(size_t));
    REFUSED(fram_bench_scene(c, scene, NULL, &bench, &e));
    REFUSED(fram_bench_scene(c, scene, &s, &bench, &e));
    fram_bench_scene_default(&s);
    REFUSED(fram_bench_scene(NULL, scene, &s, &bench, &e));
    REFUSED(fram_bench_scene(c, NULL, &s, &bench, &e));
    REFUSED(fram_bench_scene(c, scene, &s, NULL, &e));
    REFUSED(fram_bench_scene(c, scene, &s, &bench, &e)); /* no scene */
    for (int i = 0; i < WILD; i++) {
        double *const members[] = {&s.time_step, &s.warm, &s.time};
        static const char *const names[] = {"time_step", "warm", "time"};
        for (int k = 0; k < 3; k++) {
            fram_bench_scene_default(&s);
            *members[k] = wild[i];
            REFUSED_KEY(fram_bench_scene(c, scene, &s, &bench, &e), names[k]);
        }
    }
    fram_bench_scene_default(&s);
    s.dump = scene;
    REFUSED_KEY(fram_bench_scene(c, scene, &s, &bench, &e), "dump");
    fram_bench_scene_default(&s);
    s.iterations = INT_MIN;
    REFUSED(fram_bench_scene(c, scene, &s, &bench, &e));
    fram_bench_scene_default(&s);
    s.solver = NULL;
    REFUSED(fram_bench_scene(c, scene, &s, &bench, &e));
    close_all();
}
END_TEST

/* With a finished run. */
static fram_context *open_run(void)
{
    open_all();
    fram_run_definition d;
    fram_run_default(&d);
    d.folder = run;
    assert_ok(fram_run(scenario_of_test, &d, NULL, &e), e);
    assert_ok(fram_resume(context_of_test, &d, NULL, &e), e);
    return context_of_test;
}

START_TEST(exports_and_reports)
{
    fram_context *c = open_run();
    fram_result result;
    REFUSED_NULL(fram_export_vtk(NULL, run, NULL, 1, &result, &e), fram_export_vtk(NULL, run, NULL, 1, NULL, NULL));
    REFUSED(fram_export_vtk(c, NULL, NULL, 1, &result, &e));
    REFUSED(fram_export_vtk(c, run, NULL, 0, &result, &e));
    REFUSED(fram_export_vtk(c, run, NULL, INT64_MIN, &result, &e));
    REFUSED(fram_export_vtk(c, folder, NULL, 1, &result, &e)); /* no run */
    assert_ok(fram_export_vtk(c, run, NULL, INT64_MAX, NULL, &e), e);
    REFUSED(fram_export_geojson(NULL, run, NULL, 0, &result, &e));
    REFUSED(fram_export_geojson(c, NULL, NULL, 0, &result, &e));
    for (int i = 0; i < WILD; i++)
        REFUSED(fram_export_geojson(c, run, NULL, wild[i], &result, &e));
    assert_ok(fram_export_geojson(c, run, NULL, 0.25, NULL, &e), e);
    REFUSED(fram_export_netcdf(NULL, run, NULL, &result, &e));
    REFUSED(fram_export_netcdf(c, NULL, NULL, &result, &e));
    REFUSED(fram_report(NULL, run, NULL, false, &result, &e));
    REFUSED(fram_report(c, NULL, NULL, false, &result, &e));
    assert_ok(fram_report(c, run, NULL, true, NULL, &e), e);
    char own[4096];
    snprintf(own, sizeof own, "%s/series.csv", run);
    REFUSED(fram_report(c, run, own, false, &result, &e));
    REFUSED(fram_export_vtk(c, run, own, 1, &result, &e));
    REFUSED(fram_export_geojson(c, run, own, 0, &result, &e));
    REFUSED(fram_export_netcdf(c, run, own, &result, &e));
    ck_assert(fram_run_has_file(run, own) && !fram_run_has_file(NULL, own) && !fram_run_has_file(run, NULL));
    ck_assert(!fram_path_is_stream(NULL) && !fram_path_is_stream(own) && !fram_path_is_stream(run));
    ck_assert(fram_path_is_stream("/dev/null") && fram_path_is_stream("/dev/fd/2"));
    ck_assert_int_eq(fram_path_check_place(NULL, false, &e), FRAM_ERROR_USAGE);
    assert_ok(fram_path_check_place(own, false, &e), e);
    assert_fails(fram_path_check_place("none/there/x", true, &e), e, FRAM_ERROR_INPUT,
                 "cannot make the folder: the folder none/there is not there; make it");
    close_all();
}
END_TEST

START_TEST(plots_and_channels)
{
    fram_context *c = open_run();
    const char *channels[] = {"ice_force_x", NULL, "no such channel"};
    char *text;
    REFUSED(fram_plot(NULL, run, channels, 1, nan_value, nan_value, output, &e));
    REFUSED(fram_plot(c, NULL, channels, 1, nan_value, nan_value, output, &e));
    REFUSED(fram_plot(c, run, NULL, 1, nan_value, nan_value, output, &e));
    REFUSED(fram_plot(c, run, channels, 1, nan_value, nan_value, NULL, &e));
    REFUSED(fram_plot(c, run, channels, 2, nan_value, nan_value, output, &e));
    REFUSED_KEY(fram_plot(c, run, channels, 0, nan_value, nan_value, output, &e), "channel_count");
    REFUSED_KEY(fram_plot(c, run, channels, INT_MIN, nan_value, nan_value, output, &e), "channel_count");
    REFUSED_KEY(fram_plot(c, run, channels, FRAM_PLOT_CHANNELS + 1, nan_value, nan_value, output, &e), "channel_count");
    REFUSED(fram_plot(c, run, channels + 2, 1, nan_value, nan_value, output, &e));
    REFUSED(fram_plot(c, run, channels, 1, infinite, nan_value, output, &e));
    REFUSED(fram_plot(c, run, channels, 1, 1e300, -1e300, output, &e));
    REFUSED(fram_channels(NULL, run, &text, &e));
    REFUSED(fram_channels(c, NULL, &text, &e));
    REFUSED(fram_channels(c, run, NULL, &e));
    assert_ok(fram_channels(c, run, &text, &e), e);
    fram_text_free(c, text);
    close_all();
}
END_TEST

START_TEST(managed_ice)
{
    fram_context *c = open_run();
    fram_manage_definition ice;
    char *text;
    (fram_manage_default)(NULL, sizeof(size_t));
    fram_manage_default(&ice);
    REFUSED(fram_manage(NULL, run, &ice, NULL, &text, &e));
    REFUSED(fram_manage(c, NULL, &ice, NULL, &text, &e));
    REFUSED(fram_manage(c, run, NULL, NULL, &text, &e));
    REFUSED(fram_manage(c, run, &ice, NULL, NULL, &e));
    ice.limit = -1;
    REFUSED(fram_manage(c, run, &ice, NULL, &text, &e));
    ice.limit = 0, ice.vessel = "nobody";
    REFUSED(fram_manage(c, run, &ice, NULL, &text, &e));
    close_all();
}
END_TEST

START_TEST(explained_peaks)
{
    fram_context *c = open_run();
    fram_why_definition asked;
    char *text;
    (fram_why_default)(NULL, sizeof(size_t));
    fram_why_default(&asked);
    asked.rerun = false;
    asked.peak = 1;
    REFUSED(fram_why(NULL, run, &asked, &text, &e));
    REFUSED(fram_why(c, NULL, &asked, &text, &e));
    REFUSED(fram_why(c, run, NULL, &text, &e));
    REFUSED(fram_why(c, run, &asked, NULL, &e));
    asked.peak = INT_MIN;
    REFUSED(fram_why(c, run, &asked, &text, &e));
    asked.peak = INT_MAX;
    REFUSED(fram_why(c, run, &asked, &text, &e));
    asked.peak = 0;
    asked.time = nan_value;
    REFUSED(fram_why(c, run, &asked, &text, &e));
    asked.time = -1e300;
    REFUSED(fram_why(c, run, &asked, &text, &e));
    asked.peak = 1;
    asked.vessel = "nobody";
    REFUSED(fram_why(c, run, &asked, &text, &e));
    asked.size = 0;
    REFUSED(fram_why(c, run, &asked, &text, &e));
    close_all();
}
END_TEST

START_TEST(pressure_on_panels)
{
    fram_context *c = open_run();
    fram_pressure_definition panels;
    (fram_pressure_default)(NULL, sizeof(size_t));
    fram_pressure_default(&panels);
    REFUSED(fram_pressure(c, run, &panels, &e));
    panels.output = "nowhere";
    REFUSED(fram_pressure(NULL, run, &panels, &e));
    REFUSED(fram_pressure(c, NULL, &panels, &e));
    REFUSED(fram_pressure(c, run, NULL, &e));
    panels.panel = infinite;
    REFUSED(fram_pressure(c, run, &panels, &e));
    panels.panel = 0;
    REFUSED(fram_pressure(c, run, &panels, &e));
    panels.panel = 1;
    panels.from = infinite;
    REFUSED(fram_pressure(c, run, &panels, &e));
    panels.from = 0;
    panels.frame_count = 2;
    REFUSED(fram_pressure(c, run, &panels, &e));
    panels.frame_count = -1;
    REFUSED(fram_pressure(c, run, &panels, &e));
    panels.frame_count = 0;
    panels.stringer_count = INT_MAX;
    REFUSED(fram_pressure(c, run, &panels, &e));
    close_all();
}
END_TEST

START_TEST(comparisons)
{
    fram_context *c = open_run();
    fram_comparison comparison;
    REFUSED(fram_compare(NULL, run, run, NULL, &comparison, &e));
    REFUSED(fram_compare(c, NULL, run, NULL, &comparison, &e));
    REFUSED(fram_compare(c, run, NULL, NULL, &comparison, &e));
    REFUSED(fram_compare(c, run, run, NULL, NULL, &e));
    assert_ok(fram_compare(c, run, run, NULL, &comparison, &e), e);
    ck_assert(comparison.same_scenario && comparison.same_state);
    fram_comparison_free(NULL, &comparison);
    fram_comparison_free(c, NULL);
    fram_comparison_free(c, &comparison);
    fram_comparison_free(c, &comparison);
    close_all();
}
END_TEST

START_TEST(videos_pages_and_capability)
{
    fram_context *c = open_run();
    fram_result result;
    fram_video_definition v = {0};
    (fram_video_default)(NULL, sizeof(size_t));
    REFUSED(fram_video(c, run, NULL, &result, &e));
    REFUSED(fram_video(c, run, &v, &result, &e));
    fram_video_default(&v);
    v.output = output;
    v.pictures = true;
    REFUSED(fram_video(NULL, run, &v, &result, &e));
    REFUSED(fram_video(c, NULL, &v, &result, &e));
    for (int i = 0; i < WILD; i++) {
        fram_video_definition wrong = v;
        if (!(fabs(wild[i]) <= 1)) {
            wrong.speed = wild[i];
            REFUSED(fram_video(c, run, &wrong, &result, &e));
        }
        wrong = v;
        wrong.camera = "plan";
        wrong.span = wild[i];
        if (!(fabs(wild[i]) <= 1))
            REFUSED(fram_video(c, run, &wrong, &result, &e));
    }
    const int sizes[] = {INT_MIN, -1, 0, 321, INT_MAX};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        fram_video_definition wrong = v;
        wrong.width = sizes[i];
        REFUSED(fram_video(c, run, &wrong, &result, &e));
        wrong = v;
        wrong.frames_per_second = sizes[i];
        REFUSED(fram_video(c, run, &wrong, &result, &e));
    }
    char own[4096];
    snprintf(own, sizeof own, "%s/series.csv", run);
    v.output = own;
    REFUSED(fram_video(c, run, &v, &result, &e));
    v.output = output;
    v.colour = NULL;
    REFUSED(fram_video(c, run, &v, &result, &e));
    v.colour = "speed", v.camera = NULL;
    REFUSED(fram_video(c, run, &v, &result, &e));

    fram_playback_definition p = {0};
    fram_playback_result report;
    (fram_playback_default)(NULL, sizeof(size_t));
    REFUSED(fram_playback(c, NULL, &report, &e));
    REFUSED(fram_playback(c, &p, &report, &e));
    fram_playback_default(&p);
    REFUSED(fram_playback(c, &p, &report, &e));
    p.folder = run;
    REFUSED(fram_playback(c, &p, &report, &e));
    p.output = output;
    REFUSED(fram_playback(c, &p, &report, &e));
    p.viewer_page = page;
    REFUSED(fram_playback(c, &p, &report, &e)); /* no viewer */
    p.output = page;
    REFUSED_KEY(fram_playback(c, &p, &report, &e), "output");
    p.output = output;
    p.page_limit = UINT64_MAX, p.total_limit = UINT64_MAX;
    REFUSED(fram_playback(c, &p, &report, &e));
    REFUSED(fram_playback(NULL, &p, &report, &e));

    fram_capability_definition k = {0};
    (fram_capability_default)(NULL, sizeof(size_t));
    REFUSED(fram_capability(scenario_of_test, NULL, &result, &e));
    REFUSED(fram_capability(scenario_of_test, &k, &result, &e));
    fram_capability_default(&k);
    REFUSED(fram_capability(scenario_of_test, &k, &result, &e));
    k.folder = output;
    REFUSED(fram_capability(NULL, &k, &result, &e));
    static const char text[] = "vessel:\n  mode: free\n  hull: {form: box, length: 20, beam: 8, draught: 2}\n"
                               "  mooring: {depth: 60, lines: [{count: 4, distance: 400, pretension: 1e5}]}\n"
                               "ice: {source: none}\ndomain: {boundary: open}\n";
    fram_scenario *moored = NULL;
    scratch_text(page, text);
    assert_ok(fram_scenario_load(c, page, NULL, 0, &moored, &e), e);
    for (int i = 0; i < WILD; i++) {
        for (int member = 0; member < 6; member++) {
            fram_capability_default(&k);
            k.folder = output;
            double *const members[] = {&k.measure,   &k.speed_step,  &k.speed_most,
                                       &k.allowance, &k.line_safety, &k.line_safety_damaged};
            *members[member] = wild[i];
            REFUSED(fram_capability(moored, &k, &result, &e));
        }
    }
    fram_capability_default(&k);
    k.folder = output;
    k.directions = INT_MAX;
    REFUSED(fram_capability(moored, &k, &result, &e));
    fram_scenario_destroy(moored);
    close_all();
}
END_TEST

START_TEST(fields)
{
    open_all();
    fram_context *c = context_of_test;
    fram_field *f;
    fram_field_definition d = {0};
    fram_field_summary summary;
    scratch_text(output, "0 0\n10 0\n10 10\n0 10\n");
    (fram_field_default)(NULL, sizeof(size_t));
    REFUSED_NULL(fram_field_load(NULL, output, NULL, &f, &e), fram_field_load(NULL, output, NULL, &f, NULL));
    REFUSED(fram_field_load(c, NULL, NULL, &f, &e));
    REFUSED(fram_field_load(c, output, NULL, NULL, &e));
    REFUSED(fram_field_load(c, output, &d, &f, &e));
    for (int i = 0; i < WILD; i++) {
        for (int member = 0; member < 7; member++) {
            fram_field_default(&d);
            double *const members[] = {&d.scale,      &d.simplify,   &d.smallest_area, &d.offset[0],
                                       &d.crop_lo[1], &d.crop_hi[0], &d.crop_hi[1]};
            *members[member] = wild[i];
            d.crop = member >= 4;
            if (member == 3 || member == 4 ? isfinite(wild[i]) : member < 3 && wild[i] > 0 && isfinite(wild[i]))
                continue; /* no length is too long to be left out, or far off */
            REFUSED(fram_field_load(c, output, &d, &f, &e));
        }
    }
    fram_field_default(&d);
    d.bad = (fram_field_bad)99;
    REFUSED(fram_field_load(c, output, &d, &f, &e));
    fram_field_default(&d);
    d.scale = 1e300;
    REFUSED(fram_field_load(c, output, &d, &f, &e));
    d.scale = 1, d.offset[0] = 1e300;
    REFUSED(fram_field_load(c, output, &d, &f, &e));

    assert_ok(fram_field_load(c, output, NULL, &f, &e), e);
    double lo[2] = {0, 0}, hi[2] = {20, 20}, xy[2] = {0, 0};
    fram_field_summary_get(NULL, &summary);
    ck_assert_int_eq(summary.floes, 0);
    fram_field_summary_get(f, NULL);
    fram_field_note note;
    ck_assert_int_eq(fram_field_notes(NULL, &note, 1), 0);
    ck_assert_int_eq(fram_field_notes(f, NULL, INT_MAX), 0);
    ck_assert_int_eq(fram_field_outline(NULL, 0, xy, 1), 0);
    ck_assert_int_eq(fram_field_outline(f, -1, xy, 1), 0);
    ck_assert_int_eq(fram_field_outline(f, INT_MAX, xy, 1), 0);
    ck_assert_int_eq(fram_field_outline(f, 0, NULL, INT_MAX), 4);
    ck_assert_int_eq(fram_field_outline(f, 0, xy, INT_MIN), 4);
    assert_relative(fram_field_concentration(f, lo, hi), 0.25, 1e-12);
    ck_assert(isnan(fram_field_concentration(NULL, lo, hi)) && isnan(fram_field_concentration(f, NULL, hi)) &&
              isnan(fram_field_concentration(f, lo, NULL)) && isnan(fram_field_concentration(f, hi, lo)) &&
              isnan(fram_field_concentration(f, lo, lo)));
    for (int i = 0; i < 3; i++) {
        double far[2] = {wild[i], 20};
        ck_assert(isnan(fram_field_concentration(f, lo, far)) && isnan(fram_field_concentration(f, far, hi)));
    }
    fram_field_making making;
    fram_field_population population;
    ck_assert(!fram_field_making_get(NULL, &making) && !fram_field_making_get(f, &making) &&
              !fram_field_making_get(f, NULL));
    REFUSED(fram_field_population_get(NULL, 0, &population, &e));
    REFUSED(fram_field_population_get(f, 0, NULL, &e));
    REFUSED(fram_field_population_get(f, 0, &population, &e));
    REFUSED(fram_field_population_get(f, INT_MIN, &population, &e));
    REFUSED(fram_field_draw(NULL, NULL, output, &e));
    REFUSED(fram_field_draw(f, NULL, NULL, &e));
    REFUSED(fram_field_draw_cover(NULL, 0, NULL, output, &e));
    REFUSED(fram_field_draw_cover(f, 0, NULL, NULL, &e));
    for (int i = 0; i < WILD; i++)
        REFUSED(fram_field_draw_cover(f, wild[i], NULL, output, &e));
    REFUSED(fram_field_draw_cover(f, 1e-300, NULL, output, &e));
    REFUSED(fram_field_table(NULL, output, &e));
    REFUSED(fram_field_table(f, NULL, &e));
    REFUSED(fram_field_save(NULL, output, &e));
    REFUSED(fram_field_save(f, NULL, &e));
    /* The file that it came from stays. */
    snprintf(run, sizeof run, "%s/./output", folder);
    REFUSED_KEY(fram_field_draw(f, NULL, run, &e), "path");
    REFUSED_KEY(fram_field_draw_cover(f, 0, NULL, run, &e), "path");
    REFUSED_KEY(fram_field_table(f, run, &e), "path");
    REFUSED_KEY(fram_field_save(f, run, &e), "path");
    fram_field_destroy(f);
    fram_field_destroy(NULL);

    /* What a scenario's is made of stays too, when the scenario is gone. */
    static const char *const opened[] = {"ice.open_water_file=output"};
    fram_scenario *s;
    assert_ok(fram_scenario_load(c, scene, opened, 1, &s, &e), e);
    assert_ok(fram_field_generate(s, &f, &e), e);
    fram_scenario_destroy(s);
    REFUSED_KEY(fram_field_save(f, run, &e), "path");
    REFUSED_KEY(fram_field_save(f, scene, &e), "path");
    fram_field_destroy(f);

    /* No floe is left: nothing to map, and no undefined size of a picture. */
    fram_field_default(&d);
    d.smallest_area = 1e9;
    if (fram_field_load(c, output, &d, &f, &e) == FRAM_OK) {
        REFUSED(fram_field_draw_cover(f, 0, NULL, page, &e));
        (void)fram_field_draw(f, NULL, page, &e);
        fram_field_destroy(f);
    }
    REFUSED(fram_field_generate(NULL, &f, &e));
    REFUSED(fram_field_generate(scenario_of_test, NULL, &e));
    close_all();
}
END_TEST

START_TEST(hulls)
{
    open_all();
    fram_context *c = context_of_test;
    fram_hull *h;
    fram_hull_file_definition d = {0};
    fram_hull_particulars p = {0};
    fram_hull_condition k = {0};
    fram_hull_surface surface;
    fram_hull_floating floating;
    fram_hull_pieces pieces;
    (fram_hull_file_default)(NULL, sizeof(size_t));
    (fram_hull_particulars_default)(NULL, sizeof(size_t));
    (fram_hull_condition_default)(NULL, sizeof(size_t));
    REFUSED(fram_hull_load(NULL, scene, NULL, &h, &e));
    REFUSED(fram_hull_load(c, NULL, NULL, &h, &e));
    REFUSED(fram_hull_load(c, scene, NULL, NULL, &e));
    REFUSED(fram_hull_load(c, scene, &d, &h, &e));
    for (int i = 0; i < WILD; i++) {
        fram_hull_file_default(&d);
        d.scale = wild[i];
        REFUSED(fram_hull_load(c, scene, &d, &h, &e));
    }
    REFUSED(fram_hull_make(c, NULL, &h, &e));
    REFUSED(fram_hull_make(c, &p, &h, &e));
    fram_hull_particulars_default(&p);
    REFUSED(fram_hull_make(NULL, &p, &h, &e));
    REFUSED(fram_hull_make(c, &p, NULL, &e));
    for (int i = 0; i < WILD; i++) {
        for (int member = 0; member < 10; member++) {
            fram_hull_particulars_default(&p);
            double *const members[] = {
                &p.length,         &p.beam,        &p.draught,     &p.freeboard,        &p.stem_angle,
                &p.entrance_angle, &p.flare_angle, &p.stern_angle, &p.parallel_midbody, &p.block_coefficient};
            *members[member] = wild[i];
            fram_status status = fram_hull_make(c, &p, &h, &e);
            if (status == FRAM_OK && member < 4)
                ck_abort_msg("a hull of member %d = %g", member, wild[i]);
            if (status == FRAM_OK)
                fram_hull_destroy(h);
        }
    }
    fram_hull_particulars_default(&p);
    p.box = true;
    assert_ok(fram_hull_make(c, &p, &h, &e), e);
    fram_hull_surface_get(NULL, &surface);
    ck_assert_int_eq(surface.triangles, 0);
    fram_hull_surface_get(h, NULL);
    fram_hull_triangles(NULL, NULL, 0, NULL, 0);
    fram_hull_triangles(h, NULL, INT_MAX, NULL, INT_MAX);
    fram_hull_triangles(h, NULL, INT_MIN, NULL, INT_MIN);
    REFUSED(fram_hull_float(NULL, NULL, &floating, &e));
    REFUSED(fram_hull_float(h, NULL, NULL, &e));
    REFUSED(fram_hull_float(h, &k, &floating, &e));
    for (int i = 1; i < WILD; i++) {
        for (int member = 0; member < 6; member++) {
            fram_hull_condition_default(&k);
            double *const members[] = {&k.draught, &k.mass, &k.water_density, &k.centre[0], &k.centre[2], &k.gravity};
            *members[member] = wild[i];
            if (member == 2 && wild[i] > 0 && isfinite(wild[i]))
                continue;
            if (member >= 3 && isfinite(wild[i]))
                continue;
            REFUSED(fram_hull_float(h, &k, &floating, &e));
        }
    }
    REFUSED(fram_hull_cut(NULL, nan_value, 8, &pieces, &e));
    REFUSED(fram_hull_cut(h, nan_value, 8, NULL, &e));
    REFUSED_KEY(fram_hull_cut(h, nan_value, 0, &pieces, &e), "most");
    REFUSED_KEY(fram_hull_cut(h, nan_value, INT_MAX, &pieces, &e), "most");
    for (int i = 1; i < 4; i++)
        REFUSED(fram_hull_cut(h, wild[i], 8, &pieces, &e));
    REFUSED(fram_hull_draw(NULL, NULL, NULL, output, &e));
    REFUSED(fram_hull_draw(h, NULL, NULL, NULL, &e));
    REFUSED(fram_hull_save(NULL, output, &e));
    REFUSED(fram_hull_save(h, NULL, &e));
    REFUSED(fram_hull_save(h, output, &e)); /* no ending */
    fram_hull_destroy(h);
    fram_hull_destroy(NULL);
    close_all();
}
END_TEST

START_TEST(ice)
{
    fram_ice_wedge_result wedge;
    fram_ice_sheet_result sheet;
    fram_ice_edge load = {0};
    fram_ice_breaking breaking;
    REFUSED_NULL(fram_ice_wedge(0.1, NULL, &e), fram_ice_wedge(0.1, NULL, NULL));
    REFUSED(fram_ice_sheet(0.1, 0.3, NULL, &e));
    for (int i = 0; i < WILD; i++) {
        REFUSED(fram_ice_wedge(wild[i], &wedge, &e));
        REFUSED(fram_ice_sheet(wild[i], 0.3, &sheet, &e));
        REFUSED(fram_ice_sheet(0.1, wild[i], &sheet, &e));
    }
    (fram_ice_edge_default)(NULL, sizeof(size_t));
    REFUSED(fram_ice_break(NULL, &breaking, &e));
    REFUSED(fram_ice_break(&load, &breaking, &e));
    fram_ice_edge_default(&load);
    REFUSED(fram_ice_break(&load, NULL, &e));
    for (int i = 0; i < 4; i++) {
        for (int member = 0; member < 14; member++) {
            fram_ice_edge_default(&load);
            double *const members[] = {&load.force,           &load.contact_area,      &load.thickness,
                                       &load.elastic_modulus, &load.poisson_ratio,     &load.flexural_strength,
                                       &load.gravity,         &load.crushing_strength, &load.water_density,
                                       &load.included_angle,  &load.contact_width,     &load.ice_length,
                                       &load.rise_time,       &load.ice_density};
            *members[member] = wild[i];
            REFUSED(fram_ice_break(&load, &breaking, &e));
        }
    }
    fram_ice_edge_default(&load);
    load.wedges = INT_MAX;
    REFUSED(fram_ice_break(&load, &breaking, &e));
    fram_ice_floe floe = {0};
    fram_ice_splitting splitting;
    (fram_ice_floe_default)(NULL, sizeof(size_t));
    REFUSED(fram_ice_split(NULL, &splitting, &e));
    REFUSED(fram_ice_split(&floe, &splitting, &e));
    fram_ice_floe_default(&floe);
    REFUSED(fram_ice_split(&floe, NULL, &e));
    for (int i = 0; i < 4; i++) {
        for (int member = 0; member < (i < 3 ? 5 : 4); member++) {
            fram_ice_floe_default(&floe);
            double *const members[] = {&floe.thickness, &floe.toughness, &floe.length, &floe.width, &floe.place};
            *members[member] = wild[i];
            REFUSED(fram_ice_split(&floe, &splitting, &e));
        }
    }
}
END_TEST

TEST_MAIN("misuse", words_and_contexts, scenarios, worlds, runs_and_benchmarks, exports_and_reports, plots_and_channels,
          managed_ice, explained_peaks, pressure_on_panels, comparisons, videos_pages_and_capability, fields, hulls,
          ice)
