/* Runs and benchmarks of the public API. */
#include "api/arguments.h"
#include "api/handles.h"

#include "io/path.h"
#include "results/playback.h"
#include "results/run_results.h"
#include "sim/bench.h"
#include "sim/run.h"

#include <string.h>

static void fram_run_fill(fram_run_definition *definition)
{
    *definition = (fram_run_definition){.size = sizeof *definition};
}
DEFINITION_DEFAULT(fram_run, fram_run_definition)

fram_status live_open(context *ctx, const char *folder, const char *page, fram_live_function live, void *user,
                      live_view **view, fram_error *error)
{
    *view = NULL;
    if (!page)
        return FRAM_OK;
    if (!live)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "live",
                         "expected a function that is told the address, found NULL");
    fram_status status = live_view_open(ctx, folder, page, view, error);
    if (status == FRAM_OK)
        live(user, live_view_address(*view));
    return status;
}

static void begin_view(void *user) { live_view_begin(user); }

/* The caller's progress function with its user pointer. */
typedef struct progress_bridge {
    fram_progress_function function;
    void *user;
} progress_bridge;

static void forward_progress(void *user, const run_progress *p)
{
    const progress_bridge *bridge = user;
    fram_progress out = {p->time, p->end, p->wall, p->eta, p->real_time_factor};
    bridge->function(bridge->user, &out);
}

static fram_status take_run(const fram_run_definition *given, fram_run_definition *d, fram_error *error)
{
    fram_run_fill(d);
    fram_status status = definition_take(d, given, sizeof *d, offsetof(fram_run_definition, force), "fram_run", error);
    if (status == FRAM_OK)
        status = folder_check("folder", d->folder, error);
    if (status != FRAM_OK)
        return status;
    if (!(d->until < 1e300))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "until", "expected a finite time");
    return FRAM_OK;
}

static run_options options_of(const fram_run_definition *d, progress_bridge *bridge)
{
    *bridge = (progress_bridge){d->progress, d->progress_user};
    return (run_options){.folder = d->folder,
                         .force = d->force,
                         .with_paths = d->with_paths,
                         .until = d->until,
                         .begun = begin_view,
                         .progress = d->progress ? forward_progress : NULL,
                         .progress_user = bridge,
                         .stop = d->stop,
                         .finish = run_results_write};
}

fram_run_result run_answer(const run_result *from)
{
    return (fram_run_result){.state_hash = from->state_hash,
                             .steps = from->steps,
                             .time = from->time,
                             .wall = from->wall,
                             .real_time_factor = from->real_time_factor,
                             .bodies = from->bodies,
                             .floes = from->floes,
                             .finished = from->finished};
}

/* An interrupted run tells how far it came; one that failed leaves the caller's result alone. */
static void give_result(fram_run_result *result, size_t size, fram_status status, const run_result *from)
{
    if (status == FRAM_OK || status == FRAM_INTERRUPTED)
        result_give(result, size, &(fram_run_result[]){run_answer(from)});
}

/* s: NULL goes on with what the folder holds. */
static fram_status run_or_resume(context *ctx, const scenario *s, const fram_run_definition *definition,
                                 fram_run_result *result, size_t size, fram_error *error)
{
    fram_run_definition d;
    fram_status status = RESULT_CHECK(result, size, fram_run_result, error);
    if (status == FRAM_OK)
        status = take_run(definition, &d, error);
    if (status != FRAM_OK)
        return status;
    progress_bridge bridge;
    run_options options = options_of(&d, &bridge);
    run_result inner = {0};
    live_view *view;
    status = live_open(ctx, d.folder, d.live_page, d.live, d.live_user, &view, error);
    if (status != FRAM_OK)
        return status;
    options.begun_user = view;
    status = s ? run_start(ctx, s, &options, &inner, error) : run_resume(ctx, &options, &inner, error);
    live_view_end(view);
    give_result(result, size, status, &inner);
    return status;
}

fram_status(fram_run)(const fram_scenario *s, const fram_run_definition *definition, fram_run_result *result,
                      fram_error *error, size_t size)
{
    fram_status status = REFUSE_NULL(error, {"scenario", s});
    return status == FRAM_OK ? run_or_resume(&s->context->inner, &s->inner, definition, result, size, error) : status;
}

