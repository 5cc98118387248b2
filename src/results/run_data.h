/* What is read of a run's folder for plots, reports and comparisons: scenario, time series, fractures, run.json and the
   field at the first and the last frame. */
#ifndef RESULTS_RUN_DATA_H
#define RESULTS_RUN_DATA_H

#include "base/hash.h"
#include "io/csv_read.h"
#include "io/path.h"
#include "io/run_note.h"
#include "model/scenario.h"
#include "vessel/event.h"

/* The ice of one frame. */
typedef struct field_state {
    double time;        /* [s] */
    double_array areas; /* of the floes, ascending [m2] */
    double area, mass;  /* of all ice [m2], [kg] */
    double inside;      /* what of its area lies in the domain [m2] */
    double thickness;   /* mean over the area [m] */
    double thinnest, thickest;
    double mean, median, greatest;
    int32_t fixed; /* of the floes */
} field_state;

typedef struct run_data {
    char folder[PATH_ROOM];
    scenario s;
    char scenario_hash[SHA256_TEXT_SIZE]; /* of s, that is as scenario.yaml stands now and this program reads it */
    bool is_changed;                      /* it is not the one that the run was made of, or another Fram made it */
    run_note note; /* of a run that has no end yet, steps and time are how far its series goes, and there is no hash of
                      its state, no track, no computing time that says anything */
    csv_table series, fractures;
    field_state before, after; /* empty without a record */
    int64_t frames;
    bool lacks_record; /* though the fields were asked for and its scenario has frames */
} run_data;

/* FRAM_ERROR_INPUT when the folder is not that of a run. with_field: read the record too; a record without frames,
   or none, leaves the fields empty.  wish: names of columns, "time" among them, that are kept; NULL: all. */
fram_status run_data_read(context *ctx, const char *folder, bool with_field, const csv_wish *wish, run_data *d,
                          fram_error *error);
void run_data_free(context *ctx, run_data *d);

/* Finds whether the scenario is still the one of run.json; as run_data_read did. */
fram_status run_find_change(context *ctx, run_data *d, fram_error *error);
/* What is told where it is not, and the warning in the log of who tells something of the scenario. */
#define RUN_IS_CHANGED                                                                                            \
    "scenario.yaml was changed since the run was made, or another Fram made it: what is told of the scenario is " \
    "what stands there now"
void run_warn_change(context *ctx, const run_data *d);
/* The same once of so many runs, of which the first is in this folder; of none nothing. */
void run_warn_changes(context *ctx, const char *first, int32_t count);

/* The names of what a program told the run in place of its scenario, "wind_x, tug.path and 2 more"; "": nothing. */
enum { RUN_TOLD_SIZE = 1280 };
void run_told(const run_data *d, char out[RUN_TOLD_SIZE]);

/* Whether the run has no end: it goes on, or was killed. */
bool run_is_open(const run_data *d);
/* Whether there may have been events that are not in its note: it is open, or had more than that holds. */
bool run_lacks_events(const run_data *d);
/* Values of a channel, NULL when the run does not have it. */
const double *run_channel(const run_data *d, const char *name);
/* Of a vessel by its row, whether the run's vessels have names or not; a channel of the world is that for all. */
const double *run_vessel_channel(const run_data *d, int32_t vessel, const char *name);
/* When the run's own events of every step tell that something began after a time [s]; HUGE_VAL: they do not. */
double run_event_from(const run_data *d, int32_t vessel, station_event kind, double from);
/* When the last one by a time began [s]; -HUGE_VAL: none did. */
double run_event_until(const run_data *d, int32_t vessel, station_event kind, double to);
/* Whether something had begun at a time and was not yet over. */
bool run_event_goes_on(const run_data *d, int32_t vessel, station_event kind, station_event over, double at);
/* Lines of a vessel that parted, whenever that was, but not those that were let go. */
int32_t run_lines_broken(const run_data *d, int32_t vessel);
/* Events of a kind, enum fracture_kind: those in fractures.csv, or as many as the series has counted since the
   recording began where these are more.  Of a run that goes on, or was killed, that table often lags behind. */
int32_t run_fractures(const run_data *d, int kind);
/* How many of these are not in fractures.csv, of all kinds that the series counts. */
int32_t run_fractures_untold(const run_data *d);
/* That the series has the column time[s], with rising times; FRAM_ERROR_INPUT with its path and line, as run_data_read.
 */
fram_status run_series_check(const csv_table *series, const char *path, fram_error *error);
/* Warns where rows are missing between others or at the end, or all are; as run_data_read did. */
void run_warn_gaps(context *ctx, const run_data *d);
/* First row after the transient. */
int32_t run_first_row(const run_data *d);
/* From when on a run was recorded that a program had stepped before [s]; 0: from its start, or nothing tells. */
double run_recorded_from(const run_data *d);
/* The time of the last row where the run went on after it [s]; HUGE_VAL: that is its end, or there is no row. */
double run_ends_after_row(const run_data *d);
/* Steps from row to row of a series. */
double scenario_steps_of_row(const scenario *s);
/* Whether rows of the series are more than a step apart. */
bool run_leaves_out_steps(const run_data *d);
/* Whether it has no row of a run that made steps which have one, and what is told then, with its steps. */
bool run_is_cut_off(const run_data *d);
#define RUN_IS_CUT_OFF "series.csv has no rows, though the run made %.0f steps: it was cut off"
/* That the series has no rows. */
fram_status run_data_refuse_empty(const run_data *d, fram_error *error);
/* That the run has no channel of a name, and which may be meant; `also`: a name that is none of its columns and can be
   asked for besides, or NULL. */
fram_status run_refuse_channel(const run_data *d, const char *name, const char *also, fram_error *error);

#endif
