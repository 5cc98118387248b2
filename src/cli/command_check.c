/* fram check and fram keys: what a scenario says, and what it could say. */
#include "cli/cli.h"

/* Build the world of the scenario, in case the ice cannot be placed or the hull cannot float there, and count it. */
static fram_status count_world(const fram_scenario *scenario, int *bodies, int *floes, fram_error *error)
{
    fram_world *world = NULL;
    fram_status status = fram_world_create(scenario, &world, error);
    for (int slot = 0; status == FRAM_OK && slot < fram_world_slots(world); slot++) {
        fram_body_id id;
        fram_body_state body;
        if (!fram_world_body(world, slot, &id))
            continue;
        status = fram_body_state_get(world, id, &body, error);
        *bodies += 1;
        *floes += body.kind == FRAM_BODY_FLOE;
    }
    fram_world_destroy(world);
    return status;
}

int command_check(const command_row *self, int argc, char **argv)
{
    common_options common;
    option_list overrides = {0};
    bool build = false;
    const char *path = NULL;
    const option_row rows[] = {
        {"--set", NULL, OPTION_LIST, &overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
        {"--build", NULL, OPTION_FLAG, &build, NULL, "also pack the ice and float the vessel, as a run would"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &path, 1);
    if (code >= 0)
        return code;
    work_view work;
    fram_context *context = NULL;
    code = session_open_making(&common, &work, &context);
    if (code >= 0)
        return code;

    fram_scenario *scenario = NULL;
    fram_error error = {0};
    int bodies = 0, floes = 0;
    fram_status status = fram_scenario_load(context, path, overrides.value, overrides.count, &scenario, &error);
    if (status == FRAM_OK)
        status = build ? count_world(scenario, &bodies, &floes, &error) : fram_scenario_check(scenario, &error);
    if (status != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        fputs(fram_scenario_text(scenario), stdout);
        if (!common.quiet)
            fputs(fram_scenario_notes(scenario), stderr);
        if (!common.quiet && build)
            fprintf(stderr, "built: %d floes among %d bodies\n", floes, bodies);
        if (common.json) {
            json j = json_begin();
            json_text(&j, "scenario", path);
            json_text(&j, "scenario_hash", fram_scenario_hash(scenario));
            json_real(&j, "duration_s", fram_scenario_duration(scenario));
            json_real(&j, "time_step_s", fram_scenario_time_step(scenario));
            if (build) {
                json_integer(&j, "floes", floes);
                json_integer(&j, "bodies", bodies);
            }
            json_end(&j);
        }
    }
    fram_scenario_destroy(scenario);
    fram_context_destroy(context);
    return code;
}

int command_keys(const command_row *self, int argc, char **argv)
{
    common_options common;
    int code = options_read(self, NULL, 0, &common, argc, argv, NULL, 0);
    if (code >= 0)
        return code;
    fram_context *context = NULL;
    code = session_open(&common, &context);
    if (code >= 0)
        return code;
    char *text = NULL;
    fram_error error = {0};
    if (fram_scenario_reference(context, &text, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        fputs(text, stdout);
        if (common.json) {
            int lines = 0;
            for (const char *c = text; *c; c++)
                lines += *c == '\n';
            json j = json_begin();
            json_text(&j, "format", "Markdown");
            json_integer(&j, "lines", lines);
            json_end(&j);
        }
        fram_text_free(context, text);
    }
    fram_context_destroy(context);
    return code;
}
