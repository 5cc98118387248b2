/* What the two pages of keeping station have in common, station.json and station.png: what is read of the series, and
   what is told of it: one module with station_results, station_data and station_page.  Knows no format. */
#ifndef RESULTS_STATION_PARTS_H
#define RESULTS_STATION_PARTS_H

#include "io/path.h"
#include "results/station_results.h"

/* Columns of the series, then a tension of each line and a thrust of each thruster. */
enum { TIME, OFFSET_X, OFFSET_Y, HEADING, LOAD_X, LOAD_Y, POWER, SATURATED, TENSION, FIXED };
/* Lines, and thrusters, of a vessel. */
enum { MOST_EACH = 64, MOST_CHANNELS = FIXED + 2 * MOST_EACH };

typedef struct station_data {
    const scenario *s;
    int32_t vessel;
    const station_outcome *outcome;
    double_array column[MOST_CHANNELS];
    double_array offset, load;                    /* magnitudes */
    int32_t line[MOST_EACH], thruster[MOST_EACH]; /* their rows in the outcome's tables */
    int32_t lines, thrusters, rows;
} station_data;

/* What the series of the folder tells of a vessel; path: of the vessel's file with this ending there.  d is to be freed
   in any case. */
fram_status station_data_read(context *ctx, const scenario *s, int32_t vessel, const station_outcome *o,
                              const char *folder, const char *ending, station_data *d, char path[PATH_ROOM],
                              fram_error *error);
void station_data_free(context *ctx, station_data *d);

const scenario_station *station_limits(const station_data *d);
/* The first row after the transient; d->rows: there is none. */
int32_t station_first_row(const station_data *d, double transient);
channel_statistics station_statistics(const station_data *d, const double_array *of, double transient);
/* Part of the rows after the transient beyond a limit; NaN without any. */
double station_exceedance(const station_data *d, const double_array *of, double limit, double transient);
/* Of the thrusters after the transient [J], of which a row tells the power since the one before, the first one since
   the transient or, of a recording that began later, over one interval of rows, and the last one until the end as well.
   NaN without any. */
double station_energy(const station_data *d, double transient);
/* Lines that parted or were let go. */
int32_t station_lines_gone(const station_data *d);
/* An event of the outcome, by its row, in words. */
void station_tell_event(const station_data *d, int32_t row, char *out, size_t size);

#endif
