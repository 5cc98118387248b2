/* Keys of what keeps a vessel on station: mooring, thrusters, dynamic positioning, limits.  Part of scenario_keys.h,
   which says what the rows mean. */
#ifndef MODEL_SCENARIO_STATION_KEYS_H
#define MODEL_SCENARIO_STATION_KEYS_H

#define SCENARIO_LINE_POINT_KEYS(X)                                                         \
    X(offset, REAL(0, -1e6, 1e6), "m",                                                      \
      "of the upper end away from the anchor, horizontally, from where it is at the start") \
    X(tension, REAL(0, 0, 1e12), "N", "of the line then, along the straight line between its ends")

#define SCENARIO_MOORING_LINE_KEYS(X)                                                                                  \
    X(kind, CHOICE(line_kind, LINE_CATENARY, "catenary spring table"), "",                                             \
      "catenary: elastic, over a flat bottom; spring: straight, pulls only; table: straight, tension by its offset")   \
    X(count, INTEGER(1, 1, 64), "1", "so many of the kind, spread about the mooring's centre")                         \
    X(spacing_deg, REAL(30, -360, 360), "deg", "count over 1: angle from one to the next")                             \
    X(direction_deg, REAL(0, -360, 360), "deg", "in which the (first) line leads off as the vessel lies at the start") \
    X(fairlead_distance, REAL(0, 0, 1e4), "m", "of the upper end from the mooring's centre")                           \
    X(distance, REAL(1000, 1e-6, 1e6), "m", "of the anchor from the upper end, horizontally")                          \
    X(length, AUTOMATIC(1e-6, 1e6), "m", "unstretched; auto: from the pretension")                                     \
    X(pretension, REAL(1e6, 1e-6, 1e12), "N", "at the upper end as the vessel lies at the start; without a length")    \
    X(weight, REAL(1000, 1e-6, 1e9), "N/m", "catenary: in water")                                                      \
    X(stiffness, REAL(5e8, 1e-6, 1e15), "N, N/m", "catenary: axial stiffness EA; spring: force per length")            \
    X(table, LIST(line_point, 32), "",                                                                                 \
      "table: tensions, linear between rows; the first one's below it, the last slope beyond the last")                \
    X(table_file, PATH(""), "", "table: CSV of offset [m], tension [N], instead of the list")                          \
    X(breaking_load, AUTOMATIC(1e-6, 1e12), "N", "it parts beyond this tension; auto: never")                          \
    X(release_time, AUTOMATIC(0, 1e9), "s", "it is let go then; auto: never")

#define SCENARIO_MOORING_KEYS(X)                                                                               \
    X(depth, REAL(100, 1e-6, 1e5), "m", "of the flat bottom")                                                  \
    X(turret, BOOLEAN(false), "", "the vessel turns freely about the mooring's centre; false: spread mooring") \
    X(x, REAL(0, -1e4, 1e4), "m", "centre of the mooring in ship coordinates, forward of amidships")           \
    X(y, REAL(0, -1e4, 1e4), "m", "to port")                                                                   \
    X(z, REAL(0, -1e4, 1e4), "m", "above the design waterline")                                                \
    X(equilibrium, BOOLEAN(true), "",                                                                          \
      "begin where the lines balance current and wind, not heave, heel and trim; false: where it is put")      \
    X(lines, LIST(mooring_line, 64), "", "the lines, 64 in all")

