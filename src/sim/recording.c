#include "sim/recording.h"

#include "base/clock.h"
#include "base/pool.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/image.h"
#include "io/path.h"
#include "io/scenario_file.h"
#include "sim/pictures.h"
#include "sim/run_folder.h"
#include "sim/run_inputs.h"
#include "sim/run_summary.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static fram_status end_checkpoint(recording *r, fram_error *error)
{
    return checkpoint_end(r->ctx, r->folder, &r->checkpoint, error);
}

/* The state of now; the one before is on the disk first. */
static fram_status write_checkpoint(recording *r, fram_error *error)
{
    fram_status status = end_checkpoint(r, error);
    if (status == FRAM_OK)
        status = peak_watch_write(&r->recorder.peaks, r->folder, error);
    if (status == FRAM_OK && !peak_state_save(&r->recorder.peaks, r->w, &r->peaks))
        status = error_memory(error);
    if (status != FRAM_OK)
        return status;
    file_writer *streams[RECORDER_STREAMS];
    recorder_streams(&r->recorder, streams);
    recorder_lengths lengths = recorder_lengths_of(&r->recorder);
    checkpoint_note note = {.series_length = lengths.series,
                            .record_length = lengths.record,
                            .fractures_length = lengths.fractures,
                            .inputs = r->inputs.data,
                            .peaks = &r->peaks};
    memcpy(note.scenario_hash, r->hash, sizeof note.scenario_hash);
    return checkpoint_begin(r->ctx, r->folder, r->w, &note, streams, RECORDER_STREAMS, &r->checkpoint, error);
}

static fram_status write_summary(recording *r, const char *state, const char *message, fram_error *error)
{
    run_summary summary = {.status = state,
                           .message = message,
                           .recorded_from = r->recorded_from,
                           .good_until = r->good_until,
                           .inputs = r->inputs.data,
                           .threads = context_threads(r->ctx),
                           .wall = clock_wall() - r->started,
                           .recording = r->record_time,
                           .recording_end = r->end_time,
                           .step_times = &r->steps,
                           .state_hash = world_hash(r->w)};
    memcpy(summary.scenario_hash, r->hash, sizeof summary.scenario_hash);
    return run_summary_write(r->ctx, r->folder, r->s, r->w, &summary, error);
}

static fram_status draw_plan(recording *r, const char *name, fram_error *error)
{
    char path[PATH_ROOM];
    fram_error reason = {0};
    fram_status status = path_own(r->folder, name, path, &reason);
    if (status == FRAM_OK)
        status = picture_plan(r->ctx, r->s, r->w, path, &reason);
    return image_or_skip(r->ctx, name, status, &reason, error);
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

static fram_status draw_numbered_plan(recording *r, fram_error *error)
{
    char name[64], folder[PATH_ROOM];
    double dt = r->s->run.time_step;
    int decimals = picture_decimals((double)r->picture_every * dt);
    fram_status status = path_join(r->folder, "pictures", folder, error);
    if (status != FRAM_OK)
        return status;
    status = folder_make_own(folder, error);
    if (status != FRAM_OK)
        return status;
    snprintf(name, sizeof name, "pictures/plan-%0*.*f.png", PICTURE_DIGITS + 1 + decimals, decimals,
             r->w->clock.time[0]);
    return draw_plan(r, name, error);
}

static fram_status write_what_is_due(recording *r, double step_wall_time, fram_error *error)
{
    int64_t step = r->w->clock.step[0];
    fram_status status = recorder_step(&r->recorder, r->w, step_wall_time, error);
    if (status == FRAM_OK && r->picture_every > 0 && step % r->picture_every == 0)
        status = draw_numbered_plan(r, error);
    if (status == FRAM_OK && r->checkpoint_every > 0 && step % r->checkpoint_every == 0 && step != r->stop_step)
        status = write_checkpoint(r, error);
    return status;
}

/* The state as it went wrong; the last good checkpoint stays. */
static void leave_state(recording *r)
{
    checkpoint_note note = {.inputs = r->inputs.data};
    memcpy(note.scenario_hash, r->hash, sizeof note.scenario_hash);
    (void)end_checkpoint(r, NULL);
    (void)recorder_flush(&r->recorder, NULL);
    (void)peak_watch_write(&r->recorder.peaks, r->folder, NULL);
    (void)checkpoint_write_failed(r->ctx, r->folder, r->w, &note, NULL);
}

/* Checkpoint, pictures and figures of the end. */
static fram_status write_end(recording *r, fram_error *error)
{
    double began = clock_wall();
    fram_status status = write_checkpoint(r, error);
    if (status == FRAM_OK)
        status = draw_plan(r, "plan.png", error);
    const world *w = r->w;
    const station_outcome station = {w->clock.time[0], &w->lines, &w->thrusters, &w->events};
    if (status == FRAM_OK && r->options.finish)
        status = r->options.finish(r->ctx, r->s, &station, r->folder, error);
    if (status == FRAM_OK)
        status = end_checkpoint(r, error);
    r->end_time = clock_wall() - began;
    r->record_time += r->end_time;
    return status;
}

/* A folder that was taken away while the run went on: its files are written, and nobody finds them. */
static fram_status check_streams(recording *r, fram_error *error)
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
    if (error)
        error->status = FRAM_ERROR_IO;
    return FRAM_ERROR_IO;
}

