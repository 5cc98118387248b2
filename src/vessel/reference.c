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

/* A speed beyond the largest is shortened to it, and its acceleration loses what would lengthen it. */
static void hold_within(double most, vec3 *v, vec3 *a)
{
    double speed = vec3_length(*v);
    if (!(speed > most))
        return;
    vec3 along = vec3_scale(*v, 1 / speed);
    *v = vec3_scale(along, most);
    *a = vec3_mad(*a, along, -fmax(vec3_dot(*a, along), 0));
}

/* Semi-implicit: the new acceleration moves the speed, the new speed the place. */
static void reference_part(const reference_filter *f, double w, reference_state *s, vec3 target, double dt)
{
    double k = 2 * f->damping + 1;
    vec3 left = vec3_sub(target, s->place);
    left.z = plane_angle(left.z);
    vec3 jerk = vec3_scale(left, w * w * w);
    jerk = vec3_mad(jerk, s->velocity, -k * w * w);
    jerk = vec3_mad(jerk, s->acceleration, -k * w);
    s->acceleration = vec3_mad(s->acceleration, jerk, dt);
    s->velocity = vec3_mad(s->velocity, s->acceleration, dt);
    vec3 v = {s->velocity.x, s->velocity.y, 0}, a = {s->acceleration.x, s->acceleration.y, 0};
    vec3 turn = {0, 0, s->velocity.z}, spin = {0, 0, s->acceleration.z};
    hold_within(f->speed, &v, &a);
    hold_within(f->turn, &turn, &spin);
    s->velocity = vec3_make(v.x, v.y, turn.z);
    s->acceleration = vec3_make(a.x, a.y, spin.z);
    s->place = vec3_mad(s->place, s->velocity, dt);
}

/* Largest product of frequency and step of a part: a critically damped filter diverges from 0.52 on. */
#define REFERENCE_PART 0.25
/* A filter that could do with more parts is where it is sent to by the end of a step, whatever its frequency. */
#define REFERENCE_PARTS 64

void reference_step(const reference_filter *f, reference_state *s, vec3 target, double dt)
{
    double parts = fmin(fmax(ceil(f->frequency * dt / REFERENCE_PART), 1), REFERENCE_PARTS);
    double part = dt / parts, w = fmin(f->frequency, REFERENCE_PART / part);
    for (int i = 0; i < (int)parts; i++)
        reference_part(f, w, s, target, part);
}
