/* fram manage: what ice management brought. */
#include "cli/cli.h"

#include "fram/results.h"

int command_manage(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *run = NULL;
    fram_manage_definition d;
    fram_manage_default(&d);
    const option_row rows[] = {
        {"--vessel", NULL, OPTION_TEXT, &d.vessel, "NAME", "the protected vessel (the only one without propulsion)"},
        {"--beside", NULL, OPTION_TEXT, &d.beside, "RUN", "a run to compare with, for instance without icebreakers"},
        {"--limit", NULL, OPTION_SIZE, &d.limit, "M",
         "largest size of a floe that counts as managed [m] (the vessel's beam)"},
        {"--depth", NULL, OPTION_SIZE, &d.depth, "M",
         "length of the ice windows along the drift [m] (the width of the corridor)"},
        {"--output", "-o", OPTION_TEXT, &d.output, "FILE", "the page (RUN/manage.html); tables are written beside it"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &run, 1);
    if (code >= 0)
        return code;
    const command_files files = {.runs = {run, d.beside}, .outputs = {{"--output", d.output, PAGE_ENDINGS}}};
    work_view work;
    fram_context *context = NULL;
    code = session_open_files(&common, &files, SESSION_MAKES, &work, &context);
    if (code >= 0)
        return code;
    char *text = NULL;
    fram_result result = {0};
    fram_error error = {0};
    d.json = common.json;
    if (fram_manage(context, run, &d, &result, &text, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        put_shown(stdout, text);
        if (!common.quiet)
            tell(stderr, "%s: open it in a browser, or print it\n", result.path);
    }
    fram_text_free(context, text);
    fram_context_destroy(context);
    return code;
}
