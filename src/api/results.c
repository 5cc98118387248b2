/* Exports, reports and pictures of the public API. */
#include "fram/results.h"

#include "api/handles.h"
#include "sim/export.h"

#include <string.h>

static fram_status answer(fram_status status, const export_report *from, fram_result *to)
{
    if (status == FRAM_OK && to) {
        *to = (fram_result){.frames = from->frames, .time = from->time};
        memcpy(to->path, from->path, sizeof to->path);
    }
    return status;
}

fram_status fram_export_vtk(fram_context *c, const char *run, const char *output, int64_t every, fram_result *result,
                            fram_error *error)
{
    export_report report;
    return answer(export_vtk(&c->inner, run, output, every, &report, error), &report, result);
}

fram_status fram_export_geojson(fram_context *c, const char *run, const char *output, double time, fram_result *result,
                                fram_error *error)
{
    export_report report;
    return answer(export_geojson(&c->inner, run, output, time, &report, error), &report, result);
}

fram_status fram_export_netcdf(fram_context *c, const char *run, const char *output, fram_result *result,
                               fram_error *error)
{
    export_report report;
    return answer(export_netcdf(&c->inner, run, output, &report, error), &report, result);
}
