#include "sim/wash.h"

#include "base/transcendental.h"
#include "fluid/facet.h"
#include "fluid/jet.h"
#include "sim/media_now.h"
#include "sim/propulsion_forces.h"

/* A propeller works under water: its axis lies at least this part of its diameter down. */
static const double LEAST_DEPTH = 0.5;

/* A propeller as it pushes now. */
typedef struct propeller {
    int32_t vessel;
    vec3 place;    /* body frame, about the centre of mass [m] */
    vec2 push;     /* unit, along the ship and to port: the force on the ship at a positive thrust */
    double thrust; /* [N] */
    double diameter;
} propeller;

/* Whether any part of a floe, within its radius, may lie in a jet. */
static bool in_jet(const jet *j, vec3 centre, double radius)
{
    vec2 off = {centre.x - j->origin.x, centre.y - j->origin.y};
    double x = vec2_dot(off, j->along), y = fabs(vec2_dot(off, vec2_perp(j->along)));
    double far = fmin(x + radius, j->length);
    return far > 0 && x - radius < j->length && y - radius < 0.5 * j->diameter + 3 * j->spread * far;
}

/* What a jet does to a floe; false: nothing. */
static bool push_floe(const model *m, const world *w, const media *now, const jet *j, int32_t body, wrench *out)
{
    const body_table *b = &w->bodies;
    int32_t shape = b->shape[body];
    if (!body_is_free(b, body) || shape < 0 || w->shapes.shapes.kind[shape] != SHAPE_PRISM ||
        !in_jet(j, b->position[body], w->shapes.shapes.radius[shape]))
        return false;
    fluid_motion state = {b->position[body], quat_matrix(b->orientation[body]), b->velocity[body],
                          b->angular_velocity[body]};
    polygon outline = shape_outline(&w->shapes, shape);
    double half = w->shapes.shapes.half_height[shape], z = state.position.z;
    double rise = prism_current_height(z, half * state.rotation.m[2][2]) - z;
    jet_share share = jet_over(j, outline, state.position, state.rotation, rise);
    if (!(share.speed > 0))
        return false;
    media washed = *now;
    washed.current.x += share.speed * j->along.x;
    washed.current.y += share.speed * j->along.y;
    fluid_load with, without;
    fluid_load_prism(&washed, &m->drag[MATERIAL_ICE], outline, half, &state, &with);
    fluid_load_prism(now, &m->drag[MATERIAL_ICE], outline, half, &state, &without);
    out->force = vec3_sub(with.water_drag.force, without.water_drag.force);
    out->moment = vec3_sub(with.water_drag.moment, without.water_drag.moment);
    out->moment = vec3_add(out->moment, vec3_cross(share.arm, out->force));
    return true;
}

static fram_status push_floes(context *ctx, const model *m, world *w, const media *now, const jet *j, double thrust,
                              int32_t vessel, fram_error *error)
{
    double sum = 0;
    array_clear(&w->scratch.wash);
    for (int32_t i = 0; i < w->floes.count; i++) {
        wash_push push = {.body = w->floes.body[i]};
        if (push.body < 0 || !push_floe(m, w, now, j, push.body, &push.load))
            continue;
        rest_wake(&w->bodies, &w->rest, push.body);
        sum += push.load.force.x * j->along.x + push.load.force.y * j->along.y;
        if (!array_push(ctx, &w->scratch.wash, push))
            return error_memory(error);
    }
    double share = sum > thrust ? thrust / sum : 1;
    for (int32_t i = 0; i < w->scratch.wash.count; i++) {
        const wash_push *push = &w->scratch.wash.data[i];
        vec3 force = vec3_scale(push->load.force, share);
        wrench *load = &w->scratch.loads.data[push->body];
        load->force = vec3_add(load->force, force);
        load->moment = vec3_mad(load->moment, push->load.moment, share);
        w->scratch.wash_force.data[vessel] = vec3_add(w->scratch.wash_force.data[vessel], force);
    }
    return FRAM_OK;
}

