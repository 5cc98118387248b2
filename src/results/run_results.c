#include "results/run_results.h"

#include "io/chart.h"
#include "io/csv_read.h"
#include "io/path.h"
#include "results/station_results.h"

#include <stdio.h>

enum { CHART_WIDTH = 1280, CHART_HEIGHT = 560 };

static double mean_after(const double_array *time, const double_array *value, double transient)
{
    double sum = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < value->count; i++) {
        if (time->data[i] < transient)
            continue;
        sum += value->data[i];
        n++;
    }
    return n > 0 ? sum / n : 0;
}

static fram_status draw_loads(context *ctx, const scenario *s, const char *folder, fram_error *error)
{
    static const char *const names[] = {"time", "ice_force_body_x", "ice_force_body_y", "ice_force_averaged_x",
                                        "ice_force_averaged_y"};
    enum { TIME, RAW_X, RAW_Y, MEAN_X, MEAN_Y, COUNT };
    char from[PATH_ROOM], to[PATH_ROOM];
    if (path_join(folder, "series.csv", from, error) != FRAM_OK || path_join(folder, "loads.png", to, error) != FRAM_OK)
        return FRAM_ERROR_INPUT;
    double_array column[COUNT] = {0};
    fram_status status = csv_read(ctx, from, names, COUNT, column, error);
    if (status == FRAM_OK) {
        double mean = mean_after(&column[TIME], &column[RAW_X], s->run.transient);
        for (int k = RAW_X; k < COUNT; k++) {
            for (int32_t i = 0; i < column[k].count; i++)
                column[k].data[i] *= 1e-3;
        }
        int32_t rows = column[TIME].count;
        const chart_line lines[] = {
            chart_line_make("along the vessel, each step", column[TIME].data, column[RAW_X].data, rows, false),
            chart_line_make("along X, averaged", column[TIME].data, column[MEAN_X].data, rows, true),
            chart_line_make("along Y, averaged", column[TIME].data, column[MEAN_Y].data, rows, true),
        };
        char subtitle[256];
        snprintf(
            subtitle, sizeof subtitle,
            "averaged over %.3g s; mean along the vessel (x forward) %.4g kN after %g s; a resisting load is negative",
            s->output.averaging_window, mean * 1e-3, s->run.transient);
        chart c = chart_make("Ice load on the vessel", subtitle, "time [s]", "force [kN]", lines, 3);
        status = chart_write(ctx, &c, to, CHART_WIDTH, CHART_HEIGHT, error);
    }
    for (int k = 0; k < COUNT; k++)
        array_free(ctx, &column[k]);
    return status;
}

/* A picture that this build cannot draw is no failure of the run. */
static fram_status drawn(context *ctx, const char *name, fram_status status, const fram_error *reason,
                         fram_error *error)
{
    if (status == FRAM_ERROR_UNSUPPORTED) {
        log_write(ctx, LOG_WARNING, "%s is skipped: %s", name, reason->message);
        return FRAM_OK;
    }
    if (status != FRAM_OK && error)
        *error = *reason;
    return status;
}

fram_status run_results_write(context *ctx, const scenario *s, const station_outcome *station, const char *folder,
                              fram_error *error)
{
    fram_error reason = {0};
    fram_status status = FRAM_OK;
    if (s->vessel.present)
        status = drawn(ctx, "loads.png", draw_loads(ctx, s, folder, &reason), &reason, error);
    if (status != FRAM_OK || !station_has_results(s))
        return status;
    status = station_results_write(ctx, s, station, folder, error);
    if (status != FRAM_OK)
        return status;
    return drawn(ctx, "station.png", station_page_write(ctx, s, station, folder, &reason), &reason, error);
}
