#include "sim/run.h"

#include "base/pool.h"
#include "io/atomic_file.h"
#include "io/path.h"
#include "io/scenario_file.h"
#include "sim/build.h"
#include "sim/checkpoint.h"
#include "sim/notes.h"
#include "sim/pictures.h"
#include "sim/recorder.h"
#include "sim/run_folder.h"
#include "sim/step.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Everything a running simulation holds. */
typedef struct run {
    context *ctx;
    const scenario *s;
    const run_options *options;
    model model;
    world world;
    recorder recorder;
    late_commit checkpoint; /* under way */
    text_buffer inputs;
    char hash[65];
    double started, drawn; /* wall clock [s] */
    double record_time;    /* for all that was written so far [s] */
    double end_time;       /* of it at the end [s] */
    double start_time;     /* simulated time at which this call began [s] */
    int64_t end_step, stop_step;
    int64_t checkpoint_every, picture_every;
    bool recording;
    int lock; /* on the folder, -1 */
} run;

static double wall_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The first step whose time is not before `time`, within rounding. */
static int64_t step_at(double time, double time_step) { return (int64_t)floor(time / time_step + 0.5); }

static void set_schedule(run *r)
{
    double dt = r->s->run.time_step;
    r->end_step = step_at(r->s->run.duration, dt);
    r->stop_step = r->end_step;
    /* Times first: the step of one far behind the end may be no integer of 64 bits. */
    if (r->options->until > 0 && r->options->until < r->s->run.duration)
        r->stop_step = step_at(r->options->until, dt);
    r->checkpoint_every = interval_steps(r->s->output.checkpoint_interval, dt);
    r->picture_every = interval_steps(r->s->output.picture_interval, dt);
}

static fram_status end_checkpoint(run *r, fram_error *error)
{
    return checkpoint_end(r->ctx, r->options->folder, &r->checkpoint, error);
}

/* The state of now; the one before is on the disk first. */
static fram_status write_checkpoint(run *r, fram_error *error)
{
    fram_status status = end_checkpoint(r, error);
    if (status != FRAM_OK)
        return status;
    file_writer *streams[RECORDER_STREAMS];
    recorder_streams(&r->recorder, streams);
    recorder_lengths lengths = recorder_lengths_of(&r->recorder);
    checkpoint_note note = {.series_length = lengths.series,
                            .record_length = lengths.record,
                            .fractures_length = lengths.fractures,
                            .inputs = r->inputs.data};
    memcpy(note.scenario_hash, r->hash, sizeof note.scenario_hash);
    return checkpoint_begin(r->ctx, r->options->folder, &r->world, &note, streams, RECORDER_STREAMS, &r->checkpoint,
                            error);
}

static fram_status write_summary(run *r, const char *state, const char *message, fram_error *error)
{
    run_summary summary = {.status = state,
                           .message = message,
                           .inputs = r->inputs.data,
                           .threads = context_threads(r->ctx),
                           .wall = wall_clock() - r->started,
                           .recording = r->record_time,
                           .recording_end = r->end_time,
                           .state_hash = world_hash(&r->world)};
    memcpy(summary.scenario_hash, r->hash, sizeof summary.scenario_hash);
    return run_folder_write_summary(r->ctx, r->options->folder, r->s, &r->world, &summary, error);
}

/* Pictures are a service: a build without cairo says so once and goes on. */
static fram_status draw(run *r, const char *name, fram_status (*picture)(run *, const char *, fram_error *),
                        fram_error *error)
{
    fram_error reason = {0};
    fram_status status = picture(r, name, &reason);
    if (status == FRAM_ERROR_UNSUPPORTED) {
        log_write(r->ctx, LOG_WARNING, "%s is skipped: %s", name, reason.message);
        return FRAM_OK;
    }
    if (status != FRAM_OK && error)
        *error = reason;
    return status;
}

static fram_status draw_plan(run *r, const char *name, fram_error *error)
{
    char path[PATH_ROOM];
    fram_status status = path_join(r->options->folder, name, path, error);
    return status == FRAM_OK ? picture_plan(r->ctx, r->s, &r->world, path, error) : status;
}

/* Digits of the time in a picture's name: before the point, and behind it at least and at most. */
enum { PICTURE_DIGITS = 6, PICTURE_DECIMALS = 2, PICTURE_MOST_DECIMALS = 12 };

