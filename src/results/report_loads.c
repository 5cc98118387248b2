/* The report's sections on loads and on keeping station. */
#include "results/report_parts.h"

#include "base/channel_statistics.h"
#include "io/file.h"
#include "io/png_check.h"
#include "results/station_results.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

static double step_of(const report *r)
{
    const double *time = run_channel(&r->d, "time");
    int32_t rows = r->d.series.rows;
    return rows > 1 ? (time[rows - 1] - time[0]) / (rows - 1) : r->d.s.run.time_step;
}

/* Of few independent values the lower bound falls by decades where nothing was met: an axis that shows it flattens the
   curve.  What lies under a tenth of the least part of the time goes to the axis's end. */
static void cut_low_bound(load_distribution *d)
{
    double least = 1;
    for (int32_t i = 0; i < d->exceeded.count; i++)
        least = d->exceeded.data[i] > 0 ? fmin(least, d->exceeded.data[i]) : least;
    for (int32_t i = 0; i < d->low.count; i++)
        d->low.data[i] = d->low.data[i] < 0.1 * least ? 0 : d->low.data[i];
}

static fram_status draw_distribution(report *r, load_distribution *d, load_unit unit, fram_error *error)
{
    char x_label[64], worth[LOAD_WORTH_SIZE], subtitle[LOAD_WORTH_SIZE + 16];
    double *scaled[2] = {d->level.data, d->bar.data};
    for (int32_t i = 0; i < d->level.count; i++)
        scaled[0][i] *= unit.factor;
    for (int32_t i = 0; i < d->bar.count; i++)
        scaled[1][i] *= unit.factor;
    for (int32_t i = 0; i < d->density.count; i++)
        d->density.data[i] *= 100;
    snprintf(x_label, sizeof x_label, "horizontal ice load, averaged [%s]", unit.name);
    chart_line bars = chart_line_make("", d->bar.data, d->density.data, d->bar.count, false);
    bars.style = CHART_BARS;
    bars.colour = 2;
    chart histogram = chart_make("Histogram of the load", "", x_label, "share of the time [%]", &bars, 1);
    cut_low_bound(d);
    chart_line lines[2] = {chart_line_make("95 % confidence", d->level.data, d->low.data, d->level.count, false),
                           chart_line_make("exceedance", d->level.data, d->exceeded.data, d->level.count, true)};
    lines[0].style = CHART_BAND;
    lines[0].y2 = d->high.data;
    lines[0].colour = lines[1].colour = 2;
    load_distribution_tell(d, true, worth);
    snprintf(subtitle, sizeof subtitle, "equivalent to %s", worth);
    chart exceedance = chart_make("Exceedance of the load", subtitle, x_label, "share of the time", lines, 2);
    exceedance.log_y = true;
    fram_status status = html_chart(&r->page, &histogram, false, error);
    return status == FRAM_OK ? html_chart(&r->page, &exceedance, false, error) : status;
}

static fram_status distribution(report *r, load_unit unit, fram_error *error)
{
    int32_t first = run_first_row(&r->d);
    load_distribution d;
    double most = 0;
    for (int32_t i = first; i < r->load.count; i++)
        most = fmax(most, r->load.data[i]);
    if (!(most > 0)) /* of no load there is no distribution */
        return FRAM_OK;
    if (!load_distribution_of(r->ctx, r->load.data + first, r->load.count - first, step_of(r),
                              scenario_averaging_window(&r->d.s), &d)) {
        load_distribution_free(r->ctx, &d);
        return error_memory(error);
    }
    fram_status status = draw_distribution(r, &d, unit, error);
    load_distribution_free(r->ctx, &d);
    return status;
}

/* Whether the mean load lies more along Y than along X. */
static bool lies_along_y(const report *r)
{
    const double *time = run_channel(&r->d, "time");
    double mean[2] = {0, 0};
    for (int k = 0; k < 2 && time; k++) {
        const double *load = run_vessel_channel(&r->d, r->vessel, k ? "ice_force_averaged_y" : "ice_force_averaged_x");
        if (load)
            mean[k] = channel_statistics_of(time, load, r->d.series.rows, r->d.s.run.transient).mean;
    }
    return fabs(mean[1]) > fabs(mean[0]);
}

