#include "sim/steady_load.h"

#include "vessel/plane_motion.h"

/* The vessel's velocity past the water, its own axes, where it lies still with this heading. */
static vec3 past_water(const model *m, int32_t vessel, const media *now, double heading)
{
    vec3 current = media_hull_current(now, m->vessels.data[vessel].hydrodynamics.depth);
    return vec3_neg(plane_to_vessel(heading, current));
}

/* Matrices act on all motions of a vessel that moves by itself. */
static bool has_matrices(const model *m, const world *w, int32_t vessel)
{
    return m->vessels.data[vessel].has_hydrodynamics && w->bodies.motion[w->vessels.body[vessel]] == MOTION_DYNAMIC;
}

vec3 steady_damping_load(const model *m, const world *w, int32_t vessel, const media *now, double heading)
{
    if (!has_matrices(m, w, vessel))
        return vec3_make(0, 0, 0);
    pair6 past = {vec3_neg(past_water(m, vessel, now, heading)), {0, 0, 0}};
    pair6 push = matrix6_mul(&m->vessels.data[vessel].hydrodynamics.damping, past);
    return plane_to_global(heading, vec3_make(push.linear.x, push.linear.y, push.angular.z));
}

vec3 steady_drag_load(const model *m, const world *w, int32_t vessel, const media *now, double heading)
{
    const hull_flows *flows = &m->vessels.data[vessel].flows;
    int32_t body = w->vessels.body[vessel];
    const mesh *surface = &shape_solid(&w->shapes, w->bodies.shape[body])->surface;
    const fluid_motion still = {.position = w->bodies.position[body],
                                .rotation = quat_matrix(quat_from_roll_pitch_yaw(0, 0, heading))};
    const vec3 rest = {0, 0, 0};
    media panels = flows_media(now, flows, rest);
    fluid_load load;
    fluid_load_mesh(&panels, &m->drag[MATERIAL_HULL], surface, &still, &load);
    flows_add(now, flows, still.rotation, rest, &load);
    vec3 force = vec3_add(load.water_drag.force, load.wind_drag.force);
    double munk = has_matrices(m, w, vessel) && w->vessels.mode[vessel] == VESSEL_FREE
                      ? hydrodynamics_munk(&m->vessels.data[vessel].hydrodynamics, past_water(m, vessel, now, heading))
                      : 0;
    return vec3_make(force.x, force.y, load.water_drag.moment.z + load.wind_drag.moment.z + munk);
}

vec3 steady_media_load(const model *m, const world *w, int32_t vessel, const media *now, double heading)
{
    return vec3_add(steady_drag_load(m, w, vessel, now, heading), steady_damping_load(m, w, vessel, now, heading));
}
