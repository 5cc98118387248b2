/* Tracks of straight lines and arcs: what an autopilot follows (docs/decisions/0380).  A track has a curvature
   everywhere, so that a helmsman can know of a turn before it comes.  Pure geometry. */
#ifndef VESSEL_TRACK_H
#define VESSEL_TRACK_H

#include "base/vec.h"
#include "vessel/pattern.h"

#include <stdbool.h>
#include <stdint.h>

/* A leg and its corner are two pieces, or five with a loop; of way points near to each other an autopilot sees several
   corners at once.  So many of them are enough for a track of legs: sixty legs of a twentieth of a ship, the least that
   there are, reach farther than its helm looks ahead. */
enum { TRACK_PIECES = 128, TRACK_POINTS = TRACK_PIECES / 2 + 5 };

typedef struct track_piece {
    double length;    /* [m] */
    double curvature; /* positive turns to port [1/m] */
    bool turning;     /* of a loop or a rounded corner: room to turn, not a part of what is asked for */
} track_piece;

typedef struct track {
    vec2 start;
    double heading; /* of its first piece where it begins [rad] */
    int32_t count;
    track_piece piece[TRACK_PIECES];
    double length; /* [m] */
    bool closed;   /* else the ends go on straight */
} track;

/* A place on a track. */
typedef struct track_place {
    vec2 at;
    double heading;   /* of the track there [rad] */
    double curvature; /* [1/m] */
    bool turning;     /* of its piece */
} track_place;

/* The pattern as a ship can sail it, in the pattern's frame: the corners of a square are rounded by this radius [m], or
   by half a side where that is less (they are all of it then, and no room to turn), and each end of a line or an arc is
   a loop of three arcs of that radius, on which the ship comes back to the same point the other way.  A line is moved
   updrift by its loop, so that nothing of it is nearer than `distance`.  A circle stays as it is.  The way ahead has
   none. */
track track_of_pattern(const pattern_shape *p, double radius);
/* An open track through a place at this heading [rad], *way [m] along it, that bends [1/m] before and after it for a
   quarter of a round. */
track track_of_bend(vec2 at, double heading, double curvature, double *way);
/* Whether a corner is so sharp, more than 135 degrees, that a ship turns about at it, on a loop beyond it. */
bool track_turns_about(vec2 before, vec2 corner, vec2 after);
/* What the corner at point i, which is neither end, has of this radius [m]: its legs may be too short for more, by what
   corners at their other ends take too.  Two points on either side tell, where there are such. */
double track_corner_left(const vec2 *point, int32_t count, int32_t i, double radius);
/* Legs from point to point, none of no length, from where the corner at point `at` (0: none) leaves its legs; corners
   are rounded by this radius [m], or by as much less as the legs are shorter than their corners take.  Has as many legs
   as there are pieces for; *corner: way to the end of the first of its corners [m], infinity without one.  Corners
   are room to turn, but those between legs of which corners leave next to nothing.  What a corner is left depends on
   its neighbours: give two points before `at`, where there are such. */
track track_of_legs(const vec2 *point, int32_t count, int32_t at, double radius, double *corner);

/* The place after this way along it [m]; past an end or before the start of an open one, straight on. */
track_place track_at(const track *t, double way);
/* How far the track has turned from its start to a way; goes on from round to round [rad]. */
double track_turned(const track *t, double way);
/* The foot of the perpendicular from a point, near a way from which it is looked for: a way, within the length of a
   closed track. */
double track_foot(const track *t, double way, vec2 point);
/* The way where a ship there with this heading joins a track: the nearest place, where a course that is wrong by 180
   degrees counts as much as this distance [m]. */
double track_join(const track *t, vec2 point, double heading, double weight);
/* How far a point is to port of a place of the track [m]. */
double track_off(const track_place *place, vec2 point);

#endif
