/* fram run and fram resume: a simulation with results on disk. */
#include "cli/cli.h"

#include <math.h>
#include <string.h>

/* Without --until. */
#define TO_THE_END HUGE_VAL

static void print_run(const common_options *common, const char *folder, const fram_run_result *r)
{
    if (!common->quiet) {
        fprintf(stderr, "%s at t = %g s after %lld step%s: %d floe%s, wall-clock %.1f s, real-time factor %.2f\n",
                r->finished ? "finished" : "stopped", r->time, (long long)r->steps, plural(r->steps), r->floes,
                plural(r->floes), r->wall, r->real_time_factor);
        tell(stderr, "results are in %s\n", folder);
    }
    if (!common->json)
        return;
    json j = json_begin();
    json_hash(&j, "state_hash", r->state_hash);
    json_integer(&j, "steps", r->steps);
    json_real(&j, "time_s", r->time);
    json_real(&j, "wall_s", r->wall);
    json_real(&j, "real_time_factor", r->real_time_factor);
    json_integer(&j, "bodies", r->bodies);
    json_integer(&j, "floes", r->floes);
    json_boolean(&j, "finished", r->finished);
    json_text(&j, "folder", folder);
    json_end(&j);
}

/* How a shell takes the folder as one word. */
static void print_resume(const char *folder)
{
    bool plain =
        folder[strspn(folder, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+=:,@%")] == '\0';
    fprintf(stderr, "continue with: fram resume %s%s", folder[0] == '-' ? "./" : "", plain ? folder : "'");
    for (const char *c = folder; *c && !plain; c += strcspn(c, "'") + (c[strcspn(c, "'")] == '\''))
        tell(stderr, "%.*s%s", (int)strcspn(c, "'"), c, c[strcspn(c, "'")] == '\'' ? "'\\''" : "");
    fputs(plain ? "\n" : "'\n", stderr);
}

static int finish(const common_options *common, fram_status status, const fram_error *error, const char *folder,
                  const fram_run_result *result)
{
    if (status != FRAM_OK) {
        int code = answer_error(common, error);
        if (status == FRAM_INTERRUPTED && result->steps > 0)
            print_resume(folder);
        return code;
    }
    print_run(common, folder, result);
    return EXIT_GOOD;
}

static void tell_address(void *user, const char *address)
{
    (void)user;
    fprintf(stderr, "live view: %s\n", address);
    fflush(stderr);
}

/* --live: the run can be looked on at.  -1: good, otherwise an exit code. */
static int prepare_live(const common_options *common, bool live, char page[BESIDE_SIZE],
                        fram_run_definition *definition)
{
    if (!live)
        return -1;
    if (!viewer_page_find(page))
        return answer_usage(common, "--live", "needs the viewer's page: build it with make viewer");
    definition->live_page = page;
    definition->live = tell_address;
    return -1;
}

/* Where to stop: by default the end of the scenario.  -1: good, otherwise an exit code. */
static int take_until(const common_options *common, double *until)
{
    if (!(*until > 0))
        return answer_usage(common, "--until", "must be a time after 0 s");
    *until = *until < TO_THE_END ? *until : 0;
    return -1;
}

static void watch_run(const common_options *common, progress_view *view, fram_run_definition *definition)
{
    progress_begin(view);
    definition->progress = common->quiet ? NULL : progress_show;
    definition->progress_user = view;
    definition->stop = session_stop_flag();
}

int command_run(const command_row *self, int argc, char **argv)
{
    common_options common;
    fram_run_definition definition;
    fram_run_default(&definition);
    definition.until = TO_THE_END;
    option_list overrides = {0};
    const char *path = NULL;
    bool live = false;
    char page[BESIDE_SIZE];
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &definition.folder, "DIR", "folder for the results (required)"},
        {"--until", NULL, OPTION_REAL, &definition.until, "T", "stop at simulated time T [s] with a checkpoint"},
        {"--set", NULL, OPTION_LIST, &overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
        {"--with-paths", NULL, OPTION_FLAG, &definition.with_paths, NULL,
         "record the full paths of input files, not only their names"},
        {"--live", NULL, OPTION_FLAG, &live, NULL,
         "print an address at which a browser on this machine can watch the run"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &path, 1);
    if (code < 0)
        code = take_until(&common, &definition.until);
    if (code >= 0)
        return code;
    if (!definition.folder)
        return answer_usage(&common, "--output", "is missing: name a folder for the results, -o DIR");
    code = prepare_live(&common, live, page, &definition);
    if (code >= 0)
        return code;
    definition.force = common.force;

    work_view work;
    fram_context *context = NULL;
    code = session_open_making(&common, &work, &context);
    if (code >= 0)
        return code;
    progress_view view;
    watch_run(&common, &view, &definition);

    fram_scenario *scenario = NULL;
    fram_error error = {0};
    fram_run_result result = {0};
    fram_status status = fram_scenario_load(context, path, overrides.value, overrides.count, &scenario, &error);
    if (status == FRAM_OK)
        code = refuse_run_folder(&common, path, scenario, definition.folder);
    if (status == FRAM_OK && code < 0)
        status = fram_run(scenario, &definition, &result, &error);
    progress_end(&view);
    if (code < 0)
        code = finish(&common, status, &error, definition.folder, &result);
    fram_scenario_destroy(scenario);
    fram_context_destroy(context);
    return code;
}

int command_resume(const command_row *self, int argc, char **argv)
{
    common_options common;
    fram_run_definition definition;
    fram_run_default(&definition);
    definition.until = TO_THE_END;
    bool live = false;
    char page[BESIDE_SIZE];
    const option_row rows[] = {
        {"--until", NULL, OPTION_REAL, &definition.until, "T", "stop at simulated time T [s] with a checkpoint"},
        {"--live", NULL, OPTION_FLAG, &live, NULL,
         "print an address at which a browser on this machine can watch the run"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &definition.folder, 1);
    if (code < 0)
        code = take_until(&common, &definition.until);
    if (code < 0)
        code = prepare_live(&common, live, page, &definition);
    if (code >= 0)
        return code;

    fram_context *context = NULL;
    code = session_open(&common, &context);
    if (code >= 0)
        return code;
    progress_view view;
    watch_run(&common, &view, &definition);

    fram_error error = {0};
    fram_run_result result = {0};
    fram_status status = fram_resume(context, &definition, &result, &error);
    progress_end(&view);
    code = finish(&common, status, &error, definition.folder, &result);
    fram_context_destroy(context);
    return code;
}
