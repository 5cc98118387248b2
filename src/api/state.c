/* Copying, saving and loading of worlds. */
#include "api/arguments.h"
#include "api/handles.h"

#include "fram/live.h"
#include "io/atomic_file.h"
#include "io/table_file.h"
#include "sim/checkpoint.h"
#include "sim/run_inputs.h"

#include <string.h>

void fram_stop_set(volatile int *stop, int value) /* NOLINT(readability-non-const-parameter): it is written */
{
    if (stop)
        __atomic_store_n(stop, value, __ATOMIC_RELAXED);
}

static fram_status copy_world(const fram_world *w, fram_world **out, fram_error *error)
{
    fram_world *copy = world_handle(w->scenario, w->base);
    if (!copy)
        return error_memory(error);
    fram_status status = world_make_row(copy) ? world_copy(&w->scenario->context->inner, &w->inner, &copy->inner, error)
                                              : error_memory(error);
    if (status != FRAM_OK) {
        world_handle_free(copy);
        return status;
    }
    copy->failed = w->failed;
    copy->step_wall = w->step_wall;
    *out = copy;
    return FRAM_OK;
}

fram_status fram_world_copy(const fram_world *w, fram_world **out, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"copy", out});
    if (status == FRAM_OK)
        status = world_begin_reading(w, error);
    if (status != FRAM_OK)
        return status;
    status = copy_world(w, out, error);
    world_end_reading(w);
    return status;
}

fram_status world_find_inputs(fram_world *w, fram_error *error)
{
    context *ctx = &w->scenario->context->inner;
    text_buffer list = {0};
    fram_status status = run_inputs_list(ctx, &w->scenario->inner, NULL, &list, error);
    if (status == FRAM_OK)
        status = run_inputs_digest(ctx, list.data, (size_t)list.count, w->base->inputs, error);
    text_free(ctx, &list);
    return status;
}

static checkpoint_note note_of(const fram_world *w)
{
    checkpoint_note note = {.inputs = w->base->inputs, .failed = w->failed};
    memcpy(note.scenario_hash, w->scenario->hash, sizeof note.scenario_hash);
    return note;
}

fram_status fram_world_save_memory(const fram_world *w, void **data, size_t *size, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"data", data}, {"size", size});
    if (status == FRAM_OK)
        status = world_begin_reading(w, error);
    if (status != FRAM_OK)
        return status;
    checkpoint_note note = note_of(w);
    char *bytes;
    status = state_encode(&w->scenario->context->inner, &w->inner, &note, &bytes, size, error);
    world_end_reading(w);
    if (status == FRAM_OK)
        *data = bytes;
    return status;
}

void fram_data_free(fram_context *c, void *data)
{
    if (c)
        memory_free(&c->inner, data);
}

static fram_status take_over(fram_world *w, const char *name, const void *data, size_t size, fram_error *error)
{
    if (w->recording)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "world",
                         "it is recorded, and its series would not follow from one another: end the recording before");
    context *ctx = &w->scenario->context->inner;
    checkpoint_note note = note_of(w);
    bool failed;
    world loaded;
    fram_status status = world_init(ctx, &w->base->model, &loaded, error);
    if (status != FRAM_OK)
        return status;
    status = state_decode(ctx, name, data, size, &w->base->model, &loaded, &note, &failed, error);
    if (status != FRAM_OK) {
        world_free(ctx, &loaded);
        return status;
    }
    /* Bodies that a program was shown keep their place; loaded.bodies becomes what the world has. */
    body_table shown = w->inner.bodies;
    kept_replace(&w->aside->kept, ctx, &shown, &loaded.bodies);
    w->inner.bodies = (body_table){0};
    loaded.bodies = shown;
    loaded.shapes.changes += w->inner.shapes.changes + 1;
    world_free(ctx, &w->inner);
    w->inner = loaded;
    w->failed = failed; /* a state that was saved after a failed step is none to go on from */
    w->step_wall = 0;
    world_changed(w);
    return FRAM_OK;
}

static fram_status load(fram_world *w, const char *name, const void *data, size_t size, fram_error *error)
{
    fram_status status = world_enter(w, error);
    if (status != FRAM_OK)
        return status;
    status = take_over(w, name, data, size, error);
    world_leave(w);
    return status;
}

fram_status fram_world_load_memory(fram_world *w, const void *data, size_t size, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"data", data});
    return status == FRAM_OK ? load(w, "(memory)", data, size, error) : status;
}

fram_status fram_world_save(const fram_world *w, const char *path, fram_error *error)
{
    void *data;
    size_t size;
    fram_status status = REFUSE_NULL(error, {"world", w}, {"path", path});
    if (status == FRAM_OK)
        status = list_refuse_read(&w->scenario->read, path, "path", error);
    if (status == FRAM_OK)
        status = fram_world_save_memory(w, &data, &size, error);
    if (status != FRAM_OK)
        return status;
    context *ctx = &w->scenario->context->inner;
    status = atomic_file_write(ctx, path, data, size, error);
    memory_free(ctx, data);
    return status;
}

fram_status fram_world_load(fram_world *w, const char *path, fram_error *error)
{
    char *data;
    size_t size;
    fram_status status = REFUSE_NULL(error, {"world", w}, {"path", path});
    context *ctx = status == FRAM_OK ? &w->scenario->context->inner : NULL;
    if (status == FRAM_OK)
        status = file_read(ctx, path, TABLE_FILE_BYTES_MOST, &data, &size, error);
    if (status != FRAM_OK)
        return status;
    status = load(w, path, data, size, error);
    memory_free(ctx, data);
    return status;
}
