#include "results/run_channels.h"

#include "base/number_text.h"
#include "results/rainflow.h"

#include <math.h>
#include <string.h>

bool run_size_channel(context *ctx, const run_data *d, int32_t vessel, const char *x, const char *y, double_array *out)
{
    const double *a = run_vessel_channel(d, vessel, x), *b = y ? run_vessel_channel(d, vessel, y) : NULL;
    array_clear(out);
    if (!a || (y && !b))
        return true;
    if (!array_resize(ctx, out, d->series.rows))
        return false;
    for (int32_t i = 0; i < out->count; i++)
        out->data[i] = b ? sqrt(a[i] * a[i] + b[i] * b[i]) : fabs(a[i]);
    return true;
}

bool run_size_statistics(context *ctx, const run_data *d, int32_t vessel, const char *x, const char *y,
                         channel_statistics *out)
{
    const double *time = run_channel(d, "time");
    double_array size = {0};
    bool good = run_size_channel(ctx, d, vessel, x, y, &size);
    *out = channel_statistics_of(time, size.data, time ? size.count : 0, d->s.run.transient);
    array_free(ctx, &size);
    return good;
}

bool run_equivalent_range(context *ctx, const run_data *d, const double *value, double *out)
{
    const double *time = run_channel(d, "time");
    int32_t first = run_first_row(d), rows = d->series.rows, count = rows - first;
    rain_cycles cycles = {0};
    *out = (double)NAN;
    if (!time || !value || count < 2)
        return true;
    /* Each value stands for a step, the last one too. */
    double seconds = (time[rows - 1] - time[first]) * count / (count - 1);
    bool good = rainflow(ctx, value + first, count, &cycles);
    if (good && seconds > 0)
        *out = equivalent_range(&cycles, FATIGUE_CHAIN_SLOPE, seconds);
    rainflow_free(ctx, &cycles);
    return good;
}

/* A solver's residual, overlaps and computing times have no parts that cancel: they may be as small as they like. */
double run_channel_least(const char *channel)
{
    static const char *const small[] = {"solver_residual", "overlap_mean", "overlap_max", "step_wall_time"};
    for (size_t i = 0; i < sizeof small / sizeof *small; i++)
        if (strcmp(channel, small[i]) == 0)
            return 0;
    return LEAST_TOLD;
}

double angle_next_to(double other, double angle)
{
    double turns = floor((other - angle) / 360 + 0.5);
    return isfinite(turns) ? angle + 360 * turns : angle;
}
