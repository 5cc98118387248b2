#include "sim/steady_load.h"

#include "vessel/plane_motion.h"

/* Linear damping of the water's motion past the hull, vessel frame. */
static vec3 damping_load(const world *w, int32_t body, const media *m, double heading)
{
    if (!w->has_hydrodynamics || w->bodies.motion[body] != MOTION_DYNAMIC)
        return vec3_make(0, 0, 0);
    vec3 current = media_current(m, fmin(0, w->bodies.position[body].z));
    pair6 past = {plane_to_vessel(heading, current), {0, 0, 0}};
    pair6 push = matrix6_mul(&w->hydrodynamics.damping, past);
    return plane_to_global(heading, vec3_make(push.linear.x, push.linear.y, push.angular.z));
}

vec3 steady_media_load(const step_settings *settings, const world *w, int32_t body, const media *m, double heading)
{
    const mesh *surface = &w->shapes.solids.data[w->shapes.shapes.solid[w->bodies.shape[body]]].surface;
    const fluid_motion still = {.position = w->bodies.position[body],
                                .rotation = quat_matrix(quat_from_roll_pitch_yaw(0, 0, heading))};
    const vec3 rest = {0, 0, 0};
    media panels = flows_media(m, &w->flows, rest);
    fluid_load load;
    fluid_load_mesh(&panels, &settings->drag[MATERIAL_HULL], surface, &still, &load);
    flows_add(m, &w->flows, still.rotation, rest, &load);
    vec3 force = vec3_add(load.water_drag.force, load.wind_drag.force);
    vec3 sum = vec3_make(force.x, force.y, load.water_drag.moment.z + load.wind_drag.moment.z);
    return vec3_add(sum, damping_load(w, body, m, heading));
}
