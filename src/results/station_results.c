#include "results/station_parts.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "io/atomic_file.h"
#include "io/text_buffer.h"
#include "model/scenario_vessel.h"
#include "results/ice_contact.h"

#include <math.h>
#include <string.h>

bool station_has_results(const scenario *s, int32_t vessel)
{
    if (vessel >= scenario_vessel_count(s))
        return false;
    const scenario_vessel *v = scenario_vessel_entry(s, vessel).keys;
    bool required = !is_automatic(v->station.offset_limit) || !is_automatic(v->station.heading_limit_deg);
    return v->mode == VESSEL_FREE &&
           (v->mooring.lines.count > 0 || v->thrusters.count > 0 || v->positioning.active || required);
}

void offset_envelope(const double *time, const double *x, const double *y, int32_t count, double transient,
                     double out[ENVELOPE_DIRECTIONS])
{
    memset(out, 0, ENVELOPE_DIRECTIONS * sizeof *out);
    for (int32_t i = first_time_after(time, count, transient); i < count; i++) {
        double at = real_atan2(y[i], x[i]) / (2 * PI) * ENVELOPE_DIRECTIONS;
        int32_t k = (int32_t)floor(at + 0.5);
        k = (k + ENVELOPE_DIRECTIONS) % ENVELOPE_DIRECTIONS;
        out[k] = fmax(out[k], sqrt(x[i] * x[i] + y[i] * y[i]));
    }
}

/* ---- JSON ---- */

static void add_number(context *ctx, text_buffer *b, const char *key, double value, const char *end)
{
    text_format(ctx, b, "\"%s\": ", key);
    text_real_or_null(ctx, b, value);
    text_add(ctx, b, end);
}

/* Null where nothing was measured. */
static void add_statistics(context *ctx, text_buffer *b, const channel_statistics *s, const char *end)
{
    add_number(ctx, b, "mean", s->mean, ", ");
    add_number(ctx, b, "deviation", s->deviation, ", ");
    add_number(ctx, b, "least", s->least, ", ");
    add_number(ctx, b, "significant", s->significant, ", ");
    add_number(ctx, b, "greatest", s->greatest, ", ");
    add_number(ctx, b, "peak", s->peak, end);
}

static void add_channel_statistics(context *ctx, text_buffer *b, const station_data *d, const char *key,
                                   const double_array *of, double transient, const char *end)
{
    channel_statistics s = station_statistics(d, of, transient);
    text_format(ctx, b, "  \"%s\": {", key);
    add_statistics(ctx, b, &s, end);
}

/* The end of a channel that may have a limit; null for both where it has none. */
static void add_limit(context *ctx, text_buffer *b, const station_data *d, const double_array *of, double limit,
                      double transient)
{
    double set = automatic_or(limit, HUGE_VAL);
    add_number(ctx, b, "limit", set, ", ");
    add_number(ctx, b, "exceedance", set < HUGE_VAL ? station_exceedance(d, of, set, transient) : HUGE_VAL, "},\n");
}

