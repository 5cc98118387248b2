/* A vessel that drives itself (docs/decisions/0140): net thrust that falls with speed, a course-keeping autopilot that
   follows way points or a pattern, backing and ramming when the ice stops it.

   Net thrust is what is left for ice once open water is paid for (Riska et al. 1997):
       T_net(v) = T_b (1 - v / (3 v_ow) - 2/3 (v / v_ow)^2),
   so that a vessel in open water runs at v_ow.  At a share p of full power T_b goes with p^(2/3) and v_ow with p^(1/3).
   The gross thrust, which also turns the ship, is the net one and the water's resistance to the hull.

   The water past a hull that drifts aside or turns lifts it as a wing of low aspect (manoeuvre.h): without that a ship
   slides on sideways for minutes, and no course can be kept.  Rudders in the race of the propellers turn it (rudder.h),
   or the thrust itself.  Knows bodies and vessels; must not know ice: where the ice drifts, and
   how it presses, is told. */
#ifndef VESSEL_PROPULSION_H
#define VESSEL_PROPULSION_H

#include "bodies/body.h"
#include "vessel/autopilot.h"
#include "vessel/event.h"
#include "vessel/vessel.h"

typedef enum propulsion_phase { PROPULSION_AHEAD = 0, PROPULSION_ASTERN } propulsion_phase;

/* What stays: numbers of one vessel's propulsion. */
typedef struct propulsion_settings {
    double bollard_pull;     /* T_b at the power that is given [N] */
    double open_water_speed; /* v_ow at that power [m/s] */
    double astern;           /* bollard pull astern over that ahead [1] */
    double speed;            /* that is wanted over the ground; infinity: as fast as it goes [m/s] */
    double steering_most;    /* [rad] */
    double steering_rate;    /* [rad/s] */
    double steering_x;       /* where rudders and thrust act, forward of the centre of mass [m] */
    double lookahead;        /* of the autopilot, which takes no less than its ship's lag asks for [m] */
    double beset_speed;      /* in the ice; a ship slower than that under thrust ... [m/s] */
    double beset_time;       /* ... for so long is beset [s] */
    double ram_distance;     /* it backs so far [m] */
    double x, y;             /* place of the pattern [m] */
    double distance, width;  /* of the pattern [m] */
    double aside;            /* it is moved so far to the left [m] */
    double track_limit;      /* track error beyond which it is off its track [m] */
    double transient;        /* until when the track error does not count [s] */
    manoeuvring ship;
    rudder rudder;
    turning_ability turning;
} propulsion_settings;

#define PROPULSION_FIELDS(X)                                                                                 \
    X(vessel, int32_t, FIELD_I32, 1, "1", "row of the vessel")                                               \
    X(settings, propulsion_settings, FIELD_F64, 38, "SI", "thrust, steering, autopilot, pattern")            \
    X(pattern, uint8_t, FIELD_U8, 1, "1", "enum pattern_kind")                                               \
    X(forecast, uint8_t, FIELD_U8, 1, "1", "1: the pattern points to the ice that is going to come")         \
    X(phase, uint8_t, FIELD_U8, 1, "1", "enum propulsion_phase")                                             \
    X(axis, double, FIELD_F64, 1, "rad", "direction that is updrift; without a track: heading that is kept") \
    X(way, double, FIELD_F64, 1, "m", "along the track to the foot of the ship; negative: not looked for")   \
    X(joined, double, FIELD_F64, 1, "m", "along a closed track to where the ship joined it")                 \
    X(rounds, int64_t, FIELD_I64, 1, "1", "rounds of the pattern done, from there")                          \
    X(leg, int32_t, FIELD_I32, 1, "1", "way point that is steered for, from 0")                              \
    X(from, vec2, FIELD_F64, 2, "m", "where the first of them began")                                        \
    X(steering, double, FIELD_F64, 1, "rad", "steering angle, positive turns to port")                       \
    X(seen, motion_observer, FIELD_F64, 3, "SI", "turn, moment and drift as the autopilot sees them")        \
    X(off, double, FIELD_F64, 1, "m", "track error: how far the ship is to port of its track")               \
    X(off_most, double, FIELD_F64, 1, "m", "largest that counts (follow() in propulsion.c)")                 \
    X(off_square, double, FIELD_F64, 1, "m2 s", "its square, summed over that time")                         \
    X(off_time, double, FIELD_F64, 1, "s", "that time; 0: it has not come so near yet")                      \
    X(astray, double, FIELD_F64, 1, "m", "largest since it was told to be off its track; 0: it is on it")    \
    X(thrust, double, FIELD_F64, 1, "N", "net thrust")                                                       \
    X(slow_time, double, FIELD_F64, 1, "s", "slower than the beset speed under thrust; ahead, held by ice")  \
    X(backed, double, FIELD_F64, 1, "m", "way astern in this backing")                                       \
    X(besets, int64_t, FIELD_I64, 1, "1", "times that the ice stopped it")                                   \
    X(rams, int64_t, FIELD_I64, 1, "1", "times that it came ahead again after backing")
TABLE_DECLARE(propulsion, PROPULSION_FIELDS)

/* Way points of all vessels that follow some, in their order. */
#define COURSE_FIELDS(X)                                       \
    X(vessel, int32_t, FIELD_I32, 1, "1", "row of the vessel") \
    X(place, vec2, FIELD_F64, 2, "m", "of the way point")
TABLE_DECLARE(course, COURSE_FIELDS)

/* T_net at a speed through the water [N]; a speed astern counts as 0. */
double propulsion_net_thrust(double bollard_pull, double open_water_speed, double speed);

/* Thrust over bollard pull of a ship that lacks so much of the speed that it wants over the ground [m/s]. */
double propulsion_push(double open_water_speed, double lacks);
/* A ship that lacks less pushes too little to count as stopped by ice: it is never beset, and never backs [m/s]. */
double propulsion_least_lack(double open_water_speed);

/* A new row for a vessel that lies where it was made. */
fram_status propulsion_add(context *ctx, const propulsion_settings *settings, pattern_kind pattern, bool forecast,
                           int32_t vessel, const vessel_table *vessels, const body_table *bodies, propulsion_table *out,
                           fram_error *error);

/* What the step looks like to a propulsion. */
typedef struct propulsion_moment {
    double time, dt;
    vec2 water;          /* velocity of the water [m/s] */
    vec2 drift;          /* velocity of the ice far away [m/s] */
    track_place comes;   /* where the ice is, from the place of the pattern, that is going to come there, and the way on
                            which it does, outward; at (0, 0): the pattern keeps its axis */
    double resistance;   /* of the water to the hull, against its way ahead [N] */
    wrench drag;         /* of the water on the hull, without its lift, with linear damping of sway and turn: what the
                            autopilot reckons with */
    double course_speed; /* slower over the ground a ship has a heading and no course [m/s] */
    vec2 ice;            /* force of the ice on the hull in the step before [N] */
    double lift_z;       /* how high over the centre of mass the hull's lift acts ... [m] */
    double steering_z;   /* ... rudders and thrust do where they push it aside ... [m] */
    double surge_z;      /* ... and the added mass of surge does [m] */
} propulsion_moment;

/* Steer, set the thrust, and add it to the load on the hull (about its centre of mass). */
fram_status propulsion_step(context *ctx, propulsion_table *propulsion, int32_t row, const propulsion_moment *now,
                            const vessel_table *vessels, const body_table *bodies, const course_table *course,
                            wrench *load, event_table *events, fram_error *error);

#endif
