/* Rows of the fast solver: where they lie, how bodies and contacts get into them and out again. */
#include "base/pool.h"
#include "dynamics/solver_bodies_kernel.h"
#include "dynamics/solver_fast.h"

#include <string.h>

/* ---- memory ---- */

bool rows_reserve(context *ctx, aligned_rows *r, int64_t rows)
{
    enum { LINE = 64 };
    if (rows > INT32_MAX / BATCH_LANES - 1 || !array_reserve(ctx, &r->memory, BATCH_LANES * ((int32_t)rows + 1)))
        return false;
    size_t past = (size_t)((uintptr_t)r->memory.data % LINE);
    r->rows = r->memory.data + (past == 0 ? 0 : (LINE - past) / sizeof(double));
    return true;
}

void rows_clear(aligned_rows *r, int64_t rows) { memset(r->rows, 0, (size_t)rows * BATCH_LANES * sizeof *r->rows); }

void fast_rows_free(context *ctx, fast_rows *f)
{
    if (!f)
        return;
    aligned_rows *rows[] = {&f->velocity, &f->driven, &f->inverse,    &f->tensor,       &f->mass,
                            &f->inertia,  &f->frame,  &f->point,      &f->impulse,      &f->work,
                            &f->share,    &f->bias,   &f->correction, &f->joint_impulse};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        array_free(ctx, &rows[i]->memory);
    acceleration_free(ctx, &f->acceleration);
    array_free(ctx, &f->joint_row);
    array_free(ctx, &f->island);
    array_free(ctx, &f->lane_island);
    array_free(ctx, &f->gain);
    array_free(ctx, &f->blocks);
    batch_plan_free(ctx, &f->plan);
    memory_free(ctx, f);
}

batch_view fast_view(const fast_rows *f)
{
    return (batch_view){.velocity = f->velocity.rows,
                        .driven = f->driven.rows,
                        .inverse = f->inverse.rows,
                        .tensor = f->tensor.rows,
                        .batch = f->plan.batches.data,
                        .frame = f->frame.rows,
                        .point = f->point.rows,
                        .impulse = f->impulse.rows};
}

/* ---- bodies ---- */

static body_rows rows_at(const fast_rows *f, int32_t row)
{
    return (body_rows){row_of(&f->inverse, row), row_of(&f->tensor, row), row_of(&f->mass, row),
                       row_of(&f->inertia, row)};
}

static void put_velocity(fast_rows *f, int32_t row, const body_table *bodies, int32_t slot)
{
    double *r = row_of(&f->velocity, row);
    memset(r, 0, BODY_ROW * sizeof *r);
    if (slot < 0)
        return;
    memcpy(r + BODY_VELOCITY, &bodies->velocity[slot], sizeof(vec3));
    memcpy(r + BODY_SPIN, &bodies->angular_velocity[slot], sizeof(vec3));
}

enum { ROW_BLOCK = 256 };

static void fill_body_rows(void *arg, int32_t block, int32_t thread)
{
    const stage *st = arg;
    fast_rows *f = st->s->fast;
    (void)thread;
    for (int32_t row = ROW_BLOCK * block; row < pool_block_end(block, ROW_BLOCK, padded_rows(f)); row += BATCH_LANES) {
        int32_t slot[BATCH_LANES];
        body_rows rows = rows_at(f, row);
        for (int32_t i = 0; i < BATCH_LANES; i++) {
            slot[i] = row + i < f->plan.slot.count ? f->plan.slot.data[row + i] : -1;
            put_velocity(f, row + i, st->bodies, slot[i]);
        }
        KERNEL_PICK(st->s->ctx, solver_masses)(st->bodies, slot, 1, &rows);
    }
}

/* Rows for the bodies of joints. */
static bool find_joint_rows(solver *s, const body_table *bodies)
{
    fast_rows *f = s->fast;
    if (!array_resize(s->ctx, &f->joint_row, s->bodies.count))
        return false;
    for (int32_t i = 0; i < s->bodies.count; i++) {
        f->joint_row.data[i] = batch_plan_row(s->ctx, &f->plan, bodies, s->bodies.data[i].slot);
        if (f->joint_row.data[i] < 0)
            return false;
    }
    return true;
}

static void put_tensor(double *row, sym3 s, double factor)
{
    const double part[6] = {s.xx, s.yy, s.zz, s.xy, s.xz, s.yz};
    for (int i = 0; i < 6; i++)
        row[i] = factor * part[i];
}

