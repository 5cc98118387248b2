/* Joint rows: creation, and the block of locked motions that the solvers treat as one. */
#include "dynamics/joint.h"

#include "dynamics/solver_rows.h"

#include <string.h>

#define TABLE_SELF joint_table
TABLE_DEFINE(joint, JOINT_FIELDS)
#undef TABLE_SELF

static quat quat_conjugate(quat q) { return (quat){q.w, -q.x, -q.y, -q.z}; }

static void attach(const body_table *bodies, int32_t slot, vec3 point, quat axes, vec3 *anchor, quat *frame)
{
    *anchor = slot < 0 ? point : body_to_local(bodies, slot, point);
    *frame = slot < 0 ? axes : quat_mul(quat_conjugate(bodies->orientation[slot]), axes);
}

int32_t joint_create(context *ctx, joint_table *joints, const body_table *bodies, int32_t a, int32_t b, uint32_t locked,
                     vec3 point, quat axes)
{
    if (!table_resize(ctx, joints, &joint_table_info, joints->count + 1))
        return -1;
    int32_t row = joints->count - 1;
    joints->a[row] = a;
    joints->b[row] = b;
    joints->locked[row] = locked;
    attach(bodies, a, point, axes, &joints->anchor_a[row], &joints->frame_a[row]);
    attach(bodies, b, point, axes, &joints->anchor_b[row], &joints->frame_b[row]);
    return row;
}

/* ---- geometry of one joint ---- */

/* Where a joint stands now, global frame. */
typedef struct joint_pose {
    vec3 anchor_a, anchor_b;
    vec3 arm_a, arm_b; /* from the centres of mass to anchor b, where the impulses act on both bodies */
    mat3 axes_a, axes_b;
    quat turned; /* of frame b seen from frame a */
} joint_pose;

static joint_pose pose_of(const body_table *bodies, const joint_table *joints, int32_t row)
{
    int32_t a = joints->a[row], b = joints->b[row];
    joint_pose p;
    quat frame_a = a < 0 ? joints->frame_a[row] : quat_mul(bodies->orientation[a], joints->frame_a[row]);
    quat frame_b = b < 0 ? joints->frame_b[row] : quat_mul(bodies->orientation[b], joints->frame_b[row]);
    p.anchor_a = a < 0 ? joints->anchor_a[row] : body_to_global(bodies, a, joints->anchor_a[row]);
    p.anchor_b = b < 0 ? joints->anchor_b[row] : body_to_global(bodies, b, joints->anchor_b[row]);
    p.arm_a = a < 0 ? p.anchor_b : vec3_sub(p.anchor_b, bodies->position[a]);
    p.arm_b = b < 0 ? p.anchor_b : vec3_sub(p.anchor_b, bodies->position[b]);
    p.axes_a = quat_matrix(frame_a);
    p.axes_b = quat_matrix(frame_b);
    p.turned = quat_mul(quat_conjugate(frame_a), frame_b);
    return p;
}

/* How far the locked turn about axis k has slipped [rad].  With one free axis f the misalignment of that axis is meant,
   which holds for any angle of the hinge; otherwise the rotation vector. */
static double turn_error(const joint_pose *p, uint32_t locked, int k)
{
    uint32_t free_turns = ~(locked >> 3) & 7u;
    if (free_turns == 1 || free_turns == 2 || free_turns == 4) {
        int f = free_turns == 1 ? 0 : free_turns == 2 ? 1 : 2;
        return vec3_dot(vec3_cross(mat3_column(p->axes_a, f), mat3_column(p->axes_b, f)), mat3_column(p->axes_a, k));
    }
    double sign = p->turned.w < 0 ? -2 : 2, part[3] = {p->turned.x, p->turned.y, p->turned.z};
    return sign * part[k];
}

static void add_row(solver *s, joint_block *j, int bit, vec3 direction, vec3 arm_body, vec3 arm_base, double error)
{
    const solver_body *body = &s->bodies.data[j->body], *base = &s->bodies.data[j->base];
    j->axis[j->count] = row_axis_make(body, base, direction, arm_body, arm_base);
    j->motion[j->count] = bit;
    j->error[j->count++] = error;
}

