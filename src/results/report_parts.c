#include "results/report_parts.h"

#include "base/number_text.h"
#include "results/run_channels.h"

#include <math.h>
#include <stdio.h>

void report_number(double value, char out[32]) { snprintf(out, 32, "%s", plain_text_of(value, VALUE_DIGITS).text); }

fram_status report_choose_vessel(report *r, int32_t vessel, fram_error *error)
{
    r->vessel = vessel;
    bool good = run_size_channel(r->ctx, &r->d, vessel, "ice_force_averaged_x", "ice_force_averaged_y", &r->load);
    return good ? FRAM_OK : error_memory(error);
}

fram_status report_peaks(report *r, peak_list *list, fram_error *error)
{
    return peak_list_try(r->ctx, r->d.folder, r->vessel, "the report", &r->peaks_unread, list, error);
}

vessel_title report_vessel(const report *r)
{
    vessel_entry entry = scenario_vessel_entry(&r->d.s, r->vessel);
    return vessel_title_of(&entry);
}

void report_vessel_section(report *r, const char *title)
{
    char text[128];
    if (!scenario_names_vessels(&r->d.s)) {
        html_section(&r->page, title);
        return;
    }
    snprintf(text, sizeof text, "%s, %s", title, report_vessel(r).text);
    html_section(&r->page, text);
}

load_unit report_load_unit(const report *r)
{
    double most = 0;
    for (int32_t i = 0; i < r->load.count; i++)
        most = fmax(most, r->load.data[i]);
    return load_unit_for(most);
}

/* A channel of the vessel or of the world times a factor; NULL without the channel, and without memory: then the page
   fails as a whole. */
static double *report_scaled(report *r, const char *channel, double factor)
{
    const double *from = run_vessel_channel(&r->d, r->vessel, channel);
    int32_t rows = r->d.series.rows;
    if (!from || rows < 1)
        return NULL;
    double *to = memory_array(r->ctx, (size_t)rows, sizeof *to);
    if (!to || !array_push(r->ctx, &r->kept, to)) {
        memory_free(r->ctx, to);
        r->page.text.failed = true; /* a page that lacks a chart without saying so is worse than none */
        return NULL;
    }
    for (int32_t i = 0; i < rows; i++)
        to[i] = from[i] * factor;
    return to;
}

enum { LINES_MOST = 5 };

fram_status report_series(report *r, const char *title, const char *y_label, double factor, const report_line *lines,
                          int32_t count, bool wide, fram_error *error)
{
    chart_line drawn[LINES_MOST];
    int32_t n = 0;
    for (int32_t i = 0; i < count && i < LINES_MOST; i++) {
        const double *y = report_scaled(r, lines[i].channel, factor);
        if (!y)
            continue;
        drawn[n] = chart_line_make(lines[i].name, run_channel(&r->d, "time"), y, r->d.series.rows, wide && i > 0);
        drawn[n].colour = wide && i == 0 && count > 1 ? 1 : n + (wide && count > 1 ? 1 : 2);
        n++;
    }
    if (n == 0)
        return FRAM_OK;
    chart c = chart_make(title, "", "time [s]", y_label, drawn, n);
    return html_chart(&r->page, &c, wide, error);
}

/* A coordinate as a person reads it, to the millimetre, without the rounding of a zero. */
static double told_place(double metres) { return floor(metres * 1e3 + 0.5) * 1e-3; }

fram_status report_way(report *r, fram_error *error)
{
    static const char *const channels[2] = {"position_x", "position_y"}, *const names[2] = {"x", "y"};
    const double *time = run_channel(&r->d, "time");
    double *place[2], start[2];
    chart_line lines[2];
    char subtitle[96];
    int32_t first = 0, rows = r->d.series.rows;
    for (int k = 0; k < 2; k++)
        place[k] = report_scaled(r, channels[k], 1);
    if (!time || !place[0] || !place[1])
        return FRAM_OK;
    while (first + 1 < rows && !(isfinite(place[0][first]) && isfinite(place[1][first])))
        first++;
    for (int k = 0; k < 2; k++) {
        start[k] = place[k][first];
        for (int32_t i = 0; i < rows; i++)
            place[k][i] -= start[k];
        lines[k] = chart_line_make(names[k], time, place[k], rows, false);
        lines[k].colour = k + 2;
    }
    snprintf(subtitle, sizeof subtitle, "from x %.10g m, y %.10g m at %.6g s", told_place(start[0]),
             told_place(start[1]), time[first]);
    chart c = chart_make("Position", subtitle, "time [s]", "way from there [m]", lines, 2);
    return html_chart(&r->page, &c, false, error);
}

void report_statistics_heads(report *r, const char *first)
{
    const char *const heads[] = {first, "mean", "standard deviation", "minimum", "maximum", "significant peak"};
    html_table_begin(&r->page, heads, 6);
}

void report_statistics(report *r, const char *channel, const char *name, double factor)
{
    const double *time = run_channel(&r->d, "time"), *value = report_scaled(r, channel, factor);
    if (!time || !value)
        return;
    channel_statistics s = channel_statistics_of(time, value, r->d.series.rows, r->d.s.run.transient);
    html_row_begin(&r->page);
    html_row_name(&r->page, name);
    const double told[] = {s.mean, s.deviation, s.least, s.greatest, isfinite(s.mean) ? s.significant : (double)NAN};
    const double largest = fmax(fabs(s.least), fabs(s.greatest)), least = run_channel_least(channel) * factor;
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        html_number(&r->page, told_beside(told[i], largest, least));
    html_row_end(&r->page);
}
