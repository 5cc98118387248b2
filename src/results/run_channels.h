/* What is made of the channels of a run: sizes, their statistics, ranges of fatigue, and angles that go on. */
#ifndef RESULTS_RUN_CHANNELS_H
#define RESULTS_RUN_CHANNELS_H

#include "base/channel_statistics.h"
#include "results/run_data.h"

/* The size of a channel of a vessel, |x|, or with y of the vector of the two, sqrt(x^2 + y^2), in every row; nothing
   where the run lacks one of them.  out is filled anew.  false: no memory. */
bool run_size_channel(context *ctx, const run_data *d, int32_t vessel, const char *x, const char *y, double_array *out);
/* Statistics of that size after the transient; NaN without it.  false: no memory. */
bool run_size_statistics(context *ctx, const run_data *d, int32_t vessel, const char *x, const char *y,
                         channel_statistics *out);
/* The range that does the damage of a channel after the transient with a cycle a second, of chains
   (results/rainflow.h); NaN without a time between its values.  value: one a row, NULL for none.  false: no memory. */
bool run_equivalent_range(context *ctx, const run_data *d, const double *value, double *out);
/* Under this a number of the channel is what rounding leaves of a zero, told_beside's `least` in the channel's unit. */
double run_channel_least(const char *channel);
/* The same angle [deg], by as many turns more or less that it is next to the other one: 180.1 for -179.9 beside 179;
   as it is where one of them is no number. */
double angle_next_to(double other, double angle);

#endif
