#include "sim/bench.h"

#include "base/clock.h"
#include "base/sort.h"
#include "bodies/energy.h"
#include "sim/bench_measure.h"
#include "sim/build.h"

static double median(double *value, int64_t count)
{
    numbers_sort(value, count);
    return numbers_median(value, count);
}

/* Of ascending values. */
static step_times times_of(const double *value, int64_t count)
{
    step_times t = {.longest = value[count - 1]};
    for (int64_t k = 0; k < count; k++)
        t.mean += value[k] / (double)count;
    t.p99 = value[(99 * count + 99) / 100 - 1];
    t.p999 = value[(999 * count + 999) / 1000 - 1];
    return t;
}

/* ---- what a step did ---- */

/* A pair of bodies that was counted last: contacts of one pair follow one another. */
typedef struct last_pair {
    int32_t a, b;
} last_pair;

static bool is_new_pair(last_pair *last, const contact *c)
{
    bool new = c->a != last->a || c->b != last->b;
    *last = (last_pair){c->a, c->b};
    return new;
}

/* Points that overlap, pairs of bodies that have some, and pairs that press on one another: with a contact skin, what
   lies together may be a skin apart. */
static void count_touching(const contact_array *contacts, bench_result *r)
{
    last_pair overlapping = {-1, -1}, loaded = {-1, -1};
    for (int32_t i = 0; i < contacts->count; i++) {
        const contact *c = &contacts->data[i];
        if (c->depth > 0) {
            r->contact_points++;
            r->pairs += is_new_pair(&overlapping, c);
        }
        if (c->impulse[0] > 0)
            r->loaded_pairs += is_new_pair(&loaded, c);
    }
}

/* Force of all contacts on a body, against its own x axis [N]. */
static double load_against(const world *w, int32_t body, double time_step)
{
    vec3 sum = {0, 0, 0};
    for (int32_t i = 0; i < w->scratch.contacts.count; i++) {
        const contact *c = &w->scratch.contacts.data[i];
        if (c->a == body || c->b == body)
            sum = vec3_mad(sum, contact_impulse(c), c->a == body ? -1 : 1);
    }
    return mat3_tmul_vec(quat_matrix(w->bodies.orientation[body]), sum).x / time_step;
}

static void add_step(const model *m, const world *w, int32_t ship, bench_result *r)
{
    count_touching(&w->scratch.contacts, r);
    r->mean_depth += w->scratch.solver.mean_depth;
    r->max_depth = fmax(r->max_depth, w->scratch.solver.max_depth);
    r->residual += w->scratch.solver.residual;
    if (ship >= 0)
        r->ship_force += load_against(w, ship, m->time_step);
}

/* ---- clocks ---- */

/* Times of the measured steps, one column each. */
enum { TIME_CPU, TIME_WALL, TIME_FORCES, TIME_COLLIDE, TIME_SOLVE, TIME_COUNT };

typedef struct stopwatch {
    double last, part[STAGE_COUNT]; /* process CPU time [s] */
} stopwatch;

static void stage_done(void *user, step_stage stage)
{
    stopwatch *s = user;
    double now = clock_processor();
    s->part[stage] = now - s->last;
    s->last = now;
}

/* times: TIME_COUNT columns of `steps` rows. */
static fram_status measure_step(context *ctx, const model *m, world *w, int64_t row, int64_t steps, double *times,
                                bench_result *r, fram_error *error)
{
    stopwatch clock = {.last = clock_processor()};
    double wall_time = clock_wall(), cpu = clock.last;
    fram_status status = world_step_watched(ctx, m, w, &(step_watch){stage_done, &clock}, error);
    times[TIME_CPU * steps + row] = clock_processor() - cpu;
    times[TIME_WALL * steps + row] = clock_wall() - wall_time;
    for (int i = 0; i < STAGE_COUNT; i++)
        r->share[i] += clock.part[i];
    times[TIME_FORCES * steps + row] = clock.part[STAGE_FORCES];
    times[TIME_COLLIDE * steps + row] = clock.part[STAGE_DETECTION] + clock.part[STAGE_CRUSHING];
    times[TIME_SOLVE * steps + row] = clock.part[STAGE_SOLVE] + clock.part[STAGE_INTEGRATION];
    return status;
}

