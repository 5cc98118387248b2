/* Warm start of the fast solver: see solver_warm.c for what it does and why; here on batches. */
#include "dynamics/solver_fast.h"

static void recall_task(const stage *st, batch_task *task)
{
    KERNEL_PICK(st->s->ctx, solver_recall)(&st->view, task->first, task->end);
}

static void work_task(const stage *st, batch_task *task)
{
    KERNEL_PICK(st->s->ctx, solver_work)(&st->view, task->first, task->end, st->s->fast->work.rows);
}

static void push_task(const stage *st, batch_task *task)
{
    KERNEL_PICK(st->s->ctx, solver_push)(&st->view, task->first, task->end, st->share);
}

/* Impulses shrink by what was taken back: a negative share less one. */
static void shrink_task(const stage *st, batch_task *task)
{
    const fast_rows *f = st->s->fast;
    push_task(st, task);
    for (int32_t i = task->first; i < task->end; i++) {
        const contact_batch *batch = &f->plan.batches.data[i];
        const double *share = row_of(&f->share, i);
        double *impulse = row_of(&f->impulse, IMPULSE_ROWS * batch->first);
        for (int32_t k = 0; k < IMPULSE_ROWS * batch->points; k++)
            for (int32_t lane = 0; lane < BATCH_LANES; lane++)
                impulse[BATCH_LANES * k + lane] *= 1 + share[lane];
    }
}

static bool has_movable_body(const fast_rows *f, const body_table *bodies, int32_t row)
{
    int32_t slot = f->plan.slot.data[row];
    return slot >= 0 && body_is_dynamic(bodies, slot);
}

/* A movable body of two, the hub for its copies, -1 without. */
static int32_t member(const fast_rows *f, const body_table *bodies, const contact_batch *batch, int32_t row)
{
    if (batch && batch->hub >= 0 && row >= batch->copies && row < batch->copies + BATCH_LANES)
        return batch->hub;
    return has_movable_body(f, bodies, row) ? row : -1;
}

static void island_task(const stage *st, batch_task *task)
{
    const fast_rows *f = st->s->fast;
    for (int32_t i = task->first; i < task->end; i++) {
        const contact_batch *batch = &f->plan.batches.data[i];
        for (int32_t lane = 0; lane < BATCH_LANES; lane++) {
            int32_t a = member(f, st->bodies, batch, batch->a[lane]), b = member(f, st->bodies, batch, batch->b[lane]);
            f->lane_island.data[BATCH_LANES * i + lane] = a < 0 && b < 0 ? -1 : f->island.data[a >= 0 ? a : b];
        }
    }
}

static int32_t joint_island(const solver *s, const body_table *bodies, const joint_block *j)
{
    const fast_rows *f = s->fast;
    int32_t a = member(f, bodies, NULL, f->joint_row.data[j->body]);
    int32_t b = member(f, bodies, NULL, f->joint_row.data[j->base]);
    return f->island.data[a >= 0 ? a : b];
}

static bool find_row_islands(stage *st)
{
    solver *s = st->s;
    fast_rows *f = s->fast;
    const body_table *bodies = st->bodies;
    int32_t rows = f->plan.slot.count;
    if (!array_resize(s->ctx, &f->island, rows) || !array_resize(s->ctx, &f->gain, rows) ||
        !array_resize(s->ctx, &f->lane_island, BATCH_LANES * f->plan.batches.count))
        return false;
    for (int32_t i = 0; i < rows; i++) {
        f->island.data[i] = i;
        f->gain.data[i] = (energy_gain){0, 0};
    }
    for (int32_t i = 0; i < f->plan.batches.count; i++) {
        const contact_batch *batch = &f->plan.batches.data[i];
        for (int32_t lane = 0; lane < BATCH_LANES; lane++) {
            int32_t a = member(f, bodies, batch, batch->a[lane]), b = member(f, bodies, batch, batch->b[lane]);
            if (a >= 0 && b >= 0)
                island_join(f->island.data, a, b);
        }
    }
    for (int32_t i = 0; i < s->joints.count; i++) {
        int32_t a = member(f, bodies, NULL, f->joint_row.data[s->joints.data[i].body]);
        int32_t b = member(f, bodies, NULL, f->joint_row.data[s->joints.data[i].base]);
        if (a >= 0 && b >= 0)
            island_join(f->island.data, a, b);
    }
    /* Leaders come first in their islands: from here on every row names its own. */
    for (int32_t i = 0; i < rows; i++)
        f->island.data[i] = f->island.data[f->island.data[i]];
    stage_run(st, island_task);
    return true;
}

/* Adds the work of all impulses to their islands; with `square` that of soft joints too. */
static void weigh(stage *st, bool square)
{
    solver *s = st->s;
    fast_rows *f = s->fast;
    stage_run(st, work_task);
    joints_borrow(s);
    for (int32_t i = 0; i < f->lane_island.count; i++) {
        int32_t island = f->lane_island.data[i];
        if (island >= 0)
            *(square ? &f->gain.data[island].square : &f->gain.data[island].linear) += f->work.rows[i];
    }
    for (int32_t i = 0; i < s->joints.count; i++) {
        const joint_block *j = &s->joints.data[i];
        energy_gain *g = &f->gain.data[joint_island(s, st->bodies, j)];
        *(square ? &g->square : &g->linear) += joint_row_work(s, j);
        for (int r = 0; r < j->count && square; r++)
            g->square += j->softness * j->impulse[r] * j->impulse[r];
    }
}

static void push_joints(stage *st, bool shrink)
{
    solver *s = st->s;
    if (s->joints.count == 0)
        return;
    joints_borrow(s);
    for (int32_t i = 0; i < s->joints.count; i++) {
        joint_block *j = &s->joints.data[i];
        double share = shrink ? energy_share(s->fast->gain.data[joint_island(s, st->bodies, j)]) - 1 : 1;
        joint_row_push(s, j, share);
        for (int r = 0; r < j->count && shrink; r++)
            j->impulse[r] *= 1 + share;
    }
    joints_return(s);
}

void fast_velocities_of_impulses(stage *st)
{
    fast_velocities_load(st);
    st->share = NULL;
    stage_run_colours(st, push_task);
    push_joints(st, false);
}

bool fast_warm_start(stage *st)
{
    solver *s = st->s;
    fast_rows *f = s->fast;
    int32_t batches = f->plan.batches.count;
    if (!find_row_islands(st) || !rows_reserve(s->ctx, &f->work, batches) || !rows_reserve(s->ctx, &f->share, batches))
        return false;
    stage_run(st, recall_task);
    weigh(st, false);
    st->share = NULL;
    stage_run_colours(st, push_task);
    push_joints(st, false);
    weigh(st, true);
    bool whole = true;
    for (int32_t i = 0; i < f->plan.slot.count; i++) {
        f->gain.data[i].square -= f->gain.data[i].linear;
        whole = whole && energy_share(f->gain.data[i]) == 1;
    }
    if (whole)
        return true;
    for (int32_t i = 0; i < f->lane_island.count; i++) {
        int32_t island = f->lane_island.data[i];
        f->share.rows[i] = island < 0 ? 0 : energy_share(f->gain.data[island]) - 1;
    }
    st->share = f->share.rows;
    stage_run_colours(st, shrink_task);
    push_joints(st, true);
    return true;
}
