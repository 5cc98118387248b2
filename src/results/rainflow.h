/* Rainflow counting (ASTM E1049-85, 5.4.4) and damage-equivalent ranges.  Knows numbers only. */
#ifndef RESULTS_RAINFLOW_H
#define RESULTS_RAINFLOW_H

#include "io/csv_read.h"

/* m of the T-N curves of chains (API RP 2SK). */
#define FATIGUE_CHAIN_SLOPE 3.0

typedef struct rain_cycle {
    double range, mean, count; /* count: 1, or 0.5 of a half cycle */
} rain_cycle;
typedef struct rain_cycles {
    ARRAY(rain_cycle) list; /* in the order in which they close */
} rain_cycles;

/* Cycles of the turning points of a series, the first and the last value among them.  Values that are no numbers are
   left out.  false: no memory. */
bool rainflow(context *ctx, const double *value, int32_t count, rain_cycles *out);
void rainflow_free(context *ctx, rain_cycles *c);

/* The range that does the damage of all cycles in `cycles` of its own, with the slope m of an S-N line (Miner 1945):
   (sum n range^m / cycles)^(1/m). */
double equivalent_range(const rain_cycles *c, double slope, double cycles);

#endif
