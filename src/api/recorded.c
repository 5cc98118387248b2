/* Worlds of the public API that are recorded while they are stepped. */
#include "api/arguments.h"
#include "api/handles.h"

#include "fram/live.h"
#include "io/path.h"
#include "results/run_results.h"
#include "sim/run_inputs.h"

#include <string.h>
#include <unistd.h>

static void fram_record_fill(fram_record_definition *definition)
{
    *definition = (fram_record_definition){.size = sizeof *definition};
}
DEFINITION_DEFAULT(fram_record, fram_record_definition)

static void forget(fram_world *w)
{
    recording *r = w->recording;
    w->recording = NULL;
    recording_free(r);
    live_view_end(w->live);
    w->live = NULL;
    memory_free(r->ctx, r);
}

/* The record tells of which files its world was made, and what is computed again from it is made of them. */
static fram_status check_inputs(const fram_world *w, const recording *r, fram_error *error)
{
    char now[SHA256_TEXT_SIZE];
    fram_status status = run_inputs_digest(r->ctx, r->inputs.data, (size_t)r->inputs.count, now, error);
    if (status == FRAM_OK && strcmp(now, w->base->inputs) != 0)
        status = error_set(error, FRAM_ERROR_INPUT, NULL, 0, "world",
                           "a file that its scenario names was changed since the world was made; restore it to record "
                           "this world, or make a new one");
    return status;
}

/* A record begins with all bodies, whatever was recorded of them before. */
static fram_status begin(fram_world *w, recording *r, fram_error *error)
{
    fram_status status = recording_prepare(r, error);
    if (status == FRAM_OK)
        status = check_inputs(w, r, error);
    if (status != FRAM_OK)
        return status;
    table_free(r->ctx, &w->inner.recorded, &recorded_table_info);
    return recording_begin(r, &w->inner, error);
}

static fram_status record(fram_world *w, const fram_record_definition *definition, fram_error *error)
{
    fram_record_definition d;
    fram_record_fill(&d);
    fram_status status =
        definition_take(&d, definition, sizeof d, offsetof(fram_record_definition, force), "fram_record", error);
    if (status == FRAM_OK)
        status = world_refuse_failed(w, error);
    if (status == FRAM_OK)
        status = folder_check("folder", d.folder, error);
    if (status != FRAM_OK)
        return status;
    if (w->recording)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "world", "it is recorded already, into %s",
                         w->recording->folder);
    char folder[PATH_ROOM]; /* the same in each step, whatever the working folder is by then */
    if (!path_absolute(d.folder, folder, sizeof folder))
        return error_set(error, FRAM_ERROR_INPUT, d.folder, 0, "folder",
                         "expected a folder with a path from the root of less than %d bytes", PATH_ROOM);
    context *ctx = &w->scenario->context->inner;
    recording *r = memory_array(ctx, 1, sizeof *r);
    if (!r)
        return error_memory(error);
    w->recording = r;
    w->process = getpid();
    const recording_options options = {d.force, d.with_paths, run_results_write};
    status = recording_init(ctx, &w->scenario->inner, folder, &options, r, error);
    if (status == FRAM_OK)
        status = live_open(ctx, folder, d.live_page, d.live, d.live_user, &w->live, error);
    if (status == FRAM_OK)
        status = begin(w, r, error);
    if (status == FRAM_OK)
        live_view_begin(w->live);
    if (status != FRAM_OK)
        forget(w);
    return status;
}

fram_status fram_world_record(fram_world *w, const fram_record_definition *definition, fram_error *error)
{
    fram_status status = world_enter(w, error);
    if (status != FRAM_OK)
        return status;
    status = record(w, definition, error);
    world_leave(w);
    return status;
}

bool fram_world_is_recorded(const fram_world *w) { return w && w->recording && w->process == getpid(); }

static fram_status enter_recorded(fram_world *w, fram_error *error)
{
    fram_status status = world_enter(w, error);
    if (status != FRAM_OK || w->recording)
        return status;
    world_leave(w);
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "world", "it is not recorded");
}

fram_status fram_world_checkpoint(fram_world *w, fram_error *error)
{
    fram_status status = enter_recorded(w, error);
    if (status != FRAM_OK)
        return status;
    status = recording_checkpoint(w->recording, error);
    world_leave(w);
    return status;
}

fram_status(fram_world_record_end)(fram_world *w, fram_run_result *result, fram_error *error, size_t size)
{
    run_result reached;
    fram_status status = REFUSE_NULL(error, {"world", w});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_run_result, error);
    if (status == FRAM_OK)
        status = enter_recorded(w, error);
    if (status != FRAM_OK)
        return status;
    recording_result(w->recording, &reached);
    result_give(result, size, &(fram_run_result[]){run_answer(&reached)});
    status = recording_end(w->recording, reached.finished ? "finished" : "stopped", error);
    forget(w);
    world_leave(w);
    return status;
}

void recording_abandon(fram_world *w, const fram_error *reason)
{
    if (!w->recording)
        return;
    recording_fail(w->recording, reason);
    forget(w);
}
