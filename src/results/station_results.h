/* What a run says about keeping station, on one page: offsets, loads, line tensions, thruster use and power, events; as
   FOLDER/station.json and FOLDER/station.png, from FOLDER/series.csv after the transient; with a list of vessels as
   station-NAME.json and station-NAME.png for each that keeps station.  vessel: its row. */
#ifndef RESULTS_STATION_RESULTS_H
#define RESULTS_STATION_RESULTS_H

#include "base/channel_statistics.h"
#include "io/csv_read.h"
#include "model/scenario.h"
#include "vessel/outcome.h"

/* The offset envelope: the largest offset [m] towards each of these directions, evenly round from X on,
   counter-clockwise, after the transient; 0 where the point never was. */
enum { ENVELOPE_DIRECTIONS = 36 };
void offset_envelope(const double *time, const double *x, const double *y, int32_t count, double transient,
                     double out[ENVELOPE_DIRECTIONS]);

/* True when the scenario has something that keeps the vessel on station, or requires that it stays there. */
bool station_has_results(const scenario *s, int32_t vessel);
fram_status station_results_write(context *ctx, const scenario *s, int32_t vessel, const station_outcome *o,
                                  const char *folder, fram_error *error);
/* The picture alone; FRAM_ERROR_UNSUPPORTED without cairo. */
fram_status station_page_write(context *ctx, const scenario *s, int32_t vessel, const station_outcome *o,
                               const char *folder, fram_error *error);

#endif
