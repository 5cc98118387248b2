/* A driven hull or towing carriage on a prescribed path.  Knows neither ice nor files. */
#ifndef VESSEL_PRESCRIBED_PATH_H
#define VESSEL_PRESCRIBED_PATH_H

#include "vessel/reference.h"
#include "vessel/vessel.h"

/* Place of the ship's origin and heading at a time: linear between the points, those of the first before it and of the
   last after it; a NaN heading without points of the vessel. */
vec3 path_place(const waypoint_table *path, int32_t vessel, double time);

/* How fast it goes there from this time on [m/s, rad/s]: nothing before its first point and after its last. */
vec3 path_velocity(const waypoint_table *path, int32_t vessel, double time);

/* Velocities of prescribed bodies (carriage or driven hull) whose vessel has a path, for the step that ends at `time`,
   such that they stand on it then: in the place of vessel_drive's.  The hull turns about its centre of mass as the
   heading of the path does.  At rest they are 0: what rounding leaves of place and heading is made up when the path
   goes on. */
void vessel_follow(const vessel_table *vessels, const waypoint_table *path, body_table *bodies, double time, double dt);

#endif
