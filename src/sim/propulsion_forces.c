#include "sim/propulsion_forces.h"

#include "sim/feed.h"
#include "sim/ice_loads.h"
#include "sim/media_now.h"

vec3 propulsion_damping(const vessel_model *hull, vec3 velocity)
{
    if (!hull->has_hydrodynamics)
        return vec3_make(0, 0, 0);
    pair6 push = matrix6_mul(&hull->hydrodynamics.damping, (pair6){{velocity.x, velocity.y, 0}, {0, 0, velocity.z}});
    return vec3_make(-push.linear.x, -push.linear.y, -push.angular.z);
}

static vec3 damping_now(const model *m, const world *w, int32_t vessel, vec2 water)
{
    int32_t body = w->vessels.body[vessel];
    vec3 past = vec3_sub(w->bodies.velocity[body], vec3_make(water.x, water.y, 0));
    vec3 own = mat3_tmul_vec(quat_matrix(w->bodies.orientation[body]), past);
    return propulsion_damping(&m->vessels.data[vessel], vec3_make(own.x, own.y, w->bodies.angular_velocity[body].z));
}

/* Damping acts afterwards. */
double propulsion_resistance(const model *m, const world *w, int32_t vessel, vec2 water)
{
    int32_t body = w->vessels.body[vessel], row = w->shapes.shapes.solid[w->bodies.shape[body]];
    vec3 bow = mat3_column(quat_matrix(w->bodies.orientation[body]), 0);
    double sum = -damping_now(m, w, vessel, water).x;
    if (row >= 0 && w->scratch.fluid.count > row)
        sum -= vec3_dot(w->scratch.fluid.data[row].water_drag.force, bow);
    return sum;
}

/* Of the water on the hull; the damping of surge is in the resistance. */
static wrench drag_now(const model *m, const world *w, int32_t vessel, vec2 water)
{
    int32_t body = w->vessels.body[vessel], row = w->shapes.shapes.solid[w->bodies.shape[body]];
    wrench out = {{0, 0, 0}, {0, 0, 0}};
    if (m->forces != FORCES_FLUID)
        return out;
    if (row >= 0 && w->scratch.fluid.count > row)
        out = w->scratch.fluid.data[row].water_drag;
    vec3 damping = damping_now(m, w, vessel, water);
    vec3 port = mat3_column(quat_matrix(w->bodies.orientation[body]), 1);
    out.force = vec3_mad(out.force, port, damping.y);
    out.moment.z += damping.z;
    return out;
}

track_place propulsion_comes(const model *m, const world *w, int32_t row, double time, double away)
{
    if (m->boundary != DOMAIN_FEEDING)
        return (track_place){.at = {0, 0}};
    bool ahead = w->propulsion.pattern[row] == PATTERN_AHEAD;
    double distance = ahead ? away : w->propulsion.settings[row].distance;
    return feed_origin(m, &w->inputs, time, distance, w->propulsion.forecast[row]);
}

static double away_from_place(const world *w, int32_t row)
{
    const propulsion_settings *s = &w->propulsion.settings[row];
    vec3 at = w->bodies.position[w->vessels.body[w->propulsion.vessel[row]]];
    return vec2_length(vec2_make(at.x - s->x, at.y - s->y));
}

vec2 propulsion_water(const model *m, const media *now, int32_t vessel)
{
    vec3 current = media_hull_current(now, m->vessels.data[vessel].hydrodynamics.depth);
    return m->forces == FORCES_NONE ? vec2_make(0, 0) : vec2_make(current.x, current.y);
}

/* Over the centre of mass, by the matrix: there Kirchhoff's -a11 u r acts. */
static double surge_height(const vessel_model *hull)
{
    const matrix6 *a = &hull->hydrodynamics.added_mass;
    return hull->has_hydrodynamics && a->m[0][0] > 0 ? a->m[0][4] / a->m[0][0] : 0;
}

/* What the step looks like to a row's propulsion, `drift` being that of the ice. */
static propulsion_moment moment_of(const model *m, const world *w, int32_t row, const media *now, vec2 drift)
{
    int32_t vessel = w->propulsion.vessel[row];
    const vessel_model *hull = &m->vessels.data[vessel];
    vec2 water = propulsion_water(m, now, vessel);
    vec3 ice = last_ice_load(w, vessel).force;
    double time = w->clock.time[0];
    propulsion_moment out = {.time = time,
                             .dt = m->time_step,
                             .water = water,
                             .drift = drift,
                             .comes = propulsion_comes(m, w, row, time, away_from_place(w, row)),
                             .drag = drag_now(m, w, vessel, water),
                             .course_speed = m->course_speed,
                             .ice = {ice.x, ice.y}};
    if (m->forces == FORCES_FLUID) { /* nothing rights a ship without water */
        out.resistance = propulsion_resistance(m, w, vessel, water);
        out.lift_z = -hull->hydrodynamics.depth - hull->centre.z;
        out.steering_z = hull->wash.z;
        out.surge_z = surge_height(hull);
    }
    return out;
}

fram_status propulsion_forces(context *ctx, const model *m, world *w, fram_error *error)
{
    if (w->propulsion.count == 0)
        return FRAM_OK;
    media now = media_now(m, &w->inputs, w->clock.time[0]);
    bool drifts = m->boundary == DOMAIN_FEEDING;
    vec2 drift = drifts ? feed_drift(m, &w->inputs, w->clock.time[0]) : vec2_make(0, 0);
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < w->propulsion.count && status == FRAM_OK; i++) {
        int32_t body = w->vessels.body[w->propulsion.vessel[i]];
        propulsion_moment moment = moment_of(m, w, i, &now, drift);
        status = propulsion_step(ctx, &w->propulsion, i, &moment, &w->vessels, &w->bodies, &w->course,
                                 &w->scratch.loads.data[body], &w->events, error);
    }
    return status;
}
