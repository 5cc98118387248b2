/* What a run says about keeping station, on one page: offsets, loads, line tensions, thruster use and power, events; as
   FOLDER/station.json and FOLDER/station.png, from FOLDER/series.csv after the transient. */
#ifndef SIM_STATION_RESULTS_H
#define SIM_STATION_RESULTS_H

#include "io/csv_read.h"
#include "model/scenario.h"
#include "model/world.h"

/* Statistics of one channel after the transient. */
typedef struct channel_statistics {
    double mean, deviation, least, greatest;
    double significant; /* mean of the highest third of the peaks between crossings of the mean upwards; 0: no peak */
    int32_t peaks;
} channel_statistics;
channel_statistics channel_statistics_of(const double *time, const double *value, int32_t count, double transient);

/* The offset envelope: the largest offset [m] towards each of these directions, evenly round from X on,
   counter-clockwise, after the transient; 0 where the point never was. */
enum { ENVELOPE_DIRECTIONS = 36 };
void offset_envelope(const double *time, const double *x, const double *y, int32_t count, double transient,
                     double out[ENVELOPE_DIRECTIONS]);

/* True when the scenario has something that keeps its vessel on station. */
bool station_has_results(const scenario *s);
fram_status station_results_write(context *ctx, const scenario *s, const world *w, const char *folder,
                                  fram_error *error);
/* The picture alone; FRAM_ERROR_UNSUPPORTED without cairo. */
fram_status station_page_write(context *ctx, const scenario *s, const world *w, const char *folder, fram_error *error);

#endif
