/* See motion_kernel.h.  What a body does depends on no other in its group. */
#include "dynamics/motion_kernel.h"

#include "base/lanes.h"

/* Lanes of dynamic bodies. */
V8_INLINE v8_mask dynamic_lanes(const body_table *bodies, int32_t slot)
{
    double dynamic[V8_LANES] = {0};
    for (int32_t i = 0; i < V8_LANES && slot + i < bodies->count; i++)
        dynamic[i] = body_is_dynamic(bodies, slot + i) ? 1 : 0;
    return v8_less(v8_set(0), v8_load(dynamic));
}

/* Rigid and added inertia, body frame. */
V8_INLINE void total_inertia(const body_table *bodies, int32_t slot, v8 inertia[6])
{
    lanes_sym3_pick(bodies->inertia + slot, inertia);
    lanes3 added = lanes3_pick(bodies->added_inertia + slot);
    inertia[0] = inertia[0] + added.x;
    inertia[1] = inertia[1] + added.y;
    inertia[2] = inertia[2] + added.z;
}

/* ---- velocities ---- */

/* Velocity change per time. */
V8_INLINE lanes3 acceleration(const body_table *bodies, int32_t slot, const lanes33 *r, lanes3 force)
{
    v8 mass = v8_load(bodies->mass + slot), zero = v8_set(0);
    lanes3 added = lanes3_pick(bodies->added_mass + slot), push = lanes3_scale(force, 1 / mass);
    v8_mask none = v8_less_equal(v8_max(v8_max(v8_abs(added.x), v8_abs(added.y)), v8_abs(added.z)), zero);
    if (v8_all(none))
        return push;
    v8 body[6] = {1 / (mass + added.x), 1 / (mass + added.y), 1 / (mass + added.z), zero, zero, zero}, inverse[6];
    lanes_sym3_rotate(body, r, inverse);
    return lanes3_select(none, push, lanes_sym3_mul(inverse, force));
}

void KERNEL(motion_accelerate)(body_table *bodies, const wrench *loads, double dt, int32_t first, int32_t end)
{
    v8 step = v8_set(dt);
    for (int32_t group = first; group < end; group++) {
        int32_t slot = V8_LANES * group;
        v8_mask dynamic = dynamic_lanes(bodies, slot);
        unsigned lanes = v8_bits(dynamic);
        if (lanes == 0)
            continue;
        wrench last[V8_LANES] = {{{0, 0, 0}, {0, 0, 0}}};
        const wrench *load = loads + slot;
        if (slot + V8_LANES > bodies->count) {
            memcpy(last, load, (size_t)(bodies->count - slot) * sizeof *last);
            load = last;
        }
        v8 part[6];
        for (int i = 0; i < 6; i++)
            part[i] = lanes_pick(&load->force.x, 6, i);
        lanes3 force = {part[0], part[1], part[2]}, moment = {part[3], part[4], part[5]};
        lanes33 r = lanes_quat_matrix(lanes_quat_pick(bodies->orientation + slot));
        v8 inertia[6], inverse[6];
        total_inertia(bodies, slot, inertia);
        lanes_sym3_inverse(inertia, inverse);
        lanes3 push = acceleration(bodies, slot, &r, force);
        lanes3 turn = lanes33_mul(&r, lanes_sym3_mul(inverse, lanes33_tmul(&r, moment)));
        lanes3_put(bodies->velocity + slot, lanes3_mad(lanes3_pick(bodies->velocity + slot), push, step), lanes);
        lanes3_put(bodies->angular_velocity + slot,
                   lanes3_mad(lanes3_pick(bodies->angular_velocity + slot), turn, step), lanes);
    }
}

/* ---- gyroscopic term ---- */

/* I (w' - w) + dt m x (I m) with m = (w + w') / 2: Euler's equations over a step by the midpoint rule, body frame. */
V8_INLINE lanes3 spin_error(const v8 inertia[6], lanes3 w, lanes3 next, v8 dt)
{
    lanes3 m = lanes3_scale(lanes3_add(w, next), v8_set(0.5));
    return lanes3_mad(lanes_sym3_mul(inertia, lanes3_sub(next, w)), lanes3_cross(m, lanes_sym3_mul(inertia, m)), dt);
}

