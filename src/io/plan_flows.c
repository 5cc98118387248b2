#include "io/plan_flows.h"

#include "io/velocity_file.h"

static void add_flow(context *ctx, const scenario *s, const char *name, const ice_drift *f, double time,
                     plan_flows *out)
{
    velocity_series h = {0};
    media surface = {.current = scenario_velocity(f->speed, f->towards_deg)};
    if (f->file[0]) {
        bool read = velocity_file_read(ctx, s, f->file, &h, NULL) == FRAM_OK && h.count > 0;
        surface.current = read ? velocity_series_at(&h, time) : (vec3){0, 0, 0};
        velocity_series_free(ctx, &h);
    }
    if (velocity_profile_read(ctx, s, f->profile, &surface.profile, NULL) != FRAM_OK)
        surface.profile.count = 0;
    vec3 v = media_current(&surface, 0);
    if (v.x * v.x + v.y * v.y > 0)
        out->flow[out->count++] = (plan_flow){name, vec2_make(v.x, v.y)};
}

plan_flows plan_flows_at(context *ctx, const scenario *s, double time)
{
    const scenario_environment *e = &s->environment;
    const ice_drift drift = scenario_drift(s), current = scenario_current(s);
    const ice_drift wind = {e->wind_file, "", e->wind_speed, e->wind_direction_deg, false, false};
    plan_flows out = {.count = 0};
    if (drift.own)
        add_flow(ctx, s, "drift", &drift, time, &out);
    add_flow(ctx, s, "current", &current, time, &out);
    add_flow(ctx, s, "wind", &wind, time, &out);
    return out;
}
