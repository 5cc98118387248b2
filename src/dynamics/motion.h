/* How a single body moves when nothing touches it.  Inside dynamics. */
#ifndef DYNAMICS_MOTION_H
#define DYNAMICS_MOTION_H

#include "base/simd.h"
#include "bodies/body.h"

/* Groups of eight body slots that a thread moves at a time. */
enum { MOTION_GROUPS = 32 };
static inline int32_t motion_blocks(const body_table *bodies)
{
    return (bodies->count + V8_LANES * MOTION_GROUPS - 1) / (V8_LANES * MOTION_GROUPS);
}

/* Slots of a block: the first, and the end. */
static inline int32_t motion_block_first(int32_t block) { return block * V8_LANES * MOTION_GROUPS; }
static inline int32_t motion_block_end(const body_table *bodies, int32_t block)
{
    int32_t first = motion_block_first(block), left = bodies->count - first;
    return first + (left < V8_LANES * MOTION_GROUPS ? left : V8_LANES * MOTION_GROUPS);
}

/* Rigid and added inertia, body frame [kg m2]. */
sym3 body_total_inertia(const body_table *bodies, int32_t slot);
/* r += dt v, Q += dt/2 (0, Omega) Q, normalised; velocities in the global frame. */
void body_move(body_table *bodies, int32_t slot, vec3 velocity, vec3 angular_velocity, double dt);

#endif
