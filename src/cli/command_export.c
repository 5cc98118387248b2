/* fram export: results in the formats of other programs. */
#include "cli/cli.h"

#include "fram/results.h"
#include <math.h>
#include <unistd.h>

static void print_export(const common_options *common, const fram_result *r, const char *advice)
{
    if (!common->quiet)
        tell(stderr, "%s: %lld frame%s; %s\n", r->path, (long long)r->frames, plural(r->frames), advice);
    if (!common->json)
        return;
    json j = json_begin();
    json_text(&j, "file", r->path);
    json_integer(&j, "frames", r->frames);
    json_real(&j, "time_s", r->time);
    json_end(&j);
}

int command_export(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *run = NULL, *output = NULL;
    bool vtk = false, geojson = false, netcdf = false;
    double time = (double)NAN;
    int every = 0; /* not given */
    const option_row rows[] = {
        {"--vtk", NULL, OPTION_FLAG, &vtk, NULL,
         "for ParaView: floes, hull and forces of every frame (RUN/vtk/run.pvd)"},
        {"--netcdf", NULL, OPTION_FLAG, &netcdf, NULL,
         "NetCDF-4 for xarray and h5py: all channels and floes (RUN/run.nc)"},
        {"--geojson", NULL, OPTION_FLAG, &geojson, NULL, "floe outlines at one time (RUN/field-T.geojson)"},
        {"--time", NULL, OPTION_REAL, &time, "T", "time of --geojson [s]"},
        {"--every", NULL, OPTION_COUNT, &every, "N", "only every N-th frame, for --vtk (1)"},
        {"--output", "-o", OPTION_TEXT, &output, "PATH", "the file, or the folder of --vtk"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &run, 1);
    if (code >= 0)
        return code;
    if (vtk + geojson + netcdf != 1)
        return answer_usage(&common, "export", "name one format: --vtk, --netcdf or --geojson");
    if (geojson == !!isnan(time))
        return answer_usage(&common, "--time",
                            geojson ? "is missing: --geojson shows one time, --time T" : "goes with --geojson only");
    if (every > 0 && !vtk)
        return answer_usage(&common, "--every", "goes with --vtk only");
    if (every == 0)
        every = 1;
    const command_files files = {.runs = {run},
                                 .outputs = {{"--output", output,
                                              vtk      ? FOLDER_OUTPUT
                                              : netcdf ? "nc"
                                                       : "geojson json"}}};
    work_view work;
    fram_context *context = NULL;
    code = session_open_files(&common, &files, SESSION_MAKES, &work, &context);
    if (code >= 0)
        return code;
    fram_result result = {0};
    fram_error error = {0};
    fram_status status = vtk      ? fram_export_vtk(context, run, output, every, &result, &error)
                         : netcdf ? fram_export_netcdf(context, run, output, &result, &error)
                                  : fram_export_geojson(context, run, output, time, &result, &error);
    if (status == FRAM_OK)
        print_export(&common, &result,
                     vtk      ? "open it in ParaView"
                     : netcdf ? "xarray.open_dataset reads it"
                              : "readable by any GIS, geopandas and fram itself; coordinates are metres in the "
                                "scenario's plane, so give a GIS a plane system (ogr2ogr -a_srs), not degrees");
    code = status == FRAM_OK ? EXIT_GOOD : answer_error(&common, &error);
    fram_context_destroy(context);
    /* HDF5 keeps a file that it could not close for want of room, tries again at exit and reads what it has freed. */
    if (netcdf && status == FRAM_ERROR_IO) {
        fflush(NULL);
        _exit(code);
    }
    return code;
}