static void add_locked_rows(solver *s, joint_block *j, const joint_pose *p, uint32_t locked)
{
    vec3 gap = vec3_sub(p->anchor_b, p->anchor_a);
    for (int k = 0; k < 3; k++) {
        vec3 axis = mat3_column(p->axes_a, k);
        if (locked >> k & 1u)
            add_row(s, j, k, axis, vec3_cross(p->arm_b, axis), vec3_cross(p->arm_a, axis), vec3_dot(axis, gap));
    }
    for (int k = 0; k < 3; k++) {
        vec3 axis = mat3_column(p->axes_a, k);
        if (locked >> (3 + k) & 1u)
            add_row(s, j, 3 + k, vec3_make(0, 0, 0), axis, axis, turn_error(p, locked, k));
    }
}

/* Semi-implicit spring and damper: impulse = -dt (k (x + dt u) + c u) with u the new rate of length, that is
   u + impulse / (dt (c + dt k)) + k x / (c + dt k) = 0; stable for any stiffness and time step. */
static void add_spring_row(solver *s, joint_block *j, const joint_pose *p, const joint_table *joints, double dt)
{
    double k = joints->stiffness[j->joint], c = joints->damping[j->joint], hardness = c + dt * k;
    vec3 gap = vec3_sub(p->anchor_b, p->anchor_a);
    double length = vec3_length(gap);
    if (!(hardness > 0) || !(length > 0))
        return;
    vec3 axis = vec3_scale(gap, 1 / length);
    add_row(s, j, 0, axis, vec3_cross(p->arm_b, axis), vec3_cross(p->arm_a, axis), 0);
    j->softness = 1 / (dt * hardness);
    j->bias[0] = k * (length - joints->rest_length[j->joint]) / hardness;
}

/* ---- the block ---- */

/* A pivot under this share of its diagonal entry means that the row repeats others; it then carries nothing. */
#define DEPENDENT_ROW 1e-12

static void factorise(joint_block *j)
{
    for (int r = 0; r < j->count; r++) {
        double diagonal = row_axis_coupling(&j->axis[r], &j->axis[r]) + j->softness, pivot = diagonal,
               *l = j->factor[r];
        for (int c = 0; c < r; c++) {
            double sum = row_axis_coupling(&j->axis[r], &j->axis[c]);
            for (int k = 0; k < c; k++)
                sum -= l[k] * j->factor[c][k]; /* l holds L D so far */
            l[c] = sum;
        }
        for (int c = 0; c < r; c++) {
            double scaled = l[c] * j->factor[c][c];
            pivot -= scaled * l[c];
            l[c] = scaled;
        }
        l[r] = pivot > DEPENDENT_ROW * diagonal ? 1 / pivot : 0;
    }
}

/* x becomes the solution of (K + softness) y = x. */
static void block_solve(const joint_block *j, double x[JOINT_MOST_ROWS])
{
    for (int r = 0; r < j->count; r++)
        for (int c = 0; c < r; c++)
            x[r] -= j->factor[r][c] * x[c];
    for (int r = j->count - 1; r >= 0; r--) {
        x[r] *= j->factor[r][r];
        for (int c = r + 1; c < j->count; c++)
            x[r] -= j->factor[c][r] * x[c];
    }
}

static bool is_live(const body_table *bodies, int32_t slot)
{
    return slot < bodies->count && (slot < 0 || body_is_alive(bodies, slot));
}

fram_status joint_rows_make(solver *s, double dt, const body_table *bodies, const joint_table *joints,
                            fram_error *error)
{
    array_clear(&s->joints);
    if (!array_reserve(s->ctx, &s->joints, joints->count))
        return error_memory(error);
    for (int32_t i = 0; i < joints->count; i++) {
        int32_t a = joints->a[i], b = joints->b[i];
        if (!is_live(bodies, a) || !is_live(bodies, b))
            continue;
        bool movable = (a >= 0 && body_is_dynamic(bodies, a)) || (b >= 0 && body_is_dynamic(bodies, b));
        if (!movable)
            continue;
        joint_block *j = &s->joints.data[s->joints.count];
        memset(j, 0, sizeof *j);
        j->joint = i;
        j->base = solver_body_place(s, bodies, a);
        j->body = solver_body_place(s, bodies, b);
        if (j->base < 0 || j->body < 0)
            return error_memory(error);
        joint_pose pose = pose_of(bodies, joints, i);
        if (joints->locked[i] & JOINT_SPRING)
            add_spring_row(s, j, &pose, joints, dt);
        else
            add_locked_rows(s, j, &pose, joints->locked[i]);
        factorise(j);
        s->joints.count++;
    }
    return FRAM_OK;
}

