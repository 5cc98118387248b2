#include "fluid/media.h"

#include <assert.h>

void velocity_series_free(context *ctx, velocity_series *s)
{
    memory_free(ctx, s->time);
    memory_free(ctx, s->velocity);
    *s = (velocity_series){0};
}

void media_history_free(context *ctx, media_history *h)
{
    velocity_series_free(ctx, &h->current);
    velocity_series_free(ctx, &h->wind);
    velocity_series_free(ctx, &h->drift);
    *h = (media_history){0};
}

vec3 velocity_series_at(const velocity_series *s, double time)
{
    assert(s->count > 0);
    /* The last row that is not later: low, or the first one. */
    int32_t low = 0, high = s->count;
    while (high - low > 1) {
        int32_t middle = low + (high - low) / 2;
        if (s->time[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    if (low + 1 == s->count || time <= s->time[low])
        return s->velocity[low];
    double share = (time - s->time[low]) / (s->time[low + 1] - s->time[low]);
    return vec3_mad(s->velocity[low], vec3_sub(s->velocity[low + 1], s->velocity[low]), share);
}

media media_at(const media *still, const media_history *history, double time)
{
    media m = *still;
    if (history->current.count > 0)
        m.current = velocity_series_at(&history->current, time);
    if (history->wind.count > 0)
        m.wind = velocity_series_at(&history->wind, time);
    if (history->profile.count > 0)
        m.profile = history->profile;
    return m;
}

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