void recording_result(const recording *r, run_result *out)
{
    const world *w = r->w;
    *out = (run_result){.state_hash = world_hash(w), .steps = w->clock.step[0], .time = w->clock.time[0]};
    out->wall = clock_wall() - r->started;
    out->real_time_factor = out->wall > 0 ? (out->time - r->began_at) / out->wall : 0;
    for (int32_t i = 0; i < w->bodies.count; i++)
        out->bodies += body_is_alive(&w->bodies, i);
    out->floes = world_floe_count(w);
    out->finished = out->steps >= r->end_step;
}

static void remove_file(const recording *r, const char *name)
{
    char path[PATH_ROOM];
    if (path_join(r->folder, name, path, NULL) == FRAM_OK)
        (void)unlink(path);
}

/* How the run stands, last of all: whatever fails before, run.json does not stay at "running".  One that cannot be
   replaced is removed, which may make the room that it takes; that memory ran out is told all the same. */
static fram_status end_summary(recording *r, const char *state, const char *message, fram_error *error)
{
    fram_status status = write_summary(r, state, message, error);
    if (status == FRAM_OK)
        return FRAM_OK;
    remove_file(r, "run.json");
    bool replaced = write_summary(r, state, message, NULL) == FRAM_OK;
    return replaced && status != FRAM_ERROR_MEMORY ? FRAM_OK : status;
}

/* With the file that could not be written, where it is one. */
static void end_failed(recording *r, const fram_error *reason)
{
    char message[sizeof reason->file + sizeof reason->message + 2];
    snprintf(message, sizeof message, "%s%s%s", reason->file, reason->file[0] ? ": " : "", reason->message);
    (void)end_summary(r, "failed", message, NULL);
}

static fram_status identify(recording *r, fram_error *error)
{
    fram_status status = scenario_hash(r->ctx, r->s, r->hash, error);
    return status == FRAM_OK ? run_inputs_list(r->ctx, r->s, NULL, &r->inputs, error) : status;
}

static fram_status write_scenario(recording *r, fram_error *error)
{
    const scenario_print_options options = {.comments = true, .absolute_paths = true};
    char path[PATH_ROOM];
    text_buffer text = {0};
    fram_status status = path_own(r->folder, "scenario.yaml", path, error);
    if (status == FRAM_OK)
        status = scenario_print(r->ctx, r->s, &options, &text, error);
    if (status == FRAM_OK)
        status = text_file_write(r->ctx, path, &text, error);
    text_free(r->ctx, &text);
    return status;
}