/* Rows of a guided body have what is free of its mass.  factor: as of solver_masses. */
static void put_guided(fast_rows *f, const solver *s, const guided_body *g, int32_t row, double factor)
{
    const solver_body *b = &s->bodies.data[g->place];
    const sym3 none = {0};
    body_rows rows = rows_at(f, row);
    put_tensor(rows.mass, factor == 1 ? g->mass : none, 1);
    put_tensor(rows.inertia, none, 1);
    put_tensor(rows.inverse + INVERSE_INERTIA, none, 1);
    put_tensor(rows.tensor, b->inverse_mass, factor);
    rows.inverse[INVERSE_MASS] = factor * (b->inverse_mass.xx + b->inverse_mass.yy + b->inverse_mass.zz) / 3;
    rows.inverse[INVERSE_GENERAL] = 1;
    rows.tensor[TENSOR_GIVE] = factor * b->give;
}

static void put_guided_bodies(fast_rows *f, const solver *s)
{
    for (int32_t i = 0; i < s->guided.count; i++) {
        const guided_body *g = &s->guided.data[i];
        int32_t slot = s->bodies.data[g->place].slot;
        put_guided(f, s, g, f->joint_row.data[g->place], 1);
        for (int32_t h = 0; h < f->plan.hubs.count; h++)
            for (int32_t k = 0; k < BATCH_LANES && f->plan.hubs.data[h] == slot; k++)
                put_guided(f, s, g, f->plan.movable + BATCH_LANES * h + k, BATCH_LANES);
    }
}

/* Edges that bend: mass along z alone.  The position correction moves nothing that nothing moves. */
static void put_edges(const stage *st)
{
    const fast_rows *f = st->s->fast;
    for (int32_t i = 0; i < f->plan.edges.count && !st->positions; i++) {
        const bending_edge *e = &f->plan.edges.data[i];
        body_rows rows = rows_at(f, e->row);
        double give = st->contacts->data[e->contact].give;
        put_tensor(rows.mass, (sym3){.zz = 1 / give}, 1);
        put_tensor(rows.tensor, (sym3){.zz = give}, 1);
        rows.inverse[INVERSE_MASS] = give / 3;
        rows.inverse[INVERSE_GENERAL] = 1;
    }
}

bool fast_bodies_make(stage *st)
{
    context *ctx = st->s->ctx;
    fast_rows *f = st->s->fast;
    if (!find_joint_rows(st->s, st->bodies))
        return false;
    int32_t rows = padded_rows(f);
    if (!rows_reserve(ctx, &f->velocity, rows) || !rows_reserve(ctx, &f->driven, rows) ||
        !rows_reserve(ctx, &f->inverse, rows) || !rows_reserve(ctx, &f->tensor, rows) ||
        !rows_reserve(ctx, &f->mass, rows) || !rows_reserve(ctx, &f->inertia, rows))
        return false;
    pool_run(ctx, fill_body_rows, st, pool_blocks(rows, ROW_BLOCK));
    for (int32_t h = 0; h < f->plan.hubs.count; h++) { /* an eighth of the hub in each of its copies */
        int32_t hub = f->plan.hubs.data[h], slot[BATCH_LANES] = {hub, hub, hub, hub, hub, hub, hub, hub};
        body_rows copies = rows_at(f, f->plan.movable + BATCH_LANES * h);
        KERNEL_PICK(ctx, solver_masses)(st->bodies, slot, BATCH_LANES, &copies);
    }
    put_guided_bodies(f, st->s);
    put_edges(st);
    return true;
}

static void load_velocities(void *arg, int32_t block, int32_t thread)
{
    const stage *st = arg;
    fast_rows *f = st->s->fast;
    (void)thread;
    for (int32_t row = ROW_BLOCK * block; row < pool_block_end(block, ROW_BLOCK, f->plan.slot.count); row++)
        if (f->plan.slot.data[row] >= 0)
            put_velocity(f, row, st->bodies, f->plan.slot.data[row]);
}

void fast_velocities_load(stage *st)
{
    const fast_rows *f = st->s->fast;
    pool_run(st->s->ctx, load_velocities, st, pool_blocks(f->plan.slot.count, ROW_BLOCK));
    for (int32_t i = 0; i < f->plan.edges.count; i++) {
        const bending_edge *e = &f->plan.edges.data[i];
        row_of(&f->velocity, e->row)[BODY_VELOCITY + 2] += st->contacts->data[e->contact].recoil;
    }
}

