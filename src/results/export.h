/* A finished (or running) run in the formats of other programs, made from its folder: the record and the CSV files. */
#ifndef RESULTS_EXPORT_H
#define RESULTS_EXPORT_H

#include "io/path.h"

/* What was written. */
typedef struct export_report {
    char path[PATH_ROOM]; /* the file to open */
    int64_t frames;       /* in it */
    double time;          /* of the first, simulated [s] */
} export_report;

/* For ParaView: OUTPUT/run.pvd (floes, hull and forces together) and floes.pvd, hull.pvd, forces.pvd, with a .vtp each
   per frame under OUTPUT/data; every `every`-th frame, at least 1.  Such files that are there go first.  Files are
   whole or not there, and the .pvd files come last.  output NULL: FOLDER/vtk. */
fram_status export_vtk(context *ctx, const char *folder, const char *output, int64_t every, export_report *report,
                       fram_error *error);

/* All floes, walls and the vessel's plan at `time` [s], between frames by interpolation; a time outside the record is
   FRAM_ERROR_INPUT.  output NULL: FOLDER/field-TIME.geojson. */
fram_status export_geojson(context *ctx, const char *folder, const char *output, double time, export_report *report,
                           fram_error *error);

/* NetCDF-4: every channel of series.csv over `time`, every column of fractures.csv over `fracture`, and pose, velocity
   and contact force of every floe over (frame, floe).  output NULL: FOLDER/run.nc.  FRAM_ERROR_UNSUPPORTED in a build
   without NetCDF. */
fram_status export_netcdf(context *ctx, const char *folder, const char *output, export_report *report,
                          fram_error *error);

#endif
