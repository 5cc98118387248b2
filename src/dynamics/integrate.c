/* Poses from velocities, and the free turning of rigid bodies. */
#include "base/pool.h"
#include "dynamics/motion.h"
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

/* ---- gyroscopic term ---- */

/* I (w' - w) + dt m x (I m) with m = (w + w') / 2: Euler's equations over a step by the midpoint rule, body frame. */
static vec3 spin_error(sym3 inertia, vec3 w, vec3 next, double dt)
{
    vec3 m = vec3_scale(vec3_add(w, next), 0.5);
    return vec3_mad(sym3_mul_vec(inertia, vec3_sub(next, w)), vec3_cross(m, sym3_mul_vec(inertia, m)), dt);
}

/* Its derivative by w': I + dt/2 ([m] I - [I m]), with [v] x = v x x. */
static mat3 spin_slope(sym3 i, vec3 w, vec3 next, double dt)
{
    vec3 m = vec3_scale(vec3_add(w, next), 0.5), l = sym3_mul_vec(i, m);
    double h = 0.5 * dt;
    mat3 s = {{{i.xx, i.xy, i.xz}, {i.xy, i.yy, i.yz}, {i.xz, i.yz, i.zz}}};
    mat3 turned = mat3_mul((mat3){{{0, -m.z, m.y}, {m.z, 0, -m.x}, {-m.y, m.x, 0}}}, s);
    mat3 cross = {{{0, -l.z, l.y}, {l.z, 0, -l.x}, {-l.y, l.x, 0}}};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            s.m[r][c] += h * (turned.m[r][c] - cross.m[r][c]);
    return s;
}

/* Newton iterations; one is enough while |w| dt is small, as it is for ships and ice. */
enum { SPIN_ITERATIONS = 8 };
#define SPIN_TOLERANCE 1e-15

/* Angular velocity after a step without moment, body frame. */
static vec3 spin_freely(sym3 inertia, vec3 w, double dt)
{
    vec3 next = w;
    for (int i = 0; i < SPIN_ITERATIONS; i++) {
        vec3 error = spin_error(inertia, w, next, dt);
        if (vec3_dot(error, error) == 0)
            break;
        vec3 step = mat3_mul_vec(mat3_inverse(spin_slope(inertia, w, next, dt)), error);
        next = vec3_sub(next, step);
        if (vec3_dot(step, step) <= SPIN_TOLERANCE * SPIN_TOLERANCE * vec3_dot(next, next))
            break;
    }
    return next;
}

/* The free motion of a rigid body over dt: turned by dt m with SPEC 9's quaternion step, which is the Cayley map, and
   with the midpoint rule for m; energy and the vector of angular momentum are kept to rounding for any dt (Simo and
   Wong 1991, algorithm C; Lewis and Simo 1994). */
static void move_freely(body_table *bodies, int32_t slot, double dt)
{
    mat3 r = quat_matrix(bodies->orientation[slot]);
    vec3 spin = bodies->angular_velocity[slot], w = mat3_tmul_vec(r, spin);
    vec3 next = spin_freely(body_total_inertia(bodies, slot), w, dt);
    vec3 change = vec3_sub(next, w);
    bool steady = vec3_dot(change, change) == 0;
    if (!steady)
        spin = mat3_mul_vec(r, vec3_mad(w, change, 0.5));
    body_move(bodies, slot, bodies->velocity[slot], spin, dt);
    if (!steady)
        bodies->angular_velocity[slot] = mat3_mul_vec(quat_matrix(bodies->orientation[slot]), next);
}

typedef struct pose_work {
    body_table *bodies;
    double dt;
} pose_work;

static void integrate_block(void *arg, int32_t block, int32_t thread)
{
    const pose_work *work = arg;
    body_table *bodies = work->bodies;
    double dt = work->dt;
    int32_t end = (block + 1) * MOTION_BLOCK < bodies->count ? (block + 1) * MOTION_BLOCK : bodies->count;
    (void)thread;
    for (int32_t i = block * MOTION_BLOCK; i < end; i++) {
        if (bodies->motion[i] == MOTION_DYNAMIC)
            move_freely(bodies, i, dt);
        else if (bodies->motion[i] == MOTION_PRESCRIBED)
            body_move(bodies, i, bodies->velocity[i], bodies->angular_velocity[i], dt);
    }
}

void integrate_poses(context *ctx, body_table *bodies, double dt)
{
    pose_work work = {bodies, dt};
    pool_run(ctx, integrate_block, &work, (bodies->count + MOTION_BLOCK - 1) / MOTION_BLOCK);
}