static void store_velocities(void *arg, int32_t block, int32_t thread)
{
    const stage *st = arg;
    const fast_rows *f = st->s->fast;
    (void)thread;
    for (int32_t row = ROW_BLOCK * block; row < pool_block_end(block, ROW_BLOCK, f->plan.slot.count); row++) {
        int32_t slot = f->plan.slot.data[row];
        if (slot < 0 || !body_is_dynamic(st->bodies, slot))
            continue;
        memcpy(&st->moved->velocity[slot], row_of(&f->velocity, row) + BODY_VELOCITY, sizeof(vec3));
        memcpy(&st->moved->angular_velocity[slot], row_of(&f->velocity, row) + BODY_SPIN, sizeof(vec3));
    }
}

void fast_velocities_store(stage *st)
{
    pool_run(st->s->ctx, store_velocities, st, pool_blocks(st->s->fast->plan.slot.count, ROW_BLOCK));
}

void fast_velocities_centre(fast_rows *f)
{
    vec3 sum = vec3_make(0, 0, 0);
    double all = 0;
    for (int32_t row = 0; row < f->plan.slot.count; row++) {
        const double *r = row_of(&f->velocity, row), *m = row_of(&f->mass, row);
        double weight = m[0] + m[1] + m[2];
        all += weight;
        sum = vec3_mad(sum, vec3_make(r[BODY_VELOCITY], r[BODY_VELOCITY + 1], r[BODY_VELOCITY + 2]), weight);
    }
    if (all == 0)
        return;
    const double mean[3] = {sum.x / all, sum.y / all, sum.z / all};
    for (int32_t row = 0; row < f->plan.slot.count; row++)
        for (int k = 0; k < 3; k++)
            row_of(&f->velocity, row)[BODY_VELOCITY + k] -= mean[k];
}

void fast_driven_make(stage *st)
{
    const solver *s = st->s;
    fast_rows *f = s->fast;
    const batch_plan *plan = &f->plan;
    int32_t first_copy = plan->movable, end_copy = plan->movable + BATCH_LANES * plan->hubs.count;
    rows_clear(&f->driven, plan->slot.count);
    for (int32_t row = end_copy; row < plan->slot.count; row++) {
        int32_t slot = plan->slot.data[row];
        if (slot < 0 || !body_is_dynamic(st->bodies, slot))
            memcpy(row_of(&f->driven, row), row_of(&f->velocity, row), BODY_ROW * sizeof(double));
    }
    for (int32_t i = 0; i < plan->edges.count; i++)
        row_of(&f->driven, plan->edges.data[i].row)[BODY_VELOCITY + 2] = 0;
    for (int32_t i = 0; i < s->guided.count; i++) {
        const guided_body *g = &s->guided.data[i];
        int32_t row = f->joint_row.data[g->place];
        const double *velocity = row_of(&f->velocity, row);
        double driven[BODY_ROW] = {0};
        vec3 locked = guided_velocity(
            g, vec3_make(velocity[BODY_VELOCITY], velocity[BODY_VELOCITY + 1], velocity[BODY_VELOCITY + 2]));
        memcpy(driven + BODY_VELOCITY, &locked, sizeof locked);
        memcpy(driven + BODY_SPIN, velocity + BODY_SPIN, sizeof(vec3));
        memcpy(row_of(&f->driven, row), driven, sizeof driven);
        for (int32_t h = 0; h < plan->hubs.count; h++)
            for (int32_t k = 0; k < BATCH_LANES && plan->hubs.data[h] == s->bodies.data[g->place].slot; k++)
                memcpy(row_of(&f->driven, first_copy + BATCH_LANES * h + k), driven, sizeof driven);
    }
}

static sym3 tensor_of(const double *row) { return (sym3){row[0], row[1], row[2], row[3], row[4], row[5]}; }

double fast_energy(const fast_rows *f)
{
    double sum = 0;
    for (int32_t row = 0; row < f->plan.slot.count; row++) {
        const double *r = row_of(&f->velocity, row);
        vec3 v = {r[BODY_VELOCITY], r[BODY_VELOCITY + 1], r[BODY_VELOCITY + 2]};
        vec3 w = {r[BODY_SPIN], r[BODY_SPIN + 1], r[BODY_SPIN + 2]};
        sum += 0.5 * vec3_dot(v, sym3_mul_vec(tensor_of(row_of(&f->mass, row)), v));
        sum += 0.5 * vec3_dot(w, sym3_mul_vec(tensor_of(row_of(&f->inertia, row)), w));
    }
    return sum;
}

/* ---- contacts into rows ---- */

static void put3(double *rows, int at, int32_t lane, vec3 v)
{
    rows[BATCH_LANES * at + lane] = v.x;
    rows[BATCH_LANES * (at + 1) + lane] = v.y;
    rows[BATCH_LANES * (at + 2) + lane] = v.z;
}

