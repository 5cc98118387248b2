#include "sim/feed.h"

#include "base/transcendental.h"
#include "fluid/facet.h"
#include "sim/media_now.h"
#include "vessel/plane_motion.h"

#include <math.h>

feeding_world feed_world(world *w)
{
    return (feeding_world){.feeding = &w->feeding,
                           .pattern = &w->pattern,
                           .copies = &w->pattern_copies,
                           .vertices = &w->pattern_vertices,
                           .bodies = &w->bodies,
                           .shapes = &w->shapes,
                           .floes = &w->floes,
                           .boxes = &w->boxes,
                           .next_number = w->clock.next_floe,
                           .left = w->clock.ice_left,
                           .near = &w->scratch.feeding_near};
}

drift_world feed_sheet(const model *m, world *w)
{
    return (drift_world){&m->sheet,  &m->fracture.tiles, &w->drift, &w->drift_cells,    &w->drift_vertices,
                         &w->bodies, &w->shapes,         &w->floes, w->clock.next_floe, w->clock.ice_left};
}

tile_grid feed_grid(const model *m, const world *w) { return drift_grid(&m->fracture.tiles, &w->drift); }

static vec3 untold_drift(const model *m, const input_table *inputs, double time)
{
    if (m->history.drift.count > 0)
        return velocity_series_at(&m->history.drift, time);
    if (m->drift_given)
        return vec3_make(m->drift.x, m->drift.y, 0);
    media now = media_now(m, inputs, time);
    return media_current(&now, 0);
}

vec2 feed_drift(const model *m, const input_table *inputs, double time)
{
    vec3 drift = input_velocity(inputs, INPUT_DRIFT, untold_drift(m, inputs, time));
    return vec2_make(drift.x, drift.y);
}

/* A drift that is slower brings no ice [m/s]: 0.1 m in a day. */
static const double STILL = 1e-6;
/* Steps in which ice at the drift of now comes, and those in which its way is followed, by the midpoint rule. */
enum { ORIGIN_STEPS = 32, ORIGIN_MOST = 4 * ORIGIN_STEPS };

static double updrift_at(const model *m, const input_table *inputs, double time)
{
    vec2 drift = feed_drift(m, inputs, time);
    return real_atan2(-drift.y, -drift.x);
}

/* The way at a place whose ice comes at a time: in the ice it is where the drift is going to lead. */
static track_place way_of(const model *m, const input_table *inputs, vec2 at, double time, double dt)
{
    double speed = vec2_length(feed_drift(m, inputs, time));
    if (!(speed > STILL))
        return (track_place){.at = at, .heading = real_atan2(at.y, at.x)};
    double turn = updrift_at(m, inputs, time + dt) - updrift_at(m, inputs, time - dt);
    return (track_place){
        .at = at, .heading = updrift_at(m, inputs, time), .curvature = plane_angle(turn) / (2 * dt * speed)};
}

track_place feed_origin(const model *m, const input_table *inputs, double time, double distance, bool forecast)
{
    vec2 from = {0, 0}, drift = feed_drift(m, inputs, time);
    double speed = vec2_length(drift);
    if (!(speed > STILL) || !(distance > 0))
        return (track_place){.at = from};
    if (!forecast)
        return (track_place){.at = vec2_scale(drift, -distance / speed), .heading = updrift_at(m, inputs, time)};
    double dt = distance / (ORIGIN_STEPS * speed);
    for (int i = 0; i < ORIGIN_MOST; i++) {
        vec2 way = vec2_scale(feed_drift(m, inputs, time + (i + 0.5) * dt), -dt), next = vec2_add(from, way);
        if (vec2_length(next) >= distance) {
            double near = vec2_length(from), part = (distance - near) / (vec2_length(next) - near);
            return way_of(m, inputs, vec2_add(from, vec2_scale(way, part)), time + (i + part) * dt, dt);
        }
        from = next;
    }
    return way_of(m, inputs, from, time + ORIGIN_MOST * dt, dt);
}

/* Skin friction of a medium on a plane area [N]. */
static vec2 skin_force(double density, double coefficient, double area, vec3 medium, vec2 body)
{
    vec2 past = {medium.x - body.x, medium.y - body.y};
    return vec2_scale(past, 0.5 * density * coefficient * area * vec2_length(past));
}

/* Water under and air over all ice that moves together, the ice outside the window too. */
static vec2 sheet_fluid(const model *m, const world *w, double time)
{
    if (m->forces != FORCES_FLUID || !isfinite(m->sheet.line_load))
        return (vec2){0, 0};
    media now = media_now(m, &w->inputs, time);
    const drag_coefficients *drag = &m->drag[MATERIAL_ICE];
    double area = w->drift.mass[0] / (m->sheet.ice.material.density * m->sheet.ice.thickness);
    vec2 v = w->drift.velocity[0];
    const floe_definition *ice = &m->sheet.ice;
    double height = prism_current_height(ice->elevation, 0.5 * ice->thickness);
    return vec2_add(skin_force(now.water_density, drag->water_skin, area, media_current(&now, height), v),
                    skin_force(now.air_density, drag->air_skin, area, now.wind, v));
}

void feed_drive(const model *m, world *w, double time)
{
    if (w->drift.count > 0) {
        drift_world sheet = feed_sheet(m, w);
        drift_drive(&sheet, feed_drift(m, &w->inputs, time), sheet_fluid(m, w, time), m->time_step);
    }
    if (w->feeding.count == 0)
        return;
    feeding_world fed = feed_world(w);
    feeding_drive(&fed, feed_drift(m, &w->inputs, time));
}

void feed_load(const model *m, world *w)
{
    drift_world sheet = feed_sheet(m, w);
    drift_load(&sheet, &w->scratch.contacts, m->time_step);
}

fram_status feed_step(context *ctx, const model *m, world *w, fram_error *error)
{
    if (w->drift.count > 0) {
        drift_world sheet = feed_sheet(m, w);
        return drift_step(ctx, w->scratch.plane, &sheet, error);
    }
    feeding_world fed = feed_world(w);
    return feeding_step(ctx, w->scratch.plane, &fed, m->time_step, error);
}
