#include "sim/bench.h"

#include "sim/build.h"

#include <stdlib.h>
#include <time.h>

static double seconds(clockid_t id)
{
    struct timespec t;
    clock_gettime(id, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static double median(double *value, int64_t count)
{
    qsort(value, (size_t)count, sizeof *value, ascending);
    return count % 2 ? value[count / 2] : (value[count / 2 - 1] + value[count / 2]) / 2;
}

/* Pairs of bodies in contact: contacts of one pair follow one another. */
static int32_t touching_pairs(const contact_array *c)
{
    int32_t pairs = 0;
    for (int32_t i = 0; i < c->count; i++)
        pairs += i == 0 || c->data[i].a != c->data[i - 1].a || c->data[i].b != c->data[i - 1].b;
    return pairs;
}

static void add_step(const world *w, bench_result *r)
{
    r->contact_points += w->scratch.contacts.count;
    r->pairs += touching_pairs(&w->scratch.contacts);
    r->mean_depth += w->scratch.solver.mean_depth;
    r->max_depth = fmax(r->max_depth, w->scratch.solver.max_depth);
    r->residual += w->scratch.solver.residual;
    if (w->vessels.count > 0) {
        mat3 rotation = quat_matrix(w->bodies.orientation[w->vessels.body[0]]);
        r->ship_force += mat3_tmul_vec(rotation, w->scratch.ice_loads.data[0].total.force).x;
    }
}

static fram_status measure(context *ctx, const step_settings *settings, world *w, int64_t steps, double *cpu,
                           double *wall, bench_result *r, fram_error *error)
{
    double begun = seconds(CLOCK_MONOTONIC);
    for (int64_t k = 0; k < steps; k++) {
        double c = seconds(CLOCK_PROCESS_CPUTIME_ID), t = seconds(CLOCK_MONOTONIC);
        fram_status status = world_step(ctx, settings, w, error);
        if (status != FRAM_OK)
            return status;
        cpu[k] = seconds(CLOCK_PROCESS_CPUTIME_ID) - c;
        wall[k] = seconds(CLOCK_MONOTONIC) - t;
        add_step(w, r);
    }
    double n = (double)steps, took = seconds(CLOCK_MONOTONIC) - begun;
    r->steps = steps;
    r->real_time_factor = took > 0 ? n * settings->time_step / took : 0;
    r->contact_points /= n, r->pairs /= n, r->mean_depth /= n, r->residual /= n, r->ship_force /= n;
    r->cpu_median = median(cpu, steps);
    r->wall_median = median(wall, steps);
    return FRAM_OK;
}

fram_status bench_scenario(context *ctx, const scenario *s, double warm, double time, bench_result *out,
                           fram_error *error)
{
    *out = (bench_result){0};
    step_settings settings = build_settings(s);
    int64_t warm_steps = (int64_t)floor(warm / settings.time_step + 0.5),
            steps = (int64_t)floor(time / settings.time_step + 0.5);
    if (steps < 1)
        steps = 1;
    world w;
    build_report report;
    fram_status status = build_world(ctx, s, &w, &report, error);
    if (status != FRAM_OK)
        return status;
    double *times = memory_array(ctx, 2 * (size_t)steps, sizeof *times);
    if (!times)
        status = error_memory(error);
    for (int64_t k = 0; k < warm_steps && status == FRAM_OK; k++)
        status = world_step(ctx, &settings, &w, error);
    if (status == FRAM_OK)
        status = measure(ctx, &settings, &w, steps, times, times + steps, out, error);
    for (int32_t i = 0; i < w.floes.count; i++)
        out->floes += w.floes.body[i] >= 0;
    out->kinetic_energy = body_books_of(&w.bodies).kinetic_energy;
    out->state_hash = world_hash(&w);
    memory_free(ctx, times);
    world_free(ctx, &w);
    return status;
}
