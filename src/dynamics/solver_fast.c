/* The fast solver: the sweeps of the reference on batches of contacts (solver_batch.h), in another order, and sped up
   by steps along their directions (solver_accelerate.c). */
#include "dynamics/solver_fast.h"
#include "base/pool.h"
#include "dynamics/motion.h"

#include <assert.h>
#include <string.h>

/* Fewer rows of points than this in a colour are not worth other threads. */
enum { THREAD_POINTS = 128 };

/* ---- work on tasks ---- */

static void run_task(void *arg, int32_t block, int32_t thread)
{
    const stage *st = arg;
    (void)thread;
    st->run(st, &st->s->fast->plan.tasks.data[st->first_task + block]);
}

/* Runs tasks [first, end), which share nothing that is written. */
static void run_tasks(stage *st, int32_t first, int32_t end)
{
    const batch_plan *plan = &st->s->fast->plan;
    if (first == end)
        return;
    const batch_task *head = &plan->tasks.data[first], *last = &plan->tasks.data[end - 1];
    int32_t points = plan->batches.data[last->end - 1].first - plan->batches.data[head->first].first;
    st->first_task = first;
    if (points >= THREAD_POINTS) {
        pool_run(st->s->ctx, run_task, st, end - first);
        return;
    }
    for (int32_t t = first; t < end; t++)
        run_task(st, t - first, 0);
}

void stage_run_colours(stage *st, void (*run)(const stage *, batch_task *))
{
    const int32_array *ends = &st->s->fast->plan.colour_end;
    st->run = run;
    for (int32_t c = 0, first = 0; c < ends->count; first = ends->data[c++])
        run_tasks(st, first, ends->data[c]);
}

void stage_run(stage *st, void (*run)(const stage *, batch_task *))
{
    st->run = run;
    run_tasks(st, 0, st->s->fast->plan.tasks.count);
}

/* ---- joints ---- */

void joints_borrow(solver *s)
{
    for (int32_t i = 0; i < s->bodies.count; i++) {
        const double *r = row_of(&s->fast->velocity, s->fast->joint_row.data[i]);
        memcpy(&s->bodies.data[i].velocity, r + BODY_VELOCITY, sizeof(vec3));
        memcpy(&s->bodies.data[i].angular_velocity, r + BODY_SPIN, sizeof(vec3));
    }
}

void joints_return(solver *s)
{
    for (int32_t i = 0; i < s->bodies.count; i++) {
        double *r = row_of(&s->fast->velocity, s->fast->joint_row.data[i]);
        memcpy(r + BODY_VELOCITY, &s->bodies.data[i].velocity, sizeof(vec3));
        memcpy(r + BODY_SPIN, &s->bodies.data[i].angular_velocity, sizeof(vec3));
    }
}

static double sweep_joints(solver *s)
{
    if (s->joints.count == 0)
        return 0;
    joints_borrow(s);
    double energy = joint_row_sweep(s);
    joints_return(s);
    return energy;
}

/* ---- sweeps ---- */

static sweep_sums sweep_once(stage *st, void (*sweep)(const stage *, batch_task *))
{
    const batch_plan *plan = &st->s->fast->plan;
    sweep_sums sums = {.energy = sweep_joints(st->s)};
    stage_run_colours(st, sweep);
    for (int32_t t = 0; t < plan->tasks.count; t++) {
        sums.energy += plan->tasks.data[t].energy;
        sums.wanted += plan->tasks.data[t].wanted;
    }
    return sums;
}

static void keep_sums(batch_task *task, sweep_sums sums)
{
    task->energy = sums.energy;
    task->wanted = sums.wanted;
}

static void sweep_task(const stage *st, batch_task *task)
{
    keep_sums(task, KERNEL_PICK(st->s->ctx, solver_sweep)(&st->view, task->first, task->end, st->weighs));
}

static void correct_task(const stage *st, batch_task *task)
{
    const fast_rows *f = st->s->fast;
    keep_sums(task, KERNEL_PICK(st->s->ctx, solver_correct)(&st->view, task->first, task->end, f->bias.rows,
                                                            f->correction.rows));
}

static void residual_task(const stage *st, batch_task *task)
{
    task->residual = KERNEL_PICK(st->s->ctx, solver_residual)(&st->view, task->first, task->end);
}

