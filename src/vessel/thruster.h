/* Thrusters: tunnel, azimuth, main propeller with rudder.  Each follows its orders with its own limits, rates and time
   constant, and may fail.  Frames: places in ship coordinates, angles counter-clockwise from the bow.
   The shaft speed n, a fraction of the largest, follows its order as a first-order lag with a rate limit; the thrust is
   largest thrust times n |n| (T = K n |n|, Fossen 2011, section 9.3).  A rudder turns the thrust ahead of its propeller
   by its angle and does nothing astern.  While a thruster turns, its order counts with the cosine of the angle left. */
#ifndef VESSEL_THRUSTER_H
#define VESSEL_THRUSTER_H

#include "vessel/allocation.h"
#include "vessel/event.h"
#include "vessel/vessel.h"

typedef enum thruster_kind {
    THRUSTER_TUNNEL = 0, /* athwartships, both ways */
    THRUSTER_AZIMUTH,    /* turns; pushes one way */
    THRUSTER_MAIN        /* along the ship, ahead and astern; a rudder deflects the thrust ahead */
} thruster_kind;

#define THRUSTER_FIELDS(X)                                                                                     \
    X(vessel, int32_t, FIELD_I32, 1, "1", "row of the vessel")                                                 \
    X(kind, uint8_t, FIELD_U8, 1, "1", "enum thruster_kind")                                                   \
    X(failed, uint8_t, FIELD_U8, 1, "1", "gives no thrust any more")                                           \
    X(place, vec3, FIELD_F64, 3, "m", "body frame, about the centre of mass")                                  \
    X(ahead, double, FIELD_F64, 1, "N", "largest thrust along its direction")                                  \
    X(astern, double, FIELD_F64, 1, "N", "largest thrust against it")                                          \
    X(time_constant, double, FIELD_F64, 1, "s", "of the shaft")                                                \
    X(speed_rate, double, FIELD_F64, 1, "1/s", "fastest change of the shaft speed, a fraction of the largest") \
    X(turn_rate, double, FIELD_F64, 1, "rad/s", "fastest turn of the azimuth or the rudder")                   \
    X(rudder, double, FIELD_F64, 1, "rad", "largest deflection of the thrust ahead of a main propeller")       \
    X(forbidden_centre, double, FIELD_F64, 1, "rad", "middle of the forbidden sector of an azimuth")           \
    X(forbidden_half, double, FIELD_F64, 1, "rad", "half its width; 0: none")                                  \
    X(cost, double, FIELD_F64, 1, "1", "weight of its thrust in the allocation")                               \
    X(full_power, double, FIELD_F64, 1, "W", "power at the largest thrust")                                    \
    X(failure_time, double, FIELD_F64, 1, "s", "it fails then; infinity: never")                               \
    X(order, double, FIELD_F64, 1, "N", "thrust ordered")                                                      \
    X(order_angle, double, FIELD_F64, 1, "rad", "direction ordered")                                           \
    X(speed, double, FIELD_F64, 1, "1", "shaft speed over the largest")                                        \
    X(angle, double, FIELD_F64, 1, "rad", "direction of the thrust")                                           \
    X(thrust, double, FIELD_F64, 1, "N", "thrust")
TABLE_DECLARE(thruster, THRUSTER_FIELDS)

typedef struct thruster_definition {
    int32_t vessel;
    thruster_kind kind;
    vec3 place;           /* ship coordinates [m] */
    double ahead, astern; /* [N] */
    double time_constant, speed_rate, turn_rate, rudder, forbidden_centre, forbidden_half, cost;
    double full_power;
    double failure_time;
    double order, order_angle; /* at the start */
} thruster_definition;

/* FRAM_ERROR_INPUT names the member that does not fit. */
fram_status thruster_add(context *ctx, const thruster_definition *d, const vessel_table *vessels,
                         thruster_table *thrusters, fram_error *error);
/* Direction of a positive thrust, from the bow [rad]; a rudder does nothing astern. */
double thruster_push_angle(const thruster_table *thrusters, int32_t row);
/* The direction nearest to `angle` that may be ordered: of a rudder, or outside of the forbidden sector [rad]. */
double thruster_allowed_angle(const thruster_table *thrusters, int32_t row, double angle);
/* Power drawn [W]: full power times (|T| / largest)^1.5, the largest of ahead and astern. */
double thruster_power(const thruster_table *thrusters, int32_t row);

/* Orders to the thrusters of a vessel for a force (surge, sway [N], yaw moment [N m] about the centre of mass, vessel
   frame): the cheapest that reach it with each thruster where it can push, otherwise those that miss least.  Of ways
   through different halves of what a ruddered propeller or an azimuth with a forbidden sector can give the better one
   counts, without memory, so that orders may jump with the demand there; of more than five such thrusters not all ways.
   Returns what is missed; *reached as allocation_solve.  A demand that is no number, or has 100 digits, leaves the
   orders as they are and is not reached. */
vec3 thruster_allocate(thruster_table *thrusters, int32_t vessel, double lever, vec3 tau, bool *reached);
/* The same for a yaw moment [N m] where others bear what force comes with it, as the lines of a mooring do: forces
   count neither as missed nor as reached.  Returns the moment that is missed. */
double thruster_allocate_turn(thruster_table *thrusters, int32_t vessel, double lever, double moment, bool *reached);

/* One step: failures that are due (an event each), shafts and angles follow their orders, thrusts are added to
   loads[body] and to sum[vessel]. */
fram_status thruster_step(context *ctx, thruster_table *thrusters, const vessel_table *vessels,
                          const body_table *bodies, double time, double dt, wrench *loads, wrench *sum,
                          event_table *events, fram_error *error);
/* Force and moment (surge, sway, yaw) that the thrusters of a vessel give now, vessel frame. */
vec3 thruster_effect(const thruster_table *thrusters, int32_t vessel);
/* The same that they are ordered to give. */
vec3 thruster_ordered_effect(const thruster_table *thrusters, int32_t vessel);

#endif
