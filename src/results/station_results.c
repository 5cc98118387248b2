#include "results/station_results.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "geometry/polygon.h"
#include "io/atomic_file.h"
#include "io/page.h"
#include "io/path.h"
#include "io/text_buffer.h"
#include "model/scenario_vessel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool station_has_results(const scenario *s, int32_t vessel)
{
    if (vessel >= scenario_vessel_count(s))
        return false;
    const scenario_vessel *v = scenario_vessel_entry(s, vessel).keys;
    return v->mode == VESSEL_FREE && (v->mooring.lines.count > 0 || v->thrusters.count > 0 || v->positioning.active);
}

/* ---- statistics ---- */

void offset_envelope(const double *time, const double *x, const double *y, int32_t count, double transient,
                     double out[ENVELOPE_DIRECTIONS])
{
    memset(out, 0, ENVELOPE_DIRECTIONS * sizeof *out);
    for (int32_t i = 0; i < count; i++) {
        if (time[i] < transient)
            continue;
        double at = real_atan2(y[i], x[i]) / (2 * PI) * ENVELOPE_DIRECTIONS;
        int32_t k = (int32_t)floor(at + 0.5);
        k = (k + ENVELOPE_DIRECTIONS) % ENVELOPE_DIRECTIONS;
        out[k] = fmax(out[k], sqrt(x[i] * x[i] + y[i] * y[i]));
    }
}

/* ---- what is read ---- */

enum { TIME, OFFSET_X, OFFSET_Y, HEADING, LOAD_X, LOAD_Y, POWER, SATURATED, TENSION, FIXED };
/* Lines, and thrusters, of a vessel. */
enum { MOST_EACH = 64, MOST_CHANNELS = FIXED + 2 * MOST_EACH };
static const char *const fixed_names[FIXED] = {"time",
                                               "offset_x",
                                               "offset_y",
                                               "heading_deviation",
                                               "ice_force_averaged_x",
                                               "ice_force_averaged_y",
                                               "thruster_power",
                                               "thrusters_saturated",
                                               "line_tension_max"};

typedef struct station_data {
    const scenario *s;
    int32_t vessel;
    const station_outcome *outcome;
    double_array column[MOST_CHANNELS];
    double_array offset, load;                    /* magnitudes */
    int32_t line[MOST_EACH], thruster[MOST_EACH]; /* their rows in the outcome's tables */
    int32_t lines, thrusters, rows;
} station_data;

static const scenario_station *limits_of(const station_data *d)
{
    return &scenario_vessel_entry(d->s, d->vessel).keys->station;
}

static void data_free(context *ctx, station_data *d)
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

static fram_status data_read(context *ctx, station_data *d, const char *folder, fram_error *error)
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

static channel_statistics statistics(const station_data *d, const double_array *of, double transient)
{
    return channel_statistics_of(d->column[TIME].data, of->data, d->rows, transient);
}

/* Part of the rows after the transient beyond a limit. */
static double exceedance(const station_data *d, const double_array *of, double limit, double transient)
{
    int32_t beyond = 0, all = 0;
    for (int32_t i = 0; i < d->rows; i++) {
        if (d->column[TIME].data[i] < transient)
            continue;
        beyond += fabs(of->data[i]) > limit;
        all++;
    }
    return all > 0 ? (double)beyond / all : 0;
}

/* ---- JSON ---- */

static void add_number(context *ctx, text_buffer *b, const char *key, double value, const char *end)
{
    char text[NUMBER_TEXT_SIZE];
    real_to_text(value, text);
    text_format(ctx, b, "\"%s\": %s%s", key, isfinite(value) ? text : "null", end);
}

static void add_statistics(context *ctx, text_buffer *b, const channel_statistics *s, const char *end)
{
    add_number(ctx, b, "mean", s->mean, ", ");
    add_number(ctx, b, "deviation", s->deviation, ", ");
    add_number(ctx, b, "least", s->least, ", ");
    add_number(ctx, b, "significant", s->significant, ", ");
    add_number(ctx, b, "peak", s->greatest, end);
}

static void add_channel(context *ctx, text_buffer *b, const station_data *d, const char *key, const double_array *of,
                        double transient, const char *end)
{
    channel_statistics s = statistics(d, of, transient);
    text_format(ctx, b, "  \"%s\": {", key);
    add_statistics(ctx, b, &s, end);
}

