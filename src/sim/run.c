#include "sim/run.h"

#include "base/clock.h"
#include "io/scenario_file.h"
#include "sim/build.h"
#include "sim/notes.h"
#include "sim/pace.h"
#include "sim/recording.h"
#include "sim/step.h"
#include "sim/wall_check.h"

#include <stdio.h>

/* Everything a running simulation holds. */
typedef struct run {
    context own;  /* a copy: other threads of a program may be at work in the one it comes from */
    context *ctx; /* that */
    const run_options *options;
    recording record;
    model model;
    world world;
    double drawn; /* wall clock [s] */
    pace pace;
} run;

static fram_status run_init(context *ctx, const scenario *s, const run_options *options, run *r, fram_error *error)
{
    *r = (run){.own = *ctx, .ctx = &r->own, .options = options};
    const recording_options of = {options->force, options->with_paths, options->finish};
    fram_status status = recording_init(r->ctx, s, options->folder, &of, &r->record, error);
    if (status != FRAM_OK)
        return status;
    r->record.stop_step = r->record.end_step;
    /* Times first: the step of one far behind the end may be no integer of 64 bits. */
    if (options->until > 0 && options->until < s->run.duration)
        r->record.stop_step = scenario_step_at(options->until, s->run.time_step);
    else if (options->until > s->run.duration * (1 + 1e-9))
        log_write(ctx, LOG_WARNING,
                  "until %.10g s: the run ends at run.duration, %.10g s; a longer one is a run of its own with another "
                  "run.duration, or a program's, which loads a checkpoint and steps on",
                  options->until, s->run.duration);
    return FRAM_OK;
}

/* Progress is told so seldom [s]. */
#define PROGRESS_PERIOD 0.2

static void show_progress(run *r, bool last)
{
    double now = clock_wall();
    if (!r->options->progress || (!last && now - r->drawn < PROGRESS_PERIOD))
        return;
    r->drawn = now;
    double time = r->world.clock.time[0], done = time - r->record.began_at;
    double wall_time = now - r->record.started;
    run_progress p = {.time = time, .end = (double)r->record.end_step * r->record.s->run.time_step, .wall = wall_time};
    double stop = (double)r->record.stop_step * r->record.s->run.time_step;
    p.real_time_factor = wall_time > 0 ? done / wall_time : 0;
    p.eta = pace_left(&r->pace, wall_time, time, stop);
    r->options->progress(r->options->progress_user, &p);
}

static bool asked_to_stop(const run *r) { return stop_is_asked(r->options->stop); }

static fram_status step_loop(run *r, fram_error *error)
{
    fram_status status = FRAM_OK;
    while (status == FRAM_OK && r->world.clock.step[0] < r->record.stop_step && !asked_to_stop(r)) {
        double before = clock_wall();
        status = world_step(r->ctx, &r->model, &r->world, error);
        if (status == FRAM_OK)
            status = recording_step(&r->record, clock_wall() - before, error);
        show_progress(r, false);
    }
    show_progress(r, true);
    return status;
}

static fram_status drive(run *r, run_result *result, fram_error *error)
{
    r->drawn = 0;
    if (r->options->begun)
        r->options->begun(r->options->begun_user);
    r->pace = (pace){0};
    fram_error local = {0};
    fram_status status = step_loop(r, &local);
    wall_remind(r->ctx, r->record.s, &r->model, &r->world);
    /* A flag that is set from here on comes too late to be the reason for the end. */
    bool interrupted = status == FRAM_OK && r->world.clock.step[0] < r->record.stop_step;
    if (status == FRAM_OK) {
        recording_result(&r->record, result);
        const char *state = result->finished ? "finished" : interrupted ? "interrupted" : "stopped";
        status = recording_end(&r->record, state, &local);
    } else {
        recording_fail(&r->record, &local);
    }
    if (status == FRAM_OK && interrupted)
        status = error_set(&local, FRAM_INTERRUPTED, NULL, 0, NULL,
                           "interrupted at t = %g s; a checkpoint was written, from which the run can be resumed",
                           result->time);
    if (status != FRAM_OK && error)
        *error = local;
    return status;
}

static void run_free(run *r)
{
    recording_free(&r->record);
    model_free(r->ctx, &r->model);
}

/* ---- start ---- */

/* What is told of an endless field is of the tile that it repeats; in the domain there are other floes. */
static void log_ice(const run *r, const field_report *ice)
{
    bool tile = r->record.s->domain.boundary == DOMAIN_FEEDING && !r->model.sheet.drifts;
    int32_t floes = tile ? world_floe_count(&r->world) : ice->floes;
    char more[80] = "";
    if (ice->floes <= 0)
        return;
    if (tile)
        snprintf(more, sizeof more, " (%d in the tile that repeats, concentration %.4f of it)", (int)ice->floes,
                 ice->concentration);
    else if (ice->concentration > 0)
        snprintf(more, sizeof more, ", concentration %.4f", ice->concentration);
    log_write(r->ctx, LOG_INFO, "%d floe%s%s", (int)floes, floes == 1 ? "" : "s", more);
}

