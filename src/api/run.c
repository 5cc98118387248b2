/* Runs and benchmarks of the public API. */
#include "api/handles.h"

#include "sim/bench.h"
#include "sim/playback.h"
#include "sim/run.h"

void fram_run_default(fram_run_definition *definition)
{
    *definition = (fram_run_definition){.size = sizeof *definition};
}

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

static fram_status check_definition(const fram_run_definition *d, fram_error *error)
{
    if (d->size != sizeof *d)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "fram_run_definition.size",
                         "the definition was not filled by fram_run_default of this version");
    if (!d->folder || !*d->folder)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "folder", "a folder for the results must be named");
    if (!(d->until < 1e300))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "until", "expected a finite time");
    return FRAM_OK;
}

static run_options options_of(const fram_run_definition *d, progress_bridge *bridge)
{
    *bridge = (progress_bridge){d->progress, d->progress_user};
    return (run_options){.folder = d->folder,
                         .force = d->force,
                         .until = d->until,
                         .progress = d->progress ? forward_progress : NULL,
                         .progress_user = bridge,
                         .stop = d->stop};
}

static void copy_result(const run_result *from, fram_run_result *to)
{
    if (!to)
        return;
    *to = (fram_run_result){.state_hash = from->state_hash,
                            .steps = from->steps,
                            .time = from->time,
                            .wall = from->wall,
                            .real_time_factor = from->real_time_factor,
                            .bodies = from->bodies,
                            .floes = from->floes,
                            .finished = from->finished};
}

fram_status fram_run(const fram_scenario *s, const fram_run_definition *definition, fram_run_result *result,
                     fram_error *error)
{
    fram_status status = check_definition(definition, error);
    if (status != FRAM_OK)
        return status;
    progress_bridge bridge;
    run_options options = options_of(definition, &bridge);
    run_result inner = {0};
    status = run_start(&s->context->inner, &s->inner, &options, &inner, error);
    copy_result(&inner, result);
    return status;
}

fram_status fram_resume(fram_context *c, const fram_run_definition *definition, fram_run_result *result,
                        fram_error *error)
{
    fram_status status = check_definition(definition, error);
    if (status != FRAM_OK)
        return status;
    progress_bridge bridge;
    run_options options = options_of(definition, &bridge);
    run_result inner = {0};
    status = run_resume(&c->inner, &options, &inner, error);
    copy_result(&inner, result);
    return status;
}

fram_status fram_bench(const fram_scenario *s, double warm, double time, fram_bench_result *result, fram_error *error)
{
    bench_result r;
    fram_status status = bench_scenario(&s->context->inner, &s->inner, warm, time, &r, error);
    if (status != FRAM_OK)
        return status;
    *result = (fram_bench_result){.steps = r.steps,
                                  .floes = r.floes,
                                  .ms_per_step_median = r.cpu_median * 1e3,
                                  .ms_wall_median = r.wall_median * 1e3,
                                  .us_per_floe_step = r.floes > 0 ? r.cpu_median * 1e6 / r.floes : 0,
                                  .real_time_factor = r.real_time_factor,
                                  .contact_points = r.contact_points,
                                  .pairs = r.pairs,
                                  .mean_penetration_m = r.mean_depth,
                                  .max_penetration_m = r.max_depth,
                                  .ship_force_kN = r.ship_force * 1e-3,
                                  .kinetic_energy_J = r.kinetic_energy,
                                  .solver_residual = r.residual,
                                  .state_hash = r.state_hash};
    return FRAM_OK;
}

fram_status fram_playback(fram_context *c, const char *folder, const char *viewer_page, const char *output,
                          int64_t *frames, int64_t *left_out, fram_error *error)
{
    int64_t in = 0, out = 0;
    fram_status status = playback_write(&c->inner, folder, viewer_page, output, &in, &out, error);
    if (frames)
        *frames = in;
    if (left_out)
        *left_out = out;
    return status;
}
