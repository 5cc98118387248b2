/* Results of a run in the formats of other programs, as pictures, pages and video.  All of them read the run's folder
   only, of a run that ended or goes on, and write files that are whole or not there.  Where `output` is NULL the result
   goes into the run's folder, and fram_result.path says where. */
#ifndef FRAM_RESULTS_H
#define FRAM_RESULTS_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fram_result {
    char path[1024]; /* the file to open */
    int64_t frames;  /* of the record that are in it */
    double time;     /* of the first of them, simulated [s] */
} fram_result;

/* ---- Formats of other programs ---- */

/* For ParaView: run.pvd in the folder `output` (RUN/vtk), with floes, hull and forces of every `every`-th frame. */
FRAM_API fram_status fram_export_vtk(fram_context *context, const char *run, const char *output, int64_t every,
                                     fram_result *result, fram_error *error);
/* Outlines of floes, walls and vessel at a time [s], between frames by interpolation (RUN/field-TIME.geojson).
   FRAM_ERROR_INPUT for a time outside the record. */
FRAM_API fram_status fram_export_geojson(fram_context *context, const char *run, const char *output, double time,
                                         fram_result *result, fram_error *error);
/* NetCDF-4, which is HDF5: all channels, all fractures, all floes over the frames (RUN/run.nc).
   FRAM_ERROR_UNSUPPORTED in a build without NetCDF. */
FRAM_API fram_status fram_export_netcdf(fram_context *context, const char *run, const char *output, fram_result *result,
                                        fram_error *error);

#ifdef __cplusplus
}
#endif
#endif
