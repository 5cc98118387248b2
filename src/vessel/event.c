#include "vessel/event.h"

#include "base/load_unit.h"
#include "base/transcendental.h"

#include <stdio.h>

#define TABLE_SELF event_table
TABLE_DEFINE(event, EVENT_FIELDS)
#undef TABLE_SELF

bool event_add(context *ctx, event_table *events, station_event kind, double time, int32_t vessel, int32_t number,
               double value)
{
    int32_t row = events->count;
    if (!table_resize(ctx, events, &event_table_info, row + 1))
        return false;
    events->time[row] = time;
    events->value[row] = value;
    events->kind[row] = (int32_t)kind;
    events->vessel[row] = vessel;
    events->number[row] = number;
    events->ahead[row] = 0;
    return true;
}

const char *event_name(station_event kind)
{
    static const char *const names[EVENT_COUNT] = {
        "line_break",
        "line_release",
        "thruster_failure",
        "position_lost",
        "position_regained",
        "heading_lost",
        "heading_regained",
        "beset",
        "ram",
        "approach",
        "approach_over",
        "wall",
        "off_track",
        "on_track",
        "band",
    };
    return (int)kind >= 0 && kind < EVENT_COUNT ? names[kind] : "unknown";
}

bool event_is_of_two(station_event kind) { return kind == EVENT_APPROACH || kind == EVENT_APPROACH_OVER; }

/* Of hulls that still come nearer as the prediction ends, its number is no distance at which they pass. */
static void approach_text(const event_table *events, int32_t row, const char *other, double look_ahead, char *out,
                          size_t size)
{
    double gap = events->value[row], ahead = events->ahead[row];
    /* What is nearest now is found by halving, to rounding. */
    if (ahead < 1e-3)
        snprintf(out, size, "vessel %s is at %.4g m, and comes no nearer at present velocities", other, gap);
    else if (!(gap > 0))
        snprintf(out, size, "the hull and vessel %s are going to touch, in %.4g s at present velocities", other, ahead);
    else if (ahead < look_ahead)
        snprintf(out, size, "vessel %s is going to pass at %.4g m, in %.4g s at present velocities", other, gap, ahead);
    else
        snprintf(out, size, "vessel %s comes within %.4g m in %.4g s at present velocities, and nearer after that",
                 other, gap, ahead);
}

void event_text(const event_table *events, int32_t row, const char *other, double look_ahead, char *out, size_t size)
{
    double value = events->value[row];
    int number = (int)events->number[row] + 1;
    const load_text load = load_text_of(value, 4); /* of events that are of a load */
    char name[24];
    snprintf(name, sizeof name, "%d", number);
    switch ((station_event)events->kind[row]) {
    case EVENT_LINE_BREAK:
        snprintf(out, size, "mooring line %d broke at a tension of %s", number, load.text);
        return;
    case EVENT_LINE_RELEASE:
        snprintf(out, size, "mooring line %d was let go at a tension of %s", number, load.text);
        return;
    case EVENT_THRUSTER_FAILURE:
        snprintf(out, size, "thruster %d failed at a thrust of %s", number, load.text);
        return;
    case EVENT_POSITION_LOST:
        snprintf(out, size, "position lost: the offset is %.4g m", value);
        return;
    case EVENT_POSITION_REGAINED:
        snprintf(out, size, "position regained: the offset is %.4g m", value);
        return;
    case EVENT_HEADING_LOST:
        snprintf(out, size, "heading lost: it is off by %.4g deg", degrees(value));
        return;
    case EVENT_HEADING_REGAINED:
        snprintf(out, size, "heading regained: it is off by %.4g deg", degrees(value));
        return;
    case EVENT_BESET:
        snprintf(out, size, "beset under a net thrust of %s", load.text);
        return;
    case EVENT_RAM:
        snprintf(out, size, "backed %.4g m, and rams", value);
        return;
    case EVENT_APPROACH:
        approach_text(events, row, other ? other : name, look_ahead, out, size);
        return;
    case EVENT_APPROACH_OVER:
        snprintf(out, size, "vessel %s is clear again: it came as near as %.4g m", other ? other : name, value);
        return;
    case EVENT_OFF_TRACK:
        snprintf(out, size, "off its track by %.4g m", value);
        return;
    case EVENT_ON_TRACK:
        snprintf(out, size, "back on its track: it was off by %.4g m at most", value);
        return;
    case EVENT_WALL:
        if (value > 0)
            snprintf(out, size, "the hull runs into a wall of the domain, with %s", load.text);
        else
            snprintf(out, size, "the hull is driven into a wall of the domain by the motion that is given to it");
        return;
    case EVENT_BAND:
        if (value > 0)
            snprintf(out, size, "the hull meets floes of the band, which nothing pushes aside, with %s", load.text);
        else
            snprintf(out, size, "the hull comes into the band, whose floes nothing pushes aside");
        return;
    case EVENT_COUNT:
        break;
    }
    snprintf(out, size, "unknown event");
}