/* As many that pictures `interval` seconds apart have names of their own. */
static int picture_decimals(double interval)
{
    int decimals = PICTURE_DECIMALS;
    for (double step = 0.01; step > interval * (1 + 1e-9) && decimals < PICTURE_MOST_DECIMALS; step /= 10)
        decimals++;
    return decimals;
}

static fram_status draw_numbered_plan(run *r, fram_error *error)
{
    char name[64], folder[PATH_ROOM];
    double dt = r->s->run.time_step;
    int decimals = picture_decimals((double)r->picture_every * dt);
    fram_status status = path_join(r->options->folder, "pictures", folder, error);
    if (status != FRAM_OK)
        return status;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return file_error(error, folder, "make the folder", errno);
    snprintf(name, sizeof name, "pictures/plan-%0*.*f.png", PICTURE_DIGITS + 1 + decimals, decimals,
             r->world.clock.time[0]);
    return draw(r, name, draw_plan, error);
}

static void show_progress(run *r, bool last)
{
    double now = wall_clock();
    if (!r->options->progress || (!last && now - r->drawn < 0.2))
        return;
    r->drawn = now;
    double time = r->world.clock.time[0], done = time - r->start_time, wall = now - r->started;
    run_progress p = {.time = time, .end = (double)r->end_step * r->s->run.time_step, .wall = wall};
    double stop = (double)r->stop_step * r->s->run.time_step;
    p.real_time_factor = wall > 0 ? done / wall : 0;
    p.eta = done > 0 ? (stop - time) * wall / done : 0;
    r->options->progress(r->options->progress_user, &p);
}

/* After each step: streams, pictures and checkpoints when due. */
static fram_status after_step(run *r, double step_wall, fram_error *error)
{
    int64_t step = r->world.clock.step[0];
    fram_status status = recorder_step(&r->recorder, &r->world, step_wall, error);
    if (status == FRAM_OK && r->picture_every > 0 && step % r->picture_every == 0)
        status = draw_numbered_plan(r, error);
    if (status == FRAM_OK && r->checkpoint_every > 0 && step % r->checkpoint_every == 0 && step < r->stop_step)
        status = write_checkpoint(r, error);
    return status;
}

static bool asked_to_stop(const run *r) { return r->options->stop && *r->options->stop; }

static fram_status step_loop(run *r, fram_error *error)
{
    fram_status status = FRAM_OK;
    while (status == FRAM_OK && r->world.clock.step[0] < r->stop_step && !asked_to_stop(r)) {
        double before = wall_clock();
        status = world_step(r->ctx, &r->model, &r->world, error);
        if (status != FRAM_OK)
            break;
        double done = wall_clock();
        status = after_step(r, done - before, error);
        r->record_time += wall_clock() - done;
        show_progress(r, false);
    }
    show_progress(r, true);
    return status;
}

/* The state as it went wrong; the last good checkpoint stays. */
static void leave_state(run *r)
{
    checkpoint_note note = {.inputs = r->inputs.data};
    memcpy(note.scenario_hash, r->hash, sizeof note.scenario_hash);
    (void)end_checkpoint(r, NULL);
    (void)recorder_flush(&r->recorder, NULL);
    (void)checkpoint_write_failed(r->ctx, r->options->folder, &r->world, &note, NULL);
}

static void fill_result(run *r, run_result *result)
{
    const world *w = &r->world;
    result->state_hash = world_hash(w);
    result->steps = w->clock.step[0];
    result->time = w->clock.time[0];
    result->wall = wall_clock() - r->started;
    result->real_time_factor = result->wall > 0 ? (result->time - r->start_time) / result->wall : 0;
    result->bodies = result->floes = 0;
    for (int32_t i = 0; i < w->bodies.count; i++)
        result->bodies += body_is_alive(&w->bodies, i);
    for (int32_t i = 0; i < w->floes.count; i++)
        result->floes += w->floes.body[i] >= 0;
    result->finished = result->steps >= r->end_step;
}

