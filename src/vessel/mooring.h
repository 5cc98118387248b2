/* Mooring lines between a vessel and the bottom, quasi-static: catenaries or springs, each with a breaking load.
   Frames: anchors in the global frame, fairleads in the vessel's body frame (about its centre of mass); a turret's
   fairleads stand off its centre by an arm that keeps its direction in the global frame. */
#ifndef VESSEL_MOORING_H
#define VESSEL_MOORING_H

#include "vessel/catenary.h"
#include "vessel/event.h"
#include "vessel/vessel.h"

typedef enum line_kind {
    LINE_CATENARY = 0, /* elastic, on a flat bottom */
    LINE_SPRING,       /* straight; pulls only */
    LINE_TABLE         /* straight; tension by the horizontal offset of its upper end */
} line_kind;

/* Tension over offset: linear between points, that of the first below it, the last slope beyond the last. */
enum { LINE_POINTS = 32 };
typedef struct line_curve {
    double offset[LINE_POINTS];  /* of the ends' horizontal distance from that at the start, ascending [m] */
    double tension[LINE_POINTS]; /* 0 or more, never falling [N] */
} line_curve;

#define LINE_FIELDS(X)                                                                                      \
    X(vessel, int32_t, FIELD_I32, 1, "1", "row of the vessel")                                              \
    X(kind, uint8_t, FIELD_U8, 1, "1", "enum line_kind")                                                    \
    X(broken, uint8_t, FIELD_U8, 1, "1", "carries nothing any more")                                        \
    X(fairlead, vec3, FIELD_F64, 3, "m", "upper end, or centre of the turret, body frame")                  \
    X(arm, vec3, FIELD_F64, 3, "m", "from the turret's centre to the upper end, global frame; 0: spread")   \
    X(anchor, vec3, FIELD_F64, 3, "m", "lower end on the bottom, global frame")                             \
    X(length, double, FIELD_F64, 1, "m", "unstretched; table: horizontal distance at the start")            \
    X(weight, double, FIELD_F64, 1, "N/m", "in water")                                                      \
    X(stiffness, double, FIELD_F64, 1, "N, N/m", "catenary: EA; spring: force per length; table: none")     \
    X(points, int32_t, FIELD_I32, 1, "1", "table: points of the curve")                                     \
    X(curve, line_curve, FIELD_F64, 64, "m, N", "table: tension over offset")                               \
    X(breaking_load, double, FIELD_F64, 1, "N", "tension at which it parts")                                \
    X(release_time, double, FIELD_F64, 1, "s", "it is let go then; infinity: never")                        \
    X(horizontal, double, FIELD_F64, 1, "N", "horizontal pull at the last step, where the next one starts") \
    X(tension, double, FIELD_F64, 1, "N", "at the upper end, at the last step")
TABLE_DECLARE(line, LINE_FIELDS)

typedef struct line_definition {
    int32_t vessel;
    line_kind kind;
    bool turret;
    vec3 centre;              /* of the mooring, in ship coordinates: about which fairleads stand [m] */
    double fairlead_distance; /* of the upper end from it, horizontally [m] */
    double direction;         /* in which the line leads off as the vessel lies at the start, global [rad] */
    double distance;          /* of the anchor from the upper end, horizontally [m] */
    double depth;             /* of the bottom under still water [m] */
    double length;            /* unstretched [m]; a NaN: from the pretension */
    double pretension;        /* as the vessel lies at the start [N]; looked at without a length */
    double weight, stiffness; /* see LINE_FIELDS */
    int32_t points;           /* table */
    line_curve curve;
    double breaking_load, release_time;
} line_definition;

/* A line of a vessel that lies where it was made.  FRAM_ERROR_INPUT names the member that does not fit. */
fram_status mooring_add_line(context *ctx, const line_definition *d, const vessel_table *vessels,
                             const body_table *bodies, line_table *lines, fram_error *error);

/* Pull of one line on a vessel at a pose: force [N] and where it acts (global). */
typedef struct line_pull {
    vec3 force, point;
    double tension, horizontal; /* [N] */
} line_pull;
line_pull mooring_line_pull(const line_table *lines, int32_t row, vec3 position, quat orientation);
/* Of all lines of a vessel, about `position`; about the vertical a turret bears forces alone. */
wrench mooring_pull(const line_table *lines, int32_t vessel, vec3 position, quat orientation);

/* One step: lines that are due part or are let go (an event each), the others' pulls are added to loads[body] and to
   sum[vessel].  Writes tension and horizontal. */
fram_status mooring_step(context *ctx, line_table *lines, const vessel_table *vessels, const body_table *bodies,
                         double time, wrench *loads, wrench *sum, event_table *events, fram_error *error);

/* Steady load on the vessel apart from its mooring, at a heading: (force x, force y [N], yaw moment [N m]), global. */
typedef vec3 (*steady_load)(const void *user, double heading);
typedef struct mooring_balance {
    double residual;  /* force, and moment over the length, that are left [N] */
    double turn_left; /* by which the vessel turns from there once it is touched [rad]: 0 where it comes back */
} mooring_balance;
/* Where the mooring balances the steady load and the vessel comes to rest: x, y, yaw are moved from where they are,
   heave, roll and pitch stay.  Of several such headings it is the one to which the moment turns the vessel from its
   own, with its place where the forces balance at each heading.  One that lies in balance at its own heading stays
   there, though any touch may turn it away (turn_left).  false: the residual did not get under a millionth of the
   lines' tensions; the pose is then the best that was found. */
bool mooring_equilibrium(const line_table *lines, int32_t vessel, double length, steady_load load, const void *user,
                         vec3 *position, quat *orientation, mooring_balance *out);
/* The same for a vessel that stays in no balance which any touch ends.  Pose, load and false as above. */
bool mooring_rest(const line_table *lines, int32_t vessel, double length, steady_load load, const void *user,
                  vec3 *position, quat *orientation);
/* The balance that Newton's method finds from that pose on, stable or not: for a load that holds the heading.
   Pose, load and false as above. */
bool mooring_nearest_balance(const line_table *lines, int32_t vessel, double length, steady_load load, const void *user,
                             vec3 *position, quat *orientation);

#endif
