#include "fluid/media.h"

vec3 media_current(const media *m, double height)
{
    const current_profile *p = &m->profile;
    if (p->count == 0)
        return m->current;
    double depth = -height;
    int32_t k = 0;
    while (k < p->count && p->depth[k] <= depth)
        k++;
    if (k == 0)
        return vec3_add(m->current, p->velocity[0]);
    if (k == p->count)
        return vec3_add(m->current, p->velocity[p->count - 1]);
    double share = (depth - p->depth[k - 1]) / (p->depth[k] - p->depth[k - 1]);
    vec3 change = vec3_sub(p->velocity[k], p->velocity[k - 1]);
    return vec3_add(m->current, vec3_mad(p->velocity[k - 1], change, share));
}
