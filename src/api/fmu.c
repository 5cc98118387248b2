/* Co-simulation units of the public API. */
#include "fram/fmu.h"

#include "api/arguments.h"
#include "api/handles.h"

#include "io/path.h"
#include "sim/fmu.h"

static void fram_fmu_fill(fram_fmu_definition *definition)
{
    *definition = (fram_fmu_definition){.size = sizeof *definition, .version = 2};
}
DEFINITION_DEFAULT(fram_fmu, fram_fmu_definition)

static fram_status check_names(const char *name, const char *const *names, int count, fram_error *error)
{
    if (count < 0 || (count > 0 && !names))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, name, "expected 0 or more names, found %d", count);
    for (int i = 0; i < count; i++) {
        if (!names[i])
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, name, "expected a name, found NULL at %d", i);
    }
    return FRAM_OK;
}

fram_status(fram_fmu)(const fram_scenario *s, const fram_fmu_definition *definition, fram_fmu_result *result,
                      fram_error *error, size_t size)
{
    fram_fmu_definition d;
    fram_fmu_fill(&d);
    fram_status status = REFUSE_NULL(error, {"scenario", s});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_fmu_result, error);
    if (status == FRAM_OK)
        status = definition_take(&d, definition, sizeof d, DEFINITION_LEAST, "fram_fmu", error);
    if (status == FRAM_OK)
        status = REFUSE_NULL(error, {"output", d.output}, {"binary", d.binary});
    if (status == FRAM_OK)
        status = check_names("inputs", d.inputs, d.input_count, error);
    if (status == FRAM_OK)
        status = check_names("outputs", d.outputs, d.output_count, error);
    if (status == FRAM_OK && d.version != 2 && d.version != 3)
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "version",
                           "expected 2 for FMI 2.0 or 3 for FMI 3.0, found %d", d.version);
    if (status == FRAM_OK)
        status = list_refuse_read(&s->read, d.output, "output", error);
    if (status == FRAM_OK)
        status = path_refuse_read(d.binary, d.output, "output", error);
    if (status != FRAM_OK)
        return status;
    const fmu_options options = {d.output,      d.binary,       d.inputs,  d.outputs,
                                 d.input_count, d.output_count, d.version, channel_meaning};
    fmu_report report;
    status = fmu_write(&s->context->inner, &s->inner, &options, &report, error);
    if (status == FRAM_OK)
        result_give(result, size, &(fram_fmu_result){report.inputs, report.outputs, report.files});
    return status;
}
