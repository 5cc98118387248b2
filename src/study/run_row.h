/* The figures of one run of a study: a row of summary.csv. */
#ifndef STUDY_RUN_ROW_H
#define STUDY_RUN_ROW_H

#include "base/context.h"
#include "io/text_buffer.h"

/* Every column once: name, unit.  Loads are the magnitude of the horizontal ice force on the vessel, averaged over
   output.averaging_window; statistics are of the time after run.transient; what a run does not have is a NaN.
   significant: mean of the highest third of the peaks. */
#define RUN_ROW_FIGURES(X)              \
    X(time, "s")                        \
    X(load_mean, "N")                   \
    X(load_deviation, "N")              \
    X(load_significant, "N")            \
    X(load_largest, "N")                \
    X(force_x_mean, "N")                \
    X(force_y_mean, "N")                \
    X(offset_mean, "m")                 \
    X(offset_largest, "m")              \
    X(heading_deviation_largest, "deg") \
    X(line_tension_significant, "N")    \
    X(line_tension_largest, "N")        \
    X(lines_parted, "1")                \
    X(thruster_power_mean, "W")         \
    X(fractures, "1")

#define RUN_ROW_NAME(name, unit) ROW_##name,
typedef enum run_figure { RUN_ROW_FIGURES(RUN_ROW_NAME) ROW_FIGURES } run_figure;
#undef RUN_ROW_NAME

enum { ROW_REASON = 256 };
typedef struct run_row {
    bool failed;
    char reason[ROW_REASON]; /* of a failure, on one line */
    char state_hash[17];
    double figure[ROW_FIGURES];
} run_row;

/* From the folder of a run that finished. */
fram_status run_row_of(context *ctx, const char *folder, run_row *out, fram_error *error);
/* Of a run that failed: from its run.json, or else from its exit code. */
void run_row_failed(context *ctx, const char *folder, int exit_code, run_row *out);

/* To and from a small file, so that a run is judged once. found is false when there is none, or one that was not
   written whole by this version. */
fram_status run_row_write(context *ctx, const char *path, const run_row *row, fram_error *error);
fram_status run_row_read(context *ctx, const char *path, run_row *row, bool *found, fram_error *error);

/* The end of a line of summary.csv, and of its heads: ",status,FIGURES,state_hash,reason". */
void run_row_heads(context *ctx, text_buffer *out);
void run_row_line(context *ctx, const run_row *row, text_buffer *out);

#endif