/* Checkpoint, pictures and figures of the end. */
static fram_status write_end(run *r, fram_error *error)
{
    double began = wall_clock();
    fram_status status = write_checkpoint(r, error);
    if (status == FRAM_OK)
        status = draw(r, "plan.png", draw_plan, error);
    const world *w = &r->world;
    const station_outcome station = {w->clock.time[0], &w->lines, &w->thrusters, &w->events};
    if (status == FRAM_OK && r->options->finish)
        status = r->options->finish(r->ctx, r->s, &station, r->options->folder, error);
    if (status == FRAM_OK)
        status = end_checkpoint(r, error);
    r->end_time = wall_clock() - began;
    r->record_time += r->end_time;
    return status;
}

/* A folder that was taken away while the run went on: its files are written, and nobody finds them. */
static fram_status check_streams(run *r, fram_error *error)
{
    file_writer *streams[RECORDER_STREAMS];
    recorder_streams(&r->recorder, streams);
    for (int i = 0; i < RECORDER_STREAMS; i++) {
        if (!file_is_in_place(streams[i]))
            return error_set(error, FRAM_ERROR_IO, streams[i]->path, 0, NULL,
                             "the file was removed or replaced while the run wrote it; the results are lost");
    }
    return FRAM_OK;
}

/* A file that cannot be written while a run goes on is no fault of what was given to it. */
static fram_status as_failure(fram_status status, fram_error *error)
{
    if (status != FRAM_ERROR_INPUT && status != FRAM_ERROR_USAGE)
        return status;
    error->status = FRAM_ERROR_IO;
    return FRAM_ERROR_IO;
}

/* How the run stands, last of all: whatever fails before, run.json does not stay at "running".  One that cannot be
   replaced is removed, which may make the room that it takes; that memory ran out is told all the same. */
static fram_status end_summary(run *r, const char *state, const char *message, fram_error *error)
{
    fram_status status = write_summary(r, state, message, error);
    if (status == FRAM_OK)
        return FRAM_OK;
    char path[PATH_ROOM];
    if (path_join(r->options->folder, "run.json", path, NULL) == FRAM_OK)
        (void)unlink(path);
    bool replaced = write_summary(r, state, message, NULL) == FRAM_OK;
    return replaced && status != FRAM_ERROR_MEMORY ? FRAM_OK : status;
}

/* Steps, then all that is written at the end.  The first error is the one to report. */
static fram_status step_and_write(run *r, run_result *result, fram_error *error)
{
    fram_status status = step_loop(r, error);
    if (status == FRAM_OK) {
        fill_result(r, result);
        status = check_streams(r, error);
        if (status == FRAM_OK)
            status = write_end(r, error);
    } else {
        leave_state(r);
    }
    (void)end_checkpoint(r, NULL); /* after another failure: its own is not the first */
    if (status == FRAM_OK)
        status = check_streams(r, error);
    fram_status closed = recorder_close(&r->recorder, status == FRAM_OK ? error : NULL);
    r->recording = false;
    return as_failure(status == FRAM_OK ? closed : status, error);
}

static fram_status drive(run *r, run_result *result, fram_error *error)
{
    r->recording = true;
    r->start_time = r->world.clock.time[0];
    r->drawn = 0;
    fram_error local = {0};
    fram_status status = step_and_write(r, result, &local);
    bool interrupted = asked_to_stop(r) && r->world.clock.step[0] < r->stop_step;
    if (status != FRAM_OK)
        (void)end_summary(r, "failed", local.message, NULL);
    else
        status = as_failure(end_summary(r,
                                        result->finished ? "finished"
                                        : interrupted    ? "interrupted"
                                                         : "stopped",
                                        NULL, &local),
                            &local);
    if (status == FRAM_OK && interrupted)
        status = error_set(&local, FRAM_INTERRUPTED, NULL, 0, NULL,
                           "interrupted at t = %g s; a checkpoint was written, continue with: fram resume %s",
                           result->time, r->options->folder);
    if (status != FRAM_OK && error)
        *error = local;
    return status;
}

static fram_status identify(run *r, fram_error *error)
{
    fram_status status = scenario_hash(r->ctx, r->s, r->hash, error);
    return status == FRAM_OK ? run_folder_inputs(r->ctx, r->s, &r->inputs, error) : status;
}

static void run_free(run *r)
{
    if (r->recording)
        recorder_close(&r->recorder, NULL);
    model_free(r->ctx, &r->model);
    run_folder_unlock(r->lock);
    text_free(r->ctx, &r->inputs);
}

/* ---- start ---- */

