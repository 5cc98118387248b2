#include "ice/surface_frame.h"

/* A hull that goes by less than this many contact skins in a second rests: the solver leaves such velocities behind,
   and they have no direction, 1 mm/s in full size [1/s].  Range 1 to 100. */
static const double REST_SKINS = 10;

void surface_frame_set(patch_surface *surface, const body_table *bodies, int32_t mover, int32_t floe,
                       const mat3 *rotation, bool moves, double skin)
{
    mat3 to_global = quat_matrix(bodies->orientation[mover]);
    surface->rotation = mat3_mul(mat3_transpose(*rotation), to_global);
    surface->offset = mat3_tmul_vec(*rotation, vec3_sub(bodies->position[mover], bodies->position[floe]));
    surface->slip = surface->turn = (vec3){0, 0, 0};
    surface->rest = REST_SKINS * skin;
    if (!moves)
        return;
    vec3 there = body_point_velocity(bodies, mover, bodies->position[floe]);
    surface->slip = mat3_tmul_vec(*rotation, vec3_sub(there, bodies->velocity[floe]));
    vec3 turn = vec3_sub(bodies->angular_velocity[mover], bodies->angular_velocity[floe]);
    surface->turn = mat3_tmul_vec(*rotation, turn);
}