#define SCENARIO_THRUSTER_KEYS(X)                                                                               \
    X(kind, CHOICE(thruster_kind, THRUSTER_AZIMUTH, "tunnel azimuth main"), "",                                 \
      "tunnel: athwartships; azimuth: turns; main: along the ship, with a rudder or without")                   \
    X(x, REAL(0, -1e4, 1e4), "m", "forward of amidships")                                                       \
    X(y, REAL(0, -1e4, 1e4), "m", "to port")                                                                    \
    X(z, REAL(0, -1e4, 1e4), "m", "above the design waterline")                                                 \
    X(thrust, REAL(1e5, 1e-9, 1e10), "N", "largest thrust; main: ahead")                                        \
    X(thrust_astern, AUTOMATIC(0, 1e10), "N", "tunnel and main: largest thrust the other way; auto: the same")  \
    X(time_constant, SCALED(1, 30, 0.5, 0, 1e4), "s", "of the shaft speed, after which the thrust goes")        \
    X(speed_rate, SCALED(0.2, 30, -0.5, 1e-9, 1e6), "1/s",                                                      \
      "fastest change of the shaft speed, as a part of the largest")                                            \
    X(turn_rate_deg, SCALED(12, 30, -0.5, 1e-9, 1e6), "deg/s", "fastest turn of an azimuth or a rudder")        \
    X(rudder_deg, REAL(0, 0, 60), "deg", "main: largest deflection of the thrust ahead by the rudder; 0: none") \
    X(forbidden_deg, REAL(0, -360, 360), "deg", "azimuth: middle of the forbidden sector, from the bow")        \
    X(forbidden_width_deg, REAL(0, 0, 179), "deg",                                                              \
      "azimuth: width of the forbidden sector, which it may turn across; 0: none")                              \
    X(cost, REAL(1, 1e-9, 1e9), "1", "weight of its thrust in the allocation")                                  \
    X(power, AUTOMATIC(0, 1e12), "W",                                                                           \
      "at the larger of thrust and thrust_astern; auto: 6.25 W/N * sqrt(scale / 30) of that")                   \
    X(diameter, AUTOMATIC(1e-3, 100), "m",                                                                      \
      "of the propeller, for its wash; auto: 45 kPa * scale / 30 of the largest thrust on its disc")            \
    X(failure_time, AUTOMATIC(0, 1e9), "s", "it fails then; auto: never")                                       \
    X(setting, REAL(0, -1, 1), "1", "without positioning: thrust over the largest")                             \
    X(direction_deg, REAL(0, -360, 360), "deg",                                                                 \
      "of an azimuth's thrust, or of a main's that its rudder turns; with positioning: at the start alone")

#define SCENARIO_PATH_POINT_KEYS(X)                                      \
    X(time, REAL(0, 0, 1e9), "s", "at which the ship's origin is there") \
    X(x, REAL(0, -1e7, 1e7), "m", "of the ship's origin")                \
    X(y, REAL(0, -1e7, 1e7), "m", "of the ship's origin")                \
    X(heading_deg, REAL(0, -36000, 36000), "deg", "direction of the bow; whole turns count")

#define SCENARIO_WAYPOINT_KEYS(X)                                                              \
    X(time, REAL(0, 0, 1e9), "s", "from then on, until the next")                              \
    X(x, REAL(0, -1e7, 1e7), "m", "of the ship's origin; not looked at with control: heading") \
    X(y, REAL(0, -1e7, 1e7), "m", "of the ship's origin; not looked at with control: heading") \
    X(heading_deg, REAL(0, -360, 360), "deg", "direction of the bow; not looked at with heading: vaning")

