/* The multibody solve of one step and the position correction, told in their order. */
#include "dynamics/solver.h"

#include "dynamics/motion.h"
#include "dynamics/solver_rows.h"

#include <assert.h>
#include <string.h>

solver *solver_create(context *ctx)
{
    solver *s = memory_array(ctx, 1, sizeof *s);
    if (s)
        s->ctx = ctx;
    return s;
}

void solver_free(context *ctx, solver *s)
{
    if (!s)
        return;
    array_free(ctx, &s->bodies);
    array_free(ctx, &s->place);
    array_free(ctx, &s->contacts);
    array_free(ctx, &s->joints);
    array_free(ctx, &s->guided);
    array_free(ctx, &s->before);
    array_free(ctx, &s->direction);
    array_free(ctx, &s->island);
    array_free(ctx, &s->gain);
    array_free(ctx, &s->recalled);
    array_free(ctx, &s->picked);
    array_free(ctx, &s->carriers);
    memory_free(ctx, s->entries);
    fast_rows_free(ctx, s->fast);
    memory_free(ctx, s);
}

/* ---- velocities ---- */

static fram_status iterate(solver *s, const solver_settings *settings, int32_t *iterations, fram_error *error)
{
    *iterations = 0;
    if (s->contacts.count == 0 && s->joints.count == 0)
        return FRAM_OK;
    if (settings->kind == SOLVER_ACCURATE)
        return solver_iterate_accurately(s, settings, iterations) == FRAM_OK ? FRAM_OK : error_memory(error);
    for (; *iterations < settings->iterations; ++*iterations) {
        joint_row_sweep(s);
        contact_row_sweep(s, *iterations % 2 > 0);
    }
    return FRAM_OK;
}

static void write_velocities(const solver *s, body_table *bodies)
{
    for (int32_t i = 0; i < s->bodies.count; i++) {
        const solver_body *b = &s->bodies.data[i];
        if (b->slot < 0 || !body_is_dynamic(bodies, b->slot))
            continue;
        bodies->velocity[b->slot] = b->velocity;
        bodies->angular_velocity[b->slot] = b->angular_velocity;
    }
}

static double largest_contact_residual(const solver *s)
{
    double largest = 0;
    for (int32_t i = 0; i < s->contacts.count; i++)
        largest = fmax(largest, contact_row_residual(s, &s->contacts.data[i]));
    return largest;
}

static void report_depths(const contact_array *contacts, solver_report *r)
{
    r->overlapping = 0;
    r->mean_depth = r->max_depth = 0;
    for (int32_t i = 0; i < contacts->count; i++) {
        if (contacts->data[i].depth < 0)
            continue;
        r->overlapping++;
        r->mean_depth += contacts->data[i].depth;
        r->max_depth = contacts->data[i].depth > r->max_depth ? contacts->data[i].depth : r->max_depth;
    }
    if (r->overlapping > 0)
        r->mean_depth /= r->overlapping;
}

/* The sequential and the accurate solver. */
static fram_status solve_in_order(solver *s, const solver_settings *settings, double dt, body_table *bodies,
                                  const wrench *loads, joint_table *joints, contact_array *contacts,
                                  contact_memory_table *memory, solver_report *report, fram_error *error)
{
    if (!solver_bodies_begin(s, bodies))
        return error_memory(error);
    fram_status status = solver_joints_make(s, dt, bodies, joints, error);
    if (status == FRAM_OK)
        status = contact_rows_make(s, settings, dt, bodies, contacts, error);
    if (status != FRAM_OK)
        return status;
    bodies_accelerate(s->ctx, bodies, loads, dt);
    guided_bodies_drive(s, bodies);
    solver_bodies_load(s, bodies);
    if (settings->warm_start) {
        joint_rows_recall(s, joints);
        if (!contact_rows_recall(s, contacts, memory) || !solver_warm_start(s))
            return error_memory(error);
    }
    contact_rows_reach_caps(s, bodies, contacts);
    int32_t iterations;
    status = iterate(s, settings, &iterations, error);
    if (status != FRAM_OK)
        return status;
    write_velocities(s, bodies);
    report->iterations = iterations;
    report->residual = largest_contact_residual(s);
    status = contact_rows_finish(s, bodies, contacts, memory, error);
    if (status == FRAM_OK && !guided_bodies_load(s, bodies, contacts))
        return error_memory(error);
    joint_rows_finish(s, dt, joints);
    return status;
}

#ifndef NDEBUG
/* What whoever writes contacts and joints owes the solver. */
static void assert_input(const body_table *bodies, const joint_table *joints, const contact_array *contacts)
{
    enum { WORLD = -1 };
    const double rounding = 1e-9; /* of unit vectors */
    for (int32_t i = 0; i < bodies->count; i++) {
        quat q = bodies->orientation[i];
        double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
        assert(!body_is_alive(bodies, i) || fabs(square - 1) < rounding);
    }
    for (int32_t i = 0; i < joints->count; i++) {
        assert(joints->a[i] >= WORLD && joints->a[i] < bodies->count);
        assert(joints->b[i] >= WORLD && joints->b[i] < bodies->count);
    }
    for (int32_t i = 0; i < contacts->count; i++) {
        const contact *c = &contacts->data[i];
        vec3 t1, t2;
        contact_tangents(c->normal, &t1, &t2);
        assert(c->a >= 0 && c->a < bodies->count && c->b >= 0 && c->b < bodies->count && c->a != c->b);
        assert(body_is_alive(bodies, c->a) && body_is_alive(bodies, c->b));
        assert(fabs(vec3_dot(c->normal, c->normal) - 1) < rounding);
        assert(fabs(vec3_dot(t1, t1) - 1) < rounding && fabs(vec3_dot(t2, t2) - 1) < rounding);
        assert(fabs(vec3_dot(t1, t2)) < rounding && fabs(vec3_dot(t1, c->normal)) < rounding &&
               fabs(vec3_dot(t2, c->normal)) < rounding);
        assert(c->impulse_limit >= 0 && c->friction_static >= 0 && c->friction_kinetic >= 0 && isfinite(c->depth));
    }
}
#endif