/* The end of a channel that may have a limit; null for both where it has none. */
static void add_limit(context *ctx, text_buffer *b, const station_data *d, const double_array *of, double limit,
                      double transient)
{
    double set = automatic_or(limit, HUGE_VAL);
    add_number(ctx, b, "limit", set, ", ");
    add_number(ctx, b, "exceedance", set < HUGE_VAL ? exceedance(d, of, set, transient) : HUGE_VAL, "},\n");
}

static void add_envelope(context *ctx, text_buffer *b, const station_data *d, double transient)
{
    double envelope[ENVELOPE_DIRECTIONS];
    offset_envelope(d->column[TIME].data, d->column[OFFSET_X].data, d->column[OFFSET_Y].data, d->rows, transient,
                    envelope);
    text_add(ctx, b, "  \"offset_envelope_m\": [");
    for (int i = 0; i < ENVELOPE_DIRECTIONS; i++) {
        char text[NUMBER_TEXT_SIZE];
        real_to_text(envelope[i], text);
        text_format(ctx, b, "%s%s", i > 0 ? ", " : "", text);
    }
    text_add(ctx, b, "],\n");
}

/* The event that ended a line of the vessel, by its place among the vessel's lines; -1: none did. */
static int32_t end_of_line(const station_data *d, int32_t line)
{
    const event_table *e = d->outcome->events;
    for (int32_t i = 0; i < e->count; i++)
        if (e->vessel[i] == d->vessel && e->number[i] == line &&
            (e->kind[i] == EVENT_LINE_BREAK || e->kind[i] == EVENT_LINE_RELEASE))
            return i;
    return -1;
}

static int32_t lines_gone(const station_data *d)
{
    int32_t gone = 0;
    for (int32_t i = 0; i < d->lines; i++)
        gone += d->outcome->lines->broken[d->line[i]] != 0;
    return gone;
}

/* A line that parted was used up, whenever that was: its last tension counts, before the transient too. */
static double line_use(const station_data *d, int32_t line, double peak)
{
    int32_t end = end_of_line(d, line);
    double last = end >= 0 ? d->outcome->events->value[end] : 0;
    return fmax(peak, last) / d->outcome->lines->breaking_load[d->line[line]];
}

static void add_lines(context *ctx, text_buffer *b, const station_data *d, double transient)
{
    const station_outcome *o = d->outcome;
    text_add(ctx, b, "  \"lines\": [");
    for (int32_t i = 0; i < d->lines; i++) {
        channel_statistics s = statistics(d, &d->column[FIXED + i], transient);
        text_format(ctx, b, "%s\n    {\"number\": %d, \"parted\": %s, ", i ? "," : "", (int)i + 1,
                    o->lines->broken[d->line[i]] ? "true" : "false");
        int32_t end = end_of_line(d, i);
        add_number(ctx, b, "parted_at_s", end >= 0 ? o->events->time[end] : HUGE_VAL, ", ");
        add_number(ctx, b, "tension_then", end >= 0 ? o->events->value[end] : HUGE_VAL, ", ");
        add_number(ctx, b, "utilisation", line_use(d, i, s.greatest), ", ");
        add_statistics(ctx, b, &s, "}");
    }
    text_add(ctx, b, "],\n  \"thrusters\": [");
    for (int32_t i = 0; i < d->thrusters; i++) {
        channel_statistics s = statistics(d, &d->column[FIXED + d->lines + i], transient);
        text_format(ctx, b, "%s\n    {\"number\": %d, \"failed\": %s, ", i ? "," : "", (int)i + 1,
                    o->thrusters->failed[d->thruster[i]] ? "true" : "false");
        add_number(ctx, b, "largest_use",
                   fmax(s.greatest / o->thrusters->ahead[d->thruster[i]],
                        o->thrusters->astern[d->thruster[i]] > 0 ? -s.least / o->thrusters->astern[d->thruster[i]] : 0),
                   ", ");
        add_statistics(ctx, b, &s, "}");
    }
    text_add(ctx, b, "],\n");
}

static void tell_event(const station_data *d, int32_t row, char *out, size_t size)
{
    const event_table *events = d->outcome->events;
    bool of_two = event_is_of_two((station_event)events->kind[row]);
    event_text(events, row, of_two ? scenario_vessel_name(d->s, events->number[row]) : NULL, out, size);
}

