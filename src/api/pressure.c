/* fram_pressure: ice pressure on a hull by panel. */
#include "api/arguments.h"
#include "api/handles.h"
#include "fram/results.h"
#include "sim/hull_pressure.h"

#include <math.h>

#define PANEL_LEAST 1e-6
#define PANEL_LONGEST 1e4

static void fram_pressure_fill(fram_pressure_definition *definition)
{
    *definition = (fram_pressure_definition){.size = sizeof *definition, .panel = (double)NAN};
}
DEFINITION_DEFAULT(fram_pressure, fram_pressure_definition)

static fram_status check_lines(const char *name, const double *line, int count, fram_error *error)
{
    if (count >= 0 && count <= FRAM_PRESSURE_LINES && (count == 0 || line))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, name, "expected up to %d coordinates, found %d%s",
                     FRAM_PRESSURE_LINES, count, line ? "" : " at NULL");
}

static fram_status take_pressure(const fram_pressure_definition *given, fram_pressure_definition *d, fram_error *error)
{
    fram_pressure_fill(d);
    fram_status status = definition_take(d, given, sizeof *d, DEFINITION_LEAST, "fram_pressure", error);
    if (status == FRAM_OK)
        status = folder_check("output", d->output, error);
    if (status == FRAM_OK)
        status = isnan(d->panel) ? FRAM_OK : number_check("panel", d->panel, PANEL_LEAST, PANEL_LONGEST, error);
    if (status == FRAM_OK)
        status = number_check("from", d->from, 0, TIME_MOST, error);
    if (status == FRAM_OK)
        status = number_check("to", d->to, -TIME_MOST, TIME_MOST, error);
    if (status == FRAM_OK)
        status = check_lines("frames", d->frames, d->frame_count, error);
    return status == FRAM_OK ? check_lines("stringers", d->stringers, d->stringer_count, error) : status;
}

fram_status fram_pressure(fram_context *c, const char *run, const fram_pressure_definition *definition,
                          fram_error *error)
{
    fram_pressure_definition d;
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run});
    if (status == FRAM_OK)
        status = take_pressure(definition, &d, error);
    if (status != FRAM_OK)
        return status;
    const pressure_options options = {.folder = run,
                                      .output = d.output,
                                      .rules = {.size = d.panel,
                                                .frame = d.frames,
                                                .frame_count = d.frame_count,
                                                .stringer = d.stringers,
                                                .stringer_count = d.stringer_count},
                                      .from = d.from,
                                      .to = d.to,
                                      .vessel = d.vessel,
                                      .force = d.force};
    context own = c->inner; /* other threads may be at work in the program's */
    if (d.stop)
        own.stop = d.stop;
    return hull_pressure_write(&own, &options, error);
}
