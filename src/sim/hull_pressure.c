#include "sim/hull_pressure_parts.h"

#include "io/path.h"
#include "io/scenario_file.h"
#include "model/scenario_vessel.h"
#include "sim/build_model.h"
#include "sim/rerun.h"
#include "sim/rerun_check.h"
#include "sim/run_folder.h"
#include "sim/run_inputs.h"
#include "sim/step.h"

/* The pose in which the contacts of a step were found: the vessel has moved on when the step ends. */
typedef struct hull_pose {
    vec3 position, centre; /* of the centre of mass: global, ship coordinates */
    mat3 rotation;
} hull_pose;

static hull_pose pose_of(const world *w, int32_t vessel)
{
    int32_t body = w->vessels.body[vessel];
    return (hull_pose){w->bodies.position[body], w->vessels.centre[vessel], quat_matrix(w->bodies.orientation[body])};
}

/* As the series does: the normal part by the contact's mechanism, the rest friction. */
static void add_part(pressure_map *p, const ice_share *share, vec3 normal, vec3 friction, double time_step)
{
    vec3 *part = p->part[share->zone];
    part[share->mechanism] = vec3_mad(part[share->mechanism], normal, time_step);
    part[MECHANISM_FRICTION] = vec3_mad(part[MECHANISM_FRICTION], friction, time_step);
}

static vec3 ship_place(const hull_pose *pose, vec3 point)
{
    return vec3_add(mat3_tmul_vec(pose->rotation, vec3_sub(point, pose->position)), pose->centre);
}

/* What a point stands for: a part of its patch, whose other points may carry nothing in this step. */
static patch_area area_of(const world *w, const hull_pose *pose, const ice_share *share)
{
    vec3 point[PATCH_AREA_POINTS];
    int32_t count = patch_area_points(w, share->patch, share->point, point);
    for (int32_t i = 0; i < count; i++)
        point[i] = ship_place(pose, point[i]);
    return patch_area_of(point, count);
}

static bool add_contacts(pressure_map *p, const world *w, const hull_pose *pose, double time_step)
{
    const ice_share *share = w->scratch.shares.data;
    bool good = true;
    for (int32_t i = 0; i < w->scratch.shares.count && good; i++) {
        if (share[i].vessel != p->vessel)
            continue;
        patch_area area = area_of(w, pose, &share[i]);
        vec3 normal = mat3_tmul_vec(pose->rotation, share[i].normal);
        vec3 friction = mat3_tmul_vec(pose->rotation, share[i].friction);
        add_part(p, &share[i], normal, friction, time_step);
        good = pressure_add(p, &area, ship_place(pose, share[i].point), normal, friction);
    }
    return good;
}

/* Times are those of steps to this part of a step. */
#define STEP_ROUNDING 1e-6

/* A step belongs to the time in which it ends: windows side by side have each step once.  A run may end by less than a
   step after its duration. */
static int64_t last_step(const pressure_map *p)
{
    double dt = p->s.run.time_step, last = (double)scenario_step_at(p->end, dt);
    return (int64_t)(p->o->to > 0 ? fmin(last, floor(p->o->to / dt + STEP_ROUNDING)) : last);
}

/* Where nothing tells how far the run went, as far as its scenario does.  A program may have gone on beyond that. */
static fram_status find_last_time(pressure_map *p, fram_error *error)
{
    double until;
    fram_status status = rerun_run_end(p->ctx, p->o->folder, &until, error);
    p->end = until >= 0 ? until : p->s.run.duration;
    p->last = last_step(p);
    if (status == FRAM_OK && p->o->to > p->end + STEP_ROUNDING * p->s.run.time_step)
        log_write(p->ctx, LOG_WARNING, "the run has gone to %.10g s: pressures are up to there, not to %.10g s", p->end,
                  p->o->to);
    if (p->o->to > 0)
        p->end = fmin(p->end, p->o->to);
    return status;
}

static fram_status step_checked(pressure_map *p, rerun_check *check, const model *m, world *w, fram_error *error)
{
    if (stop_is_asked(p->ctx->stop))
        return error_set(error, FRAM_INTERRUPTED, NULL, 0, NULL, "interrupted at t = %g s; nothing was written",
                         w->clock.time[0]);
    fram_status status = world_step(p->ctx, m, w, error);
    return status == FRAM_OK ? rerun_check_step(check, w, error) : status;
}

