/* The bodies of a solve: free motion of all, and the list of those that contacts and joints touch. */
#include "base/pool.h"
#include "dynamics/motion.h"
#include "dynamics/motion_kernel.h"
#include "dynamics/solver_rows.h"

static sym3 inverse_mass_of(const body_table *bodies, int32_t slot, mat3 r)
{
    double m = bodies->mass[slot];
    vec3 added = bodies->added_mass[slot];
    if (added.x == 0 && added.y == 0 && added.z == 0)
        return (sym3){.xx = 1 / m, .yy = 1 / m, .zz = 1 / m};
    sym3 body = {.xx = 1 / (m + added.x), .yy = 1 / (m + added.y), .zz = 1 / (m + added.z)};
    return sym3_rotate(body, r);
}

void body_inverse_tensors(const body_table *bodies, int32_t slot, sym3 *inverse_mass, sym3 *inverse_inertia)
{
    *inverse_mass = *inverse_inertia = (sym3){0};
    if (slot < 0 || !body_is_dynamic(bodies, slot))
        return;
    mat3 r = quat_matrix(bodies->orientation[slot]);
    *inverse_mass = inverse_mass_of(bodies, slot, r);
    *inverse_inertia = sym3_rotate(sym3_inverse(body_total_inertia(bodies, slot)), r);
}

bool solver_bodies_begin(solver *s, const body_table *bodies)
{
    array_clear(&s->bodies);
    if (!array_resize(s->ctx, &s->place, bodies->count))
        return false;
    for (int32_t i = 0; i < bodies->count; i++)
        s->place.data[i] = -1;
    return true;
}

int32_t solver_body_place(solver *s, const body_table *bodies, int32_t slot)
{
    if (slot >= 0 && s->place.data[slot] >= 0)
        return s->place.data[slot];
    solver_body b = {.slot = slot};
    if (slot >= 0) {
        b.velocity = bodies->velocity[slot];
        b.angular_velocity = bodies->angular_velocity[slot];
        body_inverse_tensors(bodies, slot, &b.inverse_mass, &b.inverse_inertia);
    }
    if (!array_push(s->ctx, &s->bodies, b))
        return -1;
    if (slot >= 0)
        s->place.data[slot] = s->bodies.count - 1;
    return s->bodies.count - 1;
}

int32_t solver_contact_place(solver *s, const body_table *bodies, const contact_array *contacts, int32_t number,
                             int32_t slot, const contact_row *before)
{
    const contact *c = &contacts->data[number];
    if (body_is_dynamic(bodies, slot) || c->give == 0)
        return solver_body_place(s, bodies, slot);
    if (before && before->contact == number - 1 && contact_same_group(c, &contacts->data[number - 1]))
        return slot == c->a ? before->a : before->b;
    solver_body edge = {.slot = slot,
                        .velocity = bodies->velocity[slot],
                        .angular_velocity = bodies->angular_velocity[slot],
                        .inverse_mass = {.zz = c->give},
                        .recoil = c->recoil};
    return array_push(s->ctx, &s->bodies, edge) ? s->bodies.count - 1 : -1;
}

static int32_t find_massless(const void *arg, int32_t first, int32_t end)
{
    const body_table *bodies = arg;
    for (int32_t i = body_next_moving(bodies, first, end); i < end; i = body_next_moving(bodies, i + 1, end)) {
        if (!body_is_dynamic(bodies, i))
            continue;
        sym3 inertia = body_total_inertia(bodies, i);
        if (!(bodies->mass[i] > 0 && inertia.xx > 0 && inertia.yy > 0 && inertia.zz > 0))
            return i;
    }
    return end;
}

fram_status bodies_check(context *ctx, const body_table *bodies, fram_error *error)
{
    int32_t i = pool_find(ctx, find_massless, bodies, bodies->count);
    if (i == bodies->count)
        return FRAM_OK;
    sym3 inertia = body_total_inertia(bodies, i);
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, NULL,
                     "dynamic body %d needs a positive mass and inertia; found %g kg, (%g, %g, %g) kg m2", (int)i,
                     bodies->mass[i], inertia.xx, inertia.yy, inertia.zz);
}

typedef struct acceleration_work {
    context *ctx;
    body_table *bodies;
    const wrench *loads;
    double dt;
} acceleration_work;

static void accelerate_block(void *arg, int32_t block, int32_t thread)
{
    const acceleration_work *work = arg;
    int32_t first = motion_block_first(block), end = motion_block_end(work->bodies, block);
    (void)thread;
    if (body_next_moving(work->bodies, first, end) < end)
        KERNEL_PICK(work->ctx, motion_accelerate)
    (work->bodies, work->loads, work->dt, first / V8_LANES, (end + V8_LANES - 1) / V8_LANES);
}

void bodies_accelerate(context *ctx, body_table *bodies, const wrench *loads, double dt)
{
    acceleration_work work = {ctx, bodies, loads, dt};
    pool_run(ctx, accelerate_block, &work, motion_blocks(bodies));
}

void solver_bodies_load(solver *s, const body_table *bodies)
{
    for (int32_t i = 0; i < s->bodies.count; i++) {
        solver_body *b = &s->bodies.data[i];
        if (b->slot < 0)
            continue;
        b->velocity = bodies->velocity[b->slot];
        b->velocity.z += b->recoil;
        b->angular_velocity = bodies->angular_velocity[b->slot];
    }
}
