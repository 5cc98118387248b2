#include "results/mechanism_curve.h"

#include "results/peaks.h"
#include "results/run_channels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool mechanism_columns_find(const run_data *run, int32_t vessel, mechanism_columns *c)
{
    bool there = true;
    for (int m = 0; m < MECHANISM_COUNT; m++) {
        char name[64];
        snprintf(name, sizeof name, "mechanism_%s_x", mechanism_name((ice_mechanism)m));
        c->x[m] = run_vessel_channel(run, vessel, name);
        name[strlen(name) - 1] = 'y';
        c->y[m] = run_vessel_channel(run, vessel, name);
        there = there && c->x[m] && c->y[m];
    }
    return there;
}

/* Shares of the load that the rows of the window up to this one tell, along it; nothing without a load in them. */
static void parts_at(const mechanism_columns *c, const double *time, int32_t row, double window, double load,
                     double part[MECHANISM_COUNT])
{
    double fx[MECHANISM_COUNT], fy[MECHANISM_COUNT], all_x = 0, all_y = 0, slack = 1e-6 * window;
    int32_t first = row;
    while (first > 0 && time[first - 1] > time[row] - window + slack)
        first--;
    for (int m = 0; m < MECHANISM_COUNT; m++) {
        fx[m] = fy[m] = 0;
        for (int32_t i = first; i <= row; i++) {
            fx[m] += c->x[m][i];
            fy[m] += c->y[m][i];
        }
        all_x += fx[m];
        all_y += fy[m];
    }
    double square = all_x * all_x + all_y * all_y;
    for (int m = 0; m < MECHANISM_COUNT; m++)
        part[m] = square > 0 ? load * (fx[m] * all_x + fy[m] * all_y) / square : 0;
}

static bool make_room(context *ctx, mechanism_curve *curve)
{
    size_t most = (size_t)curve->count + PEAKS_KEPT;
    bool good = true;
    curve->time = memory_array(ctx, most, sizeof *curve->time);
    curve->load = memory_array(ctx, most, sizeof *curve->load);
    for (int m = 0; m < MECHANISM_COUNT; m++) {
        curve->part[m] = memory_array(ctx, most, sizeof *curve->part[m]);
        good = good && curve->part[m];
    }
    return good && curve->time && curve->load;
}

/* The row of the largest averaged load among those of a stretch. */
static int32_t largest_row(const double *load, int32_t first, int32_t end)
{
    int32_t best = first;
    for (int32_t i = first; i < end; i++)
        best = load[i] > load[best] ? i : best;
    return best;
}

static void fill_curve(const run_data *run, const mechanism_columns *columns, const double *load, int32_t every,
                       mechanism_curve *curve)
{
    const double *time = run_channel(run, "time");
    double window = scenario_averaging_window(&run->s), part[MECHANISM_COUNT];
    int32_t rows = run->series.rows;
    for (int32_t k = 0; k < curve->count; k++) {
        int32_t end = (k + 1) * every < rows ? (k + 1) * every : rows, row = largest_row(load, k * every, end);
        curve->time[k] = time[row];
        curve->load[k] = load[row];
        parts_at(columns, time, row, window, load[row], part);
        for (int m = 0; m < MECHANISM_COUNT; m++)
            curve->part[m][k] = part[m];
    }
}

fram_status mechanism_curve_make(context *ctx, const run_data *run, int32_t vessel, mechanism_curve *curve,
                                 fram_error *error)
{
    int32_t rows = run->series.rows, every = (rows + MECHANISM_CURVE_MOST - 1) / MECHANISM_CURVE_MOST;
    mechanism_columns columns;
    double_array load = {0};
    *curve = (mechanism_curve){0};
    bool good = run_size_channel(ctx, run, vessel, "ice_force_averaged_x", "ice_force_averaged_y", &load);
    bool known = load.count > 0 && run_channel(run, "time") && mechanism_columns_find(run, vessel, &columns);
    if (good && known) {
        curve->count = (rows + every - 1) / every;
        good = make_room(ctx, curve);
        if (good)
            fill_curve(run, &columns, load.data, every, curve);
        else
            mechanism_curve_free(ctx, curve);
    }
    array_free(ctx, &load);
    return good ? FRAM_OK : error_memory(error);
}

void mechanism_curve_add(mechanism_curve *curve, double time, double load, const double part[MECHANISM_COUNT])
{
    int32_t at = 0;
    while (at < curve->count && curve->time[at] < time - 1e-9 * fabs(time))
        at++;
    bool new = at == curve->count || curve->time[at] > time + 1e-9 * fabs(time);
    for (int32_t k = new ? curve->count++ : at; k > at; k--) {
        curve->time[k] = curve->time[k - 1];
        curve->load[k] = curve->load[k - 1];
        for (int m = 0; m < MECHANISM_COUNT; m++)
            curve->part[m][k] = curve->part[m][k - 1];
    }
    curve->time[at] = time;
    curve->load[at] = load;
    for (int m = 0; m < MECHANISM_COUNT; m++)
        curve->part[m][at] = part[m];
}

void mechanism_curve_free(context *ctx, mechanism_curve *curve)
{
    memory_free(ctx, curve->time);
    memory_free(ctx, curve->load);
    for (int m = 0; m < MECHANISM_COUNT; m++)
        memory_free(ctx, curve->part[m]);
    *curve = (mechanism_curve){0};
}
