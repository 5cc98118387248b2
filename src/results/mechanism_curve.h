/* The ice load on a vessel over time, split by mechanism: what the playback page stacks.  Knows a run's series. */
#ifndef RESULTS_MECHANISM_CURVE_H
#define RESULTS_MECHANISM_CURVE_H

#include "model/mechanism.h"
#include "results/run_data.h"

/* The columns mechanism_NAME_x and _y of a vessel [N]. */
typedef struct mechanism_columns {
    const double *x[MECHANISM_COUNT], *y[MECHANISM_COUNT];
} mechanism_columns;
/* false: the run does not have them all. */
bool mechanism_columns_find(const run_data *run, int32_t vessel, mechanism_columns *c);

/* In each stretch of time the moment at which the averaged horizontal load was largest, and its parts along that load,
   which add up to it: so a curve of few points has every peak of the series, and has it whole. */
typedef struct mechanism_curve {
    int32_t count;                 /* stretches; 0: the run has no such columns */
    double *time, *load;           /* [s], [N] */
    double *part[MECHANISM_COUNT]; /* [N]; negative: against the load */
} mechanism_curve;

enum { MECHANISM_CURVE_MOST = 1200 };
/* The load is that of the column ice_force_averaged.  A series that leaves out steps (output.csv_interval) has the
   parts of its rows only: their shares are taken for those of the load. */
fram_status mechanism_curve_make(context *ctx, const run_data *run, int32_t vessel, mechanism_curve *curve,
                                 fram_error *error);
/* A peak of the run, which such a series may not have: into its place by time.  At most PEAKS_KEPT of them, on a curve
   that is not empty. */
void mechanism_curve_add(mechanism_curve *curve, double time, double load, const double part[MECHANISM_COUNT]);
void mechanism_curve_free(context *ctx, mechanism_curve *curve);

#endif
