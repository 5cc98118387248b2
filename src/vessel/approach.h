/* Vessels that are going to come too close: the closest point of approach by present velocities, as a collision
   avoidance display tells it, but between hulls and not between antennas.  Knows outlines and velocities; must not know
   bodies, ice or what anybody does about it. */
#ifndef VESSEL_APPROACH_H
#define VESSEL_APPROACH_H

#include "geometry/polygon.h"
#include "vessel/event.h"

/* What stays of a vessel's watch. */
typedef struct approach_settings {
    double limit;      /* least clear distance to another hull; infinity: nobody watches [m] */
    double look_ahead; /* how far ahead it is looked [s] */
} approach_settings;

/* A convex hull outline as seen from above, where it is now, and how it moves on: rotation is left out. */
typedef struct approach_hull {
    polygon plan;  /* convex, counter-clockwise, global [m] */
    vec2 velocity; /* [m/s] */
} approach_hull;

typedef struct approach_prediction {
    double gap;      /* least clear distance, 0: they would touch [m] */
    double time;     /* until then [s], the earliest where several are equal; look_ahead: they still come nearer */
    double distance; /* at present [m] */
} approach_prediction;

/* The least distance between the two within `look_ahead` seconds, at constant velocities. */
approach_prediction approach_predict(const approach_hull *a, const approach_hull *b, double look_ahead);

/* A row for each vessel that watches and each other one. */
#define APPROACH_FIELDS(X)                                                                  \
    X(vessel, int32_t, FIELD_I32, 1, "1", "row of the vessel that watches")                 \
    X(other, int32_t, FIELD_I32, 1, "1", "row of the vessel that is watched")               \
    X(close, uint8_t, FIELD_U8, 1, "1", "1: an approach was told and is not over")          \
    X(clear_time, double, FIELD_F64, 1, "s", "for how long no such approach was predicted") \
    X(nearest, double, FIELD_F64, 1, "m", "least distance that there was since it was told")
TABLE_DECLARE(approach, APPROACH_FIELDS)

/* How often it is looked: so many times a look-ahead; an approach is over when none was predicted for a part of it. */
enum { APPROACH_LOOKS = 100 };
#define APPROACH_CLEAR_PART 0.1
/* It is told again as less than this part of what was told last is predicted, or hulls that are going to touch: a part
   near 1 tells every look of one that is seen from afar, a small one little before they touch; 0.1 to 0.5. */
#define APPROACH_NEARER_PART 0.25

/* Books what was predicted: event_add when an approach begins or gets much nearer (value: gap, ahead: time) and when it
   is over (value: the nearest that there was).  since: the last look [s].  false: no memory. */
bool approach_book(context *ctx, approach_table *approaches, int32_t row, const approach_settings *settings,
                   const approach_prediction *predicted, double time, double since, event_table *events);

#endif
