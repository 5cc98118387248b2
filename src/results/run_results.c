#include "results/run_results.h"

#include "base/channel_statistics.h"
#include "base/load_unit.h"
#include "io/chart.h"
#include "io/csv_read.h"
#include "io/file.h"
#include "io/image.h"
#include "io/path.h"
#include "model/scenario_vessel.h"
#include "results/load_statistics.h"
#include "results/peaks.h"
#include "results/station_results.h"

#include <math.h>
#include <stdio.h>

enum { CHART_WIDTH = 1280, CHART_HEIGHT = 560 };

/* NAN without a row after it. */
static double mean_after(const double_array *time, const double_array *value, double transient)
{
    double sum = 0;
    int32_t first = first_time_after(time->data, value->count, transient);
    for (int32_t i = first; i < value->count; i++)
        sum += value->data[i];
    return first < value->count ? sum / (value->count - first) : (double)NAN;
}

enum { TIMES, RAW_X, RAW_Y, MEAN_X, MEAN_Y, CHANNELS };

static fram_status read_loads(context *ctx, const scenario *s, int32_t vessel, const char *folder,
                              double_array column[CHANNELS], fram_error *error)
{
    static const char *const of_vessel[CHANNELS] = {
        [RAW_X] = "ice_force_body_x",
        [RAW_Y] = "ice_force_body_y",
        [MEAN_X] = "ice_force_averaged_x",
        [MEAN_Y] = "ice_force_averaged_y",
    };
    char path[PATH_ROOM];
    vessel_channel full[CHANNELS];
    const char *names[CHANNELS] = {[TIMES] = "time"};
    for (int k = RAW_X; k < CHANNELS; k++) {
        full[k] = vessel_channel_name(s, vessel, of_vessel[k]);
        names[k] = full[k].text;
    }
    fram_status status = path_join(folder, "series.csv", path, error);
    return status == FRAM_OK ? csv_read(ctx, path, names, CHANNELS, column, error) : status;
}

/* Peaks are those of every step after the transient, rows may leave out steps.  A file that cannot be read proves
   nothing. */
static bool may_have_peak(context *ctx, const char *folder, int32_t vessel)
{
    peak_list list;
    bool may = peak_list_read(ctx, folder, vessel, &list, NULL) != FRAM_OK || list.count > 0;
    peak_list_free(ctx, &list);
    return may;
}

/* What shows ship and ice: a build without cairo drew no picture. */
static const char *where_seen(const char *folder)
{
    char path[PATH_ROOM];
    bool there = path_join(folder, "plan.png", path, NULL) == FRAM_OK && file_is_readable(path);
    return there ? "plan.png" : "`fram view`";
}

/* Loads that stay 0 are told where somebody may look for them. */
static void tell_without_ice(context *ctx, const scenario *s, int32_t vessel, const char *folder,
                             const double_array column[CHANNELS])
{
    vessel_entry entry = scenario_vessel_entry(s, vessel);
    int32_t rows = column[TIMES].count;
    for (int k = RAW_X; k < CHANNELS; k++)
        for (int32_t i = 0; i < rows; i++)
            if (column[k].data[i] != 0)
                return;
    if (rows > 0 && s->ice.source != ICE_NONE && !may_have_peak(ctx, folder, vessel))
        log_write(ctx, LOG_WARNING, "%s met no ice until t = %.10g s: %s shows where both are",
                  vessel_title_of(&entry).text, column[TIMES].data[rows - 1], where_seen(folder));
}

/* All of them, in the unit of the largest one, which is returned. */
static load_unit scale_loads(double_array column[CHANNELS])
{
    double most = 0;
    for (int k = RAW_X; k < CHANNELS; k++)
        for (int32_t i = 0; i < column[k].count; i++)
            most = fmax(most, fabs(column[k].data[i]));
    const load_unit unit = load_unit_for(most);
    for (int k = RAW_X; k < CHANNELS; k++)
        for (int32_t i = 0; i < column[k].count; i++)
            column[k].data[i] *= unit.factor;
    return unit;
}

