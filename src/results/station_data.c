/* What station.json and station.png tell, from the columns of series.csv. */
#include "results/station_parts.h"

#include "model/scenario_vessel.h"
#include "results/run_data.h"

#include <math.h>
#include <stdio.h>

static const char *const fixed_names[FIXED] = {"time",
                                               "offset_x",
                                               "offset_y",
                                               "heading_deviation",
                                               "ice_force_averaged_x",
                                               "ice_force_averaged_y",
                                               "thruster_power",
                                               "thrusters_saturated",
                                               "line_tension_max"};

const scenario_station *station_limits(const station_data *d)
{
    return &scenario_vessel_entry(d->s, d->vessel).keys->station;
}

void station_data_free(context *ctx, station_data *d)
{
    for (int i = 0; i < MOST_CHANNELS; i++)
        array_free(ctx, &d->column[i]);
    array_free(ctx, &d->offset);
    array_free(ctx, &d->load);
}

/* The lines and thrusters of the vessel. */
static void find_equipment(station_data *d)
{
    const line_table *lines = d->outcome->lines;
    const thruster_table *thrusters = d->outcome->thrusters;
    for (int32_t i = 0; i < lines->count && d->lines < MOST_EACH; i++)
        if (lines->vessel[i] == d->vessel)
            d->line[d->lines++] = i;
    for (int32_t i = 0; i < thrusters->count && d->thrusters < MOST_EACH; i++)
        if (thrusters->vessel[i] == d->vessel)
            d->thruster[d->thrusters++] = i;
}

static fram_status read_series(context *ctx, station_data *d, const char *folder, fram_error *error)
{
    char path[PATH_ROOM];
    vessel_channel name[MOST_CHANNELS];
    const char *names[MOST_CHANNELS];
    if (path_join(folder, "series.csv", path, error) != FRAM_OK)
        return FRAM_ERROR_INPUT;
    find_equipment(d);
    int count = FIXED + d->lines + d->thrusters;
    for (int i = 0; i < count; i++) {
        char own[40];
        int32_t line = i - FIXED, thruster = line - d->lines;
        bool of_line = thruster < 0;
        snprintf(own, sizeof own, of_line ? "line_%d_tension" : "thruster_%d_thrust",
                 (int)(of_line ? line + 1 : thruster + 1));
        name[i] = vessel_channel_name(d->s, d->vessel, i < FIXED ? fixed_names[i] : own);
        names[i] = i == TIME ? "time" : name[i].text;
    }
    fram_status status = csv_read(ctx, path, names, count, d->column, error);
    d->rows = d->column[TIME].count;
    for (int32_t i = 0; i < d->rows && status == FRAM_OK; i++) {
        double x = d->column[OFFSET_X].data[i], y = d->column[OFFSET_Y].data[i];
        double fx = d->column[LOAD_X].data[i], fy = d->column[LOAD_Y].data[i];
        if (!array_push(ctx, &d->offset, sqrt(x * x + y * y)) || !array_push(ctx, &d->load, sqrt(fx * fx + fy * fy)))
            status = error_memory(error);
    }
    return status;
}

fram_status station_data_read(context *ctx, const scenario *s, int32_t vessel, const station_outcome *o,
                              const char *folder, const char *ending, station_data *d, char path[PATH_ROOM],
                              fram_error *error)
{
    *d = (station_data){.s = s, .vessel = vessel, .outcome = o};
    fram_status status = read_series(ctx, d, folder, error);
    if (status == FRAM_OK)
        status = path_own(folder, vessel_file_name(s, vessel, "station", ending).text, path, error);
    return status;
}

channel_statistics station_statistics(const station_data *d, const double_array *of, double transient)
{
    return channel_statistics_of(d->column[TIME].data, of->data, d->rows, transient);
}

int32_t station_first_row(const station_data *d, double transient)
{
    return first_time_after(d->column[TIME].data, d->rows, transient);
}

double station_exceedance(const station_data *d, const double_array *of, double limit, double transient)
{
    int32_t beyond = 0, first = station_first_row(d, transient), all = d->rows - first;
    for (int32_t i = first; i < d->rows; i++)
        beyond += fabs(of->data[i]) > limit;
    return all > 0 ? (double)beyond / all : (double)NAN;
}

/* What the first row of a series is of began an interval before it: a program may have begun to record late. */
static double first_row_since(const station_data *d)
{
    return d->column[TIME].data[0] - scenario_steps_of_row(d->s) * d->s->run.time_step;
}

double station_energy(const station_data *d, double transient)
{
    double sum = 0, since = transient;
    const double *t = d->column[TIME].data, *p = d->column[POWER].data;
    int32_t first = station_first_row(d, transient);
    if (first == 0 && d->rows > 0)
        since = fmax(transient, first_row_since(d));
    for (int32_t i = first; i < d->rows; since = t[i++])
        sum += p[i] * (t[i] - since);
    if (first == d->rows)
        return (double)NAN;
    /* Where output.csv_interval leaves rows out a run goes on behind the last one. */
    return sum + p[d->rows - 1] * fmax(d->outcome->time - since, 0);
}

int32_t station_lines_gone(const station_data *d)
{
    int32_t gone = 0;
    for (int32_t i = 0; i < d->lines; i++)
        gone += d->outcome->lines->broken[d->line[i]] != 0;
    return gone;
}

void station_tell_event(const station_data *d, int32_t row, char *out, size_t size)
{
    const event_table *events = d->outcome->events;
    bool of_two = event_is_of_two((station_event)events->kind[row]);
    event_text(events, row, of_two ? scenario_vessel_name(d->s, events->number[row]) : NULL,
               scenario_vessel_entry(d->s, events->vessel[row]).keys->approach.look_ahead, out, size);
}
