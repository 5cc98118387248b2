/* fram check and fram keys: what a scenario says, and what it could say. */
#include "cli/cli.h"

int command_check(const command_row *self, int argc, char **argv)
{
    common_options common;
    option_list overrides = {0};
    const char *path = NULL;
    const option_row rows[] = {
        {"--set", NULL, OPTION_LIST, &overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &path, 1);
    if (code >= 0)
        return code;
    fram_context *context = NULL;
    code = session_open(&common, &context);
    if (code >= 0)
        return code;

    fram_scenario *scenario = NULL;
    fram_error error = {0};
    fram_status status = fram_scenario_load(context, path, overrides.value, overrides.count, &scenario, &error);
    if (status != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        fputs(fram_scenario_text(scenario), stdout);
        if (!common.quiet)
            fputs(fram_scenario_notes(scenario), stderr);
        if (common.json) {
            json j = json_begin();
            json_text(&j, "scenario", path);
            json_text(&j, "scenario_hash", fram_scenario_hash(scenario));
            json_real(&j, "duration_s", fram_scenario_duration(scenario));
            json_real(&j, "time_step_s", fram_scenario_time_step(scenario));
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