static void add_envelope(context *ctx, text_buffer *b, const station_data *d, double transient)
{
    double envelope[ENVELOPE_DIRECTIONS];
    offset_envelope(d->column[TIME].data, d->column[OFFSET_X].data, d->column[OFFSET_Y].data, d->rows, transient,
                    envelope);
    bool measured = station_first_row(d, transient) < d->rows;
    text_format(ctx, b, "  \"offset_envelope_m\": %s", measured ? "[" : "null,\n");
    for (int i = 0; i < ENVELOPE_DIRECTIONS && measured; i++) {
        char text[NUMBER_TEXT_SIZE];
        real_to_text(envelope[i], text);
        text_format(ctx, b, "%s%s", text, i + 1 < ENVELOPE_DIRECTIONS ? ", " : "],\n");
    }
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

/* A line that parted was used up, whenever that was: its last tension counts, before the transient too.  One without
   a breaking load has no use that could be told: 0 would look like a slack line. */
static double line_use(const station_data *d, int32_t line, double peak)
{
    int32_t end = end_of_line(d, line);
    double last = end >= 0 ? d->outcome->events->value[end] : (double)NAN;
    double breaking = d->outcome->lines->breaking_load[d->line[line]];
    return breaking < HUGE_VAL ? fmax(peak, last) / breaking : (double)NAN;
}

/* The largest part of the thrust ahead, or astern, that was asked of a thruster. */
static double thruster_use(const station_data *d, int32_t thruster, const channel_statistics *s)
{
    double ahead = d->outcome->thrusters->ahead[d->thruster[thruster]];
    double astern = d->outcome->thrusters->astern[d->thruster[thruster]];
    return astern > 0 ? fmax(s->greatest / ahead, -s->least / astern) : s->greatest / ahead;
}

static void add_lines(context *ctx, text_buffer *b, const station_data *d, double transient)
{
    const station_outcome *o = d->outcome;
    text_add(ctx, b, "  \"lines\": [");
    for (int32_t i = 0; i < d->lines; i++) {
        channel_statistics s = station_statistics(d, &d->column[FIXED + i], transient);
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
        channel_statistics s = station_statistics(d, &d->column[FIXED + d->lines + i], transient);
        text_format(ctx, b, "%s\n    {\"number\": %d, \"failed\": %s, ", i ? "," : "", (int)i + 1,
                    o->thrusters->failed[d->thruster[i]] ? "true" : "false");
        add_number(ctx, b, "largest_use", thruster_use(d, i, &s), ", ");
        add_statistics(ctx, b, &s, "}");
    }
    text_add(ctx, b, "],\n");
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
        station_tell_event(d, i, text, sizeof text);
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

static void compose_station(context *ctx, const station_data *d, text_buffer *b)
{
    const scenario *s = d->s;
    double transient = s->run.transient;
    const double_array *c = d->column;
    text_add(ctx, b, "{\n  ");
    if (scenario_names_vessels(s))
        text_format(ctx, b, "\"vessel\": \"%s\",\n  ", scenario_vessel_entry(s, d->vessel).keys->name);
    add_number(ctx, b, "time_s", d->outcome->time, ",\n  ");
    add_number(ctx, b, "transient_s", transient, ",\n  ");
    add_number(ctx, b, "averaging_window_s", scenario_averaging_window(s), ",\n");
    add_channel_statistics(ctx, b, d, "offset_m", &d->offset, transient, ", ");
    add_limit(ctx, b, d, &d->offset, station_limits(d)->offset_limit, transient);
    add_envelope(ctx, b, d, transient);
    add_channel_statistics(ctx, b, d, "offset_x_m", &c[OFFSET_X], transient, "},\n");
    add_channel_statistics(ctx, b, d, "offset_y_m", &c[OFFSET_Y], transient, "},\n");
    add_channel_statistics(ctx, b, d, "heading_deviation_deg", &c[HEADING], transient, ", ");
    add_limit(ctx, b, d, &c[HEADING], station_limits(d)->heading_limit_deg, transient);
    add_channel_statistics(ctx, b, d, "ice_load_N", &d->load, transient, "},\n");
    add_channel_statistics(ctx, b, d, "ice_load_x_N", &c[LOAD_X], transient, "},\n");
    add_channel_statistics(ctx, b, d, "ice_load_y_N", &c[LOAD_Y], transient, "},\n");
    text_add(ctx, b, "  ");
    add_number(ctx, b, "ice_last_contact_s", ice_contact_of(c[TIME].data, d->load.data, d->rows).last, ",\n");
    add_channel_statistics(ctx, b, d, "line_tension_largest_N", &c[TENSION], transient, "},\n");
    add_channel_statistics(ctx, b, d, "thruster_power_W", &c[POWER], transient, ", ");
    add_number(ctx, b, "energy_J", station_energy(d, transient), "},\n  ");
    add_number(ctx, b, "thrusters_saturated", station_statistics(d, &c[SATURATED], transient).mean, ",\n");
    add_lines(ctx, b, d, transient);
    add_events(ctx, b, d);
}

fram_status station_results_write(context *ctx, const scenario *s, int32_t vessel, const station_outcome *o,
                                  const char *folder, fram_error *error)
{
    station_data d;
    text_buffer b = {0};
    char path[PATH_ROOM];
    fram_status status = station_data_read(ctx, s, vessel, o, folder, ".json", &d, path, error);
    if (status == FRAM_OK) {
        compose_station(ctx, &d, &b);
        status = b.failed ? error_memory(error) : atomic_file_put(ctx, path, b.data, (size_t)b.count, error);
    }
    text_free(ctx, &b);
    station_data_free(ctx, &d);
    return status;
}