static void log_start(const run *r, const field_report *ice)
{
    log_ice(r, ice);
    for (int32_t i = 0; i < r->model.vessels.count; i++) {
        const vessel_model *v = &r->model.vessels.data[i];
        log_write(r->ctx, LOG_INFO, "%s%s displaces %.6g t", v->name[0] ? "vessel " : "the hull", v->name,
                  v->displaced_mass * 1e-3);
    }
}

/* What vessels cannot be is told alone.  What is odd beside it is told as soon as they stand, before the ice, which may
   take long and be refused for a reason that a warning names; some of it when all is made. */
static fram_status make_told(run *r, field_report *ice, fram_error *error)
{
    const scenario *s = r->record.s;
    bool when_made = notes_ask_what_was_made(s);
    fram_status status = build_model(r->ctx, s, &r->model, error);
    if (status == FRAM_OK)
        status = build_world_begin(r->ctx, s, &r->model, &r->world, error);
    if (status != FRAM_OK)
        return status;
    if (!when_made)
        notes_log_warnings(r->ctx, s, NULL, NULL);
    status = build_world_ice(r->ctx, s, &r->model, &r->world, ice, error);
    bool made = status == FRAM_OK;
    if (when_made)
        notes_log_warnings(r->ctx, s, made ? &r->model : NULL, made ? &r->world : NULL);
    return status;
}

/* The stop flag of the run stands for that of the context while the world is made. */
static fram_status make_world(run *r, field_report *ice, fram_error *error)
{
    const volatile int *stop = r->ctx->stop;
    if (r->options->stop)
        r->ctx->stop = r->options->stop;
    fram_status status = make_told(r, ice, error);
    r->ctx->stop = stop;
    return status;
}

fram_status run_start(context *ctx, const scenario *s, const run_options *options, run_result *result,
                      fram_error *error)
{
    run r;
    field_report ice = {0};
    fram_status status = run_init(ctx, s, options, &r, error);
    if (status == FRAM_OK)
        status = recording_prepare(&r.record, error);
    /* The world before the folder: a scenario that cannot be made leaves it as it was. */
    if (status == FRAM_OK)
        status = make_world(&r, &ice, error);
    if (status == FRAM_OK) {
        log_start(&r, &ice);
        status = recording_begin(&r.record, &r.world, error);
        if (status == FRAM_OK)
            status = drive(&r, result, error);
        world_free(ctx, &r.world);
    }
    run_free(&r);
    return status;
}

/* ---- resume ---- */

/* A run that a program took beyond the scenario's end is at its end. */
static fram_status check_stop(run *r, fram_error *error)
{
    double now = r->world.clock.time[0], until = r->options->until;
    if (until > 0 && until < now - 0.5 * r->record.s->run.time_step)
        return error_set(error, FRAM_ERROR_USAGE, r->options->folder, 0, "until",
                         "expected a time from %g s on, where the newest checkpoint is; found %g s", now, until);
    if (r->record.stop_step < r->world.clock.step[0])
        r->record.stop_step = r->world.clock.step[0];
    return FRAM_OK;
}

static fram_status resume_world(run *r, run_result *result, fram_error *error)
{
    recorder_lengths lengths;
    fram_status status = recording_read_state(&r->record, &r->model, &r->world, &lengths, error);
    if (status == FRAM_OK)
        status = check_stop(r, error);
    if (status == FRAM_OK)
        status = recording_resume(&r->record, &lengths, error);
    if (status != FRAM_OK)
        return status;
    log_write(r->ctx, LOG_INFO, "resuming at t = %g s", r->world.clock.time[0]);
    return drive(r, result, error);
}

fram_status run_resume(context *ctx, const run_options *options, run_result *result, fram_error *error)
{
    char path[PATH_ROOM];
    scenario s = {0};
    fram_status status = path_join(options->folder, "scenario.yaml", path, error);
    if (status == FRAM_OK)
        status = scenario_read(ctx, path, NULL, &s, error);
    if (status != FRAM_OK)
        return status;
    run r;
    status = run_init(ctx, &s, options, &r, error);
    if (status == FRAM_OK)
        status = recording_prepare_resume(&r.record, error);
    if (status == FRAM_OK)
        status = build_model(ctx, &s, &r.model, error);
    if (status == FRAM_OK)
        status = world_init(ctx, &r.model, &r.world, error);
    if (status == FRAM_OK) {
        status = resume_world(&r, result, error);
        world_free(ctx, &r.world);
    }
    run_free(&r);
    scenario_free(ctx, &s);
    return status;
}