static void add_events(context *ctx, text_buffer *b, const station_data *d)
{
    const event_table *events = d->outcome->events;
    bool first = true;
    text_add(ctx, b, "  \"events\": [");
    for (int32_t i = 0; i < events->count; i++) {
        if (events->vessel[i] != d->vessel)
            continue;
        char text[160];
        tell_event(d, i, text, sizeof text);
        text_format(ctx, b, "%s\n    {\"kind\": \"%s\", ", first ? "" : ",",
                    event_name((station_event)events->kind[i]));
        add_number(ctx, b, "time_s", events->time[i], ", ");
        add_number(ctx, b, "value", events->value[i], ", ");
        text_format(ctx, b, "\"number\": %d, ", (int)events->number[i] + 1);
        text_format(ctx, b, "\"text\": \"%s\"}", text);
        first = false;
    }
    text_add(ctx, b, "]\n}\n");
}

static double energy_of(const station_data *d)
{
    double sum = 0;
    const double *t = d->column[TIME].data, *p = d->column[POWER].data;
    for (int32_t i = 1; i < d->rows; i++)
        sum += 0.5 * (p[i] + p[i - 1]) * (t[i] - t[i - 1]);
    return sum;
}

static void compose(context *ctx, const station_data *d, text_buffer *b)
{
    const scenario *s = d->s;
    double transient = s->run.transient;
    const double_array *c = d->column;
    text_add(ctx, b, "{\n  ");
    if (scenario_names_vessels(s))
        text_format(ctx, b, "\"vessel\": \"%s\",\n  ", scenario_vessel_entry(s, d->vessel).keys->name);
    add_number(ctx, b, "time_s", d->outcome->time, ",\n  ");
    add_number(ctx, b, "transient_s", transient, ",\n  ");
    add_number(ctx, b, "averaging_window_s", s->output.averaging_window, ",\n");
    add_channel(ctx, b, d, "offset_m", &d->offset, transient, ", ");
    add_limit(ctx, b, d, &d->offset, limits_of(d)->offset_limit, transient);
    add_envelope(ctx, b, d, transient);
    add_channel(ctx, b, d, "offset_x_m", &c[OFFSET_X], transient, "},\n");
    add_channel(ctx, b, d, "offset_y_m", &c[OFFSET_Y], transient, "},\n");
    add_channel(ctx, b, d, "heading_deviation_deg", &c[HEADING], transient, ", ");
    add_limit(ctx, b, d, &c[HEADING], limits_of(d)->heading_limit_deg, transient);
    add_channel(ctx, b, d, "ice_load_N", &d->load, transient, "},\n");
    add_channel(ctx, b, d, "ice_load_x_N", &c[LOAD_X], transient, "},\n");
    add_channel(ctx, b, d, "ice_load_y_N", &c[LOAD_Y], transient, "},\n");
    add_channel(ctx, b, d, "line_tension_largest_N", &c[TENSION], transient, "},\n");
    add_channel(ctx, b, d, "thruster_power_W", &c[POWER], transient, ", ");
    add_number(ctx, b, "energy_J", energy_of(d), "},\n  ");
    add_number(ctx, b, "thrusters_saturated", statistics(d, &c[SATURATED], transient).mean, ",\n");
    add_lines(ctx, b, d, transient);
    add_events(ctx, b, d);
}

fram_status station_results_write(context *ctx, const scenario *s, int32_t vessel, const station_outcome *o,
                                  const char *folder, fram_error *error)
{
    station_data d = {.s = s, .vessel = vessel, .outcome = o};
    text_buffer b = {0};
    char path[PATH_ROOM];
    fram_status status = data_read(ctx, &d, folder, error);
    if (status == FRAM_OK)
        status = path_join(folder, vessel_file_name(s, vessel, "station", ".json").text, path, error);
    if (status == FRAM_OK) {
        compose(ctx, &d, &b);
        status = b.failed ? error_memory(error) : atomic_file_put(ctx, path, b.data, (size_t)b.count, error);
    }
    text_free(ctx, &b);
    data_free(ctx, &d);
    return status;
}

/* ---- page ---- */

/* A limit of more than so many largest offsets is not drawn. */
#define FAR_LIMIT 6

enum { PAGE_WIDTH = 1600, PAGE_HEIGHT = 1130, CIRCLE = 73 };