#define SCENARIO_POSITIONING_KEYS(X)                                                                                  \
    X(active, BOOLEAN(false), "", "dynamic positioning holds the vessel, or moves it along the way points")           \
    X(control, CHOICE(positioning_control, CONTROL_PLACE_AND_HEADING, "all heading"), "",                             \
      "all: position and heading; heading: the heading alone, as thrusters assist a mooring that holds the position") \
    X(interval, SCALED(0.5, 30, 0.5, 0, 1e4), "s", "between calls of the controller; at least a time step")           \
    X(sample_interval, SCALED(0.5, 30, 0.5, 0, 1e4), "s",                                                             \
      "between measurements, which are taken at calls: a multiple of interval, if need be the next larger")           \
    X(noise_position, SCALED(0.05, 30, 1, 0, 1e3), "m", "standard deviation of the measured position")                \
    X(noise_heading_deg, REAL(0.05, 0, 90), "deg", "standard deviation of the measured heading")                      \
    X(observer, CHOICE(observer_kind, OBSERVER_PASSIVE, "passive kalman"), "",                                        \
      "passive: nonlinear passive observer without wave filter; kalman: extended Kalman filter")                      \
    X(observer_bandwidth, SCALED(0.2, 30, -0.5, 1e-9, 1e6), "rad/s", "passive: how fast estimates follow")            \
    X(bias_time, SCALED(1000, 30, 0.5, 1e-9, 1e9), "s",                                                               \
      "time constant of the estimated load of ice, wind and current")                                                 \
    X(bias_rate, SCALED(0.001, 30, -0.25, 0, 1e3), "m/s^2.5",                                                         \
      "kalman: how much that load may change, per mass and root of a second")                                         \
    X(force_noise, SCALED(0.0015, 30, 0.25, 0, 1e3), "m/s^1.5",                                                       \
      "kalman: unknown force, per mass, times the root of a second")                                                  \
    X(frequency, SCALED(0.1, 30, -0.5, 1e-9, 1e6), "rad/s", "natural frequency of the controlled vessel")             \
    X(damping, REAL(1, 0, 100), "1", "its relative damping")                                                          \
    X(reference_frequency, SCALED(0.05, 30, -0.5, 1e-9, 1e6), "rad/s", "of the filter that smooths the way points")   \
    X(reference_speed, SCALED(0.5, 30, 0.5, 1e-9, 1e6), "m/s", "largest speed between way points")                    \
    X(reference_turn_rate_deg, SCALED(0.5, 30, -0.5, 1e-9, 1e6), "deg/s", "largest turn rate between way points")     \
    X(feed_forward, CHOICE(feed_source, FEED_NONE, "none measured observed"), "",                                     \
      "of the ice load. measured: the load itself, smoothed; observed: the observer's estimate")                      \
    X(feed_forward_gain, REAL(0.8, 0, 10), "1", "part of the load that is fed forward")                               \
    X(feed_forward_time, SCALED(10, 30, 0.5, 0, 1e6), "s", "measured: time constant of the smoothing")                \
    X(heading, CHOICE(heading_rule, HEADING_FIXED, "fixed vaning"), "",                                               \
      "fixed: as at the start or in the way points; vaning: the bow turns against the load")                          \
    X(vaning_rate_deg, SCALED(0.1, 30, -0.5, 1e-9, 1e6), "deg/s", "fastest turn")                                     \
    X(vaning_time, SCALED(100, 30, 0.5, 1e-9, 1e9), "s", "time constant of the turn: then a third (1/e) is left")     \
    X(vaning_load, SCALED(5e4, 30, 3, 0, 1e12), "N", "the heading stays while the load is smaller")                   \
    X(mass_surge, AUTOMATIC(1e-9, 1e13), "kg", "of the controller's model; auto: mass and added mass")                \
    X(mass_sway, AUTOMATIC(1e-9, 1e13), "kg", "of the controller's model; auto: mass and added mass")                 \
    X(mass_yaw, AUTOMATIC(1e-9, 1e18), "kg m2", "of the controller's model; auto: inertia and added inertia")         \
    X(damping_surge, AUTOMATIC(0, 1e13), "kg/s", "of the controller's model; auto: mass over 100 s at full scale")    \
    X(damping_sway, AUTOMATIC(0, 1e13), "kg/s", "of the controller's model; auto: mass over 50 s at full scale")      \
    X(damping_yaw, AUTOMATIC(0, 1e18), "kg m2/s", "of the controller's model; auto: inertia over 20 s at full scale") \
    X(waypoints, LIST(waypoint, 1000), "", "where the vessel shall be, by time; before the first: where it starts")

#define SCENARIO_STATION_KEYS(X)                                                                          \
    X(offset_limit, AUTOMATIC(0, 1e7), "m",                                                               \
      "position is lost beyond this offset from x, y or the way points; auto: no limit")                  \
    X(heading_limit_deg, AUTOMATIC(0, 180), "deg",                                                        \
      "heading is lost beyond this deviation from heading_deg, the way points or vaning; auto: no limit") \
    X(watch_x, AUTOMATIC(-1e4, 1e4), "m",                                                                 \
      "the point whose offset counts, in ship coordinates; auto: the mooring's centre")                   \
    X(watch_y, AUTOMATIC(-1e4, 1e4), "m", "auto: the mooring's centre")

/* Inner sections before those that hold them. */
#define SCENARIO_STATION_SECTIONS(S)            \
    S(line_point, SCENARIO_LINE_POINT_KEYS)     \
    S(mooring_line, SCENARIO_MOORING_LINE_KEYS) \
    S(path_point, SCENARIO_PATH_POINT_KEYS)     \
    S(mooring, SCENARIO_MOORING_KEYS)           \
    S(thruster, SCENARIO_THRUSTER_KEYS)         \
    S(waypoint, SCENARIO_WAYPOINT_KEYS)         \
    S(positioning, SCENARIO_POSITIONING_KEYS)   \
    S(station, SCENARIO_STATION_KEYS)

#endif
