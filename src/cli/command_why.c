/* fram why: what carried a peak of the ice load. */
#include "cli/cli.h"

#include "fram/results.h"

#include <math.h>

int command_why(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *run = NULL;
    int peak = 0; /* not given */
    bool no_rerun = false;
    fram_why_definition d;
    fram_why_default(&d);
    d.time = (double)NAN;
    const option_row rows[] = {
        {"--peak", NULL, OPTION_COUNT, &peak, "N", "the N-th largest peak of the run, 1 to 10"},
        {"--time", NULL, OPTION_REAL, &d.time, "T",
         "a moment instead of a peak [s]; recomputed unless it is one of the peaks"},
        {"--vessel", NULL, OPTION_TEXT, &d.vessel, "NAME", "of several vessels: whose load (the first)"},
        {"--no-rerun", NULL, OPTION_FLAG, &no_rerun, NULL,
         "do not repeat the last second with half the time step and with the accurate solver"},
        {"--output", "-o", OPTION_TEXT, &d.picture, "FILE", "also draw the plan view, .png or .svg"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &run, 1);
    if (code >= 0)
        return code;
    const bool timed = d.time == d.time;
    if (peak > 0 && timed)
        return answer_usage(&common, "--time", "does not go with --peak: give one of them");
    if (peak == 0 && !timed)
        return answer_usage(&common, "--peak", "is missing: --peak 1 is the largest; or name a moment, --time T");
    const command_files files = {.runs = {run}, .outputs = {{"--output", d.picture, PICTURE_ENDINGS}}};
    work_view work;
    fram_context *context = NULL;
    code = session_open_files(&common, &files, SESSION_READS, &work, &context);
    if (code >= 0)
        return code;
    d.peak = peak;
    d.time = timed ? d.time : 0;
    d.rerun = !no_rerun;
    d.json = common.json;
    d.stop = session_stop_flag();
    char *text = NULL;
    fram_error error = {0};
    if (fram_why(context, run, &d, &text, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        put_shown(stdout, text);
        if (d.picture && !common.quiet)
            tell(stderr, "%s\n", d.picture);
    }
    fram_text_free(context, text);
    fram_context_destroy(context);
    return code;
}
