/* fram_manage: results of ice management. */
#include "results/manage.h"
#include "api/arguments.h"
#include "api/handles.h"
#include "fram/results.h"

#include <math.h>
#include <string.h>

/* Far beyond every floe [m]. */
#define SIZE_MOST 1e7

static void fram_manage_fill(fram_manage_definition *definition)
{
    *definition = (fram_manage_definition){.size = sizeof *definition};
}
DEFINITION_DEFAULT(fram_manage, fram_manage_definition)

fram_status(fram_manage)(fram_context *c, const char *run, const fram_manage_definition *definition,
                         fram_result *result, char **text, fram_error *error, size_t size)
{
    fram_manage_definition d;
    manage_summary own, beside;
    text_buffer out = {0};
    fram_manage_fill(&d);
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run}, {"text", text});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_result, error);
    if (status == FRAM_OK)
        status = definition_take(&d, definition, sizeof d, DEFINITION_LEAST, "fram_manage", error);
    if (status == FRAM_OK)
        status = number_check("limit", d.limit, 0, SIZE_MOST, error);
    if (status == FRAM_OK)
        status = number_check("depth", d.depth, 0, SIZE_MOST, error);
    if (status != FRAM_OK)
        return status;
    const manage_options options = {.vessel = d.vessel,
                                    .beside = d.beside,
                                    .output = d.output,
                                    .limit = d.limit > 0 ? d.limit : (double)NAN,
                                    .depth = d.depth > 0 ? d.depth : (double)NAN};
    status = manage_write(&c->inner, run, &options, &own, &beside, error);
    if (status == FRAM_OK)
        status = manage_text(&c->inner, &own, d.beside ? &beside : NULL, d.json, &out, error);
    if (status != FRAM_OK) {
        text_free(&c->inner, &out);
        return status;
    }
    fram_result full = {.frames = 0};
    memcpy(full.path, own.page, sizeof full.path);
    result_give(result, size, &full);
    *text = out.data;
    return FRAM_OK;
}
