/* station.png: what a run says about keeping station on one page. */
#include "results/station_parts.h"

#include "base/load_unit.h"
#include "base/transcendental.h"
#include "geometry/polygon.h"
#include "io/page.h"
#include "io/text_buffer.h"
#include "model/scenario_vessel.h"

#include <stdio.h>
#include <string.h>

/* A limit of more than so many largest offsets is not drawn. */
#define FAR_LIMIT 6

/* TEXT_WIDTH: up to the charts beside it [pixels]. */
enum { PAGE_WIDTH = 1600, PAGE_HEIGHT = 1130, TEXT_LEFT = 60, TEXT_WIDTH = 580, CIRCLE = 73 };

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
        station_tell_event(d, i, text, sizeof text);
        text_format(ctx, b, events->time[i] < 100 ? "t = %.3g s: %s.\n" : "t = %.1f s: %s.\n", events->time[i], text);
    }
    if (count > TOLD)
        text_format(ctx, b, "and %d more events.\n", (int)(count - TOLD));
}

/* By all that the charts show. */
typedef struct station_units {
    load_unit load, tension, power;
} station_units;

static double largest_of(const double_array *values)
{
    double most = 0;
    for (int32_t i = 0; i < values->count; i++)
        most = fmax(most, fabs(values->data[i]));
    return most;
}

static station_units find_units(const station_data *d)
{
    return (station_units){load_unit_for(largest_of(&d->load)), load_unit_for(largest_of(&d->column[TENSION])),
                           power_unit_for(largest_of(&d->column[POWER]))};
}

static void describe_loads(context *ctx, const station_data *d, const station_units *u, text_buffer *b)
{
    double transient = d->s->run.transient, energy = station_energy(d, transient);
    channel_statistics load = station_statistics(d, &d->load, transient);
    channel_statistics tension = station_statistics(d, &d->column[TENSION], transient);
    channel_statistics power = station_statistics(d, &d->column[POWER], transient);
    load_unit p = u->power, e = energy_unit_for(energy);
    text_format(ctx, b, "Ice load: mean %s, significant %s, peak %s.\n", load_text_of(load.mean, 4).text,
                load_text_of(load.significant, 4).text, load_text_of(load.greatest, 4).text);
    if (d->lines > 0)
        text_format(ctx, b, "Largest line tension: mean %s, peak %s.\n", load_text_of(tension.mean, 4).text,
                    load_text_of(tension.greatest, 4).text);
    if (station_lines_gone(d) > 0)
        text_format(ctx, b, "%d of %d lines parted or were let go: tensions are those of the lines that were left.\n",
                    (int)station_lines_gone(d), (int)d->lines);
    if (d->thrusters > 0)
        text_format(ctx, b,
                    "Power: mean %.4g %s, largest %.4g %s; energy %.4g %s.\nThrusters saturated %.3g %% of the time.\n",
                    power.mean * p.factor, p.name, power.greatest * p.factor, p.name, energy * e.factor, e.name,
                    100 * station_statistics(d, &d->column[SATURATED], transient).mean);
}

