/* What befell a vessel on station: a table that grows, kept as state so that a resumed run tells the whole story. */
#ifndef VESSEL_EVENT_H
#define VESSEL_EVENT_H

#include "base/table.h"

typedef enum station_event {
    EVENT_LINE_BREAK = 0,    /* a line's tension exceeded its breaking load; value: tension [N] */
    EVENT_LINE_RELEASE,      /* a line was let go at its given time; value: tension [N] */
    EVENT_THRUSTER_FAILURE,  /* value: thrust it had [N] */
    EVENT_POSITION_LOST,     /* the offset came to exceed its limit; value: offset [m] */
    EVENT_POSITION_REGAINED, /* it came well within it again; value: offset [m] */
    EVENT_HEADING_LOST,      /* the heading came to deviate by more than its limit; value: deviation [rad] */
    EVENT_HEADING_REGAINED,  /* it came well within it again; value: deviation [rad] */
    EVENT_BESET,             /* the ice stopped a ship that pushes; value: net thrust [N] */
    EVENT_RAM,               /* it has backed and comes again; value: how far it backed [m] */
    EVENT_APPROACH,          /* another vessel is going to be nearer than the limit; value: predicted distance [m] */
    EVENT_APPROACH_OVER,     /* value: least distance that there was [m] */
    EVENT_WALL,      /* the hull met a wall, for the first time; value: normal force [N], 0 where its motion is given */
    EVENT_OFF_TRACK, /* a ship that drives itself came off its track; value: track error [m] */
    EVENT_ON_TRACK,  /* it is back; value: largest track error until then [m] */
    EVENT_BAND,      /* the hull met the band of an endless field, for the first time; value: force [N], 0 without */
    EVENT_COUNT
} station_event;

#define EVENT_FIELDS(X)                                                                                   \
    X(time, double, FIELD_F64, 1, "s", "simulated time")                                                  \
    X(value, double, FIELD_F64, 1, "", "what the kind says")                                              \
    X(kind, int32_t, FIELD_I32, 1, "1", "enum station_event")                                             \
    X(vessel, int32_t, FIELD_I32, 1, "1", "row of the vessel")                                            \
    X(number, int32_t, FIELD_I32, 1, "1", "line, thruster, or row of the other vessel, from 0; -1: none") \
    X(ahead, double, FIELD_F64, 1, "s", "until what is predicted comes, 0 for what has come")
TABLE_DECLARE(event, EVENT_FIELDS)

/* false: no memory. */
bool event_add(context *ctx, event_table *events, station_event kind, double time, int32_t vessel, int32_t number,
               double value);
/* Whether its number is the row of another vessel. */
bool event_is_of_two(station_event kind);
/* "mooring line 3 broke at a tension of 2100 kN", for people; numbers count from 1.  other: how the other vessel of an
   event of two is called; NULL: by its number.  look_ahead: approach_settings of its vessel [s]. */
void event_text(const event_table *events, int32_t row, const char *other, double look_ahead, char *out, size_t size);
/* "line_break", for machines. */
const char *event_name(station_event kind);

#endif