fram_status solver_solve(context *ctx, solver *s, const solver_settings *settings, double dt, body_table *bodies,
                         const wrench *loads, joint_table *joints, contact_array *contacts,
                         contact_memory_table *memory, solver_report *report, fram_error *error)
{
    s->ctx = ctx;
    solver_report unread;
    report = report ? report : &unread;
    fram_status status = bodies_check(ctx, bodies, error);
    if (status != FRAM_OK)
        return status;
#ifndef NDEBUG
    assert_input(bodies, joints, contacts);
#endif
    if (settings->kind == SOLVER_FAST)
        status = solver_solve_fast(s, settings, dt, bodies, loads, joints, contacts, memory, report, error);
    else if (settings->kind == SOLVER_SEQUENTIAL || settings->kind == SOLVER_ACCURATE)
        status = solve_in_order(s, settings, dt, bodies, loads, joints, contacts, memory, report, error);
    else
        status = error_set(error, FRAM_ERROR_UNSUPPORTED, NULL, 0, NULL, "there is no solver number %d",
                           (int)settings->kind);
    report_depths(contacts, report);
    return status;
}

/* ---- positions ---- */

/* Normal rows only, wanting the speed that takes away its share of the overlap within the step. */
static bool make_correction_rows(solver *s, const solver_settings *settings, double dt, const body_table *bodies,
                                 const contact_array *contacts)
{
    array_clear(&s->contacts);
    if (!array_reserve(s->ctx, &s->contacts, contacts->count))
        return false;
    for (int32_t i = 0; i < contacts->count && !settings->baumgarte; i++) {
        const contact *c = &contacts->data[i];
        if (!c->correct || (!body_is_dynamic(bodies, c->a) && !body_is_dynamic(bodies, c->b)))
            continue;
        contact_row *row = &s->contacts.data[s->contacts.count++];
        memset(row, 0, sizeof *row);
        row->contact = i;
        row->a = solver_body_place(s, bodies, c->a);
        row->b = solver_body_place(s, bodies, c->b);
        if (row->a < 0 || row->b < 0)
            return false;
        /* The arms of the solve: bodies have moved since, and not all by the same way (Galileo's symmetry). */
        row->axis[0] = row_axis_make(&s->bodies.data[row->a], &s->bodies.data[row->b], c->normal,
                                     vec3_cross(c->arm_a, c->normal), vec3_cross(c->arm_b, c->normal));
        row->normal_mass = 1 / contact_row_coupling(row, &s->bodies.data[row->a], &s->bodies.data[row->b], 0, 0);
        row->limit = HUGE_VAL;
        row->bias = correction_velocity(c, settings, dt);
    }
    return true;
}

/* Overlaps shrink by ever smaller steps: what is under this share of the skin is not worth one. */
#define SKIN_SLACK 0.01

static bool correction_needed(const solver_settings *settings, const joint_table *joints, const contact_array *contacts)
{
    bool needed = joints->count > 0;
    for (int32_t i = 0; i < contacts->count && !needed && !settings->baumgarte; i++)
        needed = contacts->data[i].correct && contacts->data[i].depth > SKIN_SLACK * settings->contact_skin;
    return needed;
}

fram_status solver_correct_positions(context *ctx, solver *s, const solver_settings *settings, double dt,
                                     body_table *bodies, const joint_table *joints, const contact_array *contacts,
                                     fram_error *error)
{
    if (!correction_needed(settings, joints, contacts))
        return FRAM_OK;
    s->ctx = ctx;
    if (settings->kind == SOLVER_FAST)
        return solver_correct_fast(s, settings, dt, bodies, joints, contacts, error);
    if (!solver_bodies_begin(s, bodies))
        return error_memory(error);
    fram_status status = solver_joints_make(s, dt, bodies, joints, error);
    if (status != FRAM_OK)
        return status;
    if (!make_correction_rows(s, settings, dt, bodies, contacts))
        return error_memory(error);
    joint_rows_for_positions(s, settings->correction_rate, dt);
    /* Pseudo velocities start from rest and are forgotten: no kinetic energy is added. */
    for (int32_t i = 0; i < s->bodies.count; i++)
        s->bodies.data[i].velocity = s->bodies.data[i].angular_velocity = vec3_make(0, 0, 0);
    for (int32_t i = 0; i < settings->position_iterations; i++) {
        joint_row_sweep(s);
        contact_row_sweep(s, i % 2 > 0);
    }
    for (int32_t i = 0; i < s->bodies.count; i++) {
        const solver_body *b = &s->bodies.data[i];
        if (b->slot >= 0 && body_is_dynamic(bodies, b->slot))
            body_move(bodies, b->slot, b->velocity, b->angular_velocity, dt);
    }
    guided_bodies_place(s, bodies, dt);
    return FRAM_OK;
}
