/* Where the vessel shall be: a path of way points in time, smoothed by a third-order reference filter.  A vec3 is
   (x, y, heading) in the global frame, headings counted on without jumps.  Pure functions. */
#ifndef VESSEL_REFERENCE_H
#define VESSEL_REFERENCE_H

#include "base/table.h"
#include "vessel/plane_motion.h"

#define WAYPOINT_FIELDS(X)                                                        \
    X(vessel, int32_t, FIELD_I32, 1, "1", "row of the vessel")                    \
    X(time, double, FIELD_F64, 1, "s", "from then on; ascending within a vessel") \
    X(place, vec3, FIELD_F64, 3, "m, m, rad", "x, y of the ship's origin and heading")
TABLE_DECLARE(waypoint, WAYPOINT_FIELDS)

typedef struct reference_state {
    vec3 place, velocity, acceleration;
} reference_state;

typedef struct reference_filter {
    double frequency; /* natural [rad/s] */
    double damping;   /* relative [1] */
    double speed;     /* largest, in whatever direction [m/s] */
    double turn;      /* largest turn rate [rad/s] */
} reference_filter;

/* The last way point whose time has come, or `home` before the first. */
vec3 reference_target(const waypoint_table *path, int32_t vessel, vec3 home, double time);
/* eta''' + (2 zeta + 1) w eta'' + (2 zeta + 1) w^2 eta' + w^3 (eta - target) = 0 with speed and turn rate held within
   their largest (Fossen 2011, section 10.2.1); a way from rest to rest is straight, heading goes the short way. */
void reference_step(const reference_filter *f, reference_state *state, vec3 target, double dt);

#endif
