/* Keys of a vessel's hydrodynamics: rows as those of scenario_keys.h, which says what they mean. */
#ifndef MODEL_SCENARIO_WATER_KEYS_H
#define MODEL_SCENARIO_WATER_KEYS_H

#define SCENARIO_HYDRODYNAMICS_KEYS(X)                                                                           \
    X(source, CHOICE(hydrodynamics_source, HYDRODYNAMICS_NONE, "none estimate given"), "",                       \
      "none: pressure and drag alone; estimate: added mass of an ellipsoid of the hull's length, beam and "      \
      "draught, damping by the ratios below; given: the matrices below")                                         \
    X(heave_damping, REAL(0.2, 0, 10), "1", "estimate: linear damping over the critical one")                    \
    X(roll_damping, REAL(0.05, 0, 10), "1", "estimate: linear damping over the critical one")                    \
    X(pitch_damping, REAL(0.2, 0, 10), "1", "estimate: linear damping over the critical one")                    \
    X(axes, CHOICE(matrix_axes, MATRIX_AXES_UP, "up down"), "",                                                  \
      "given: axes of the matrices; up: x forward, y to port, z up; down: x forward, y to starboard, z down")    \
    X(x, REAL(0, -1e4, 1e4), "m", "given: reference point of the matrices, forward of amidships")                \
    X(y, REAL(0, -1e4, 1e4), "m", "given: reference point, to port")                                             \
    X(z, REAL(0, -1e4, 1e4), "m", "given: reference point, above the design waterline")                          \
    X(added_mass, LIST(matrix_row, 6), "", "given: added mass, 6 rows for the forces and moments; none is zero") \
    X(damping, LIST(matrix_row, 6), "", "given: linear damping, 6 rows; none is zero")

#define SCENARIO_MATRIX_ROW_KEYS(X)                                                    \
    X(surge, REAL(0, -1e20, 1e20), "SI", "by surge: kg, kg m, kg m2, or those over s") \
    X(sway, REAL(0, -1e20, 1e20), "SI", "by sway")                                     \
    X(heave, REAL(0, -1e20, 1e20), "SI", "by heave")                                   \
    X(roll, REAL(0, -1e20, 1e20), "SI", "by roll")                                     \
    X(pitch, REAL(0, -1e20, 1e20), "SI", "by pitch")                                   \
    X(yaw, REAL(0, -1e20, 1e20), "SI", "by yaw")

#define SCENARIO_FLOW_ROW_KEYS(X)                                                                  \
    X(angle_deg, REAL(0, 0, 360), "deg",                                                           \
      "of the medium's motion past the vessel, counter-clockwise from the bow: 0 from astern, 90 " \
      "from starboard, 180 from ahead")                                                            \
    X(cx, REAL(0, -100, 100), "1", "force forward over 1/2 rho u^2 and the frontal area")          \
    X(cy, REAL(0, -100, 100), "1", "force to port over 1/2 rho u^2 and the lateral area")          \
    X(cn, REAL(0, -100, 100), "1", "moment counter-clockwise over 1/2 rho u^2, lateral area and length")

#define SCENARIO_FLOW_KEYS(X)                                                                                         \
    X(table, LIST(flow_row, 73), "",                                                                                  \
      "in place of the drag of the hull's faces in the water plane; angles from 0 to 180 (equal sides) or to 360")    \
    X(table_file, PATH(""), "", "CSV of angle [deg], cx, cy, cn [1], instead of the list")                            \
    X(frontal_area, AUTOMATIC(1e-9, 1e9), "m2", "auto: beam times draught (current) or freeboard (wind)")             \
    X(lateral_area, AUTOMATIC(1e-9, 1e9), "m2", "auto: waterline length times draught (current) or freeboard (wind)") \
    X(length, AUTOMATIC(1e-6, 1e5), "m", "auto: of the waterline")                                                    \
    X(x, REAL(0, -1e4, 1e4), "m", "where the forces act, forward of amidships")                                       \
    X(z, AUTOMATIC(-1e4, 1e4), "m",                                                                                   \
      "and above the design waterline; auto: half the draught below (current), half the freeboard above (wind)")

/* Inner sections before those that hold them. */
#define SCENARIO_WATER_SECTIONS(S)          \
    S(flow_row, SCENARIO_FLOW_ROW_KEYS)     \
    S(flow, SCENARIO_FLOW_KEYS)             \
    S(matrix_row, SCENARIO_MATRIX_ROW_KEYS) \
    S(hydrodynamics, SCENARIO_HYDRODYNAMICS_KEYS)

#endif