/* A vector's part along X, and along Y where that is asked for too. */
static void axis_rows(report *r, const char *channel, const char *name, bool along_y, double factor)
{
    for (int k = 0; k < 1 + along_y; k++) {
        char full[COLUMN_NAME_SIZE], title[64];
        snprintf(full, sizeof full, "%s_%c", channel, 'x' + k);
        snprintf(title, sizeof title, "%s, along %c", name, 'X' + k);
        report_statistics(r, full, title, factor);
    }
}

static void load_table(report *r, load_unit unit)
{
    static const report_line body[] = {{"ice_force_body_x", "each step, along the vessel"},
                                       {"ice_force_body_y", "each step, across the vessel"},
                                       {"ice_force_body_z", "each step, upwards"}};
    static const report_line parts[] = {{"ice_force_bow", "bow"},
                                        {"ice_force_shoulder", "shoulder"},
                                        {"ice_force_midbody", "midbody"},
                                        {"ice_force_stern", "stern"},
                                        {"ice_force_bottom", "bottom"},
                                        {"ice_force_capped", "crushing"},
                                        {"ice_force_below_cap", "below the limit"},
                                        {"ice_force_friction", "friction"}};
    char head[64];
    bool along_y = lies_along_y(r);
    snprintf(head, sizeof head, "load on %s [%s]", report_vessel(r).text, unit.name);
    report_statistics_heads(r, head);
    axis_rows(r, "ice_force_averaged", "averaged", true, unit.factor);
    for (size_t i = 0; i < sizeof body / sizeof *body; i++)
        report_statistics(r, body[i].channel, body[i].name, unit.factor);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        axis_rows(r, parts[i].channel, parts[i].name, along_y, unit.factor);
    if (scenario_vessel_entry(&r->d.s, r->vessel).keys->mode != VESSEL_FREE) /* which has no carriage */
        axis_rows(r, "tow_force", "towing carriage", true, unit.factor);
    html_table_end(&r->page);
}

/* ---- keeping station ---- */

/* Of a link, which may lead to anybody's file, and of what is no picture, nothing goes into a page that others get. */
static bool picture_may_be_shown(const char *path, const char *png, size_t size)
{
    struct stat about;
    return lstat(path, &about) == 0 && S_ISREG(about.st_mode) && png_is_whole(png, size);
}

static void show_station(report *r, const char *png, size_t size)
{
    char shows[256];
    bool moored = scenario_vessel_entry(&r->d.s, r->vessel).keys->mooring.lines.count > 0;
    const char *caption =
        moored ? "Footprint, offsets, heading, loads and lines" : "Footprint, offsets, heading, loads and power";
    snprintf(shows, sizeof shows, "Station keeping of %s: %s of the run, whose numbers are in the tables above",
             report_vessel(r).text, caption);
    html_picture(&r->page, png, size, shows, caption);
}

static fram_status station_picture(report *r, fram_error *error)
{
    char path[PATH_ROOM], *png = NULL;
    size_t size = 0;
    vessel_file name = vessel_file_name(&r->d.s, r->vessel, "station", ".png");
    fram_status status = path_join(r->d.folder, name.text, path, error);
    if (status != FRAM_OK)
        return status;
    if (access(path, F_OK) != 0 && errno == ENOENT)
        return FRAM_OK;
    status = file_read(r->ctx, path, 64 << 20, &png, &size, error);
    bool shown = status == FRAM_OK && picture_may_be_shown(path, png, size);
    if (shown)
        show_station(r, png, size);
    else if (status == FRAM_OK)
        log_write(r->ctx, LOG_WARNING, "%s: expected a picture (PNG) that the run drew, found %s: it is left out", path,
                  size == 0 ? "an empty file" : "another file, or a link");
    memory_free(r->ctx, png);
    return status;
}

/* The largest size of what a channel has after the transient. */
static double largest_told(const report *r, const char *channel)
{
    const double *value = run_vessel_channel(&r->d, r->vessel, channel);
    double most = 0;
    for (int32_t i = run_first_row(&r->d); value && i < r->d.series.rows; i++)
        most = fmax(most, fabs(value[i]));
    return most;
}

