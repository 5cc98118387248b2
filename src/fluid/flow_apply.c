#include "fluid/flow_apply.h"

#include "fluid/hull_load.h"

media flows_media(const media *m, const hull_flows *flows, vec3 velocity)
{
    media own = *m;
    vec3 along = vec3_make(velocity.x, velocity.y, 0);
    if (flows->water.count > 0) {
        own.current = along;
        own.profile.count = 0;
    }
    if (flows->air.count > 0)
        own.wind = along;
    return own;
}

static void add_to(wrench *sum, wrench load)
{
    sum->force = vec3_add(sum->force, load.force);
    sum->moment = vec3_add(sum->moment, load.moment);
}

void flows_add(const media *m, const hull_flows *flows, mat3 rotation, vec3 velocity, fluid_load *load)
{
    vec3 current = media_hull_current(m, flows->depth);
    if (flows->water.count > 0)
        add_to(&load->water_drag, flow_load(&flows->water, m->water_density, rotation, vec3_sub(current, velocity)));
    if (flows->air.count > 0)
        add_to(&load->wind_drag, flow_load(&flows->air, m->air_density, rotation, vec3_sub(m->wind, velocity)));
}

void fluid_apply_flows(context *ctx, const media *m, const drag_coefficients *c, const hull_flows *flows,
                       const body_table *bodies, const shape_store *shapes, int32_t slot, wrench *loads,
                       const fluid_details *details)
{
    if (flows->water.count == 0 && flows->air.count == 0)
        return;
    const fluid_motion state = {bodies->position[slot], quat_matrix(bodies->orientation[slot]), bodies->velocity[slot],
                                bodies->angular_velocity[slot]};
    media own = flows_media(m, flows, state.velocity);
    int32_t row = shapes->shapes.solid[bodies->shape[slot]];
    fluid_load load;
    fluid_load_solid(ctx, &own, c, &shapes->solids->data[row], &state, &load);
    flows_add(m, flows, state.rotation, state.velocity, &load);
    wrench sum = load.hydrostatic;
    add_to(&sum, load.water_drag);
    add_to(&sum, load.wind_drag);
    sum.force.z -= bodies->mass[slot] * m->gravity;
    loads[slot] = sum;
    if (details->volume)
        details->volume[slot] = load.submerged_volume;
    if (details->solids)
        details->solids[row] = load;
    if (details->all)
        details->all[slot] = load;
}