static fram_status draw_loads(context *ctx, const scenario *s, int32_t vessel, const char *folder, fram_error *error)
{
    char to[PATH_ROOM];
    vessel_entry entry = scenario_vessel_entry(s, vessel);
    if (path_own(folder, vessel_file_name(s, vessel, "loads", ".png").text, to, error) != FRAM_OK)
        return FRAM_ERROR_INPUT;
    double_array column[CHANNELS] = {0};
    fram_status status = read_loads(ctx, s, vessel, folder, column, error);
    if (status == FRAM_OK) {
        tell_without_ice(ctx, s, vessel, folder, column);
        double mean = mean_after(&column[TIMES], &column[RAW_X], s->run.transient);
        load_unit unit = scale_loads(column);
        int32_t rows = column[TIMES].count;
        const double *const averaged[] = {column[MEAN_X].data, column[MEAN_Y].data};
        static const char *const beyond[] = {[LOAD_CUT_NONE] = "",
                                             [LOAD_CUT_SOME] = "; some lie beyond the picture",
                                             [LOAD_CUT_LARGEST] = ", beyond the picture"};
        load_cut cut;
        double axis[2], spike = load_spikes_cut(column[RAW_X].data, averaged, 2, rows, &cut, axis);
        const chart_line lines[] = {
            chart_line_make("along the vessel, each step", column[TIMES].data, column[RAW_X].data, rows, false),
            chart_line_make("along X, averaged", column[TIMES].data, column[MEAN_X].data, rows, true),
            chart_line_make("along Y, averaged", column[TIMES].data, column[MEAN_Y].data, rows, true),
        };
        char title[80], of_mean[96], subtitle[256], force[24];
        snprintf(force, sizeof force, "force [%s]", unit.name);
        snprintf(title, sizeof title, "Ice load on %s", vessel_title_of(&entry).text);
        if (isfinite(mean))
            snprintf(of_mean, sizeof of_mean, "mean along the vessel (x forward) %s after %g s, negative: it resists",
                     load_text_of(mean, 4).text, s->run.transient);
        else
            snprintf(of_mean, sizeof of_mean, "no mean: the transient of %g s has not ended", s->run.transient);
        snprintf(subtitle, sizeof subtitle, "averaged over %.3g s; %s; single steps reach %s%s",
                 scenario_averaging_window(s), of_mean, load_text_of(spike / unit.factor, 4).text, beyond[cut]);
        chart c = chart_make(title, subtitle, "time [s]", force, lines, 3);
        c.y_from = axis[0], c.y_to = axis[1];
        status = chart_write(ctx, &c, to, CHART_WIDTH, CHART_HEIGHT, error);
    }
    for (int k = 0; k < CHANNELS; k++)
        array_free(ctx, &column[k]);
    return status;
}

static fram_status write_station(context *ctx, const scenario *s, int32_t vessel, const station_outcome *station,
                                 const char *folder, fram_error *error)
{
    fram_error reason = {0};
    if (!station_has_results(s, vessel))
        return FRAM_OK;
    fram_status status = station_results_write(ctx, s, vessel, station, folder, error);
    if (status != FRAM_OK)
        return status;
    vessel_file name = vessel_file_name(s, vessel, "station", ".png");
    status = station_page_write(ctx, s, vessel, station, folder, &reason);
    return image_or_skip(ctx, name.text, status, &reason, error);
}

fram_status run_results_write(context *ctx, const scenario *s, const station_outcome *station, const char *folder,
                              fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t v = 0; v < scenario_vessel_count(s) && status == FRAM_OK; v++) {
        fram_error reason = {0};
        vessel_file name = vessel_file_name(s, v, "loads", ".png");
        status = image_or_skip(ctx, name.text, draw_loads(ctx, s, v, folder, &reason), &reason, error);
        if (status == FRAM_OK)
            status = write_station(ctx, s, v, station, folder, error);
    }
    return status;
}