static fram_status step_through(pressure_map *p, rerun_check *check, const model *m, world *w, fram_error *error)
{
    double slack = STEP_ROUNDING * m->time_step;
    int64_t first = w->clock.step[0], last = p->last;
    fram_status status = FRAM_OK;
    while (status == FRAM_OK && w->clock.step[0] < last) {
        work_tell(p->ctx, "computing again", (double)(w->clock.step[0] - first), (double)(last - first));
        hull_pose pose = pose_of(w, p->vessel);
        status = step_checked(p, check, m, w, error);
        if (status != FRAM_OK || w->clock.time[0] <= p->o->from + slack)
            continue;
        if (!add_contacts(p, w, &pose, m->time_step))
            return error_memory(error);
        pressure_end_step(p, w->clock.time[0], m->time_step);
    }
    double end = (double)last * m->time_step;
    while (status == FRAM_OK && rerun_check_awaits(check, end))
        status = step_checked(p, check, m, w, error);
    return status == FRAM_OK ? rerun_check_end(check, w, end, error) : status;
}

static fram_status compute(pressure_map *p, const model *m, fram_error *error)
{
    world w = {0};
    rerun_check check;
    fram_status status = rerun_check_open(p->ctx, p->o->folder, &p->s, &check, error);
    if (status != FRAM_OK)
        return status;
    status = rerun_start(p->ctx, p->o->folder, &p->s, p->o->from, m, &w, error);
    if (status == FRAM_OK) {
        status = step_through(p, &check, m, &w, error);
        world_free(p->ctx, &w);
    }
    rerun_check_close(&check);
    return status;
}

static fram_status make_panels(pressure_map *p, const model *m, fram_error *error)
{
    const vessel_model *v = &m->vessels.data[p->vessel];
    mesh hull = {0};
    if (!mesh_copy(p->ctx, &hull, &m->solids.data[v->solid].surface))
        return error_memory(error);
    mesh_translate(&hull, v->centre);
    p->centre = v->centre;
    fram_status status = pressure_begin(p, &hull, error);
    mesh_free(p->ctx, &hull);
    return status;
}

static fram_status build_and_compute(pressure_map *p, fram_error *error)
{
    model m = {0};
    fram_status status = build_model(p->ctx, &p->s, &m, error);
    if (status != FRAM_OK)
        return status;
    status = make_panels(p, &m, error);
    if (status == FRAM_OK)
        status = compute(p, &m, error);
    model_free(p->ctx, &m);
    return status;
}

/* ---- what is asked ---- */

static fram_status check_times(const pressure_map *p, fram_error *error)
{
    if (((double)p->last - STEP_ROUNDING) * p->s.run.time_step > p->o->from)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, p->o->folder, 0, "from", "no step ends after %g s and up to %g s",
                     p->o->from, p->end);
}

/* What the run is computed again from is read once more. */
static fram_status keep_inputs(pressure_map *p, fram_error *error)
{
    text_buffer inputs = {0};
    fram_status status = run_inputs_list(p->ctx, &p->s, NULL, &inputs, error);
    if (status == FRAM_OK)
        status = run_inputs_refuse(inputs.data, p->o->output, pressure_is_file, error);
    text_free(p->ctx, &inputs);
    return status;
}

fram_status hull_pressure_write(context *ctx, const pressure_options *o, fram_error *error)
{
    char path[PATH_ROOM];
    pressure_options own = *o;
    pressure_map p = {.ctx = ctx, .o = &own};
    fram_status status = path_join(o->folder, "scenario.yaml", path, error);
    if (status == FRAM_OK)
        status = scenario_read(ctx, path, NULL, &p.s, error);
    if (status != FRAM_OK)
        return status;
    if (isnan(own.rules.size))
        own.rules.size = scenario_size(&p.s);
    status = scenario_choose_vessel(&p.s, p.o->folder, p.o->vessel, &p.vessel, error);
    if (status == FRAM_OK)
        status = find_last_time(&p, error);
    if (status == FRAM_OK)
        status = check_times(&p, error);
    if (status == FRAM_OK)
        status = run_folder_check(o->output, o->force, error);
    if (status == FRAM_OK)
        status = keep_inputs(&p, error);
    if (status == FRAM_OK)
        status = build_and_compute(&p, error);
    if (status == FRAM_OK)
        status = pressure_write_files(&p, error);
    pressure_free(&p);
    scenario_free(ctx, &p.s);
    return status;
}