static fram_status write_scenario(run *r, fram_error *error)
{
    const scenario_print_options options = {.comments = true, .absolute_paths = true};
    char path[PATH_ROOM];
    text_buffer text = {0};
    fram_status status = path_join(r->options->folder, "scenario.yaml", path, error);
    if (status == FRAM_OK)
        status = scenario_print(r->ctx, r->s, &options, &text, error);
    if (status == FRAM_OK)
        status = atomic_file_write(r->ctx, path, text.data, (size_t)text.count, error);
    text_free(r->ctx, &text);
    return status;
}

static void log_start(const run *r, const field_report *report)
{
    if (report->floes > 0)
        log_write(r->ctx, LOG_INFO, "%d floes, concentration %.4f", (int)report->floes, report->concentration);
    for (int32_t i = 0; i < r->model.vessels.count; i++)
        log_write(r->ctx, LOG_INFO, "the hull displaces %.6g t", r->model.vessels.data[i].displaced_mass * 1e-3);
}

/* The record's scenario is for programs: without comments. */
static fram_status start_streams(run *r, fram_error *error)
{
    const scenario_print_options options = {.absolute_paths = r->options->with_paths,
                                            .names_only = !r->options->with_paths};
    text_buffer text = {0};
    fram_status status = scenario_print(r->ctx, r->s, &options, &text, error);
    if (status == FRAM_OK)
        status = recorder_create(r->ctx, r->s, r->options->folder, text.data, &r->recorder, error);
    text_free(r->ctx, &text);
    if (status != FRAM_OK)
        return status;
    r->recording = true;
    status = recorder_step(&r->recorder, &r->world, 0, error);
    return status == FRAM_OK ? write_summary(r, "running", NULL, error) : status;
}

fram_status run_start(context *ctx, const scenario *s, const run_options *options, run_result *result,
                      fram_error *error)
{
    run r = {.ctx = ctx, .s = s, .options = options, .started = wall_clock(), .lock = -1};
    field_report report = {0};
    set_schedule(&r);
    fram_status status = run_folder_check(options->folder, options->force, error);
    if (status == FRAM_OK)
        status = identify(&r, error);
    if (status == FRAM_OK)
        scenario_log_warnings(ctx, s);
    /* The world before the folder: a scenario that cannot be made leaves it as it was. */
    const volatile int *stop = ctx->stop;
    if (options->stop)
        ctx->stop = options->stop;
    if (status == FRAM_OK)
        status = build_model(ctx, s, &r.model, error);
    if (status == FRAM_OK)
        status = build_world(ctx, s, &r.model, &r.world, &report, error);
    ctx->stop = stop;
    if (status != FRAM_OK) {
        run_free(&r);
        return status;
    }
    log_start(&r, &report);
    double began = wall_clock();
    status = run_folder_prepare(ctx, options->folder, options->force, &r.lock, error);
    if (status == FRAM_OK)
        status = write_scenario(&r, error);
    if (status == FRAM_OK)
        status = start_streams(&r, error);
    r.record_time += wall_clock() - began;
    if (status == FRAM_OK)
        status = drive(&r, result, error);
    world_free(ctx, &r.world);
    run_free(&r);
    return status;
}

/* ---- resume ---- */

static fram_status resume_world(run *r, run_result *result, fram_error *error)
{
    checkpoint_note note = {.inputs = r->inputs.data};
    memcpy(note.scenario_hash, r->hash, sizeof note.scenario_hash);
    fram_status status = checkpoint_read_newest(r->ctx, r->options->folder, &r->model, &r->world, &note, error);
    if (status != FRAM_OK)
        return status;
    if (r->stop_step < r->world.clock.step[0])
        return error_set(error, FRAM_ERROR_USAGE, r->options->folder, 0, "--until",
                         "expected a time from %g s on, where the newest checkpoint is; found %g s",
                         r->world.clock.time[0], r->options->until);
    recorder_lengths lengths = {note.series_length, note.record_length, note.fractures_length};
    status = recorder_continue(r->ctx, r->s, r->options->folder, &lengths, &r->recorder, error);
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
    run r = {.ctx = ctx, .s = &s, .options = options, .started = wall_clock(), .lock = -1};
    set_schedule(&r);
    status = run_folder_lock(options->folder, &r.lock, error);
    if (status == FRAM_OK)
        status = identify(&r, error);
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
