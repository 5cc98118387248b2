/* What the rows of a run's series are of, and what is refused where it has none, or not the channel.  One module with
   run_data. */
#include "results/run_data.h"

#include "base/channel_statistics.h"
#include "base/words.h"

#include <math.h>
#include <string.h>

int32_t run_first_row(const run_data *d)
{
    const double *time = run_channel(d, "time");
    int32_t first = 0;
    while (time && first < d->series.rows && !time_is_after(time[first], d->s.run.transient))
        first++;
    return first;
}

double run_recorded_from(const run_data *d)
{
    if (d->note.recorded_from >= 0)
        return d->note.recorded_from;
    /* An earlier version tells it by what was recorded first. */
    const double *time = run_channel(d, "time");
    double step = d->s.run.time_step, first = time && d->series.rows > 0 ? time[0] : 0;
    /* Recorded from its start a run has a frame of that.  Later ones come at multiples of their interval, as rows do.
     */
    if (d->frames > 0 && !(d->before.time > 1.5 * step))
        return 0;
    if (d->frames > 0)
        return first > 0 ? fmin(first, d->before.time) : d->before.time;
    return first > fmax(step, d->s.output.csv_interval) + 0.5 * step ? first : 0;
}

double run_ends_after_row(const run_data *d)
{
    const double *time = run_channel(d, "time");
    double last = time && d->series.rows > 0 ? time[d->series.rows - 1] : HUGE_VAL;
    return d->note.time > last + 0.5 * d->s.run.time_step ? last : HUGE_VAL;
}

bool run_leaves_out_steps(const run_data *d) { return floor(d->s.output.csv_interval / d->s.run.time_step + 0.5) > 1; }

fram_status run_data_refuse_empty(const run_data *d, fram_error *error)
{
    bool goes_on = strcmp(d->note.status, "finished") != 0 &&
                   d->s.run.duration + 0.5 * d->s.run.time_step >= d->s.output.csv_interval;
    if (strcmp(d->note.status, "failed") == 0)
        return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, NULL,
                         "the run's series has no rows: it failed before the first step that has one");
    if (goes_on)
        return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, NULL,
                         "the run's series has no rows: it has made no step yet that has one; `fram resume %.200s` "
                         "goes on with it",
                         d->folder);
    return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, NULL, "the run's series has no rows%s",
                     run_leaves_out_steps(d) ? "; give the scenario a shorter output.csv_interval"
                                             : ": it made no step");
}

fram_status run_refuse_channel(const run_data *d, const char *name, const char *also, fram_error *error)
{
    name_search near = name_search_begin(name);
    const char *inside = NULL;
    for (int32_t i = 0; i < d->series.columns.count; i++) {
        const char *other = d->series.columns.data[i].name;
        name_try(&near, other);
        if (!inside && strstr(other, name))
            inside = other;
    }
    if (also)
        name_try(&near, also);
    /* A part of a name, as `tension` of line_1_tension, is further from it than a third of its letters. */
    const char *meant = near.found ? near.found : inside;
    return error_set(error, FRAM_ERROR_INPUT, d->folder, 0, name,
                     "the run has no channel of this name; %s%s%s`fram plot %.200s` lists them all",
                     meant ? "did you mean " : "", meant ? meant : "", meant ? "? " : "", d->folder);
}