/* The first events of the vessel. */
static void describe_events(context *ctx, const station_data *d, text_buffer *b)
{
    enum { TOLD = 8 };
    const event_table *events = d->outcome->events;
    int32_t count = 0;
    for (int32_t i = 0; i < events->count; i++) {
        if (events->vessel[i] != d->vessel || count++ >= TOLD)
            continue;
        char text[160];
        tell_event(d, i, text, sizeof text);
        text_format(ctx, b, "t = %.1f s: %s.\n", events->time[i], text);
    }
    if (count > TOLD)
        text_format(ctx, b, "and %d more events.\n", (int)(count - TOLD));
}

static void describe(context *ctx, const station_data *d, text_buffer *b)
{
    const scenario *s = d->s;
    double transient = s->run.transient;
    channel_statistics offset = statistics(d, &d->offset, transient), load = statistics(d, &d->load, transient);
    channel_statistics tension = statistics(d, &d->column[TENSION], transient);
    channel_statistics power = statistics(d, &d->column[POWER], transient);
    text_format(ctx, b, "Statistics after %g s; loads averaged over %.3g s.\n", transient, s->output.averaging_window);
    text_format(ctx, b, "Offset: mean %.3g m, largest %.3g m", offset.mean, offset.greatest);
    double limit = automatic_or(limits_of(d)->offset_limit, HUGE_VAL);
    if (limit < HUGE_VAL)
        text_format(ctx, b, "; beyond the limit of %.3g m %.3g %% of the time.\n", limit,
                    100 * exceedance(d, &d->offset, limit, transient));
    else
        text_add(ctx, b, "; no limit is set.\n");
    text_format(ctx, b, "Ice load: mean %.4g kN, significant %.4g kN, peak %.4g kN.\n", load.mean * 1e-3,
                load.significant * 1e-3, load.greatest * 1e-3);
    if (d->lines > 0)
        text_format(ctx, b, "Largest line tension: mean %.4g kN, peak %.4g kN.\n", tension.mean * 1e-3,
                    tension.greatest * 1e-3);
    if (lines_gone(d) > 0)
        text_format(ctx, b, "%d of %d lines parted or were let go: tensions are those of the lines that were left.\n",
                    (int)lines_gone(d), (int)d->lines);
    if (d->thrusters > 0)
        text_format(ctx, b,
                    "Power: mean %.4g MW, largest %.4g MW; energy %.4g GJ.\nThrusters saturated %.3g %% of the time.\n",
                    power.mean * 1e-6, power.greatest * 1e-6, energy_of(d) * 1e-9,
                    100 * statistics(d, &d->column[SATURATED], transient).mean);
    describe_events(ctx, d, b);
}

static void scale(double_array *values, double by)
{
    for (int32_t i = 0; i < values->count; i++)
        values->data[i] *= by;
}

/* The track from its first row after the transient on, and round it the line that encloses it (its convex hull). */
static fram_status enclose(context *ctx, const station_data *d, int32_t first, vec2_array *hull, double_array out[2],
                           fram_error *error)
{
    vec2_array points = {0};
    bool good = true;
    for (int32_t i = first; i < d->rows && good; i++)
        good = array_push(ctx, &points, vec2_make(d->column[OFFSET_X].data[i], d->column[OFFSET_Y].data[i]));
    good = good && polygon_convex_hull(ctx, (polygon){points.data, points.count}, hull);
    for (int32_t i = 0; good && hull->count > 0 && i <= hull->count; i++) {
        vec2 corner = hull->data[i % hull->count];
        good = array_push(ctx, &out[0], corner.x) && array_push(ctx, &out[1], corner.y);
    }
    array_free(ctx, &points);
    return good ? FRAM_OK : error_memory(error);
}

/* A channel over time; the palette's first colour is for backgrounds. */
static chart_line over_time(const station_data *d, const char *name, int32_t column, int32_t place)
{
    chart_line line = chart_line_make(name, d->column[TIME].data, d->column[column].data, d->rows, true);
    line.colour = place + 2;
    return line;
}

