/* Poses from velocities, and the free turning of rigid bodies. */
#include "base/pool.h"
#include "dynamics/motion.h"
#include "dynamics/motion_kernel.h"
#include "dynamics/solver.h"

sym3 body_total_inertia(const body_table *bodies, int32_t slot)
{
    sym3 inertia = bodies->inertia[slot];
    vec3 added = bodies->added_inertia[slot];
    inertia.xx += added.x;
    inertia.yy += added.y;
    inertia.zz += added.z;
    return inertia;
}

void body_move(body_table *bodies, int32_t slot, vec3 velocity, vec3 angular_velocity, double dt)
{
    bodies->position[slot] = vec3_mad(bodies->position[slot], velocity, dt);
    quat q = bodies->orientation[slot];
    quat spin = {0, angular_velocity.x, angular_velocity.y, angular_velocity.z}, rate = quat_mul(spin, q);
    double half = 0.5 * dt;
    bodies->orientation[slot] =
        quat_unit((quat){q.w + half * rate.w, q.x + half * rate.x, q.y + half * rate.y, q.z + half * rate.z});
}

typedef struct pose_work {
    context *ctx;
    body_table *bodies;
    double dt;
} pose_work;

static void integrate_block(void *arg, int32_t block, int32_t thread)
{
    const pose_work *work = arg;
    body_table *bodies = work->bodies;
    int32_t first = motion_block_first(block), end = motion_block_end(bodies, block);
    (void)thread;
    if (body_slots_stand(bodies, first, end))
        return;
    KERNEL_PICK(work->ctx, motion_advance)(bodies, work->dt, first / V8_LANES, (end + V8_LANES - 1) / V8_LANES);
    for (int32_t i = first; i < end; i++) {
        if (bodies->motion[i] == MOTION_PRESCRIBED || bodies->motion[i] == MOTION_CARRIED)
            body_move(bodies, i, bodies->velocity[i], bodies->angular_velocity[i], work->dt);
        else if (bodies->motion[i] == MOTION_ASLEEP)
            bodies->position[i] = vec3_mad(bodies->position[i], bodies->velocity[i], work->dt);
    }
}

void integrate_poses(context *ctx, body_table *bodies, double dt)
{
    pose_work work = {ctx, bodies, dt};
    pool_run(ctx, integrate_block, &work, motion_blocks(bodies));
}
