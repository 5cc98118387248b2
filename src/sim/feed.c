#include "sim/feed.h"

#include "sim/media_now.h"

feeding_world feed_world(world *w)
{
    return (feeding_world){&w->feeding, &w->pattern, &w->pattern_vertices, &w->bodies,       &w->shapes,
                           &w->floes,   &w->boxes,   w->clock.next_floe,   w->clock.ice_left};
}

vec2 feed_drift(const model *m, const input_table *inputs, double time)
{
    int32_t told = input_find(inputs, INPUT_DRIFT, 0);
    if (told >= 0)
        return vec2_make(inputs->first[told].x, inputs->first[told].y);
    if (m->history.drift.count > 0) {
        vec3 drift = velocity_series_at(&m->history.drift, time);
        return vec2_make(drift.x, drift.y);
    }
    if (m->drift_given)
        return m->drift;
    media now = media_now(m, inputs, time);
    vec3 current = media_current(&now, 0);
    return vec2_make(current.x, current.y);
}

void feed_drive(const model *m, world *w, double time)
{
    if (w->feeding.count == 0)
        return;
    feeding_world fed = feed_world(w);
    feeding_drive(&fed, feed_drift(m, &w->inputs, time));
}

fram_status feed_step(context *ctx, const model *m, world *w, fram_error *error)
{
    feeding_world fed = feed_world(w);
    return feeding_step(ctx, w->scratch.plane, &fed, m->time_step, error);
}
