#include "sim/known_flow.h"

#include "base/transcendental.h"

#include <math.h>

/* One more velocity of a flow that began with `first`. */
static void take_in(known_flow *f, vec3 first, vec3 next)
{
    f->fastest = fmax(f->fastest, vec3_length(next));
    f->steady = f->steady && next.x == first.x && next.y == first.y;
}

/* A history in place of what stands still, and what is on top of either.  Between rows it is linear, so that it is
   fastest at one of them or where the run begins or ends. */
static known_flow flow_of_files(const velocity_series *history, vec3 still, vec3 on_top, double end)
{
    bool told = history->count > 0;
    vec3 first = vec3_add(told ? velocity_series_at(history, 0) : still, on_top);
    double angle = degrees(real_atan2(first.y, first.x));
    known_flow f = {true, true, vec3_length(first), angle < 0 ? angle + 360 : angle};
    for (int32_t i = 0; i < history->count; i++)
        if (history->time[i] > 0 && history->time[i] < end)
            take_in(&f, first, vec3_add(history->velocity[i], on_top));
    if (told)
        take_in(&f, first, vec3_add(velocity_series_at(history, end), on_top));
    return f;
}

static known_flow known_of(const scenario *s, const ice_drift *d, const media_history *read)
{
    if (ice_drift_is_of_keys(d))
        return (known_flow){true, true, d->speed, d->towards_deg};
    if (!read)
        return (known_flow){.known = false};
    const media surface = {.profile = read->profile};
    vec3 on_top = d->own ? vec3_make(0, 0, 0) : media_current(&surface, 0);
    return flow_of_files(d->own ? &read->drift : &read->current, scenario_velocity(d->speed, d->towards_deg), on_top,
                         s->run.duration);
}

known_flow known_drift(const scenario *s, const media_history *read)
{
    const ice_drift drift = scenario_drift(s);
    return known_of(s, &drift, read);
}

known_flow known_current(const scenario *s, const media_history *read)
{
    const ice_drift current = scenario_current(s);
    return known_of(s, &current, read);
}
