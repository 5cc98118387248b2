#include "results/limit_use.h"

#include "base/channel_statistics.h"

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

typedef struct limited {
    const double *time, *x, *y; /* y: NULL, or the other part of the vector */
} limited;

static double limited_size(const limited *of, int32_t row)
{
    return of->y ? sqrt(of->x[row] * of->x[row] + of->y[row] * of->y[row]) : fabs(of->x[row]);
}

/* When the stretch beyond the limit that holds a row began: by the run's own event, which a step without a row has too,
   or by the rows. */
static double beyond_since(const run_data *d, const limited *of, int32_t vessel, station_event lost, double limit,
                           int32_t row)
{
    while (row > 0 && limited_size(of, row - 1) > limit)
        row--;
    double event = run_event_until(d, vessel, lost, of->time[row]);
    bool inside = isfinite(event) && (row == 0 || time_is_after(event, of->time[row - 1]));
    return inside ? event : of->time[row];
}

limit_use limit_use_of(const run_data *d, int32_t vessel, const char *x_name, const char *y_name, double limit)
{
    station_event lost = y_name ? EVENT_POSITION_LOST : EVENT_HEADING_LOST;
    station_event regained = y_name ? EVENT_POSITION_REGAINED : EVENT_HEADING_REGAINED;
    limited of = {run_channel(d, "time"), run_vessel_channel(d, vessel, x_name),
                  y_name ? run_vessel_channel(d, vessel, y_name) : NULL};
    limit_use u = limit_between(d, vessel, lost, regained);
    u.since = HUGE_VAL;
    if (!of.time || !of.x) {
        u.unsure = u.unsure && !isfinite(u.first);
        return u;
    }
    int32_t first = run_first_row(d), rows = d->series.rows, beyond = 0;
    for (int32_t i = first; i < rows; i++) {
        double size = limited_size(&of, i);
        u.most = fmax(u.most, size);
        beyond += size > limit;
        if (size > limit)
            u.first = fmin(u.first, of.time[i]);
    }
    u.part = rows > first ? (double)beyond / (rows - first) : 0;
    u.unsure = u.unsure && !isfinite(u.first);
    if (first < rows && limited_size(&of, first) > limit)
        u.since = beyond_since(d, &of, vessel, lost, limit, first);
    if (time_is_after(u.since, d->s.run.transient))
        u.since = HUGE_VAL;
    return u;
}

const char *limit_use_between_rows(const run_data *d, double time)
{
    return time < run_recorded_from(d) ? "before the recording began" : "between two rows of the series";
}
