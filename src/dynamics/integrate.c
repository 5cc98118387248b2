/* Poses from velocities, and the free turning of a rigid body. */
#include "dynamics/motion.h"
#include "dynamics/solver.h"

void body_move(body_table *bodies, int32_t slot, vec3 velocity, vec3 angular_velocity, double dt)
{
    bodies->position[slot] = vec3_mad(bodies->position[slot], velocity, dt);
    quat q = bodies->orientation[slot];
    quat spin = {0, angular_velocity.x, angular_velocity.y, angular_velocity.z}, rate = quat_mul(spin, q);
    double half = 0.5 * dt;
    bodies->orientation[slot] =
        quat_unit((quat){q.w + half * rate.w, q.x + half * rate.x, q.y + half * rate.y, q.z + half * rate.z});
}

void integrate_poses(context *ctx, body_table *bodies, double dt)
{
    (void)ctx;
    for (int32_t i = 0; i < bodies->count; i++)
        if (bodies->motion[i] == MOTION_DYNAMIC || bodies->motion[i] == MOTION_PRESCRIBED)
            body_move(bodies, i, bodies->velocity[i], bodies->angular_velocity[i], dt);
}

/* Solves a x = b by cofactors; a is near the identity times a positive inertia. */
static vec3 solve3(mat3 a, vec3 b) { return mat3_mul_vec(mat3_inverse(a), b); }

/* Implicit midpoint rule on Euler's equations in the body frame: I (w' - w) + dt m x (I m) = 0 with m = (w + w')/2.  It keeps
   the energy w.I w / 2 and |I w|, both quadratic, for any time step; Newton iterations, the first of which is enough
   while |w| dt is small. */
enum { SPIN_ITERATIONS = 6 };
#define SPIN_TOLERANCE 1e-15

vec3 spin_freely(sym3 inertia, vec3 w, double dt)
{
    vec3 next = w;
    for (int i = 0; i < SPIN_ITERATIONS; i++) {
        vec3 m = vec3_scale(vec3_add(w, next), 0.5), l = sym3_mul_vec(inertia, m);
        vec3 error = vec3_mad(sym3_mul_vec(inertia, vec3_sub(next, w)), vec3_cross(m, l), dt);
        /* d error / d next = I + dt/2 ([m] I - [I m]) */
        double h = 0.5 * dt;
        mat3 s = {{{inertia.xx, inertia.xy, inertia.xz},
                   {inertia.xy, inertia.yy, inertia.yz},
                   {inertia.xz, inertia.yz, inertia.zz}}};
        mat3 cross_m = {{{0, -m.z, m.y}, {m.z, 0, -m.x}, {-m.y, m.x, 0}}};
        mat3 cross_l = {{{0, -l.z, l.y}, {l.z, 0, -l.x}, {-l.y, l.x, 0}}};
        mat3 turned = mat3_mul(cross_m, s), slope;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                slope.m[r][c] = s.m[r][c] + h * (turned.m[r][c] - cross_l.m[r][c]);
        vec3 step = solve3(slope, error);
        next = vec3_sub(next, step);
        if (vec3_dot(step, step) <= SPIN_TOLERANCE * SPIN_TOLERANCE * vec3_dot(next, next))
            break;
    }
    return next;
}
