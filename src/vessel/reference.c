#include "vessel/reference.h"

#define TABLE_SELF waypoint_table
TABLE_DEFINE(waypoint, WAYPOINT_FIELDS)
#undef TABLE_SELF

vec3 reference_target(const waypoint_table *path, int32_t vessel, vec3 home, double time)
{
    vec3 target = home;
    for (int32_t i = 0; i < path->count; i++)
        if (path->vessel[i] == vessel && path->time[i] <= time)
            target = path->place[i];
    return target;
}

/* Semi-implicit: the new acceleration moves the speed, the new speed the place. */
static void filter_axis(const reference_filter *f, double most, double target, double dt, double *x, double *v,
                        double *a)
{
    double w = f->frequency, k = 2 * f->damping + 1;
    double jerk = w * w * w * (target - *x) - k * w * w * *v - k * w * *a;
    *a += dt * jerk;
    *v += dt * *a;
    if (fabs(*v) > most) {
        *v = *v < 0 ? -most : most;
        *a = 0;
    }
    *x += dt * *v;
}

void reference_step(const reference_filter *f, reference_state *s, vec3 target, double dt)
{
    double heading = s->place.z + plane_angle(target.z - s->place.z);
    filter_axis(f, f->most.x, target.x, dt, &s->place.x, &s->velocity.x, &s->acceleration.x);
    filter_axis(f, f->most.y, target.y, dt, &s->place.y, &s->velocity.y, &s->acceleration.y);
    filter_axis(f, f->most.z, heading, dt, &s->place.z, &s->velocity.z, &s->acceleration.z);
}
