/* A vessel on station: where it shall be, what it measures and believes, what its controller orders, how far it is off.
   Row i belongs to vessel i; the row of a vessel that keeps no station is zero.  The controller runs at its own rate:
   every `control_every` steps, on measurements taken every `sample_every` steps. */
#ifndef VESSEL_STATION_H
#define VESSEL_STATION_H

#include "vessel/controller.h"
#include "vessel/observer.h"
#include "vessel/reference.h"
#include "vessel/thruster.h"

typedef enum observer_kind { OBSERVER_PASSIVE = 0, OBSERVER_KALMAN } observer_kind;
/* Where the feed-forward of the ice load comes from. */
typedef enum feed_source {
    FEED_NONE = 0,
    FEED_MEASURED, /* the ice load itself, as strain gauges would tell it, smoothed */
    FEED_OBSERVED  /* the observer's bias: ice, wind and current together */
} feed_source;
/* What the controller orders of the thrusters.  The choice stands in the gains of the table: those of surge and sway
   are zero where the heading alone is controlled. */
typedef enum positioning_control { CONTROL_PLACE_AND_HEADING = 0, CONTROL_HEADING } positioning_control;
typedef enum heading_rule { HEADING_FIXED = 0, HEADING_VANING } heading_rule;

#define STATION_FIELDS(X)                                                                                      \
    X(positioning, uint8_t, FIELD_U8, 1, "1", "1: on dynamic positioning")                                     \
    X(observer, uint8_t, FIELD_U8, 1, "1", "enum observer_kind")                                               \
    X(feed, uint8_t, FIELD_U8, 1, "1", "enum feed_source")                                                     \
    X(heading_rule, uint8_t, FIELD_U8, 1, "1", "enum heading_rule")                                            \
    X(control_every, int64_t, FIELD_I64, 1, "1", "steps between calls of the controller")                      \
    X(sample_every, int64_t, FIELD_I64, 1, "1", "steps between measurements")                                  \
    X(home, vec3, FIELD_F64, 3, "m, m, rad", "x, y of the ship's origin and heading that are wanted at first") \
    X(watched, vec3, FIELD_F64, 3, "m", "the point whose offset counts, body frame about the centre of mass")  \
    X(watched_home, vec3, FIELD_F64, 3, "m", "where it was at the start")                                      \
    X(offset_limit, double, FIELD_F64, 1, "m", "largest allowed offset; infinity: none")                       \
    X(heading_limit, double, FIELD_F64, 1, "rad", "largest allowed deviation of the heading; infinity: none")  \
    X(lever, double, FIELD_F64, 1, "m", "what moments are divided by where they are compared with forces")     \
    X(model, plane_model, FIELD_F64, 18, "kg, kg/s", "mass and damping about the centre of mass")              \
    X(gains, pid_gains, FIELD_F64, 9, "", "of the controller")                                                 \
    X(filter, reference_filter, FIELD_F64, 4, "", "of the reference")                                          \
    X(passive, passive_tuning, FIELD_F64, 2, "", "of the passive observer")                                    \
    X(kalman, kalman_tuning, FIELD_F64, 10, "", "of the Kalman filter")                                        \
    X(vaning, vaning, FIELD_F64, 3, "", "of the heading that meets the ice")                                   \
    X(feed_gain, double, FIELD_F64, 1, "1", "share of the load that is fed forward")                           \
    X(feed_time, double, FIELD_F64, 1, "s", "time constant of the smoothed load")                              \
    X(noise, vec3, FIELD_F64, 3, "m, m, rad", "standard deviations of the measurements")                       \
    X(seed, uint64_t, FIELD_U64, 1, "1", "of the noise, the run's and the vessel's own")                       \
    X(reference, reference_state, FIELD_F64, 9, "", "smoothed place that is wanted")                           \
    X(estimate, motion_estimate, FIELD_F64, 9, "", "what the observer believes")                               \
    X(covariance, kalman_covariance, FIELD_F64, 81, "", "of the Kalman filter")                                \
    X(measured, vec3, FIELD_F64, 3, "m, m, rad", "last measurement of the centre of mass and heading")         \
    X(integral, vec3, FIELD_F64, 3, "m s, m s, rad s", "of the deviation, global")                             \
    X(vane_heading, double, FIELD_F64, 1, "rad", "heading that the vaning wants")                              \
    X(load, vec3, FIELD_F64, 3, "N, N, N m", "ice load, smoothed, global")                                     \
    X(demand, vec3, FIELD_F64, 3, "N, N, N m", "force demanded of the thrusters, vessel frame")                \
    X(missed, vec3, FIELD_F64, 3, "N, N, N m", "what the allocation could not give of it")                     \
    X(saturated, uint8_t, FIELD_U8, 1, "1", "the thrusters cannot give the demand")                            \
    X(lost, uint8_t, FIELD_U8, 1, "1", "bit 0: the offset exceeds its limit; bit 1: the heading does")         \
    X(offset, vec3, FIELD_F64, 3, "m, m, rad", "station_deviation at the begin of the last step")              \
    X(mooring_load, wrench, FIELD_F64, 6, "N, N m", "of all lines in the last step, global, about the centre") \
    X(thruster_load, wrench, FIELD_F64, 6, "N, N m", "of all thrusters in the last step, global")