/* Sweeps that may follow the last one while impulses give energy, which is rare. */
enum { MOST_AFTERWARDS = 32 };

/* A sweep that took no more energy than this changed no velocity by more than the tolerance at any contact: a contact
   takes p^2 / m of its impulse p and reduced mass m, which is at most each body's own. [J] */
static double negligible_energy(const stage *st)
{
    const fast_rows *f = st->s->fast;
    double lightest = HUGE_VAL, tolerance = st->settings->tolerance;
    for (int32_t row = 0; row < f->plan.slot.count; row++) {
        int32_t slot = f->plan.slot.data[row];
        if (slot >= 0 && !body_is_dynamic(st->bodies, slot))
            continue; /* an edge that bends */
        const double *m = row_of(&f->mass, row);
        double mass = (m[0] + m[1] + m[2]) / 3;
        lightest = mass > 0 && mass < lightest ? mass : lightest;
    }
    return lightest < HUGE_VAL ? 0.5 * lightest * tolerance * tolerance : 0;
}

/* At most so many sweeps; fewer when nothing is left to do.  x: multipliers of contacts, `rows` of them. */
static bool sweep_until_settled(stage *st, void (*sweep)(const stage *, batch_task *), aligned_rows *x, int64_t rows,
                                int32_t most, int32_t *iterations)
{
    sweep_sums sums = {.energy = HUGE_VAL};
    acceleration *a = &st->s->fast->acceleration;
    double negligible = negligible_energy(st);
    if (!acceleration_begin(st, x, rows))
        return false;
    int32_t next = a->pause;
    for (*iterations = 0; *iterations < most && sums.energy > negligible;) {
        ++*iterations;
        /* As many sweeps must be left to draw all back into its bounds. */
        bool due = *iterations >= next && *iterations + a->pause <= most;
        st->weighs = due || *iterations == most;
        sums = sweep_once(st, sweep);
        assert(st->positions || !st->weighs || sums.wanted == acceleration_wanted(st));
        if (!due || sums.energy <= negligible)
            continue;
        if (!acceleration_go_on(st, sums.energy, sums.wanted))
            return true;
        next = *iterations + a->pause;
    }
    if (*iterations > 0 && !st->weighs && !st->positions)
        sums.wanted = acceleration_wanted(st);
    st->weighs = true;
    /* Sweeps alone never give energy for long. */
    for (int32_t i = 0; !acceleration_end(st, sums.energy, sums.wanted) && i < MOST_AFTERWARDS; i++) {
        a->directions = 0;
        sums = sweep_once(st, sweep);
        ++*iterations;
    }
    return true;
}

static bool fast_rows_begin(solver *s)
{
    if (s->fast)
        return true;
    s->fast = memory_array(s->ctx, 1, sizeof *s->fast);
    if (s->fast)
        s->fast->planned = -1;
    return s->fast != NULL;
}

/* ---- velocities ---- */

typedef struct find_work {
    solver *s;
    const contact_memory_table *memory; /* NULL: none */
    const body_table *bodies;
    contact_array *contacts;
} find_work;
enum { FIND_BLOCK = 512 };

static void find_block(void *arg, int32_t block, int32_t thread)
{
    const find_work *w = arg;
    int32_t first = FIND_BLOCK * block, end = pool_block_end(block, FIND_BLOCK, w->contacts->count);
    (void)thread;
    for (int32_t i = first; i < end; i++) {
        contact *c = &w->contacts->data[i];
        if (!body_is_dynamic(w->bodies, c->a) && !body_is_dynamic(w->bodies, c->b)) {
            contact_load_immovable(w->bodies, c);
            continue;
        }
        c->arm_a = vec3_sub(c->point, w->bodies->position[c->a]);
        c->arm_b = vec3_sub(c->point, w->bodies->position[c->b]);
    }
    if (w->memory)
        contacts_recall(w->memory, w->contacts, first, end, w->s->recalled.data);
}

/* Arms of contacts, and what they carried. */
static bool find_contacts(solver *s, const contact_memory_table *memory, const body_table *bodies,
                          contact_array *contacts)
{
    find_work work = {s, memory, bodies, contacts};
    if (!array_resize(s->ctx, &s->recalled, contacts->count))
        return false;
    pool_run(s->ctx, find_block, &work, pool_blocks(contacts->count, FIND_BLOCK));
    return true;
}

