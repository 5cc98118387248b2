#include "results/limit_use.h"

#include <math.h>

/* What the run's own events tell of the steps that the series leaves out, or that came before it.  What was lost before
   the transient ended is regained within 0.9 of the limit only: it may have been within the limit since. */
static limit_use limit_between(const run_data *d, int32_t vessel, station_event lost, station_event regained)
{
    double from = d->s.run.transient;
    if (!run_leaves_out_steps(d) && !(run_recorded_from(d) > from))
        return (limit_use){.first = HUGE_VAL};
    return (limit_use){.first = run_event_from(d, vessel, lost, from),
                       .unsure = run_lacks_events(d) || run_event_goes_on(d, vessel, lost, regained, from)};
}

limit_use limit_use_of(const run_data *d, int32_t vessel, const char *x_name, const char *y_name, double limit)
{
    const double *time = run_channel(d, "time"), *x = run_vessel_channel(d, vessel, x_name);
    const double *y = y_name ? run_vessel_channel(d, vessel, y_name) : NULL;
    limit_use u = y_name ? limit_between(d, vessel, EVENT_POSITION_LOST, EVENT_POSITION_REGAINED)
                         : limit_between(d, vessel, EVENT_HEADING_LOST, EVENT_HEADING_REGAINED);
    int32_t first = run_first_row(d), rows = d->series.rows, beyond = 0;
    for (int32_t i = first; time && x && i < rows; i++) {
        double size = y ? sqrt(x[i] * x[i] + y[i] * y[i]) : fabs(x[i]);
        u.most = fmax(u.most, size);
        beyond += size > limit;
        if (size > limit)
            u.first = fmin(u.first, time[i]);
    }
    u.part = rows > first ? (double)beyond / (rows - first) : 0;
    u.unsure = u.unsure && !isfinite(u.first);
    return u;
}

const char *limit_use_between_rows(const run_data *d, double time)
{
    return time < run_recorded_from(d) ? "before the recording began" : "between two rows of the series";
}
