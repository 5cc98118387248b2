#include "sim/rerun.h"

#include "io/path.h"
#include "io/scenario_file.h"
#include "sim/build.h"
#include "sim/checkpoint.h"
#include "sim/ice_loads.h"
#include "sim/peak_watch.h"
#include "sim/rerun_check.h"
#include "sim/rerun_step.h"
#include "sim/run_folder.h"
#include "sim/run_inputs.h"
#include "sim/step.h"

#include <string.h>

/* The methods differ from so long before the moment [s]: long enough for contacts to settle, short enough that the
   motions stay those of the run. */
static const double DIFFERS_FOR = 1;
/* Sweeps a step of the accurate solver: ten times the default of a run.  Level ice that jams would take a hundred times
   as many to its tolerance, and minutes for a second. */
enum { ACCURATE_SWEEPS = 300 };

typedef struct rerun {
    context *ctx;
    const char *folder;
    scenario s;
    double time;
    double known_from; /* as rerun_moment */
    double ran;        /* where the run stands, as rerun_run_end [s] */
    int32_t vessel;
    rerun_check check;
    rerun_result *out;
} rerun;

static fram_status step_once(const rerun *r, const model *m, world *w, fram_error *error)
{
    if (stop_is_asked(r->ctx->stop))
        return error_set(error, FRAM_INTERRUPTED, NULL, 0, NULL, "interrupted at t = %g s", w->clock.time[0]);
    double since = r->out->start, whole = fmax(r->time - since, 0);
    /* The largest load is looked for until half an averaging window after the moment. */
    fram_status status = work_continue(r->ctx, "computing again", fmin(w->clock.time[0] - since, whole), whole, error);
    if (status != FRAM_OK)
        return status;
    return world_step(r->ctx, m, w, error);
}

/* As the run was made: what comes out is the run's, or an error. */
static fram_status step_same(rerun *r, const model *m, world *w, fram_error *error)
{
    fram_status status = step_once(r, m, w, error);
    if (status != FRAM_OK)
        return status;
    status = rerun_check_step(&r->check, w, error);
    r->out->untold = status == FRAM_ERROR_INPUT;
    return status;
}

/* By another method, which may go wrong where the run did not: that is an answer.  The time is the end of the step that
   goes wrong, whether or not the world counted it: above 0 in the first step too. */
static fram_status step_other(rerun *r, const model *m, world *w, double *wrong, fram_error *error)
{
    fram_error reason = {0};
    double end = (double)(w->clock.step[0] + 1) * m->time_step;
    fram_status status = step_once(r, m, w, &reason);
    if (status == FRAM_ERROR_SIMULATION) {
        *wrong = end;
        return FRAM_OK;
    }
    if (status != FRAM_OK && error)
        *error = reason;
    return status;
}

/* Half a window after the moment, since another method has its peak a little earlier or later; not beyond the last step
   that the run made, behind which it may have failed. */
static int64_t last_step_to_follow(const rerun *r, const model *m, const world *w)
{
    int64_t end = scenario_step_at(r->time, m->time_step), last = end + load_window_length(w) / 2;
    int64_t ran = r->ran >= 0 ? scenario_step_at(r->ran, m->time_step) : last;
    return ran >= last ? last : ran > end ? ran : end;
}

/* Largest averaged load from where the world is to the last step. */
static fram_status follow(rerun *r, const model *m, world *w, bool same, rerun_method *out, fram_error *error)
{
    fram_status status = FRAM_OK;
    int64_t end = scenario_step_at(r->time, m->time_step), last = last_step_to_follow(r, m, w);
    /* From where the window holds nothing but the method's own steps; from the run's start on it never holds others. */
    int64_t first = w->clock.step[0] + load_window_length(w);
    if (first > end)
        first = end;
    *out = (rerun_method){0};
    if (same) {
        r->out->first = (double)first * m->time_step;
        r->out->last = (double)last * m->time_step;
    }
    while (status == FRAM_OK && w->clock.step[0] < last && !(out->wrong > 0)) {
        status = same ? step_same(r, m, w, error) : step_other(r, m, w, &out->wrong, error);
        vec3 f = load_window_average(w, r->vessel).force;
        if (w->clock.step[0] >= first)
            out->load = fmax(out->load, sqrt(f.x * f.x + f.y * f.y));
    }
    while (status == FRAM_OK && same && rerun_check_awaits(&r->check, r->time))
        status = step_same(r, m, w, error);
    return status == FRAM_OK && same ? rerun_check_end(&r->check, w, r->time, error) : status;
}

/* As the run was made, with what carries the load at the moment. */
static fram_status explain(const rerun *r, const model *m, world *w, fram_error *error)
{
    peak_watch watch;
    peak_watch_init(r->ctx, m->time_step, 0, &watch);
    fram_status status = FRAM_OK;
    int64_t end = scenario_step_at(r->time, m->time_step);
    while (status == FRAM_OK && w->clock.step[0] < end) {
        status = step_once(r, m, w, error);
        if (status == FRAM_OK)
            status = peak_watch_keep(&watch, w, error);
    }
    if (status == FRAM_OK)
        status = peak_watch_explain(&watch, w, r->vessel, &r->out->detail, error);
    peak_watch_free(&watch);
    return status;
}