static void describe(context *ctx, const station_data *d, const station_units *u, text_buffer *b)
{
    const scenario *s = d->s;
    double transient = s->run.transient;
    if (station_first_row(d, transient) == d->rows) {
        text_format(ctx, b, "Nothing was measured: series.csv has no row after %g s.\n", transient);
        describe_events(ctx, d, b);
        return;
    }
    channel_statistics offset = station_statistics(d, &d->offset, transient);
    text_format(ctx, b, "Statistics after %g s; loads averaged over %.3g s.\n", transient,
                scenario_averaging_window(s));
    text_format(ctx, b, "Offset: mean %.3g m, largest %.3g m", offset.mean, offset.greatest);
    double limit = automatic_or(station_limits(d)->offset_limit, HUGE_VAL);
    if (limit < HUGE_VAL)
        text_format(ctx, b, "; beyond the limit of %.3g m %.3g %% of the time.\n", limit,
                    100 * station_exceedance(d, &d->offset, limit, transient));
    else
        text_add(ctx, b, "; no limit is set.\n");
    describe_loads(ctx, d, u, b);
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

static void draw_circle(double radius, double x[CIRCLE], double y[CIRCLE])
{
    for (int i = 0; i < CIRCLE; i++) {
        double a = 2 * PI * i / (CIRCLE - 1);
        x[i] = radius * real_cos(a), y[i] = radius * real_sin(a);
    }
}

enum { PAGE_TITLE = SCENARIO_TEXT_SIZE + 40 };
/* Returns where the vessel's name begins in it, or its end. */
static const char *title_of(const scenario *s, int32_t vessel, char out[PAGE_TITLE])
{
    bool named = scenario_names_vessels(s);
    const char *title = s->title[0] ? s->title : "Fram";
    snprintf(out, PAGE_TITLE, "%s%s%.*s", title, named ? ": vessel " : "", (int)VESSEL_NAME_MOST,
             named ? scenario_vessel_entry(s, vessel).keys->name : "");
    return out + strlen(title);
}

static fram_status draw_station(context *ctx, const station_data *d, const station_units *u, const char *text,
                                const char *path, fram_error *error)
{
    const scenario *s = d->s;
    double round_x[CIRCLE], round_y[CIRCLE], limit = automatic_or(station_limits(d)->offset_limit, 0);
    draw_circle(limit, round_x, round_y);
    int32_t n = d->rows;
    int32_t first = station_first_row(d, s->run.transient);
    vec2_array hull = {0};
    double_array edge[2] = {0};
    fram_status status = enclose(ctx, d, first, &hull, edge, error);
    /* A limit that is far away would leave nothing of the track to be seen, which is drawn before the transient's end
       too. */
    bool far = limit > FAR_LIMIT * largest_of(&d->offset);
    char note[112];
    snprintf(note, sizeof note,
             far         ? "offset of the watched point; the limit, %.3g m, lies outside"
             : first > 0 ? "offset of the watched point; envelope of its track after %.4g s, pale before"
                         : "offset of the watched point; envelope of its track",
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
    char force[24], pull[24], watts[24];
    snprintf(force, sizeof force, "force [%s]", u->load.name);
    snprintf(pull, sizeof pull, "tension [%s]", u->tension.name);
    snprintf(watts, sizeof watts, "power [%s]", u->power.name);
    const page_panel panels[5] = {
        {chart_make("Footprint", note, "X [m]", "Y [m]", footprint, limit > 0 && !far ? 4 : 3), 20, 60, 620, 560, true},
        {chart_make("Offset", "", "time [s]", "offset [m]", offsets, 2), 660, 60, 920, 270, false},
        {chart_make("Heading", "deviation", "time [s]", "deviation [deg]", &heading, 1), 660, 320, 920, 270, false},
        {chart_make("Ice load", "averaged", "time [s]", force, loads, 2), 660, 580, 920, 270, false},
        d->lines > 0
            ? (page_panel){chart_make("Line tension", "", "time [s]", pull, &tension, 1), 660, 840, 920, 270, false}
            : (page_panel){chart_make("Power", "", "time [s]", watts, &power, 1), 660, 840, 920, 270, false},
    };
    char title[PAGE_TITLE];
    const char *name = title_of(s, d->vessel, title);
    const page p = {title, name, panels, 5, text, TEXT_LEFT, 660, TEXT_WIDTH, PAGE_WIDTH, PAGE_HEIGHT};
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
    station_data d;
    text_buffer b = {0};
    char path[PATH_ROOM];
    fram_status status = station_data_read(ctx, s, vessel, o, folder, ".png", &d, path, error);
    if (status == FRAM_OK) {
        station_units units = find_units(&d);
        describe(ctx, &d, &units, &b);
        scale(&d.column[LOAD_X], units.load.factor);
        scale(&d.column[LOAD_Y], units.load.factor);
        scale(&d.column[TENSION], units.tension.factor);
        scale(&d.column[POWER], units.power.factor);
        status = b.failed ? error_memory(error) : draw_station(ctx, &d, &units, b.data, path, error);
    }
    text_free(ctx, &b);
    station_data_free(ctx, &d);
    return status;
}