fram_status(fram_resume)(fram_context *c, const fram_run_definition *definition, fram_run_result *result,
                         fram_error *error, size_t size)
{
    fram_status status = REFUSE_NULL(error, {"context", c});
    return status == FRAM_OK ? run_or_resume(&c->inner, NULL, definition, result, size, error) : status;
}

/* ---- benchmarks ---- */

/* Simulated seconds and steps of a benchmark, far beyond every use. */
#define BENCH_TIME_MOST 1e6
#define BENCH_STEPS_MOST 1e8
/* Time step of a scene, far below every use [s]. */
#define BENCH_STEP_LEAST 1e-9

static fram_bench_result bench_answer(const bench_result *r)
{
    return (fram_bench_result){.steps = r->steps,
                               .floes = r->floes,
                               .ms_per_step_median = r->cpu_median * 1e3,
                               .ms_wall_median = r->wall_median * 1e3,
                               .us_per_floe_step = r->floes > 0 ? r->cpu_median * 1e6 / r->floes : 0,
                               .collide_ms = r->collide_median * 1e3,
                               .solve_ms = r->solve_median * 1e3,
                               .forces_ms = r->forces_median * 1e3,
                               .real_time_factor = r->real_time_factor,
                               .contact_points = r->contact_points,
                               .pairs = r->pairs,
                               .loaded_pairs = r->loaded_pairs,
                               .mean_penetration_m = r->mean_depth,
                               .max_penetration_m = r->max_depth,
                               .ship_force_kN = r->ship_force * 1e-3,
                               .kinetic_energy_J = r->kinetic_energy,
                               .solver_residual = r->residual,
                               .state_hash = r->state_hash,
                               .ms_mean = r->cpu.mean * 1e3,
                               .ms_p99 = r->cpu.p99 * 1e3,
                               .ms_p999 = r->cpu.p999 * 1e3,
                               .ms_longest = r->cpu.longest * 1e3,
                               .ms_wall_p99 = r->wall.p99 * 1e3,
                               .ms_wall_p999 = r->wall.p999 * 1e3,
                               .ms_wall_longest = r->wall.longest * 1e3,
                               .share_forces = r->share[STAGE_FORCES],
                               .share_collision = r->share[STAGE_DETECTION],
                               .share_crushing = r->share[STAGE_CRUSHING],
                               .share_solver = r->share[STAGE_SOLVE] + r->share[STAGE_INTEGRATION],
                               .share_fracture = r->share[STAGE_FRACTURE]};
}

/* Times that can be measured. */
static fram_status bench_times_check(double warm, double time, fram_error *error)
{
    fram_status status = number_check("warm", warm, 0, BENCH_TIME_MOST, error);
    return status == FRAM_OK ? number_check("time", time, 0, BENCH_TIME_MOST, error) : status;
}

fram_status(fram_bench)(const fram_scenario *s, double warm, double time, fram_bench_result *result, fram_error *error,
                        size_t size)
{
    bench_result r;
    fram_status status = REFUSE_NULL(error, {"scenario", s}, {"result", result});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_bench_result, error);
    if (status == FRAM_OK)
        status = bench_times_check(warm, time, error);
    if (status == FRAM_OK &&
        !(warm / s->inner.run.time_step <= BENCH_STEPS_MOST && time / s->inner.run.time_step <= BENCH_STEPS_MOST))
        status = error_set(error, FRAM_ERROR_INPUT, NULL, 0, "time", "expected at most %g steps", BENCH_STEPS_MOST);
    if (status != FRAM_OK)
        return status;
    status = bench_scenario(&s->context->inner, &s->inner, warm, time, &r, error);
    if (status == FRAM_OK)
        result_give(result, size, &(fram_bench_result[]){bench_answer(&r)});
    return status;
}

static void fram_bench_scene_fill(fram_bench_scene_definition *definition)
{
    *definition = (fram_bench_scene_definition){
        .size = sizeof *definition, .time_step = 0.02, .warm = 5, .time = 20, .iterations = 10, .solver = "fast"};
}
DEFINITION_DEFAULT(fram_bench_scene, fram_bench_scene_definition)