static fram_status draw(context *ctx, const station_data *d, const char *text, const char *path, fram_error *error)
{
    const scenario *s = d->s;
    double round_x[CIRCLE], round_y[CIRCLE], limit = automatic_or(limits_of(d)->offset_limit, 0);
    for (int i = 0; i < CIRCLE; i++) {
        double a = 2 * PI * i / (CIRCLE - 1);
        round_x[i] = limit * real_cos(a), round_y[i] = limit * real_sin(a);
    }
    const double *time = d->column[TIME].data;
    int32_t n = d->rows;
    int32_t first = 0;
    double largest = 0;
    vec2_array hull = {0};
    double_array edge[2] = {0};
    while (first < n && time[first] < s->run.transient)
        first++;
    fram_status status = enclose(ctx, d, first, &hull, edge, error);
    for (int32_t i = first; i < n; i++)
        largest = fmax(largest, d->offset.data[i]);
    /* A limit that is far away would leave nothing of the track to be seen. */
    bool far = limit > FAR_LIMIT * largest;
    char note[96];
    snprintf(note, sizeof note,
             far ? "offset of the watched point; the limit, %.3g m, lies outside"
                 : "offset of the watched point; envelope of its track after %.4g s",
             far ? limit : s->run.transient);
    chart_line footprint[4] = {
        chart_line_make("", d->column[OFFSET_X].data, d->column[OFFSET_Y].data, first, false),
        chart_line_make("track", d->column[OFFSET_X].data + first, d->column[OFFSET_Y].data + first, n - first, false),
        chart_line_make("envelope", edge[0].data, edge[1].data, edge[0].count, false),
        chart_line_make("limit", round_x, round_y, CIRCLE, true)};
    const chart_line offsets[2] = {over_time(d, "along X", OFFSET_X, 0), over_time(d, "along Y", OFFSET_Y, 1)};
    const chart_line heading = over_time(d, "heading", HEADING, 0);
    const chart_line loads[2] = {over_time(d, "along X", LOAD_X, 0), over_time(d, "along Y", LOAD_Y, 1)};
    const chart_line tension = over_time(d, "largest of all lines", TENSION, 0);
    const chart_line power = over_time(d, "thruster power", POWER, 0);
    const page_panel panels[5] = {
        {chart_make("Footprint", note, "X [m]", "Y [m]", footprint, limit > 0 && !far ? 4 : 3), 20, 60, 620, 560, true},
        {chart_make("Offset", "", "time [s]", "offset [m]", offsets, 2), 660, 60, 920, 270, false},
        {chart_make("Heading", "deviation", "time [s]", "deviation [deg]", &heading, 1), 660, 320, 920, 270, false},
        {chart_make("Ice load", "averaged", "time [s]", "force [kN]", loads, 2), 660, 580, 920, 270, false},
        d->lines > 0
            ? (page_panel){chart_make("Line tension", "", "time [s]", "tension [kN]", &tension, 1), 660, 840, 920, 270,
                           false}
            : (page_panel){chart_make("Power", "", "time [s]", "power [MW]", &power, 1), 660, 840, 920, 270, false},
    };
    char title[SCENARIO_TEXT_SIZE + 40];
    bool named = scenario_names_vessels(s);
    snprintf(title, sizeof title, "%s%s%.*s", s->title[0] ? s->title : "Fram", named ? ": vessel " : "",
             (int)VESSEL_NAME_MOST, named ? scenario_vessel_entry(s, d->vessel).keys->name : "");
    const page p = {title, panels, 5, text, 60, 660, PAGE_WIDTH, PAGE_HEIGHT};
    if (status == FRAM_OK)
        status = page_write(ctx, &p, path, error);
    array_free(ctx, &hull);
    array_free(ctx, &edge[0]);
    array_free(ctx, &edge[1]);
    return status;
}

fram_status station_page_write(context *ctx, const scenario *s, int32_t vessel, const station_outcome *o,
                               const char *folder, fram_error *error)
{
    station_data d = {.s = s, .vessel = vessel, .outcome = o};
    text_buffer b = {0};
    char path[PATH_ROOM];
    fram_status status = data_read(ctx, &d, folder, error);
    if (status == FRAM_OK)
        status = path_join(folder, vessel_file_name(s, vessel, "station", ".png").text, path, error);
    if (status == FRAM_OK) {
        describe(ctx, &d, &b);
        scale(&d.column[LOAD_X], 1e-3);
        scale(&d.column[LOAD_Y], 1e-3);
        scale(&d.column[TENSION], 1e-3);
        scale(&d.column[POWER], 1e-6);
        status = b.failed ? error_memory(error) : draw(ctx, &d, b.data, path, error);
    }
    text_free(ctx, &b);
    data_free(ctx, &d);
    return status;
}