/* Its derivative by w': I + dt/2 ([m] I - [I m]), with [v] x = v x x. */
V8_INLINE lanes33 spin_slope(const v8 i[6], lanes3 w, lanes3 next, v8 dt)
{
    lanes3 m = lanes3_scale(lanes3_add(w, next), v8_set(0.5)), l = lanes_sym3_mul(i, m);
    v8 h = 0.5 * dt, zero = v8_set(0);
    lanes33 s = {{{i[0], i[3], i[4]}, {i[3], i[1], i[5]}, {i[4], i[5], i[2]}}};
    const lanes33 cross = {{{zero, -l.z, l.y}, {l.z, zero, -l.x}, {-l.y, l.x, zero}}};
    for (int c = 0; c < 3; c++) {
        /* Columns of [m] I. */
        lanes3 turned = lanes3_cross(m, (lanes3){s.m[0][c], s.m[1][c], s.m[2][c]});
        s.m[0][c] = s.m[0][c] + h * (turned.x - cross.m[0][c]);
        s.m[1][c] = s.m[1][c] + h * (turned.y - cross.m[1][c]);
        s.m[2][c] = s.m[2][c] + h * (turned.z - cross.m[2][c]);
    }
    return s;
}

/* Newton iterations; one is enough while |w| dt is small, as it is for ships and ice. */
enum { SPIN_ITERATIONS = 8 };
#define SPIN_TOLERANCE 1e-15

/* Angular velocity after a step without moment, body frame; `open`: lanes that are wanted. */
V8_INLINE lanes3 spin_freely(const v8 inertia[6], lanes3 w, v8 dt, v8_mask open)
{
    lanes3 next = w;
    for (int i = 0; i < SPIN_ITERATIONS && v8_any(open); i++) {
        lanes3 error = spin_error(inertia, w, next, dt);
        open &= ~v8_less_equal(lanes3_dot(error, error), v8_set(0));
        if (!v8_any(open))
            break;
        lanes33 slope = spin_slope(inertia, w, next, dt);
        lanes3 step = lanes33_solve(&slope, error);
        next = lanes3_select(open, lanes3_sub(next, step), next);
        open &= ~v8_less_equal(lanes3_dot(step, step), SPIN_TOLERANCE * SPIN_TOLERANCE * lanes3_dot(next, next));
    }
    return next;
}

/* ---- poses ---- */

/* Q + dt/2 (0, Omega) Q, normalised. */
V8_INLINE lanes_quat turned(lanes_quat q, lanes3 spin, v8 dt)
{
    v8 half = 0.5 * dt;
    lanes_quat next = {q.w + half * (0 * q.w - spin.x * q.x - spin.y * q.y - spin.z * q.z),
                       q.x + half * (0 * q.x + spin.x * q.w + spin.y * q.z - spin.z * q.y),
                       q.y + half * (0 * q.y - spin.x * q.z + spin.y * q.w + spin.z * q.x),
                       q.z + half * (0 * q.z + spin.x * q.y - spin.y * q.x + spin.z * q.w)};
    v8 share = 1 / v8_sqrt(next.w * next.w + next.x * next.x + next.y * next.y + next.z * next.z);
    return (lanes_quat){next.w * share, next.x * share, next.y * share, next.z * share};
}

/* The free motion of a rigid body over dt: turned by dt m by the normalised quaternion step, which is the Cayley map,
   and with the midpoint rule for m; energy and the vector of angular momentum are kept to rounding for any dt (Simo and
   Wong 1991, algorithm C; Lewis and Simo 1994). */
void KERNEL(motion_advance)(body_table *bodies, double dt, int32_t first, int32_t end)
{
    v8 step = v8_set(dt), zero = v8_set(0);
    for (int32_t group = first; group < end; group++) {
        int32_t slot = V8_LANES * group;
        v8_mask dynamic = dynamic_lanes(bodies, slot);
        unsigned lanes = v8_bits(dynamic);
        if (lanes == 0)
            continue;
        v8 inertia[6];
        total_inertia(bodies, slot, inertia);
        lanes_quat q = lanes_quat_pick(bodies->orientation + slot);
        lanes33 r = lanes_quat_matrix(q);
        lanes3 spin = lanes3_pick(bodies->angular_velocity + slot), w = lanes33_tmul(&r, spin);
        lanes3 next = spin_freely(inertia, w, step, dynamic), change = lanes3_sub(next, w);
        v8_mask steady = v8_less_equal(lanes3_dot(change, change), zero);
        spin = lanes3_select(steady, spin, lanes33_mul(&r, lanes3_mad(w, change, v8_set(0.5))));
        q = turned(q, spin, step);
        r = lanes_quat_matrix(q);
        lanes3_put(bodies->position + slot,
                   lanes3_mad(lanes3_pick(bodies->position + slot), lanes3_pick(bodies->velocity + slot), step), lanes);
        lanes_quat_put(bodies->orientation + slot, q, lanes);
        lanes3_put(bodies->angular_velocity + slot, lanes33_mul(&r, next), lanes & ~v8_bits(steady));
    }
}