static void finish_task(const stage *st, batch_task *task)
{
    const fast_rows *f = st->s->fast;
    for (int32_t i = task->first; i < task->end; i++) {
        const contact_batch *batch = &f->plan.batches.data[i];
        for (int32_t k = 0; k < batch->points; k++) {
            const double *impulse = row_of(&f->impulse, IMPULSE_ROWS * (batch->first + k));
            for (int32_t lane = 0; lane < BATCH_LANES; lane++) {
                int32_t number = batch->contact[k][lane];
                for (int32_t r = 0; r < IMPULSE_ROWS && number >= 0; r++)
                    st->results->data[number].impulse[r] = impulse[BATCH_LANES * r + lane];
            }
        }
    }
}

static double largest_task_residual(stage *st)
{
    double largest = 0;
    stage_run(st, residual_task);
    for (int32_t t = 0; t < st->s->fast->plan.tasks.count; t++)
        largest = fmax(largest, st->s->fast->plan.tasks.data[t].residual);
    return largest;
}

fram_status solver_solve_fast(solver *s, const solver_settings *settings, double dt, body_table *bodies,
                              const wrench *loads, joint_table *joints, contact_array *contacts,
                              contact_memory_table *memory, solver_report *report, fram_error *error)
{
    if (!fast_rows_begin(s) || !solver_bodies_begin(s, bodies))
        return error_memory(error);
    fast_rows *f = s->fast;
    f->planned = -1;
    fram_status status = solver_joints_make(s, dt, bodies, joints, error);
    if (status != FRAM_OK)
        return status;
    stage st = {.s = s,
                .bodies = bodies,
                .moved = bodies,
                .contacts = contacts,
                .results = contacts,
                .memory = settings->warm_start ? memory : NULL,
                .settings = settings,
                .dt = dt};
    if (!find_contacts(s, st.memory, bodies, contacts) || !batch_plan_make(s->ctx, &f->plan, bodies, contacts) ||
        !fast_rows_make(&st))
        return error_memory(error);
    bodies_accelerate(s->ctx, bodies, loads, dt);
    guided_bodies_drive(s, bodies);
    fast_velocities_load(&st);
    fast_velocities_centre(f);
    fast_driven_make(&st);
    st.free_energy = fast_energy(f);
    if (settings->warm_start) {
        joint_rows_recall(s, joints);
        if (!fast_warm_start(&st))
            return error_memory(error);
    }
    fast_rows_reach_caps(&st);
    if (!sweep_until_settled(&st, sweep_task, &f->impulse, (int64_t)IMPULSE_ROWS * f->plan.points, settings->iterations,
                             &report->iterations))
        return error_memory(error);
    fast_velocities_of_impulses(&st);
    fast_velocities_store(&st);
    stage_run(&st, finish_task);
    if (!guided_bodies_load(s, bodies, contacts))
        return error_memory(error);
    joint_rows_finish(s, dt, joints);
    report->residual = largest_task_residual(&st);
    f->planned = contacts->count;
    return contacts_remember(s, bodies, contacts, memory, error);
}

/* ---- positions ---- */

/* A velocity that no impulse is asked to reach. */
#define NEVER (-1e300)

static void fill_batch_bias(const stage *st, contact_batch *batch)
{
    const fast_rows *f = st->s->fast;
    batch->overlaps = false;
    for (int32_t k = 0; k < batch->points; k++) {
        double *bias = row_of(&f->bias, batch->first + k);
        for (int32_t lane = 0; lane < BATCH_LANES; lane++) {
            const contact *c = batch->contact[k][lane] < 0 ? NULL : &st->contacts->data[batch->contact[k][lane]];
            bias[lane] = !c                                       ? 0
                         : c->correct && !st->settings->baumgarte ? correction_velocity(c, st->settings, st->dt)
                                                                  : NEVER;
            batch->overlaps = batch->overlaps || bias[lane] > 0;
        }
    }
}

