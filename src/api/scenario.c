/* Scenarios of the public API. */
#include "api/arguments.h"
#include "api/handles.h"

#include "fram/live.h"
#include "io/path.h"
#include "io/scenario_file.h"
#include "model/scenario_schema.h"
#include "sim/build.h"
#include "sim/notes.h"
#include "sim/scene_size.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static fram_status fill(context *ctx, fram_scenario *s, fram_error *error)
{
    fram_status status = scene_size_check(&s->inner, error);
    if (status == FRAM_OK)
        status = scenario_print(ctx, &s->inner, NULL, &s->text, error);
    if (status == FRAM_OK)
        status = scenario_hash(ctx, &s->inner, s->hash, error);
    if (status != FRAM_OK)
        return status;
    notes_take(ctx, &s->inner, &s->notes);
    return s->text.failed || s->notes.failed ? error_memory(error) : FRAM_OK;
}

static fram_status check_overrides(const char *const *overrides, int count, fram_error *error)
{
    if (count < 0)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "override_count", "expected 0 or more, found %d", count);
    for (int i = 0; i < count; i++) {
        if (!overrides || !overrides[i])
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "overrides", "expected %d texts, found NULL at %d",
                             count, i);
    }
    return FRAM_OK;
}

/* The scenario's files, for who packs them. */
typedef struct file_list {
    context *ctx;
    fram_scenario *s;
} file_list;

static fram_status add_file(void *user, const scenario_key *key, const void *member, const char *name,
                            fram_error *error)
{
    file_list *list = user;
    const char *given = member;
    if (key->kind != KEY_PATH || !*given)
        return FRAM_OK;
    char path[SCENARIO_TEXT_SIZE];
    fram_status status = scenario_absolute_path(&list->s->inner, name, given, path, error);
    if (status != FRAM_OK)
        return status;
    text_add_bytes(list->ctx, &list->s->files, name, strlen(name) + 1);
    text_add_bytes(list->ctx, &list->s->files, path, strlen(path) + 1);
    text_add_bytes(list->ctx, &list->s->read, path, strlen(path) + 1);
    list->s->file_count++;
    return FRAM_OK;
}

/* Text `which` (0 key, 1 path) of a file. */
static const char *file_text(const fram_scenario *s, int number, int which)
{
    if (!s || number < 0 || number >= s->file_count)
        return NULL;
    const char *at = s->files.data;
    for (int i = 0; i < 2 * number + which; i++)
        at += strlen(at) + 1;
    return at;
}

const char *fram_scenario_file(const fram_scenario *s, int number) { return file_text(s, number, 1); }
const char *fram_scenario_file_key(const fram_scenario *s, int number) { return file_text(s, number, 0); }

static void add_own_file(context *ctx, fram_scenario *s)
{
    char own[PATH_ROOM], path[PATH_ROOM];
    if (scenario_own_file(&s->inner, own, sizeof own) && path_absolute(own, path, sizeof path))
        text_add_bytes(ctx, &s->read, path, strlen(path) + 1);
}

fram_status list_refuse_read(const text_buffer *read, const char *path, const char *key, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t at = 0; status == FRAM_OK && at < read->count; at += (int32_t)strlen(read->data + at) + 1)
        status = path_refuse_read(read->data + at, path, key, error);
    return status;
}

/* A scenario that was read becomes a handle, or is freed. */
static fram_status finish(fram_scenario *s, fram_scenario **out, fram_error *error)
{
    context *ctx = &s->context->inner;
    fram_status status = fill(ctx, s, error);
    file_list list = {ctx, s};
    if (status == FRAM_OK)
        status = scenario_walk(&s->inner, add_file, &list, error);
    if (status == FRAM_OK)
        add_own_file(ctx, s);
    if (status == FRAM_OK && (s->files.failed || s->read.failed))
        status = error_memory(error);
    if (status != FRAM_OK) {
        fram_scenario_destroy(s);
        return status;
    }
    *out = s;
    return FRAM_OK;
}

fram_status fram_scenario_parse(fram_context *c, const char *text, const char *base, const char *const *overrides,
                                int override_count, fram_scenario **out, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"context", c}, {"text", text}, {"scenario", out});
    if (status == FRAM_OK)
        status = check_overrides(overrides, override_count, error);
    if (status != FRAM_OK)
        return status;
    char name[SCENARIO_TEXT_SIZE];
    int length = snprintf(name, sizeof name, "%s%s(text)", base ? base : "", base && *base ? "/" : "");
    if (length < 0 || (size_t)length >= sizeof name)
        return error_set(error, FRAM_ERROR_INPUT, base, 0, "base", "the folder's name is too long");
    context *ctx = &c->inner;
    fram_scenario *s = memory_array(ctx, 1, sizeof *s);
    if (!s)
        return error_memory(error);
    s->context = c;
    const scenario_overrides list = {overrides, override_count};
    status = scenario_parse(ctx, name, text, strlen(text), &list, &s->inner, error);
    if (status == FRAM_OK)
        status = scenario_find_files(ctx, &s->inner, error);
    if (status != FRAM_OK) {
        memory_free(ctx, s);
        return status;
    }
    return finish(s, out, error);
}

fram_status fram_scenario_load(fram_context *c, const char *path, const char *const *overrides, int override_count,
                               fram_scenario **out, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"context", c}, {"path", path}, {"scenario", out});
    if (status == FRAM_OK)
        status = check_overrides(overrides, override_count, error);
    if (status != FRAM_OK)
        return status;
    context *ctx = &c->inner;
    fram_scenario *s = memory_array(ctx, 1, sizeof *s);
    if (!s)
        return error_memory(error);
    s->context = c;
    const scenario_overrides list = {overrides, override_count};
    status = scenario_read(ctx, path, &list, &s->inner, error);
    if (status != FRAM_OK) {
        memory_free(ctx, s);
        return status;
    }
    return finish(s, out, error);
}

const char *fram_scenario_text(const fram_scenario *s) { return s ? s->text.data : ""; }
const char *fram_scenario_notes(const fram_scenario *s) { return s && s->notes.data ? s->notes.data : ""; }
const char *fram_scenario_hash(const fram_scenario *s) { return s ? s->hash : ""; }

fram_status fram_scenario_check(const fram_scenario *s, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"scenario", s});
    return status == FRAM_OK ? build_check(&s->context->inner, &s->inner, NULL, NULL, error) : status;
}

double fram_scenario_duration(const fram_scenario *s) { return s ? s->inner.run.duration : (double)NAN; }
double fram_scenario_time_step(const fram_scenario *s) { return s ? s->inner.run.time_step : (double)NAN; }

void fram_scenario_destroy(fram_scenario *s)
{
    if (!s)
        return;
    context *ctx = &s->context->inner;
    scenario_free(ctx, &s->inner);
    text_free(ctx, &s->text);
    text_free(ctx, &s->notes);
    text_free(ctx, &s->files);
    text_free(ctx, &s->read);
    memory_free(ctx, s);
}

fram_status fram_scenario_reference(fram_context *c, char **markdown, fram_error *error)
{
    text_buffer text = {0};
    fram_status status = REFUSE_NULL(error, {"context", c}, {"markdown", markdown});
    if (status == FRAM_OK)
        status = scenario_reference(&c->inner, &text, error);
    if (status != FRAM_OK) {
        if (c)
            text_free(&c->inner, &text);
        return status;
    }
    *markdown = text.data;
    return FRAM_OK;
}
