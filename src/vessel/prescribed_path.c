#include "vessel/prescribed_path.h"

#include <float.h>

/* What rounding leaves of coordinates and yaw, as a part of them, 4 to 100 DBL_EPSILON. */
#define PATH_ROUNDING (16 * DBL_EPSILON)

vec3 path_place(const waypoint_table *path, int32_t vessel, double time)
{
    vec3 place = {(double)NAN, (double)NAN, (double)NAN}, before = place;
    double from = 0;
    for (int32_t i = 0; i < path->count; i++) {
        if (path->vessel[i] != vessel)
            continue;
        place = path->place[i];
        if (path->time[i] >= time) {
            if (isnan(before.z))
                return place;
            double share = (time - from) / (path->time[i] - from);
            return vec3_mad(before, vec3_sub(place, before), share);
        }
        before = place;
        from = path->time[i];
    }
    return place;
}

vec3 path_velocity(const waypoint_table *path, int32_t vessel, double time)
{
    int32_t before = -1;
    for (int32_t i = 0; i < path->count; i++) {
        if (path->vessel[i] != vessel)
            continue;
        if (path->time[i] > time && before < 0)
            break;
        if (path->time[i] > time)
            return vec3_scale(vec3_sub(path->place[i], path->place[before]), 1 / (path->time[i] - path->time[before]));
        before = i;
    }
    return (vec3){0, 0, 0};
}

/* Whether a way and a turn (z) are what rounding leaves of the places that they join. */
static bool is_at_rest(vec3 left, vec3 place, vec3 off, double length)
{
    return fabs(left.x) <= PATH_ROUNDING * (fabs(place.x) + fabs(off.x) + length) &&
           fabs(left.y) <= PATH_ROUNDING * (fabs(place.y) + fabs(off.y) + length) &&
           fabs(left.z) <= PATH_ROUNDING * (fabs(place.z) + PI);
}

void vessel_follow(const vessel_table *vessels, const waypoint_table *path, body_table *bodies, double time, double dt)
{
    for (int32_t i = 0; i < vessels->count; i++) {
        vec3 place = path_place(path, i, time);
        if (vessels->mode[i] == VESSEL_FREE || isnan(place.z))
            continue;
        int32_t slot = vessels->mode[i] == VESSEL_TOWED ? vessels->carriage[i] : vessels->body[i];
        vec3 centre = vessels->centre[i], off = plane_to_global(place.z, vec3_make(centre.x, centre.y, 0));
        vec3 at = bodies->position[slot];
        double turn = plane_angle(place.z - quat_roll_pitch_yaw(bodies->orientation[slot]).z);
        vec3 left = vec3_make(place.x + off.x - at.x, place.y + off.y - at.y, turn);
        /* Ice that does not move either bears all that it can against any approach, be it of 1e-13 m/s. */
        if (is_at_rest(left, place, off, vessels->length[i]))
            left = vec3_make(0, 0, 0);
        bodies->velocity[slot] = vec3_make(left.x / dt, left.y / dt, 0);
        bodies->angular_velocity[slot] = vec3_make(0, 0, left.z / dt);
    }
}