/* Biases of one more batch; `energy` counts those with overlap. */
static void add_bias(const stage *st, batch_task *task, int32_t number)
{
    contact_batch *batch = &st->s->fast->plan.batches.data[number];
    fill_batch_bias(st, batch);
    task->energy += batch->overlaps ? 1 : 0;
}

/* Of rows that were just made. */
static void bias_task(const stage *st, batch_task *task)
{
    task->energy = 0;
    for (int32_t i = task->first; i < task->end; i++)
        add_bias(st, task, i);
}

/* Of rows of before, while they still belong to these contacts: one look at each. */
static void fit_task(const stage *st, batch_task *task)
{
    task->energy = 0;
    task->fits = true;
    for (int32_t i = task->first; i < task->end && task->fits; i++) {
        task->fits = fast_batch_fits(st, i);
        if (task->fits)
            add_bias(st, task, i);
    }
}

static bool fill_bias(stage *st, void (*fill)(const stage *, batch_task *))
{
    fast_rows *f = st->s->fast;
    if (!rows_reserve(st->s->ctx, &f->bias, f->plan.points) ||
        !rows_reserve(st->s->ctx, &f->correction, f->plan.points))
        return false;
    stage_run(st, fill);
    return true;
}

static bool all_fit(const batch_plan *plan)
{
    bool fit = true;
    for (int32_t t = 0; t < plan->tasks.count; t++)
        fit = fit && plan->tasks.data[t].fits;
    return fit;
}

/* Rows of the solve where they will do, else new ones. */
static bool begin_correction(stage *st)
{
    solver *s = st->s;
    fast_rows *f = s->fast;
    bool fit = f->planned == st->contacts->count;
    f->planned = -1;
    if (fit) {
        if (!fill_bias(st, fit_task))
            return false;
        fit = all_fit(&f->plan);
    }
    if (fit ? !fast_bodies_make(st)
            : !batch_plan_make(s->ctx, &f->plan, st->bodies, st->contacts) || !fast_rows_make(st) ||
                  !fill_bias(st, bias_task))
        return false;
    st->view = fast_view(f);
    rows_clear(&f->velocity, padded_rows(f));
    rows_clear(&f->correction, f->plan.points);
    return true;
}

static void move_block(void *arg, int32_t block, int32_t thread)
{
    const stage *st = arg;
    const fast_rows *f = st->s->fast;
    (void)thread;
    for (int32_t row = FIND_BLOCK * block; row < pool_block_end(block, FIND_BLOCK, f->plan.slot.count); row++) {
        const double *r = row_of(&f->velocity, row);
        int32_t slot = f->plan.slot.data[row];
        if (slot < 0 || !body_is_dynamic(st->bodies, slot))
            continue;
        body_move(st->moved, slot, vec3_make(r[BODY_VELOCITY], r[BODY_VELOCITY + 1], r[BODY_VELOCITY + 2]),
                  vec3_make(r[BODY_SPIN], r[BODY_SPIN + 1], r[BODY_SPIN + 2]), st->dt);
    }
}

fram_status solver_correct_fast(solver *s, const solver_settings *settings, double dt, body_table *bodies,
                                const joint_table *joints, const contact_array *contacts, fram_error *error)
{
    if (!fast_rows_begin(s) || !solver_bodies_begin(s, bodies))
        return error_memory(error);
    fast_rows *f = s->fast;
    fram_status status = solver_joints_make(s, dt, bodies, joints, error);
    if (status != FRAM_OK)
        return status;
    joint_rows_for_positions(s, settings->correction_rate, dt);
    stage st = {.s = s,
                .bodies = bodies,
                .moved = bodies,
                .contacts = contacts,
                .settings = settings,
                .dt = dt,
                .positions = true};
    if (!begin_correction(&st))
        return error_memory(error);
    int32_t sweeps;
    bool needed = s->joints.count > 0;
    for (int32_t t = 0; t < f->plan.tasks.count; t++)
        needed = needed || f->plan.tasks.data[t].energy > 0;
    if (needed &&
        !sweep_until_settled(&st, correct_task, &f->correction, f->plan.points, settings->position_iterations, &sweeps))
        return error_memory(error);
    if (needed)
        pool_run(s->ctx, move_block, &st, pool_blocks(f->plan.slot.count, FIND_BLOCK));
    guided_bodies_place(s, bodies, dt);
    return FRAM_OK;
}
