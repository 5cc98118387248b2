/* fram fmu: a scenario as a co-simulation unit. */
#include "cli/cli.h"

#include "fram/fmu.h"

#include <string.h>

/* The unit's binary beside the command: in the build tree, or where it was installed. */
static bool find_binary(char out[BESIDE_SIZE])
{
    static const char *const places[] = {"fram_fmu.so", "../lib/fram/fram_fmu.so",
                                         "../lib/x86_64-linux-gnu/fram/fram_fmu.so"};
    return find_beside(places, sizeof places / sizeof *places, out);
}

static void print_unit(const common_options *common, const char *output, const fram_fmu_result *r)
{
    if (!common->quiet)
        tell(stderr, "%s: %d inputs, %d outputs, %d files of the scenario\n", output, r->inputs, r->outputs, r->files);
    if (!common->json)
        return;
    json j = json_begin();
    json_text(&j, "unit", output);
    json_integer(&j, "inputs", r->inputs);
    json_integer(&j, "outputs", r->outputs);
    json_integer(&j, "files", r->files);
    json_end(&j);
}

static int write_unit(const common_options *common, const command_files *files, const option_list *overrides,
                      const fram_fmu_definition *definition)
{
    work_view work;
    fram_context *context = NULL;
    int code = session_open_making(common, &work, &context);
    if (code >= 0)
        return code;
    fram_scenario *scenario = NULL;
    fram_error error = {0};
    fram_fmu_result result = {0};
    fram_status status =
        fram_scenario_load(context, files->inputs[0], overrides->value, overrides->count, &scenario, &error);
    if (status == FRAM_OK)
        code = refuse_scenario_files(common, files, scenario);
    if (status == FRAM_OK && code < 0)
        status = fram_fmu(scenario, definition, &result, &error);
    fram_scenario_destroy(scenario);
    fram_context_destroy(context);
    if (code >= 0)
        return code;
    if (status != FRAM_OK) {
        bool named = status == FRAM_ERROR_USAGE && strcmp(error.key, "inputs") == 0;
        bool chosen = status == FRAM_ERROR_USAGE && strcmp(error.key, "outputs") == 0;
        if (named || chosen)
            snprintf(error.key, sizeof error.key, "%s", named ? "--in" : "--out");
        return answer_error(common, &error);
    }
    print_unit(common, definition->output, &result);
    return EXIT_GOOD;
}

static bool read_version(const char *text, int *version)
{
    *version = text[0] - '0';
    return (*version == 2 || *version == 3) && (text[1] == '\0' || strcmp(text + 1, ".0") == 0);
}

int command_fmu(const command_row *self, int argc, char **argv)
{
    common_options common;
    fram_fmu_definition d;
    fram_fmu_default(&d);
    option_list overrides = {0}, inputs = {0}, outputs = {0};
    const char *path = NULL, *version = "2";
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &d.output, "NAME.fmu", "the unit (required); NAME is the model's"},
        {"--fmi", NULL, OPTION_TEXT, &version, "2|3", "version of the standard, 2.0 or 3.0 (2)"},
        {"--in", NULL, OPTION_LIST, &inputs, "NAME", "an input of the unit, * and ? for any (all); may be repeated"},
        {"--out", NULL, OPTION_LIST, &outputs, "NAME",
         "a channel as output, * and ? for any (all but clocks); may be repeated"},
        {"--binary", NULL, OPTION_TEXT, &d.binary, "FILE", "fram_fmu.so, if it is not beside the command"},
        {"--set", NULL, OPTION_LIST, &overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &path, 1);
    if (code >= 0)
        return code;
    if (!d.output)
        return answer_usage(&common, "--output", "is missing: name the unit, -o NAME.fmu");
    if (!read_version(version, &d.version))
        return answer_usage(&common, "--fmi", "expected 2 (FMI 2.0) or 3 (FMI 3.0)");
    char found[BESIDE_SIZE];
    if (!d.binary && !find_binary(found))
        return answer_usage(&common, "--binary", "fram_fmu.so is not beside the command: name it with --binary FILE");
    if (!d.binary)
        d.binary = found;
    d.inputs = inputs.value;
    d.input_count = inputs.count;
    d.outputs = outputs.value;
    d.output_count = outputs.count;
    const command_files files = {.inputs = {path, d.binary}, .outputs = {{"--output", d.output, "fmu"}}};
    code = refuse_outputs(&common, &files);
    return code >= 0 ? code : write_unit(&common, &files, &overrides, &d);
}