TABLE_DECLARE(station, STATION_FIELDS)

typedef struct station_definition {
    bool positioning;
    observer_kind observer;
    positioning_control control;
    feed_source feed;
    heading_rule heading;
    int64_t control_every, sample_every;
    vec3 watched; /* ship coordinates [m] */
    double offset_limit, heading_limit;
    plane_model model;                         /* about the centre of mass, z up */
    double control_frequency, control_damping; /* of the controller: [rad/s], [1] */
    reference_filter filter;
    passive_tuning passive;
    kalman_tuning kalman;
    vec3 first_speed, first_bias; /* kalman_begin */
    vaning vaning;
    double feed_gain, feed_time;
    vec3 noise;
    uint64_t seed;
} station_definition;

/* The station of a vessel, later than all that have one, which lies where it was made, with all that it believes true.
 */
fram_status station_add(context *ctx, const station_definition *d, int32_t vessel, const vessel_table *vessels,
                        const body_table *bodies, station_table *stations, fram_error *error);
/* What its controller believes and wants begins at the vessel as it lies and moves now; where it shall be, and where
   offsets count from, stay. */
void station_believe(station_table *stations, int32_t row, const vessel_table *vessels, const body_table *bodies);
/* So does how sure it is: of a vessel that was moved after station_add. */
void station_begin(station_table *stations, const station_definition *d, int32_t row, const vessel_table *vessels,
                   const body_table *bodies);
/* Whether a vessel keeps station. */
bool station_is_kept(const station_table *stations, const vessel_table *vessels, int32_t vessel);
/* Of one that does: whether its thrusters assist a mooring, which has the place, whatever x and y are wanted. */
bool station_is_of_heading_alone(const station_table *stations, int32_t vessel);

/* What the step looks like to a station. */
typedef struct station_moment {
    int64_t step;
    int64_t draw; /* number of what is drawn in it: the step of the run, also where that is divided */
    double time, dt;
    wrench ice; /* load on the vessel in the step before, global */
} station_moment;

/* Where the watched point shall be for a target of the ship's origin: where it was at the start, moved with the target,
   and turned with it where the vessel's own controller holds place and heading; not moved where lines hold the place.
 */
vec2 station_watched_place(const station_table *s, int32_t row, const vessel_table *vessels, vec3 target);
/* How far the watched point is from there at a time, along X and Y [m], and the heading from the one that is wanted
   [rad]. */
vec3 station_deviation(const station_table *s, int32_t row, double time, const vessel_table *vessels,
                       const body_table *bodies, const waypoint_table *path);
/* What its observer takes for the load of ice, wind and current [N, N, N m], global: the bias less what the lines pull,
   which a moored ship knows by their tensions.  The bias itself while no controller works. */
vec3 station_load(const station_table *s, int32_t row);
/* Measure, observe, control and give orders to the thrusters, where due; book offset and loss of position. */
fram_status station_step(context *ctx, station_table *stations, int32_t row, const station_moment *now,
                         const vessel_table *vessels, const body_table *bodies, const waypoint_table *path,
                         thruster_table *thrusters, event_table *events, fram_error *error);

#endif
