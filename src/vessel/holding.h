/* How far a steady load uses up what holds a vessel: a static balance, without motion, waves or losses of thrust.
   Thrusters give all of the load that they can; the mooring takes what they leave.  Knows neither ice nor scenarios. */
#ifndef VESSEL_HOLDING_H
#define VESSEL_HOLDING_H

#include "vessel/mooring.h"
#include "vessel/thruster.h"

/* What comes nearest to its limit, or is beyond it. */
typedef enum holding_item {
    HOLDING_NOTHING = 0, /* nothing has a limit, or the mooring finds no equilibrium */
    HOLDING_THRUSTER,
    HOLDING_LINE,
    HOLDING_OFFSET,
    HOLDING_HEADING,
    HOLDING_ITEM_COUNT
} holding_item;

typedef struct holding_case {
    thruster_table *thrusters; /* orders are written */
    const line_table *lines;
    int32_t vessel;
    double length; /* of the vessel [m] */
    vec3 position; /* of the centre of mass, where the vessel shall be, global [m] */
    double heading;
    vec3 watched;                       /* the point whose offset counts, body frame [m] */
    bool heading_alone;                 /* thrusters hold the heading; what force they give with it the mooring bears */
    bool heading_given;                 /* the mooring does not turn the vessel (a turret): it lies at `heading` */
    double line_safety;                 /* a line may carry its breaking load over this */
    double offset_limit, heading_limit; /* [m], [rad]; infinity: none */
} holding_case;

typedef struct holding {
    double use; /* the largest part of a limit that is used; over 1: not held; infinity: no equilibrium at all */
    holding_item item;
    int32_t number;                /* of the thruster or line, from 0; -1: none */
    double thruster_use, line_use; /* parts of the largest thrust and of the allowed tension; 0 without */
    double offset, turn;           /* of the watched point [m], of the heading [rad] */
} holding;

/* Where neither a turret nor thrusters hold the heading, lines hold the vessel where it comes to rest, turned by its
   load from `heading`; else it keeps that.  Thrusters hold it while they give all of the moment of load and lines, and
   the vessel is turned back from a degree beside; else they push on as they do at `heading`, in the vessel's frame.
   load: force [N] and yaw moment about the centre of mass [N m], global frame, for a heading [rad].
   thruster_use is 1 over the largest multiple of the load, or of its moment alone, that the thrusters balance (with
   lines and no turret the moment is that of load and lines), each within its limits and allowed sectors; its number
   that of the thruster which is nearest to its limit then. */
holding holding_find(const holding_case *c, steady_load load, const void *user);

/* "thruster", "line", ... */
const char *holding_item_name(holding_item item);

#endif
