/* Motion in the water plane: surge, sway, yaw.  A vec3 holds (x, y, heading) of a place in the global frame, or (surge,
   sway, yaw) of a velocity or a force in the vessel's frame (x forward, y to port, counter-clockwise).  A mat3 holds a
   mass or damping matrix in the same order (Fossen 2011, chapter 7: M v' + D v = tau). */
#ifndef VESSEL_PLANE_MOTION_H
#define VESSEL_PLANE_MOTION_H

#include "base/transcendental.h"
#include "base/vec.h"

typedef struct plane_model {
    mat3 mass;    /* with added mass [kg, kg m, kg m2] */
    mat3 damping; /* linear [kg/s, kg m/s, kg m2/s] */
} plane_model;

/* An angle brought into [-pi, pi). */
static inline double plane_angle(double a) { return a - 2 * PI * floor((a + PI) / (2 * PI)); }
/* Global from vessel components, and back; the third component stays. */
static inline vec3 plane_to_global(double heading, vec3 v)
{
    double c = real_cos(heading), s = real_sin(heading);
    return vec3_make(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
}
static inline vec3 plane_to_vessel(double heading, vec3 v)
{
    double c = real_cos(heading), s = real_sin(heading);
    return vec3_make(c * v.x + s * v.y, c * v.y - s * v.x, v.z);
}
/* Between the places of a ship's origin and its centre of mass, which is at `centre` from the origin in its frame. */
static inline vec3 plane_place_of_centre(vec3 centre, vec3 origin)
{
    vec3 off = plane_to_global(origin.z, vec3_make(centre.x, centre.y, 0));
    return vec3_make(origin.x + off.x, origin.y + off.y, origin.z);
}
static inline vec3 plane_place_of_origin(vec3 centre, vec3 place)
{
    vec3 back = plane_to_global(place.z, vec3_make(centre.x, centre.y, 0));
    return vec3_make(place.x - back.x, place.y - back.y, place.z);
}
/* A speed that grows evenly over a ramp is worth so much of its full time [s]. */
static inline double plane_ramped(double time, double ramp)
{
    return time < ramp ? time * time / (2 * ramp) : time - 0.5 * ramp;
}
static inline vec3 plane_diagonal(mat3 m) { return vec3_make(m.m[0][0], m.m[1][1], m.m[2][2]); }
static inline vec3 plane_times(vec3 a, vec3 b) { return vec3_make(a.x * b.x, a.y * b.y, a.z * b.z); }

#endif