static fram_status await_peaks(recording *r, fram_error *error)
{
    return peak_watch_await(&r->recorder.peaks, r->w) ? FRAM_OK : error_memory(error);
}

/* The record's scenario is for programs: without comments. */
static fram_status start_streams(recording *r, fram_error *error)
{
    const scenario_print_options options = {.absolute_paths = r->options.with_paths,
                                            .names_only = !r->options.with_paths};
    text_buffer text = {0};
    fram_status status = scenario_print(r->ctx, r->s, &options, &text, error);
    if (status == FRAM_OK)
        status = recorder_create(r->ctx, r->s, r->folder, text.data, &r->recorder, error);
    text_free(r->ctx, &text);
    if (status != FRAM_OK)
        return status;
    r->open = true;
    status = recorder_step(&r->recorder, r->w, 0, error);
    peak_watch_forget(&r->recorder.peaks); /* the contacts of the last step are not in a world that was copied */
    if (status == FRAM_OK)
        status = await_peaks(r, error);
    return status == FRAM_OK ? write_summary(r, "running", NULL, error) : status;
}

/* What no picture could be drawn into is told before the first step. */
static fram_status refuse_other_pictures(const recording *r, fram_error *error)
{
    char folder[PATH_ROOM];
    fram_status status = path_join(r->folder, "pictures", folder, error);
    return status == FRAM_OK ? folder_refuse_other(folder, error) : status;
}

/* ---- from outside ---- */

fram_status recording_init(context *ctx, const scenario *s, const char *folder, const recording_options *options,
                           recording *r, fram_error *error)
{
    double dt = s->run.time_step;
    *r = (recording){.ctx = ctx, .s = s, .options = *options, .started = clock_wall(), .stop_step = -1, .lock = -1};
    if (snprintf(r->folder, sizeof r->folder, "%s", folder) >= PATH_ROOM)
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL, "the folder's name is too long");
    r->end_step = scenario_step_at(s->run.duration, dt);
    r->checkpoint_every = scenario_interval_steps(s->output.checkpoint_interval, dt);
    r->picture_every = scenario_interval_steps(s->output.picture_interval, dt);
    return r->picture_every > 0 ? refuse_other_pictures(r, error) : FRAM_OK;
}

/* With overrides another scenario would stand where it was read from. */
static fram_status refuse_own_scenario(const recording *r, fram_error *error)
{
    char own[PATH_ROOM];
    if (!scenario_own_file(r->s, own, sizeof own) || !path_is_own(r->folder, own))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, own, 0, "output",
                     "expected a folder in which the run does not write over the scenario that it reads; write into "
                     "another folder");
}

fram_status recording_prepare(recording *r, fram_error *error)
{
    fram_status status = run_folder_check(r->folder, r->options.force, error);
    if (status == FRAM_OK)
        status = refuse_own_scenario(r, error);
    if (status == FRAM_OK)
        status = identify(r, error);
    return status == FRAM_OK ? run_folder_refuse_inputs(r->folder, r->inputs.data, error) : status;
}

fram_status recording_prepare_resume(recording *r, fram_error *error)
{
    fram_status status = run_folder_lock(r->folder, &r->lock, error);
    if (status == FRAM_OK)
        status = run_folder_refuse_pipes(r->folder, error);
    return status == FRAM_OK ? identify(r, error) : status;
}

fram_status recording_begin(recording *r, world *w, fram_error *error)
{
    double began = clock_wall();
    r->w = w;
    r->recorded_from = r->began_at = r->good_until = w->clock.time[0];
    fram_status status = run_folder_prepare(r->ctx, r->folder, r->options.force, r->inputs.data, &r->lock, error);
    if (status == FRAM_OK)
        status = write_scenario(r, error);
    if (status == FRAM_OK)
        status = start_streams(r, error);
    r->record_time += clock_wall() - began;
    return status;
}