static void fill_lane(const stage *st, const contact_batch *batch, double *frame, int32_t lane)
{
    const fast_rows *f = st->s->fast;
    for (int32_t k = 0; k < batch->points; k++) {
        double *point = row_of(&f->point, POINT_ROWS * (batch->first + k));
        double *impulse = row_of(&f->impulse, IMPULSE_ROWS * (batch->first + k));
        int32_t number = batch->contact[k][lane];
        vec3 zero = vec3_make(0, 0, 0);
        if (number < 0) { /* nothing: a cap of zero */
            put3(point, POINT_ARM_A, lane, zero);
            put3(point, POINT_ARM_B, lane, zero);
            put3(impulse, 0, lane, zero);
            point[BATCH_LANES * POINT_BIAS + lane] = point[BATCH_LANES * POINT_LIMIT + lane] = 0;
            continue;
        }
        const contact *c = &st->contacts->data[number];
        put3(point, POINT_ARM_A, lane, c->arm_a);
        put3(point, POINT_ARM_B, lane, c->arm_b);
        put3(impulse, 0, lane, st->memory ? st->s->recalled.data[number] : zero);
        point[BATCH_LANES * POINT_BIAS + lane] = wanted_velocity(c, st->settings, st->dt);
        point[BATCH_LANES * POINT_LIMIT + lane] = c->impulse_limit;
    }
    if (batch->contact[0][lane] < 0) {
        put3(frame, FRAME_NORMAL, lane, vec3_make(0, 0, 1));
        frame[BATCH_LANES * FRAME_STATIC + lane] = frame[BATCH_LANES * FRAME_KINETIC + lane] = 0;
        return;
    }
    const contact *c = &st->contacts->data[batch->contact[0][lane]];
    put3(frame, FRAME_NORMAL, lane, c->normal);
    frame[BATCH_LANES * FRAME_STATIC + lane] = fmax(c->friction_static, c->friction_kinetic);
    frame[BATCH_LANES * FRAME_KINETIC + lane] = c->friction_kinetic;
}

static bool has_general(const fast_rows *f, const contact_batch *batch)
{
    bool general = false;
    for (int32_t lane = 0; lane < BATCH_LANES; lane++)
        general = general || row_of(&f->inverse, batch->a[lane])[INVERSE_GENERAL] > 0 ||
                  row_of(&f->inverse, batch->b[lane])[INVERSE_GENERAL] > 0;
    return general;
}

static bool is_driven(const stage *st, int32_t slot)
{
    int32_t place = st->s->place.data[slot];
    return !body_is_dynamic(st->bodies, slot) || (place >= 0 && st->s->bodies.data[place].guided);
}

/* Not only driven bodies: in the frame of the solve walls move too. */
static bool has_driven(const stage *st, const contact_batch *batch)
{
    bool driven = false;
    for (int32_t lane = 0; lane < BATCH_LANES; lane++) {
        int32_t number = batch->contact[0][lane];
        const contact *c = number < 0 ? NULL : &st->contacts->data[number];
        driven = driven || (c && (is_driven(st, c->a) || is_driven(st, c->b)));
    }
    return driven;
}

static void fill_task(const stage *st, batch_task *task)
{
    fast_rows *f = st->s->fast;
    for (int32_t i = task->first; i < task->end; i++) {
        contact_batch *batch = &f->plan.batches.data[i];
        batch->general = has_general(f, batch);
        batch->driven = has_driven(st, batch);
        for (int32_t lane = 0; lane < BATCH_LANES; lane++)
            fill_lane(st, batch, row_of(&f->frame, FRAME_ROWS * i), lane);
    }
    KERNEL_PICK(st->s->ctx, solver_prepare)(&st->view, task->first, task->end);
}

bool fast_rows_make(stage *st)
{
    context *ctx = st->s->ctx;
    fast_rows *f = st->s->fast;
    int32_t batches = f->plan.batches.count, points = f->plan.points;
    if (!fast_bodies_make(st) || !rows_reserve(ctx, &f->frame, (int64_t)FRAME_ROWS * batches) ||
        !rows_reserve(ctx, &f->point, (int64_t)POINT_ROWS * points) ||
        !rows_reserve(ctx, &f->impulse, (int64_t)IMPULSE_ROWS * points))
        return false;
    st->view = fast_view(f);
    stage_run(st, fill_task);
    return true;
}

/* ---- guided bodies ---- */

static bool is_guided(const solver *s, int32_t slot)
{
    int32_t place = s->place.data[slot];
    return place >= 0 && s->bodies.data[place].guided;
}

