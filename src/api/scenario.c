/* Scenarios of the public API. */
#include "api/arguments.h"
#include "api/handles.h"

#include "io/scenario_file.h"
#include "sim/build.h"
#include "sim/notes.h"
#include "sim/scene_size.h"

#include <math.h>

static fram_status fill(context *ctx, fram_scenario *s, fram_error *error)
{
    fram_status status = scene_size_check(&s->inner, error);
    if (status == FRAM_OK)
        status = scenario_print(ctx, &s->inner, NULL, &s->text, error);
    if (status == FRAM_OK)
        status = scenario_hash(ctx, &s->inner, s->hash, error);
    if (status != FRAM_OK)
        return status;
    scenario_notes(ctx, &s->inner, &s->notes);
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
    status = fill(ctx, s, error);
    if (status != FRAM_OK) {
        fram_scenario_destroy(s);
        return status;
    }
    *out = s;
    return FRAM_OK;
}

const char *fram_scenario_text(const fram_scenario *s) { return s ? s->text.data : ""; }
const char *fram_scenario_notes(const fram_scenario *s) { return s && s->notes.data ? s->notes.data : ""; }
const char *fram_scenario_hash(const fram_scenario *s) { return s ? s->hash : ""; }

fram_status fram_scenario_check(const fram_scenario *s, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"scenario", s});
    return status == FRAM_OK ? build_check(&s->context->inner, &s->inner, error) : status;
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
