#include "ice/surface_frame.h"

void surface_frame_set(patch_surface *surface, const body_table *bodies, int32_t mover, int32_t floe,
                       const mat3 *rotation, bool moves, double rest)
{
    mat3 to_global = quat_matrix(bodies->orientation[mover]);
    surface->rotation = mat3_mul(mat3_transpose(*rotation), to_global);
    surface->offset = mat3_tmul_vec(*rotation, vec3_sub(bodies->position[mover], bodies->position[floe]));
    surface->slip = surface->turn = (vec3){0, 0, 0};
    surface->rest = rest;
    if (!moves)
        return;
    vec3 there = body_point_velocity(bodies, mover, bodies->position[floe]);
    surface->slip = mat3_tmul_vec(*rotation, vec3_sub(there, bodies->velocity[floe]));
    vec3 turn = vec3_sub(bodies->angular_velocity[mover], bodies->angular_velocity[floe]);
    surface->turn = mat3_tmul_vec(*rotation, turn);
}
