/* A run on one page for people: FOLDER/report.html, self-contained, without script; and two runs beside each other. */
#ifndef RESULTS_REPORT_H
#define RESULTS_REPORT_H

#include "io/csv_read.h"
#include "io/text_buffer.h"
#include "model/scenario.h"
#include "results/run_data.h"

/* Tells what follows from a scenario; given by the caller, since it takes the rooms that build a world. */
typedef void (*notes_function)(context *ctx, const scenario *s, text_buffer *out);
/* output NULL: FOLDER/report.html.  with_paths: the scenario in it tells where its files lie, not their names alone. */
fram_status report_write(context *ctx, const char *folder, const char *output, notes_function notes, bool with_paths,
                         fram_error *error);

/* One quantity of two runs. */
enum { COMPARE_NAME_SIZE = 112 };
typedef struct compare_row {
    char name[COMPARE_NAME_SIZE], unit[UNIT_SIZE];
    double a, b;   /* a NaN: the run does not have it */
    bool is_place; /* a coordinate, of which parts of another say nothing */
} compare_row;
enum { COMPARE_ROWS_MOST = 1280 }; /* of runs that share none of their vessels */
typedef struct compare_result {
    compare_row row[COMPARE_ROWS_MOST];
    int32_t count;
    bool same_scenario, same_state; /* by their hashes, of the files that a scenario names too; where a program told
                                       them the same things and not with the same end, not */
    bool only_files_differ;         /* the scenarios are the same but for those */
    bool changed_a, changed_b;      /* scenario.yaml, or by another Fram: run_data.is_changed */
    bool only_told_differs;         /* or may: what a program told one of them, or both */
    bool same_as_read;              /* not by the hashes of the runs, but as this program reads both */
    char told[2][RUN_TOLD_SIZE];    /* what a program told A and B in place of the scenario, "": nothing */
    bool no_time_shared;            /* one had ended by counted_from: nothing is of both */
    double counted_from;            /* statistics of both are from then on [s]; 0: each from after its transient */
} compare_result;
/* The numbers; output: also a page with the numbers and plots of both, NULL: none. */
fram_status compare_runs(context *ctx, const char *a, const char *b, const char *output, compare_result *result,
                         fram_error *error);

#endif
