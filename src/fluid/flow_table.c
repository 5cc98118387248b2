#include "fluid/flow_table.h"

#include "base/transcendental.h"

vec3 flow_coefficients(const flow_table *t, double angle)
{
    double a = angle - 2 * PI * floor(angle / (2 * PI)), last = t->angle[t->count - 1];
    /* The other side of a ship with equal sides: X the same, Y and N the other way. */
    bool mirrored = a > last;
    if (mirrored)
        a = 2 * PI - a;
    int32_t i = 1;
    while (i + 1 < t->count && t->angle[i] < a)
        i++;
    double share = (a - t->angle[i - 1]) / (t->angle[i] - t->angle[i - 1]);
    vec3 c = vec3_mad(vec3_scale(t->coefficient[i - 1], 1 - share), t->coefficient[i], share);
    return mirrored ? vec3_make(c.x, -c.y, -c.z) : c;
}

wrench flow_load(const flow_table *t, double density, mat3 rotation, vec3 past)
{
    /* In the water plane: along the bow's trace, and to port of it. */
    double bow = sqrt(rotation.m[0][0] * rotation.m[0][0] + rotation.m[1][0] * rotation.m[1][0]);
    vec3 ahead = bow > 0 ? vec3_make(rotation.m[0][0] / bow, rotation.m[1][0] / bow, 0) : vec3_make(1, 0, 0);
    vec3 port = vec3_make(-ahead.y, ahead.x, 0);
    double u = vec3_dot(past, ahead), v = vec3_dot(past, port), pressure = 0.5 * density * (u * u + v * v);
    wrench load = {{0, 0, 0}, {0, 0, 0}};
    if (!(pressure > 0))
        return load;
    vec3 c = flow_coefficients(t, real_atan2(v, u));
    load.force = vec3_scale(ahead, c.x * t->frontal * pressure);
    load.force = vec3_mad(load.force, port, c.y * t->lateral * pressure);
    load.moment = vec3_cross(mat3_mul_vec(rotation, t->point), load.force);
    load.moment.z += c.z * t->lateral * t->length * pressure;
    return load;
}
