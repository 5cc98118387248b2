#include "io/plan_flows.h"

#include "base/transcendental.h"
#include "io/velocity_file.h"

static void add_flow(context *ctx, const scenario *s, const char *name, const char *file, double speed, double towards,
                     double time, plan_flows *out)
{
    velocity_series h = {0};
    vec3 v = {speed * real_cos(radians(towards)), speed * real_sin(radians(towards)), 0};
    if (file[0]) {
        bool read = velocity_file_read(ctx, s, file, &h, NULL) == FRAM_OK && h.count > 0;
        v = read ? velocity_series_at(&h, time) : (vec3){0, 0, 0};
        velocity_series_free(ctx, &h);
    }
    if (v.x * v.x + v.y * v.y > 0)
        out->flow[out->count++] = (plan_flow){name, vec2_make(v.x, v.y)};
}

plan_flows plan_flows_at(context *ctx, const scenario *s, double time)
{
    const scenario_environment *e = &s->environment;
    const ice_drift drift = scenario_drift(s);
    plan_flows out = {.count = 0};
    if (drift.own)
        add_flow(ctx, s, "drift", drift.file, drift.speed, drift.towards_deg, time, &out);
    add_flow(ctx, s, "current", e->current_file, e->current_speed, e->current_direction_deg, time, &out);
    add_flow(ctx, s, "wind", e->wind_file, e->wind_speed, e->wind_direction_deg, time, &out);
    return out;
}