/* The jet goes where the propeller pushes the ship from. */
static fram_status wash_of(context *ctx, const model *m, world *w, const media *now, const propeller *p,
                           fram_error *error)
{
    const wash_model *settings = &m->vessels.data[p->vessel].wash;
    int32_t body = w->vessels.body[p->vessel];
    mat3 r = quat_matrix(w->bodies.orientation[body]);
    double sign = p->thrust < 0 ? 1 : -1, thrust = fabs(p->thrust);
    vec3 back = mat3_mul_vec(r, vec3_make(sign * p->push.x, sign * p->push.y, 0));
    double level = sqrt(back.x * back.x + back.y * back.y);
    if (!(thrust > 0) || !(level > 0))
        return FRAM_OK;
    jet j = {.along = {back.x / level, back.y / level}, .spread = settings->spread};
    j.origin = vec3_add(w->bodies.position[body], mat3_mul_vec(r, p->place));
    j.origin.z = fmin(j.origin.z, -LEAST_DEPTH * p->diameter);
    j.length = settings->reach * p->diameter;
    vec3 current = media_current(now, j.origin.z), v = w->bodies.velocity[body];
    double way = vec2_dot(vec2_make(current.x - v.x, current.y - v.y), j.along);
    jet_set_thrust(&j, thrust, p->diameter, fmax(way, 0), now->water_density);
    return push_floes(ctx, m, w, now, &j, thrust, p->vessel, error);
}

/* As thruster_step has them act. */
static fram_status wash_of_thrusters(context *ctx, const model *m, world *w, const media *now, int32_t vessel,
                                     fram_error *error)
{
    const thruster_table *t = &w->thrusters;
    fram_status status = FRAM_OK;
    int32_t number = 0;
    for (int32_t i = 0; i < t->count && status == FRAM_OK; i++) {
        if (t->vessel[i] != vessel)
            continue;
        double angle = thruster_push_angle(t, i), diameter = m->vessels.data[vessel].wash.thruster[number++];
        propeller p = {vessel, t->place[i], {real_cos(angle), real_sin(angle)}, t->thrust[i], diameter};
        if (!t->failed[i])
            status = wash_of(ctx, m, w, now, &p, error);
    }
    return status;
}

/* The thrust that propulsion_step gave, with what the water takes of it, shared by the propellers. */
static fram_status wash_of_propulsion(context *ctx, const model *m, world *w, const media *now, int32_t row,
                                      fram_error *error)
{
    const propulsion_table *t = &w->propulsion;
    int32_t vessel = t->vessel[row];
    const wash_model *wash = &m->vessels.data[vessel].wash;
    double gross = t->thrust[row] + propulsion_resistance(m, w, vessel, propulsion_water(m, now, vessel));
    /* A ship that brakes a little still pushes ahead against the water. */
    bool turns = t->phase[row] != PROPULSION_ASTERN && gross > 0;
    double angle = turns ? t->steering[row] : 0;
    fram_status status = FRAM_OK;
    for (int32_t k = 0; k < wash->propellers && status == FRAM_OK; k++) {
        double y = wash->spacing * (k - 0.5 * (wash->propellers - 1));
        propeller p = {vessel,
                       {t->settings[row].steering_x, y, wash->z},
                       {real_cos(angle), -real_sin(angle)},
                       gross / wash->propellers,
                       wash->diameter};
        status = wash_of(ctx, m, w, now, &p, error);
    }
    return status;
}

static bool any_wash(const model *m)
{
    bool any = false;
    for (int32_t v = 0; v < m->vessels.count; v++)
        any = any || m->vessels.data[v].wash.active;
    return any;
}

fram_status wash_forces(context *ctx, const model *m, world *w, fram_error *error)
{
    array_clear(&w->scratch.wash_force);
    if (m->forces != FORCES_FLUID || !any_wash(m))
        return FRAM_OK;
    media now = media_now(m, &w->inputs, w->clock.time[0]);
    if (!array_resize(ctx, &w->scratch.wash_force, w->vessels.count))
        return error_memory(error);
    for (int32_t v = 0; v < w->vessels.count; v++)
        w->scratch.wash_force.data[v] = vec3_make(0, 0, 0);
    fram_status status = FRAM_OK;
    for (int32_t v = 0; v < w->vessels.count && status == FRAM_OK; v++) {
        if (m->vessels.data[v].wash.active)
            status = wash_of_thrusters(ctx, m, w, &now, v, error);
    }
    for (int32_t i = 0; i < w->propulsion.count && status == FRAM_OK; i++) {
        if (m->vessels.data[w->propulsion.vessel[i]].wash.active)
            status = wash_of_propulsion(ctx, m, w, &now, i, error);
    }
    return status;
}
