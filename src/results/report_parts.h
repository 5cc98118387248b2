/* Inside the report: what its sections share. One module with report, whose inside this is. */
#ifndef RESULTS_REPORT_PARTS_H
#define RESULTS_REPORT_PARTS_H

#include "base/load_unit.h"
#include "ice/fracture.h"
#include "io/html_page.h"
#include "model/scenario_vessel.h"
#include "results/load_statistics.h"
#include "results/peaks.h"
#include "results/report.h"
#include "results/run_data.h"

typedef struct report {
    context *ctx;
    bool with_paths;
    notes_function notes;
    run_data d;
    html_page page;
    int32_t vessel;       /* row of the one that is reported now */
    ARRAY(double *) kept; /* scaled columns that charts point to, freed at the end */
    bool peaks_unread;    /* another Fram wrote them, or they are damaged: told in the log */
    double_array load;    /* horizontal magnitude of its averaged ice load, every row [N] */
} report;

/* The vessel that is reported from now on, its load. */
fram_status report_choose_vessel(report *r, int32_t vessel, fram_error *error);
/* Its recorded peaks; none where they cannot be read, which peaks_unread tells then. */
fram_status report_peaks(report *r, peak_list *list, fram_error *error);
/* How the report calls it: "the vessel" or "vessel NAME". */
vessel_title report_vessel(const report *r);
/* A heading, with the vessel's name where there are names. */
void report_vessel_section(report *r, const char *title);
/* The unit of its largest load. */
load_unit report_load_unit(const report *r);

typedef struct report_line {
    const char *channel, *name;
} report_line;
/* A chart of channels over time; those that the run does not have are left out, and with them an empty chart. */
fram_status report_series(report *r, const char *title, const char *y_label, double factor, const report_line *lines,
                          int32_t count, bool wide, fram_error *error);
/* A chart of the vessel's way from its first place on, which it names: beside coordinates far from the origin a motion
   would not be seen. */
fram_status report_way(report *r, fram_error *error);

/* Statistics of a channel after the transient as a row: mean, deviation, least, greatest, significant. */
void report_statistics_heads(report *r, const char *first);
void report_statistics(report *r, const char *channel, const char *name, double factor);

/* A number as a person writes it: three digits, and all those before the point: one value reads the same in its tile
   and in the verdict, and tables of whole numbers have it too. */
enum { VALUE_DIGITS = 3 };
void report_number(double value, char out[32]);

/* The sections, in files of their own. */
fram_status report_verdict(report *r, fram_error *error);
fram_status report_loads(report *r, fram_error *error);
fram_status report_mechanisms(report *r, load_unit unit, fram_error *error);
fram_status report_field(report *r, fram_error *error);
fram_status report_fractures(report *r, fram_error *error);
fram_status report_books(report *r, fram_error *error);

#endif