/* Times so that the number of steps is an ordinary one. */
static fram_status scene_times_check(const fram_bench_scene_definition *d, fram_error *error)
{
    fram_status status = bench_times_check(d->warm, d->time, error);
    if (status == FRAM_OK)
        status = number_check("time_step", d->time_step, BENCH_STEP_LEAST, BENCH_TIME_MOST, error);
    if (status == FRAM_OK && !(d->warm < d->time))
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "warm", "expected less than the time, %g s, found %g",
                           d->time, d->warm);
    if (status == FRAM_OK && !(d->time / d->time_step <= BENCH_STEPS_MOST))
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "time", "expected at most %g steps, found %g",
                           BENCH_STEPS_MOST, d->time / d->time_step);
    return status;
}

static fram_status scene_options(const fram_bench_scene_definition *given, bench_scene_options *out, fram_error *error)
{
    fram_bench_scene_definition taken, *d = &taken;
    fram_bench_scene_fill(d);
    static const char *const solvers[] = {
        [SOLVER_SEQUENTIAL] = "sequential", [SOLVER_FAST] = "fast", [SOLVER_ACCURATE] = "accurate"};
    fram_status status = definition_take(d, given, sizeof *d, DEFINITION_LEAST, "fram_bench_scene", error);
    if (status == FRAM_OK)
        status = scene_times_check(d, error);
    if (status != FRAM_OK)
        return status;
    if (d->iterations < 1 || d->iterations > 1000000)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "iterations", "expected 1 to 1000000");
    *out = (bench_scene_options){.time_step = d->time_step,
                                 .warm = d->warm,
                                 .time = d->time,
                                 .iterations = d->iterations,
                                 .dump = d->dump,
                                 .exact_water = d->exact_water != 0};
    int row;
    status = name_find("solver", d->solver, solvers, (int)(sizeof solvers / sizeof *solvers), &row, error);
    out->solver = (solver_kind)row;
    return status;
}

fram_status(fram_bench_scene)(fram_context *c, const char *path, const fram_bench_scene_definition *definition,
                              fram_bench_result *result, fram_error *error, size_t size)
{
    bench_scene_options options = {0};
    scene_text scene;
    fram_status status = REFUSE_NULL(error, {"context", c}, {"path", path}, {"result", result});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_bench_result, error);
    if (status == FRAM_OK)
        status = scene_options(definition, &options, error);
    if (status == FRAM_OK && options.dump)
        status = path_refuse_read(path, options.dump, "dump", error);
    if (status == FRAM_OK)
        status = scene_file_read(&c->inner, path, &scene, error);
    if (status != FRAM_OK)
        return status;
    bench_result r;
    status = bench_scene(&c->inner, &scene, &options, &r, error);
    scene_text_free(&c->inner, &scene);
    if (status == FRAM_OK)
        result_give(result, size, &(fram_bench_result[]){bench_answer(&r)});
    return status;
}

static void fram_playback_fill(fram_playback_definition *definition)
{
    *definition = (fram_playback_definition){.size = sizeof *definition};
}
DEFINITION_DEFAULT(fram_playback, fram_playback_definition)

fram_status(fram_playback)(fram_context *c, const fram_playback_definition *definition, fram_playback_result *result,
                           fram_error *error, size_t size)
{
    fram_playback_definition taken, *d = &taken;
    fram_playback_fill(d);
    fram_status status = REFUSE_NULL(error, {"context", c});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_playback_result, error);
    if (status == FRAM_OK)
        status = definition_take(d, definition, sizeof *d, DEFINITION_LEAST, "fram_playback", error);
    if (status == FRAM_OK)
        status = REFUSE_NULL(error, {"folder", d->folder}, {"viewer_page", d->viewer_page}, {"output", d->output});
    if (status == FRAM_OK)
        status = path_take(d->folder, d->output, error);
    if (status == FRAM_OK)
        status = path_refuse_read(d->viewer_page, d->output, "output", error);
    if (status != FRAM_OK)
        return status;
    const playback_options options = {d->viewer_page, d->output, d->page_limit, d->total_limit, d->pressure};
    playback_report report = {0};
    status = playback_write(&c->inner, d->folder, &options, &report, error);
    if (status == FRAM_OK)
        result_give(result, size, &(fram_playback_result){report.frames, report.left_out, report.files});
    return status;
}
