#include "sim/feed.h"

feeding_world feed_world(world *w)
{
    return (feeding_world){&w->feeding, &w->pattern, &w->pattern_vertices, &w->bodies,       &w->shapes,
                           &w->floes,   &w->boxes,   w->clock.next_floe,   w->clock.ice_left};
}

vec2 feed_drift(const step_settings *settings, const world *w, double time)
{
    if (w->media.drift.count > 0) {
        vec3 drift = velocity_series_at(&w->media.drift, time);
        return vec2_make(drift.x, drift.y);
    }
    if (settings->drift_given)
        return settings->drift;
    media now = media_at(&settings->media, &w->media, time);
    vec3 current = media_current(&now, 0);
    return vec2_make(current.x, current.y);
}

void feed_drive(const step_settings *settings, world *w, double time)
{
    if (w->feeding.count == 0)
        return;
    feeding_world fed = feed_world(w);
    feeding_drive(&fed, feed_drift(settings, w, time));
}

fram_status feed_step(context *ctx, const step_settings *settings, world *w, fram_error *error)
{
    feeding_world fed = feed_world(w);
    return feeding_step(ctx, w->scratch.plane, &fed, settings->time_step, error);
}