static const report_line equipment_kinds[] = {{"line_%d_tension", "tension of line %d"},
                                              {"thruster_%d_thrust", "thrust of thruster %d"}};
enum { EQUIPMENT_KINDS = 2 };

/* The channel of a line or thruster; false where the run has none of this number. */
static bool equipment_channel(const report *r, int kind, int number, char channel[40])
{
    snprintf(channel, 40, equipment_kinds[kind].channel, number);
    return run_vessel_channel(&r->d, r->vessel, channel) != NULL;
}

static load_unit equipment_unit(const report *r)
{
    char channel[40];
    double most = fmax(largest_told(r, "mooring_force_x"), largest_told(r, "mooring_force_y"));
    for (int kind = 0; kind < EQUIPMENT_KINDS; kind++)
        for (int number = 1; equipment_channel(r, kind, number, channel); number++)
            most = fmax(most, largest_told(r, channel));
    return load_unit_for(most);
}

/* Lines and thrusters, by their numbers, as far as the run has channels of them. */
static void equipment(report *r, load_unit unit)
{
    char channel[40], name[40];
    for (int kind = 0; kind < EQUIPMENT_KINDS; kind++)
        for (int number = 1; equipment_channel(r, kind, number, channel); number++) {
            snprintf(name, sizeof name, equipment_kinds[kind].name, number);
            report_statistics(r, channel, name, unit.factor);
        }
}

static fram_status station(report *r, fram_error *error)
{
    char head[64];
    load_unit unit = equipment_unit(r);
    if (!station_has_results(&r->d.s, r->vessel))
        return FRAM_OK;
    report_vessel_section(r, "Station keeping");
    report_statistics_heads(r, "deviation from the set point");
    report_statistics(r, "offset_x", "along X [m]", 1);
    report_statistics(r, "offset_y", "along Y [m]", 1);
    report_statistics(r, "heading_deviation", "heading [deg]", 1);
    html_table_end(&r->page);
    snprintf(head, sizeof head, "lines and thrusters [%s]", unit.name);
    report_statistics_heads(r, head);
    report_statistics(r, "mooring_force_x", "mooring, along X", unit.factor);
    report_statistics(r, "mooring_force_y", "mooring, along Y", unit.factor);
    report_statistics(r, "line_tension_max", "largest line tension", unit.factor);
    equipment(r, unit);
    html_table_end(&r->page);
    return station_picture(r, error);
}

fram_status report_loads(report *r, fram_error *error)
{
    load_unit unit = report_load_unit(r);
    char label[32];
    snprintf(label, sizeof label, "force [%s]", unit.name);
    const report_line force[] = {{"ice_force_body_x", "along the vessel, each step"},
                                 {"ice_force_averaged_x", "along X, averaged"},
                                 {"ice_force_averaged_y", "along Y, averaged"}};
    const report_line tilt[] = {{"roll", "roll"}, {"pitch", "pitch"}};
    report_vessel_section(r, "Ice load");
    html_paragraph(
        &r->page,
        "Loads are forces of the ice on the vessel, in the global frame unless body axes are named. Averages are over "
        "%g s; statistics exclude the first %g s. A significant peak is the mean of the highest third of the "
        "peaks, on the side of zero where the largest value is.",
        scenario_averaging_window(&r->d.s), r->d.s.run.transient);
    html_grid_begin(&r->page);
    fram_status status = report_series(r, "Ice load over time", label, unit.factor, force, 3, true, error);
    if (status == FRAM_OK)
        status = distribution(r, unit, error);
    html_grid_end(&r->page);
    load_table(r, unit);
    if (status == FRAM_OK)
        status = report_mechanisms(r, unit, error);
    if (status == FRAM_OK)
        status = station(r, error);
    report_vessel_section(r, "Motion of the vessel");
    html_grid_begin(&r->page);
    if (status == FRAM_OK)
        status = report_way(r, error);
    /* Of a vessel whose motion is given they are zero but for rounding. */
    if (status == FRAM_OK && scenario_vessel_entry(&r->d.s, r->vessel).keys->mode == VESSEL_FREE)
        status = report_series(r, "Roll and pitch", "angle [deg]", 1, tilt, 2, false, error);
    html_grid_end(&r->page);
    return status;
}
