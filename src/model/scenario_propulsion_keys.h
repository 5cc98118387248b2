/* Keys of a vessel that drives itself: net thrust, steering, way points and patterns, ramming; and of vessels that
   are going to meet.  Part of
   scenario_keys.h, which says what the rows mean. */
#ifndef MODEL_SCENARIO_PROPULSION_KEYS_H
#define MODEL_SCENARIO_PROPULSION_KEYS_H

#define SCENARIO_COURSE_POINT_KEYS(X)                      \
    X(x, REAL(0, -1e7, 1e7), "m", "of the centre of mass") \
    X(y, REAL(0, -1e7, 1e7), "m", "of the centre of mass")

#define SCENARIO_PATTERN_KEYS(X)                                                                                  \
    X(kind, CHOICE(pattern_kind, PATTERN_NONE, "none line across circle square sector ahead"), "",                \
      "line: updrift and back; across: to and fro across the drift; circle, square: about a centre updrift; "     \
      "sector: to and fro on an arc about the place; ahead: updrift, on and on")                                  \
    X(x, REAL(0, -1e7, 1e7), "m", "place that the pattern is updrift of: that of the vessel it protects")         \
    X(y, REAL(0, -1e7, 1e7), "m", "of that place")                                                                \
    X(distance, REAL(500, 1e-3, 1e6), "m", "updrift of it: of the middle, of the near end of a line, of the arc") \
    X(width, REAL(200, 1e-3, 1e6), "m", "length of a line or an arc, diameter of a circle, side of a square")     \
    X(aside, REAL(0, -1e6, 1e6), "m", "all of it is moved so far to port of updrift")                             \
    X(forecast, BOOLEAN(false), "",                                                                               \
      "it points to where the ice is now that comes to the place as the drift turns, not against the drift")      \
    X(period, AUTOMATIC(1e-3, 1e7), "s", "of a round, which gives the speed that is wanted; auto: propulsion.speed")

#define SCENARIO_PROPULSION_KEYS(X)                                                                                  \
    X(bollard_pull, AUTOMATIC(1e-6, 1e12), "N", "thrust at no speed and full power; auto: no such propulsion")       \
    X(open_water_speed, REAL(8, 1e-3, 100), "m/s", "at full power, where the net thrust has fallen to nothing")      \
    X(power, REAL(1, 1e-3, 1), "1",                                                                                  \
      "share of full power: bollard pull goes with its 2/3, open-water speed with its 1/3")                          \
    X(astern, REAL(0.7, 0, 1), "1", "bollard pull astern over that ahead")                                           \
    X(speed, AUTOMATIC(0, 100), "m/s", "over the ground that is wanted; auto: as fast as it goes")                   \
    X(rudder_area, AUTOMATIC(0, 1e4), "m2",                                                                          \
      "of all rudders, in the race of the propellers; auto: the least by rule; 0: none, the thrust itself turns")    \
    X(steering_angle_deg, REAL(35, 0, 90), "deg", "largest angle of the rudders, or of the thrust")                  \
    X(steering_rate_deg, SCALED(2.5, 30, -0.5, 1e-3, 1e3), "deg/s", "at which that angle changes")                   \
    X(steering_x, AUTOMATIC(-1e4, 1e4), "m",                                                                         \
      "where rudders and thrust act, forward of the centre of mass; auto: -0.45 lengths")                            \
    X(lookahead, AUTOMATIC(1e-3, 1e5), "m",                                                                          \
      "how gently the autopilot comes back to its track: no less than it needs; auto: 2.5 lengths")                  \
    X(turning_radius, AUTOMATIC(1e-3, 1e6), "m",                                                                     \
      "of rounded corners and loops of its track, if larger than what it does in open water; auto: that")            \
    X(track_limit, AUTOMATIC(0, 1e6), "m", "track error beyond which it is off its track, an event; auto: its beam") \
    X(beset_speed, SCALED(0.1, 30, 0.5, 1e-6, 100), "m/s", "a ship that pushes and is slower in the ice ...")        \
    X(beset_time, SCALED(20, 30, 0.5, 1e-3, 1e6), "s", "... for so long is beset: it backs, and rams")               \
    X(ram_distance, AUTOMATIC(1e-3, 1e5), "m", "it backs so far; auto: its length")                                  \
    X(propellers, INTEGER(1, 1, 4), "1",                                                                             \
      "that share the thrust: for their wash, and for the race that meets the rudders")                              \
    X(propeller_diameter, AUTOMATIC(1e-3, 100), "m",                                                                 \
      "of each; auto: 45 kPa * scale / 30 of bollard pull on their discs")                                           \
    X(propeller_spacing, AUTOMATIC(0, 1e3), "m", "between their axes; auto: 1.5 diameters")                          \
    X(propeller_z, AUTOMATIC(-1e3, 0), "m",                                                                          \
      "of their axes, at which rudders push too, above the design waterline; auto: -0.6 draughts")                   \
    X(waypoints, LIST(course_point, 1000), "",                                                                       \
      "steered for one after the other; after the last the leg goes on; none: the heading is kept")                  \
    X(pattern, SECTION(pattern), "", "of ice management, in place of way points; it turns with the drift")

#define SCENARIO_APPROACH_KEYS(X)                                                                                \
    X(limit, AUTOMATIC(0, 1e6), "m",                                                                             \
      "clear distance to any other hull; an event tells that at present velocities it will be less; auto: none") \
    X(look_ahead, REAL(300, 1e-3, 1e5), "s", "how far ahead it is looked")

#define SCENARIO_PROPULSION_SECTIONS(S)         \
    S(approach, SCENARIO_APPROACH_KEYS)         \
    S(course_point, SCENARIO_COURSE_POINT_KEYS) \
    S(pattern, SCENARIO_PATTERN_KEYS)           \
    S(propulsion, SCENARIO_PROPULSION_KEYS)

#endif
