/* fram check and fram keys: what a scenario says, and what it could say. */
#include "cli/cli.h"

/* What a world tells that a scenario does not. */
typedef struct built {
    int bodies, floes;
    double seconds; /* that the whole run is expected to compute [s] */
    char *notes;
} built;

/* The first step, which finds all contacts, is no measure of the others; then a second of them is. */
#define TRIAL_TIME 1.0

static fram_status try_steps(fram_world *world, const fram_scenario *scenario, double *seconds, fram_error *error)
{
    fram_status status = fram_world_step(world, error);
    const double begin = wall_clock(), steps = fram_scenario_duration(scenario) / fram_scenario_time_step(scenario);
    int done = 0;
    for (; status == FRAM_OK && (done < 2 || wall_clock() - begin < TRIAL_TIME) && done + 1 < steps; done++)
        status = fram_world_step(world, error);
    *seconds = done > 0 ? (wall_clock() - begin) / done * steps : 0;
    return status;
}

/* Build the world of the scenario, in case the ice cannot be placed or the hull cannot float there, count it, and step
   it for a moment. */
static fram_status build_world(const fram_scenario *scenario, built *out, fram_error *error)
{
    fram_world *world = NULL;
    fram_status status = fram_world_create(scenario, &world, error);
    for (int slot = 0; status == FRAM_OK && slot < fram_world_slots(world); slot++) {
        fram_body_id id;
        fram_body_state body;
        if (!fram_world_body(world, slot, &id))
            continue;
        status = fram_body_state_get(world, id, &body, error);
        out->bodies += 1;
        out->floes += body.kind == FRAM_BODY_FLOE;
    }
    if (status == FRAM_OK)
        status = fram_world_notes(world, &out->notes, error);
    if (status == FRAM_OK)
        status = try_steps(world, scenario, &out->seconds, error);
    fram_world_destroy(world);
    return status;
}

static void tell_check(const common_options *common, const fram_scenario *scenario, bool build, const built *made)
{
    put_given(stdout, fram_scenario_text(scenario));
    if (common->quiet)
        return;
    put_shown(stderr, build ? made->notes : fram_scenario_notes(scenario));
    if (!build) {
        fputs("time: fram check --build makes the ice and judges by its first steps how long a run takes\n", stderr);
        return;
    }
    fprintf(stderr, "built: %d floe%s among %d %s\ntime: judged by its first steps a run takes ", made->floes,
            plural(made->floes), made->bodies, made->bodies == 1 ? "body" : "bodies");
    print_duration(made->seconds);
    fputs(" here, more where ice gathers or breaks later\n", stderr);
}

static void json_check(const char *path, const fram_scenario *scenario, bool build, const built *made)
{
    json j = json_begin();
    json_text(&j, "scenario", path);
    json_text(&j, "scenario_hash", fram_scenario_hash(scenario));
    json_real(&j, "duration_s", fram_scenario_duration(scenario));
    json_real(&j, "time_step_s", fram_scenario_time_step(scenario));
    if (build) {
        json_integer(&j, "floes", made->floes);
        json_integer(&j, "bodies", made->bodies);
        json_real(&j, "run_wall_s", made->seconds);
    }
    json_end(&j);
}

int command_check(const command_row *self, int argc, char **argv)
{
    common_options common;
    option_list overrides = {0};
    bool build = false;
    const char *path = NULL;
    const option_row rows[] = {
        {"--set", NULL, OPTION_LIST, &overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
        {"--build", NULL, OPTION_FLAG, &build, NULL,
         "also generate the ice, float the vessel, and estimate how long a run will take"},
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
    built made = {0};
    fram_status status = fram_scenario_load(context, path, overrides.value, overrides.count, &scenario, &error);
    if (status == FRAM_OK)
        status = build ? build_world(scenario, &made, &error) : fram_scenario_check(scenario, &error);
    if (status != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        tell_check(&common, scenario, build, &made);
        if (common.json)
            json_check(path, scenario, build, &made);
    }
    fram_text_free(context, made.notes);
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
