/* Keys of the water that a vessel's propellers throw back.  Part of scenario_keys.h, which says what the rows mean. */
#ifndef MODEL_SCENARIO_WASH_KEYS_H
#define MODEL_SCENARIO_WASH_KEYS_H

#define SCENARIO_WASH_KEYS(X)                                                                                         \
    X(active, BOOLEAN(false), "", "the jets of thrusters and propulsion push floes; false: they push the ship alone") \
    X(spread, REAL(0.18, 0.01, 1), "1",                                                                               \
      "width of a jet over distance, C; 0.18 was measured of propellers, 0.081 of nozzles")                           \
    X(reach, REAL(50, 1, 1000), "1", "a jet ends at this many diameters of its propeller")

#define SCENARIO_WASH_SECTIONS(S) S(wash, SCENARIO_WASH_KEYS)

#endif