static void summarize(const context *ctx, const model *m, const world *w, int64_t steps, double *times, bench_result *r)
{
    double n = (double)steps, took = 0;
    for (int64_t k = 0; k < steps; k++)
        took += times[TIME_WALL * steps + k];
    r->steps = steps;
    r->real_time_factor = took > 0 ? n * m->time_step / took : 0;
    r->contact_points /= n, r->pairs /= n, r->loaded_pairs /= n, r->mean_depth /= n, r->residual /= n,
        r->ship_force /= n;
    r->cpu_median = median(times + TIME_CPU * steps, steps);
    r->wall_median = median(times + TIME_WALL * steps, steps);
    r->forces_median = median(times + TIME_FORCES * steps, steps);
    r->collide_median = median(times + TIME_COLLIDE * steps, steps);
    r->solve_median = median(times + TIME_SOLVE * steps, steps);
    r->cpu = times_of(times + TIME_CPU * steps, steps);
    r->wall = times_of(times + TIME_WALL * steps, steps);
    for (int i = 0; i < STAGE_COUNT; i++)
        r->share[i] = r->cpu.mean > 0 ? r->share[i] / (n * r->cpu.mean) : 0;
    r->kinetic_energy = body_kinetic_energy(ctx, &w->bodies);
    r->state_hash = world_hash(w);
}

fram_status bench_measure(context *ctx, const model *m, world *w, int32_t ship, int64_t warm_steps, int64_t steps,
                          bench_result *out, fram_error *error)
{
    *out = (bench_result){0};
    double *times = memory_array(ctx, TIME_COUNT * (size_t)steps, sizeof *times);
    if (!times)
        return error_memory(error);
    fram_status status = FRAM_OK;
    double all = (double)(warm_steps + steps);
    for (int64_t k = 0; k < warm_steps && status == FRAM_OK; k++) {
        status = work_continue(ctx, "measuring", (double)k, all, error);
        if (status == FRAM_OK)
            status = world_step(ctx, m, w, error);
    }
    for (int64_t k = 0; k < steps && status == FRAM_OK; k++) {
        status = work_continue(ctx, "measuring", (double)(warm_steps + k), all, error);
        if (status != FRAM_OK)
            break;
        status = measure_step(ctx, m, w, k, steps, times, out, error);
        add_step(m, w, ship, out);
    }
    if (status == FRAM_OK)
        summarize(ctx, m, w, steps, times, out);
    memory_free(ctx, times);
    return status;
}

/* ---- scenarios ---- */

static fram_status bench_model(context *ctx, const scenario *s, const model *m, double warm, double time,
                               bench_result *out, fram_error *error)
{
    int64_t steps = scenario_step_at(time, m->time_step);
    world w;
    field_report report;
    fram_status status = build_world(ctx, s, m, &w, &report, error);
    if (status != FRAM_OK)
        return status;
    int32_t ship = w.vessels.count > 0 ? w.vessels.body[0] : -1;
    status = bench_measure(ctx, m, &w, ship, scenario_step_at(warm, m->time_step), steps < 1 ? 1 : steps, out, error);
    out->floes = world_floe_count(&w);
    world_free(ctx, &w);
    return status;
}

fram_status bench_scenario(context *ctx, const scenario *s, double warm, double time, bench_result *out,
                           fram_error *error)
{
    *out = (bench_result){0};
    model m;
    fram_status status = build_model(ctx, s, &m, error);
    if (status != FRAM_OK)
        return status;
    status = bench_model(ctx, s, &m, warm, time, out, error);
    model_free(ctx, &m);
    return status;
}
