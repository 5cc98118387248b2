/* fram capability: the capability plot of a scenario's vessel in drifting ice. */
#include "cli/cli.h"

#include "fram/results.h"

static int find(const common_options *common, const char *path, const option_list *overrides,
                const fram_capability_definition *d)
{
    fram_context *context = NULL;
    work_view work;
    int code = session_open_making(common, &work, &context);
    if (code >= 0)
        return code;
    fram_scenario *scenario = NULL;
    fram_result result = {0};
    fram_error error = {0};
    fram_status status = fram_scenario_load(context, path, overrides->value, overrides->count, &scenario, &error);
    if (status == FRAM_OK)
        status = fram_capability(scenario, d, &result, &error);
    if (status != FRAM_OK)
        code = answer_error(common, &error);
    if (code < 0) {
        code = EXIT_GOOD;
        if (!common->quiet)
            tell(stderr, "%s; tables: capability.csv, capability_use.csv, capability.json beside it\n", result.path);
        if (common->json) {
            json j = json_begin();
            json_text(&j, "file", result.path);
            json_end(&j);
        }
    }
    fram_scenario_destroy(scenario);
    fram_context_destroy(context);
    return code;
}

int command_capability(const command_row *self, int argc, char **argv)
{
    common_options common;
    option_list overrides = {0}, runs = {0};
    const char *path = NULL;
    fram_capability_definition d;
    fram_capability_default(&d);
    d.stop = session_stop_flag();
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &d.folder, "DIR", "folder for the results (required)"},
        {"--set", NULL, OPTION_LIST, &overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
        {"--vessel", NULL, OPTION_TEXT, &d.vessel, "NAME", "which of several vessels; the others are left out"},
        {"--ice-from", NULL, OPTION_LIST, &runs, "RUN",
         "ice as it came to the vessel in a finished run, behind its icebreakers; may be repeated, over seeds say"},
        {"--ice-vessel", NULL, OPTION_TEXT, &d.ice_vessel, "NAME",
         "the vessel of those runs that the ice came to (the same name, or the only one without propulsion)"},
        {"--unbroken-as", NULL, OPTION_SIZE, &d.unbroken_as, "M",
         "diameter of the floes that stand for ice from runs that was still unbroken [m]"},
        {"--window", NULL, OPTION_SIZE, &d.window, "M",
         "side of the square of ice from runs about the vessel [m] (three times its length)"},
        {"--measure", NULL, OPTION_REAL, &d.measure, "T",
         "simulated seconds of each run that measures the ice load on the fixed hull (120)"},
        {"--formula", NULL, OPTION_FLAG, &d.formula, NULL,
         "ice load from Zuev's formula for ships in broken ice instead, without runs: for some 20 degrees about the "
         "bow; abeam it is many times too large"},
        {"--directions", NULL, OPTION_INTEGER, &d.directions, "N", "number of directions, evenly spaced (36)"},
        {"--speed-step", NULL, OPTION_REAL, &d.speed_step, "V", "step of drift speed [m/s] (0.1)"},
        {"--speed-most", NULL, OPTION_REAL, &d.speed_most, "V", "largest drift speed [m/s] (1)"},
        {"--allowance", NULL, OPTION_REAL, &d.allowance, "X", "dynamic allowance: factor on mean loads (1.25)"},
        {"--line-safety", NULL, OPTION_REAL, &d.line_safety, "X",
         "safety factor of lines, breaking load over tension, intact (2)"},
        {"--line-safety-damaged", NULL, OPTION_REAL, &d.line_safety_damaged, "X", "the same, after a failure (1.43)"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &path, 1);
    if (code >= 0)
        return code;
    if (!d.folder)
        return answer_usage(&common, "--output", "is missing: name the folder for the results, -o DIR");
    d.force = common.force;
    d.ice_from = runs.value;
    d.ice_from_count = runs.count;
    return find(&common, path, &overrides, &d);
}
