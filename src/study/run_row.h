/* The figures of one run of a study: a row of summary.csv, and one for each vessel of the run. */
#ifndef STUDY_RUN_ROW_H
#define STUDY_RUN_ROW_H

#include "base/context.h"
#include "io/text_buffer.h"
#include "model/scenario_vessel.h"

/* Every column once: name, unit.  Loads are the magnitude of the horizontal ice force on a vessel, averaged over
   output.averaging_window; statistics are of the time after run.transient; what a run does not have is a NaN.
   significant: mean of the highest third of the peaks.  share: part of the mean horizontal ice load, along it, that a
   mechanism makes; the shares of a run add up to 1 (model/mechanism.h has their order).  range_equivalent: of the
   largest tension of a line and of the load, the range that does the damage of all rainflow cycles with one cycle a
   second and the slope FATIGUE_CHAIN_SLOPE (results/rainflow.h).  Counts are of the whole run, its transient too:
   lines_parted with those that were let go, as the channel of this name, lines_broken without them; fractures: floes
   that split or broke in bending, without parts of a sheet that came loose. */
#define RUN_ROW_FIGURES(X)                \
    X(time, "s")                          \
    X(load_mean, "N")                     \
    X(load_deviation, "N")                \
    X(load_significant, "N")              \
    X(load_largest, "N")                  \
    X(force_x_mean, "N")                  \
    X(force_y_mean, "N")                  \
    X(offset_mean, "m")                   \
    X(offset_largest, "m")                \
    X(heading_deviation_largest, "deg")   \
    X(line_tension_significant, "N")      \
    X(line_tension_largest, "N")          \
    X(lines_parted, "1")                  \
    X(lines_broken, "1")                  \
    X(thruster_power_mean, "W")           \
    X(fractures, "1")                     \
    X(load_range_equivalent, "N")         \
    X(line_tension_range_equivalent, "N") \
    X(share_splitting, "1")               \
    X(share_bending, "1")                 \
    X(share_crushing, "1")                \
    X(share_chain, "1")                   \
    X(share_accumulation, "1")            \
    X(share_submersion, "1")              \
    X(share_impact, "1")                  \
    X(share_friction, "1")

#define RUN_ROW_NAME(name, unit) ROW_##name,
typedef enum run_figure { RUN_ROW_FIGURES(RUN_ROW_NAME) ROW_FIGURES } run_figure;
#undef RUN_ROW_NAME

/* A figure by its name, ROW_FIGURES when there is none; its name and unit as in summary.csv. */
run_figure run_figure_find(const char *name);
const char *run_figure_name(run_figure figure);
const char *run_figure_unit(run_figure figure);

enum { ROW_REASON = 512 };
typedef struct run_row {
    char vessel[VESSEL_NAME_MOST + 1]; /* that the figures are of; "" where vessels have no names, and of a failure */
    bool failed;
    char reason[ROW_REASON]; /* of a failure, on one line */
    char state_hash[17];
    double figure[ROW_FIGURES];
} run_row;
/* Of all vessels of a run, in their order; one row at least.  Free with array_free. */
typedef ARRAY(run_row) run_rows;

/* From the folder of a run that finished. */
fram_status run_rows_of(context *ctx, const char *folder, run_rows *out, fram_error *error);
/* Of a log that is looked at. */
enum { RUN_LOG_MOST = 1 << 20 };
/* What a program said last in its log, if that is why it ended; the folder of the study, which is no part of the
   reason, is left out.  false: it said nothing. */
bool run_log_reason(context *ctx, const char *log, char out[ROW_REASON]);
/* Of a run that failed: from its run.json, or else from FOLDER.log, or else from its exit code. */
fram_status run_rows_failed(context *ctx, const char *folder, int exit_code, run_rows *out, fram_error *error);
/* The row of a vessel; NULL: the first.  A failure has one row, whoever is asked for.  NULL: there is no such vessel.
 */
const run_row *run_rows_find(const run_rows *rows, const char *vessel);

/* Whether two runs and more, with seeds of their own, came out the same: chance had no part in what acted on them. */
bool run_rows_alike(const run_row *rows, int32_t count);

/* To and from a small file, so that a run is judged once; what it holds, and its most bytes.  Only rows that are whole
   are there, and to be freed.  FRAM_ERROR_INPUT where there is something else than a file. */
enum { ROW_FILE_LIMIT = 1 << 16 };
typedef enum row_file {
    ROWS_NONE = 0, /* there is no file */
    ROWS_CUT,      /* it was not written whole */
    ROWS_OTHER,    /* of another Fram, with other columns or such that mean something else */
    ROWS_WHOLE
} row_file;
void run_rows_text(context *ctx, const run_rows *rows, text_buffer *out);
fram_status run_rows_write(context *ctx, const char *path, const run_rows *rows, fram_error *error);
fram_status run_rows_read(context *ctx, const char *path, run_rows *rows, row_file *found, fram_error *error);

/* The end of a line of summary.csv, and of its heads: ",status,FIGURES,state_hash,reason". */
void run_row_heads(context *ctx, text_buffer *out);
void run_row_line(context *ctx, const run_row *row, text_buffer *out);

#endif
