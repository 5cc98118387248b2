/* Whether what is computed again is the run: rows of its series.csv, and how it ended by its run.json.  A re-run knows
   the scenario; what a program told the world on the way stands in no file, and what another version of Fram or other
   input makes of it shows in the rows too.  Reads the run's folder. */
#ifndef SIM_RERUN_CHECK_H
#define SIM_RERUN_CHECK_H

#include "sim/series.h"

/* The rows that are still to come. */
typedef struct rerun_check {
    context *ctx;
    const char *folder;
    char *path;            /* of series.csv, for errors */
    int descriptor;        /* -1: nothing to compare with */
    uint64_t offset, size; /* of the file: what is read next, and its end */
    ARRAY(char) text;      /* a part of the file */
    int32_t used, line;    /* of the part; number of the row that comes next, from 1 */
    const char *row;       /* that comes next, ended by NUL; NULL: there is none */
    double time;           /* of it [s] */
    double same;           /* up to here rows are those of the run; negative: none was compared [s] */
    series_layout layout;
    ARRAY(double) value;
    bool told_mechanisms; /* that they are others in the run: once */
    int32_array column;   /* of the layout for each of the file, -1: not of this version, or never the same */
} rerun_check;

/* Without a series the log says so, and nothing is compared. folder stays where it is.  On failure c is empty. */
fram_status rerun_check_open(context *ctx, const char *folder, const scenario *s, rerun_check *c, fram_error *error);
void rerun_check_close(rerun_check *c);
/* After each step that was computed again: FRAM_ERROR_INPUT names the first channel of the row of this time, if there
   is one, that has another value in the run.  Where only parts of the load by mechanism have, the log says so once:
   what counts as which is no matter of the motion, and another Fram may tell it otherwise. */
fram_status rerun_check_step(rerun_check *c, const world *w, fram_error *error);
/* Whether a row is to come, and none at or after this time was compared: what was told before it shows in that row. */
bool rerun_check_awaits(const rerun_check *c, double time);
/* At the end of what is computed again, where rows ended before this time: FRAM_ERROR_INPUT when the run ended in
   another state; the log says where it ended elsewhere, and nothing tells. */
fram_status rerun_check_end(const rerun_check *c, const world *w, double time, fram_error *error);

/* Where the run stands: its end, the last good step of one that failed, or the last row of one that was cut short; 0:
   it has made no step; -1: nothing tells, as where there is no row yet [s]. */
fram_status rerun_run_end(context *ctx, const char *folder, double *time, fram_error *error);

#endif
