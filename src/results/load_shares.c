#include "results/load_shares.h"

#include "base/channel_statistics.h"

#include <assert.h>

bool load_shares(const run_data *run, const double *const *x, const double *const *y, int32_t parts, double *share)
{
    const double *time = run_channel(run, "time");
    double mean_x[LOAD_PARTS_MOST] = {0}, mean_y[LOAD_PARTS_MOST] = {0}, all_x = 0, all_y = 0;
    assert(parts <= LOAD_PARTS_MOST);
    for (int32_t k = 0; k < parts && time; k++) {
        mean_x[k] = channel_statistics_of(time, x[k], run->series.rows, run->s.run.transient).mean;
        mean_y[k] = channel_statistics_of(time, y[k], run->series.rows, run->s.run.transient).mean;
        all_x += mean_x[k];
        all_y += mean_y[k];
    }
    double square = all_x * all_x + all_y * all_y;
    /* Nothing of a load that points backwards is 0, not -0. */
    for (int32_t k = 0; k < parts; k++)
        share[k] = square > 0 ? (mean_x[k] * all_x + mean_y[k] * all_y) / square + 0.0 : 0;
    return square > 0;
}