void joint_rows_recall(solver *s, const joint_table *joints)
{
    for (int32_t i = 0; i < s->joints.count; i++) {
        joint_block *j = &s->joints.data[i];
        for (int r = 0; r < j->count; r++)
            j->impulse[r] = joints->impulse[j->joint].row[j->motion[r]];
    }
}

/* What the block's velocities miss, with the sign of the impulse that is wanted. */
static void block_want(const joint_block *j, const solver_body *body, const solver_body *base,
                       double want[JOINT_MOST_ROWS])
{
    for (int r = 0; r < j->count; r++)
        want[r] = -(row_axis_velocity(&j->axis[r], body, base) + j->bias[r] + j->softness * j->impulse[r]);
}

double joint_block_solve(joint_block *j, solver_body *body, solver_body *base)
{
    double want[JOINT_MOST_ROWS], step[JOINT_MOST_ROWS], energy = 0;
    block_want(j, body, base, want);
    memcpy(step, want, sizeof step);
    block_solve(j, step);
    for (int r = 0; r < j->count; r++) {
        row_axis_push(&j->axis[r], body, base, step[r]);
        j->impulse[r] += step[r];
        energy += want[r] * step[r];
    }
    return energy;
}

double joint_row_sweep(solver *s)
{
    double energy = 0;
    for (int32_t i = 0; i < s->joints.count; i++) {
        joint_block *j = &s->joints.data[i];
        energy += joint_block_solve(j, &s->bodies.data[j->body], &s->bodies.data[j->base]);
    }
    return energy;
}

double joint_row_residual(const solver *s, const joint_block *block)
{
    double want[JOINT_MOST_ROWS], largest = 0;
    const solver_body *body = &s->bodies.data[block->body], *base = &s->bodies.data[block->base];
    double lightness = fmax(body->inverse_mass.xx, base->inverse_mass.xx);
    block_want(block, body, base, want);
    for (int r = 0; r < block->count; r++) {
        bool turn = block->motion[r] >= 3;
        double radius = turn ? sqrt(lightness / row_axis_coupling(&block->axis[r], &block->axis[r])) : 1;
        largest = fmax(largest, radius * fabs(want[r]));
    }
    return largest;
}

/* Linear rows act at the anchor on b and have no moment about it; turning rows have no direction. */
static void block_finish(const joint_block *j, double dt, joint_table *joints)
{
    vec3 *force = &joints->reaction_force[j->joint], *moment = &joints->reaction_moment[j->joint];
    for (int r = 0; r < j->count; r++) {
        *force = vec3_mad(*force, j->axis[r].direction, j->impulse[r] / dt);
        if (j->motion[r] >= 3)
            *moment = vec3_mad(*moment, j->axis[r].arm_a, j->impulse[r] / dt);
        joints->impulse[j->joint].row[j->motion[r]] = j->impulse[r];
    }
}

void joint_rows_finish(solver *s, double dt, joint_table *joints)
{
    for (int32_t i = 0; i < joints->count; i++) {
        joints->reaction_force[i] = joints->reaction_moment[i] = vec3_make(0, 0, 0);
        joints->impulse[i] = (joint_impulse){{0}};
    }
    for (int32_t i = 0; i < s->joints.count; i++)
        block_finish(&s->joints.data[i], dt, joints);
    for (int32_t i = 0; i < s->guided.count; i++)
        block_finish(&s->guided.data[i].block, dt, joints);
}

static void block_for_positions(joint_block *j, double rate, double dt)
{
    if (j->softness > 0) /* springs hold no position */
        j->count = 0;
    for (int r = 0; r < j->count; r++)
        j->bias[r] = rate * j->error[r] / dt;
}

void joint_rows_for_positions(solver *s, double rate, double dt)
{
    for (int32_t i = 0; i < s->joints.count; i++)
        block_for_positions(&s->joints.data[i], rate, dt);
    for (int32_t i = 0; i < s->guided.count; i++)
        block_for_positions(&s->guided.data[i].block, rate, dt);
}
