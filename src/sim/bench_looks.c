#include "sim/bench_looks.h"

#include "base/clock.h"
#include "sim/bench_measure.h"
#include "sim/build.h"
#include "sim/known_flow.h"

#include <math.h>

/* Steps that settle, and steps of a look: fewer where they take longer than this [s]. */
enum { SETTLES = 10, LOOK_MOST = 60, LOOK_LEAST = 3 };
#define LOOK_SECONDS 0.5

/* A run that is looked at. */
typedef struct looked_run {
    context *ctx;
    const model *m;
    world *w;
    int64_t done, steps; /* made, and all of the run */
    double drift;        /* of all its looks */
    double began, end;   /* processor time of the first step; what all steps may take [s] */
} looked_run;

/* Steps of a look where one takes so long [s]; 0: nobody knows yet. */
static int64_t look_steps(double pace)
{
    return pace > 0 ? (int64_t)fmin(fmax(LOOK_SECONDS / pace, LOOK_LEAST), LOOK_MOST) : LOOK_LEAST;
}

/* Until steps have taken so much processor time [s], or those that are left make the last look of the run; the mean
   time of these steps in *pace, which stays where there are none. */
static fram_status step_on(looked_run *run, double until, double *pace, fram_error *error)
{
    double start = clock_processor() - run->began, now = start;
    int64_t before = run->done;
    fram_status status = FRAM_OK;
    while (status == FRAM_OK && run->done < run->steps - look_steps(*pace) &&
           (now < until || (run->done < SETTLES && now < LOOK_SECONDS))) {
        status = work_continue(run->ctx, "measuring", fmin(now, run->end), run->end, error);
        if (status == FRAM_OK)
            status = world_step(run->ctx, run->m, run->w, error);
        run->done++;
        now = clock_processor() - run->began;
        *pace = (now - start) / (double)(run->done - before);
    }
    return status;
}

static fram_status look(looked_run *run, double pace, bench_look *out, fram_error *error)
{
    int64_t most = look_steps(pace), left = run->steps - run->done, steps = left > 0 && left < most ? left : most;
    bench_result r;
    /* How far it is was told by time, not by the steps of this look. */
    work_function told = run->ctx->work;
    run->ctx->work = NULL;
    fram_status status = bench_measure(run->ctx, run->m, run->w, -1, 0, steps, &r, error);
    run->ctx->work = told;
    *out = (bench_look){r.cpu_median, r.contact_points, world_floe_count(run->w), run->drift, run->done, steps};
    run->done += steps;
    return status;
}

static fram_status look_at_world(looked_run *run, const double *after, int count, bench_look *out, fram_error *error)
{
    fram_status status = FRAM_OK;
    double pace = 0;
    run->began = clock_processor();
    run->end = after[count - 1];
    for (int i = 0; i < count && status == FRAM_OK; i++) {
        status = step_on(run, after[i], &pace, error);
        if (status == FRAM_OK && (i == 0 || run->done < run->steps))
            status = look(run, pace, &out[i], error);
        else if (i > 0)
            out[i] = out[i - 1];
    }
    return status;
}

fram_status bench_looks(context *ctx, const scenario *s, build_look made, const double *after, int count,
                        bench_look *out, double *build, fram_error *error)
{
    model m;
    world w;
    field_report report;
    double began = clock_processor();
    fram_status status = build_model(ctx, s, &m, error);
    if (status != FRAM_OK) {
        if (made)
            made(ctx, s, NULL, NULL);
        return status;
    }
    status = build_world(ctx, s, &m, &w, &report, error);
    *build = clock_processor() - began;
    if (made)
        made(ctx, s, status == FRAM_OK ? &m : NULL, status == FRAM_OK ? &w : NULL);
    if (status == FRAM_OK) {
        const known_flow drift = known_drift(s, &m.history);
        looked_run run = {.ctx = ctx,
                          .m = &m,
                          .w = &w,
                          .steps = scenario_step_at(s->run.duration, s->run.time_step),
                          .drift = drift.steady ? drift.fastest : 0};
        status = look_at_world(&run, after, count, out, error);
        world_free(ctx, &w);
    }
    model_free(ctx, &m);
    return status;
}