fram_status recording_read_state(recording *r, const model *m, world *w, recorder_lengths *lengths, fram_error *error)
{
    checkpoint_note note = {.inputs = r->inputs.data, .peaks = &r->peaks};
    memcpy(note.scenario_hash, r->hash, sizeof note.scenario_hash);
    fram_status status = checkpoint_read_newest(r->ctx, r->folder, m, w, &note, error);
    *lengths = (recorder_lengths){note.series_length, note.record_length, note.fractures_length};
    r->w = w;
    r->began_at = r->good_until = w->clock.time[0];
    return status == FRAM_OK ? run_folder_recorded_from(r->ctx, r->folder, &r->recorded_from, error) : status;
}

/* Peaks that do not fit are lost, and the run is not. */
static fram_status restore_peaks(recording *r, fram_error *error)
{
    fram_error reason = {0};
    fram_status status = peak_state_restore(&r->recorder.peaks, r->w, &r->peaks, &reason);
    if (status == FRAM_ERROR_INPUT) {
        log_write(r->ctx, LOG_WARNING, "%s: only those from now on are explained", reason.message);
        status = FRAM_OK;
    }
    return status == FRAM_OK ? await_peaks(r, error) : error_memory(error);
}

fram_status recording_resume(recording *r, const recorder_lengths *lengths, fram_error *error)
{
    fram_status status = recorder_continue(r->ctx, r->s, r->folder, lengths, &r->recorder, error);
    r->open = status == FRAM_OK;
    if (status == FRAM_OK)
        status = restore_peaks(r, error);
    /* How it ended before is no news of how far it is. */
    if (status == FRAM_OK)
        status = write_summary(r, "running", NULL, error);
    if (status == FRAM_OK)
        remove_file(r, "failed.fram");
    return status;
}

fram_status recording_step(recording *r, double step_wall_time, fram_error *error)
{
    double began = clock_wall();
    time_ranks_add(&r->steps, step_wall_time);
    r->good_until = r->w->clock.time[0];
    fram_status status = as_failure(write_what_is_due(r, step_wall_time, error), error);
    r->record_time += clock_wall() - began;
    return status;
}

fram_status recording_checkpoint(recording *r, fram_error *error)
{
    double began = clock_wall();
    fram_status status = write_checkpoint(r, error);
    if (status == FRAM_OK)
        status = end_checkpoint(r, error); /* whoever asked for it has it, or hears why not */
    status = as_failure(status, error);
    r->record_time += clock_wall() - began;
    return status;
}

/* The first error is the one to report. */
static fram_status write_and_close(recording *r, fram_error *error)
{
    fram_status status = check_streams(r, error);
    if (status == FRAM_OK)
        status = write_end(r, error);
    (void)end_checkpoint(r, NULL); /* after another failure: its own is not the first */
    if (status == FRAM_OK)
        status = check_streams(r, error);
    fram_status closed = recorder_close(&r->recorder, status == FRAM_OK ? error : NULL);
    r->open = false;
    return as_failure(status == FRAM_OK ? closed : status, error);
}

fram_status recording_end(recording *r, const char *state, fram_error *error)
{
    fram_error local = {0};
    fram_status status = write_and_close(r, &local);
    if (status == FRAM_OK)
        status = as_failure(end_summary(r, state, NULL, &local), &local);
    else
        end_failed(r, &local);
    if (status != FRAM_OK && error)
        *error = local;
    return status;
}

void recording_fail(recording *r, const fram_error *reason)
{
    leave_state(r);
    (void)recorder_close(&r->recorder, NULL);
    r->open = false;
    end_failed(r, reason);
}

void recording_free(recording *r)
{
    (void)end_checkpoint(r, NULL);
    if (r->open)
        recorder_close(&r->recorder, NULL);
    r->open = false;
    run_folder_unlock(r->lock);
    r->lock = -1;
    text_free(r->ctx, &r->inputs);
    array_free(r->ctx, &r->peaks);
}