static void reach_cap(const stage *st, const contact *c, const contact_batch *batch, int32_t point, int32_t lane)
{
    const fast_rows *f = st->s->fast;
    double *row = row_of(&f->point, POINT_ROWS * point) + lane;
    double *impulse = row_of(&f->impulse, IMPULSE_ROWS * point) + lane;
    sym3 w = inverse_mass_of_both(tensor_of(row_of(&f->tensor, batch->a[lane])),
                                  tensor_of(row_of(&f->tensor, batch->b[lane])));
    guided_point p = {row[BATCH_LANES * POINT_BIAS],
                      row[BATCH_LANES * POINT_SLIDE],
                      row[BATCH_LANES * POINT_MASS],
                      {impulse[BATCH_LANES], impulse[BATCH_LANES * 2]},
                      false};
    contact_reach_cap(st->bodies, c, w, &p);
    row[BATCH_LANES * POINT_MASS] = p.normal_mass;
    impulse[BATCH_LANES] = p.tangent[0];
    impulse[BATCH_LANES * 2] = p.tangent[1];
    row[BATCH_LANES * POINT_SLIP] = p.slides ? HUGE_VAL : row[BATCH_LANES * POINT_SLIP];
}

static void reach_caps_task(const stage *st, batch_task *task)
{
    const solver *s = st->s;
    for (int32_t i = task->first; i < task->end; i++) {
        const contact_batch *batch = &s->fast->plan.batches.data[i];
        for (int32_t lane = 0; lane < BATCH_LANES && batch->driven; lane++) {
            const contact *first = batch->contact[0][lane] < 0 ? NULL : &st->contacts->data[batch->contact[0][lane]];
            if (!first || (!is_guided(s, first->a) && !is_guided(s, first->b)) || !is_driven(st, first->a) ||
                !is_driven(st, first->b))
                continue;
            for (int32_t k = 0; k < batch->points; k++)
                if (batch->contact[k][lane] >= 0)
                    reach_cap(st, &st->contacts->data[batch->contact[k][lane]], batch, batch->first + k, lane);
        }
    }
}

void fast_rows_reach_caps(stage *st)
{
    if (st->s->guided.count > 0)
        stage_run(st, reach_caps_task);
}

/* ---- rows again ---- */

/* Bits are compared: the rows hold the very numbers. */
static bool same3(const double *rows, int at, int32_t lane, vec3 v)
{
    return rows[BATCH_LANES * at + lane] == v.x && rows[BATCH_LANES * (at + 1) + lane] == v.y &&
           rows[BATCH_LANES * (at + 2) + lane] == v.z;
}

/* The body slot in a lane; that of the hub for its copies. */
static int32_t lane_slot(const batch_plan *plan, const contact_batch *batch, int32_t row)
{
    bool copy = batch->hub >= 0 && row >= batch->copies && row < batch->copies + BATCH_LANES;
    return plan->slot.data[copy ? batch->hub : row];
}

/* A body that slept in the solve and was woken after it has a row in each task that touched it, which was that of one
   that does not move. */
static bool has_woken(const stage *st, const contact_batch *batch, int32_t row, int32_t slot)
{
    bool copy = batch->hub >= 0 && row >= batch->copies && row < batch->copies + BATCH_LANES;
    return !copy && row >= st->s->fast->plan.movable && body_is_dynamic(st->bodies, slot);
}

bool fast_batch_fits(const stage *st, int32_t number)
{
    const fast_rows *f = st->s->fast;
    const contact_batch *batch = &f->plan.batches.data[number];
    const double *frame = row_of(&f->frame, FRAME_ROWS * number);
    for (int32_t k = 0; k < batch->points; k++) {
        const double *point = row_of(&f->point, POINT_ROWS * (batch->first + k));
        for (int32_t lane = 0; lane < BATCH_LANES; lane++) {
            if (batch->contact[k][lane] < 0)
                continue;
            const contact *c = &st->contacts->data[batch->contact[k][lane]];
            if (c->a != lane_slot(&f->plan, batch, batch->a[lane]) ||
                c->b != lane_slot(&f->plan, batch, batch->b[lane]) || !same3(frame, FRAME_NORMAL, lane, c->normal) ||
                !same3(point, POINT_ARM_A, lane, c->arm_a) || !same3(point, POINT_ARM_B, lane, c->arm_b) ||
                has_woken(st, batch, batch->a[lane], c->a) || has_woken(st, batch, batch->b[lane], c->b))
                return false;
        }
    }
    return true;
}