/* A copy of the world goes on by another method, with its time step or a part of that. */
static fram_status follow_other(rerun *r, const world *from, int32_t parts, bool accurate, rerun_method *out,
                                fram_error *error)
{
    scenario s = r->s;
    model m = {0};
    world w = {0};
    s.run.time_step /= parts;
    if (accurate) {
        s.run.solver.kind = SOLVER_ACCURATE;
        s.run.solver.most_iterations = ACCURATE_SWEEPS;
    }
    context quiet = *r->ctx; /* what a model warns of was told with the first */
    quiet.verbosity = LOG_ERROR;
    fram_status status = build_model(&quiet, &s, &m, error);
    if (status != FRAM_OK)
        return status;
    status = world_copy(r->ctx, from, &w, error);
    if (status == FRAM_OK) {
        if (parts > 1)
            status = rerun_divide_step(r->ctx, from, parts, &m, &w, error);
        if (status == FRAM_OK)
            status = follow(r, &m, &w, !accurate && parts == 1, out, error);
        world_free(r->ctx, &w);
    }
    model_free(r->ctx, &m);
    return status;
}

/* From the fork: the run's own method twice, for the moment and for the largest load, then the others. */
static fram_status compare(rerun *r, const model *m, world *w, fram_error *error)
{
    world again = {0};
    fram_status status = follow_other(r, w, 1, false, &r->out->same, error);
    if (status == FRAM_OK)
        status = follow_other(r, w, 2, false, &r->out->half_step, error);
    if (status == FRAM_OK)
        status = follow_other(r, w, 1, true, &r->out->accurate, error);
    if (status == FRAM_OK)
        status = world_copy(r->ctx, w, &again, error);
    if (status != FRAM_OK)
        return status;
    status = explain(r, m, &again, error);
    world_free(r->ctx, &again);
    return status;
}

fram_status rerun_start(context *ctx, const char *folder, const scenario *s, double time, const model *m, world *w,
                        fram_error *error)
{
    checkpoint_note note = {0};
    text_buffer inputs = {0};
    bool found = false;
    fram_status status = scenario_hash(ctx, s, note.scenario_hash, error);
    if (status == FRAM_OK)
        status = run_inputs_list(ctx, s, NULL, &inputs, error);
    if (status == FRAM_OK)
        status = world_init(ctx, m, w, error);
    if (status == FRAM_OK) {
        note.inputs = inputs.data;
        status = checkpoint_read_before(ctx, folder, time, m, w, &note, &found, error);
        if (status != FRAM_OK || !found)
            world_free(ctx, w);
    }
    /* A checkpoint knows of what it is; what is built anew must be what the run was. */
    if (status == FRAM_OK && !found)
        status = run_folder_unchanged(ctx, folder, note.scenario_hash, inputs.data, error);
    text_free(ctx, &inputs);
    if (status != FRAM_OK || found)
        return status;
    field_report report;
    return build_world(ctx, s, m, w, &report, error);
}

static fram_status go_back(rerun *r, const model *m, fram_error *error)
{
    world w = {0};
    double fork = fmax(r->time - DIFFERS_FOR - scenario_averaging_window(&r->s), 0);
    fram_status status = rerun_start(r->ctx, r->folder, &r->s, fork, m, &w, error);
    if (status != FRAM_OK)
        return status;
    r->out->start = w.clock.time[0];
    if (r->out->start < r->known_from - 0.5 * m->time_step) {
        world_free(r->ctx, &w);
        r->out->untold = true;
        return error_set(error, FRAM_ERROR_INPUT, r->folder, 0, "time",
                         "it was recorded from %g s on, what it was told until then stands in no file, and no "
                         "checkpoint of it is a second and an averaging window before %g s",
                         r->known_from, r->time);
    }
    log_write(r->ctx, LOG_INFO, "computing again from t = %g s", r->out->start);
    if (r->vessel >= w.vessels.count)
        status = error_set(error, FRAM_ERROR_INPUT, r->folder, 0, "vessel",
                           "the run has %d vessels, expected one of them", (int)w.vessels.count);
    int64_t first = scenario_step_at(fork, m->time_step);
    while (status == FRAM_OK && w.clock.step[0] < first)
        status = step_same(r, m, &w, error);
    r->out->fork = w.clock.time[0];
    if (status == FRAM_OK)
        status = compare(r, m, &w, error);
    world_free(r->ctx, &w);
    return status;
}

/* From the first step on to the last one of the scenario, or as far as a program took the run beyond that. */
static fram_status check_moment(rerun *r, fram_error *error)
{
    double dt = r->s.run.time_step, end = r->s.run.duration;
    fram_status status = rerun_run_end(r->ctx, r->folder, &r->ran, error);
    end = fmax(end, fmax((double)scenario_step_at(end, dt) * dt, r->ran));
    if (status == FRAM_OK && !(r->time >= dt && r->time <= end * (1 + 1e-12)))
        status = error_set(error, FRAM_ERROR_INPUT, r->folder, 0, "time", "expected a time from %g s to %g s, found %g",
                           dt, end, r->time);
    return status;
}

fram_status rerun_moment(context *ctx, const char *folder, double time, double known_from, int32_t vessel,
                         rerun_result *out, fram_error *error)
{
    char path[PATH_ROOM];
    rerun r = {.ctx = ctx, .folder = folder, .time = time, .known_from = known_from, .vessel = vessel, .out = out};
    memset(out, 0, sizeof *out);
    fram_status status = path_join(folder, "scenario.yaml", path, error);
    if (status == FRAM_OK)
        status = scenario_read(ctx, path, NULL, &r.s, error);
    if (status != FRAM_OK)
        return status;
    model m = {0};
    status = check_moment(&r, error);
    if (status == FRAM_OK)
        status = build_model(ctx, &r.s, &m, error);
    if (status == FRAM_OK) {
        status = rerun_check_open(ctx, folder, &r.s, &r.check, error);
        if (status == FRAM_OK)
            status = go_back(&r, &m, error);
        rerun_check_close(&r.check);
        model_free(ctx, &m);
    }
    scenario_free(ctx, &r.s);
    return status;
}
