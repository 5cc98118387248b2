#include "sim/step.h"

#include "base/lent_threads.h"
#include "base/number_text.h"
#include "base/pool.h"
#include "model/world_invariants.h"
#include "sim/approach_watch.h"
#include "sim/astray.h"
#include "sim/events_tell.h"
#include "sim/feed.h"
#include "sim/fenders.h"
#include "sim/ice_loads.h"
#include "sim/mechanisms.h"
#include "sim/media_now.h"
#include "sim/propulsion_forces.h"
#include "sim/station_forces.h"
#include "sim/wall_check.h"
#include "sim/wash.h"
#include "vessel/prescribed_path.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

static fram_status water_and_air(context *ctx, const model *m, world *w, fram_error *error)
{
    media now = media_now(m, &w->inputs, w->clock.time[0]);
    const fluid_details details = {.volume = w->scratch.submerged.data,
                                   .solids = w->scratch.fluid.data,
                                   .flooding = m->ventilation ? &w->flooding : NULL,
                                   .time_step = m->time_step};
    fram_status status =
        fluid_apply(ctx, &now, m->drag, &w->bodies, &w->shapes, &w->held_drag, w->scratch.loads.data, &details, error);
    for (int32_t v = 0; v < w->vessels.count && status == FRAM_OK; v++) {
        int32_t body = w->vessels.body[v];
        if (body_is_dynamic(&w->bodies, body))
            fluid_apply_flows(ctx, &now, &m->drag[MATERIAL_HULL], &m->vessels.data[v].flows, &w->bodies, &w->shapes,
                              body, w->scratch.loads.data, &details);
    }
    return status;
}

/* 1. External forces at the old state: gravity, buoyancy, drag, wind, and what came from outside. */
static fram_status fluid_forces(context *ctx, const model *m, world *w, fram_error *error)
{
    int32_t slots = w->bodies.count;
    wrench *loads = w->scratch.loads.data;
    array_clear(&w->scratch.fluid);
    switch (m->forces) {
    case FORCES_NONE:
        break;
    case FORCES_FLUID:
        if (!array_resize(ctx, &w->scratch.submerged, slots) || !array_resize(ctx, &w->scratch.fluid, m->solids.count))
            return error_memory(error);
        return water_and_air(ctx, m, w, error);
    case FORCES_COLUMNS:
        if (!m->columns || m->columns->slots != slots)
            return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL,
                             "the columns of water are not those of this world");
        column_water_apply(ctx, m->columns, &w->bodies, loads);
        return FRAM_OK;
    }
    if (slots > 0)
        memset(loads, 0, (size_t)slots * sizeof *loads);
    return FRAM_OK;
}

/* As prisms_respond for a vessel, by its matrices. */
static void respond_vessel(const model *m, const media *now, world *w, int32_t v)
{
    vessel_mode mode = (vessel_mode)w->vessels.mode[v];
    if (!m->vessels.data[v].has_hydrodynamics || mode == VESSEL_PRESCRIBED)
        return;
    int32_t body = w->vessels.body[v];
    wrench contacts = last_contact_load(w, v), *load = &w->scratch.loads.data[body];
    vec3 before = load->force;
    hydrodynamics_respond(&m->vessels.data[v].hydrodynamics, mode == VESSEL_FREE, now, m->time_step, &w->bodies, body,
                          &contacts, load);
    w->scratch.responses.data[v].force = vec3_sub(load->force, before);
}

/* What the water answers to motion: with all other loads known, since it changes what they do. */
static void respond(context *ctx, const model *m, world *w)
{
    media now = media_now(m, &w->inputs, w->clock.time[0]);
    prisms_respond(ctx, &now, m->drag, &m->floe_response, m->time_step, &w->bodies, &w->shapes,
                   w->scratch.submerged.data, w->scratch.loads.data);
    for (int32_t v = 0; v < w->vessels.count; v++)
        respond_vessel(m, &now, w, v);
}

/* What the solver moved with the hulls, as a force on each; those whose motion is given it does not move. */
static void add_carried_mass(const model *m, world *w)
{
    for (int32_t v = 0; v < w->vessels.count; v++) {
        if (w->vessels.mode[v] == VESSEL_PRESCRIBED)
            continue;
        hull_response *response = &w->scratch.responses.data[v];
        int32_t body = w->vessels.body[v];
        vec3 gain = vec3_sub(w->bodies.velocity[body], response->velocity), mass = w->bodies.added_mass[body];
        mat3 r = quat_matrix(w->bodies.orientation[body]);
        vec3 local = mat3_tmul_vec(r, vec3_scale(gain, -1 / m->time_step));
        vec3 force = mat3_mul_vec(r, vec3_make(mass.x * local.x, mass.y * local.y, mass.z * local.z));
        response->force = vec3_add(response->force, force);
    }
}

/* No response yet; the velocities as they are before the step. */
static bool start_responses(context *ctx, world *w)
{
    if (!array_resize(ctx, &w->scratch.responses, w->vessels.count))
        return false;
    for (int32_t v = 0; v < w->vessels.count; v++)
        w->scratch.responses.data[v] = (hull_response){{0, 0, 0}, w->bodies.velocity[w->vessels.body[v]]};
    return true;
}

/* Forces that were given from outside. */
static void add_outside(world *w)
{
    const input_table *in = &w->inputs;
    for (int32_t i = 0; i < in->count; i++) {
        int32_t slot = in->kind[i] == INPUT_FORCE ? w->vessels.body[in->which[i]] : in->which[i];
        if (in->kind[i] != INPUT_FORCE && in->kind[i] != INPUT_WRENCH)
            continue;
        wrench *load = &w->scratch.loads.data[slot];
        load->force = vec3_add(load->force, in->first[i]);
        load->moment = vec3_add(load->moment, in->second[i]);
    }
}

static fram_status external_forces(context *ctx, const model *m, world *w, fram_error *error)
{
    if (!array_resize(ctx, &w->scratch.loads, w->bodies.count) || !start_responses(ctx, w))
        return error_memory(error);
    fram_status status = fluid_forces(ctx, m, w, error);
    if (status != FRAM_OK)
        return status;
    add_outside(w);
    int32_t told = w->events.count;
    status = station_forces(ctx, m, w, error);
    if (status == FRAM_OK)
        status = propulsion_forces(ctx, m, w, error);
    if (status == FRAM_OK)
        status = wash_forces(ctx, m, w, error);
    if (status == FRAM_OK)
        status = approach_watch(ctx, m, w, error);
    events_tell(ctx, m, w, told);
    if (status != FRAM_OK)
        return status;
    if (m->forces == FORCES_FLUID)
        respond(ctx, m, w);
    vessel_drive(&w->vessels, &w->bodies, w->clock.time[0] + m->time_step);
    vessel_follow(&w->vessels, &w->waypoints, &w->bodies, w->clock.time[0] + m->time_step, m->time_step);
    feed_drive(m, w, w->clock.time[0] + m->time_step);
    return FRAM_OK;
}

/* What rests rests on the sheet where one drifts, which goes its way of the step.  Nothing that is slower than a floe
   may be as it falls asleep is told apart from rest then: the current that carries a sheet is its velocity a step
   ago. */
static rest_media rest_media_now(const model *m, const world *w)
{
    media now = media_now(m, &w->inputs, w->clock.time[0]);
    bool drifts = w->drift.count > 0;
    vec2 way = drifts ? w->drift.way[0] : (vec2){0, 0};
    vec3 ground = vec3_make(way.x / m->time_step, way.y / m->time_step, 0);
    rest_media around = {.wind = vec3_sub(now.wind, ground),
                         .current = vec3_sub(now.current, ground),
                         .ground = ground,
                         .slack = drifts ? m->rest.speed : 0,
                         .swerve = m->rest.speed > 0 ? 2 * m->rest.speed * m->time_step / m->rest.time : 0};
    around.calm = vec3_dot(now.wind, now.wind) == 0 && vec3_length(around.current) <= 0.5 * around.slack &&
                  now.profile.count == 0;
    return around;
}

/* Contacts name slots, and pieces of a break may stand in those when the step is over. */
static bool keep_generations(context *ctx, world *w)
{
    const body_table *b = &w->bodies;
    if (!array_resize(ctx, &w->scratch.contact_generations, b->count))
        return false;
    if (b->count > 0)
        memcpy(w->scratch.contact_generations.data, b->generation, (size_t)b->count * sizeof *b->generation);
    return true;
}

/* 2. Broad phase, narrow phase; what moves wakes what sleeps near it. */
static fram_status detect_contacts(context *ctx, const model *m, world *w, fram_error *error)
{
    rest_media around = rest_media_now(m, w);
    if (!rest_follow(ctx, &m->rest, &around, &w->bodies, &w->boxes, &w->rest, &w->scratch.rest_seen))
        return error_memory(error);
    fram_status status = broad_phase_update(ctx, &w->bodies, &w->shapes, &m->collision, &w->boxes, &w->pairs,
                                            w->scratch.collision, error);
    if (status != FRAM_OK)
        return status;
    rest_wake_near(&m->rest, &w->bodies, &w->pairs, &w->rest);
    array_clear(&w->scratch.contacts);
    array_clear(&w->scratch.patch_pairs);
    if (!keep_generations(ctx, w))
        return error_memory(error);
    return narrow_phase_run(ctx, &w->bodies, &w->shapes, &m->policies, &w->boxes, &w->pairs, &w->scratch.contacts,
                            &w->scratch.patch_pairs, w->scratch.collision, error);
}

/* 3. Crushing patches, their contacts and caps; what fenders carry. */
static fram_status limit_crushing(context *ctx, const model *m, world *w, fram_error *error)
{
    array_clear(&w->scratch.patches);
    fenders_limit(m, w);
    fram_status status = crushing_contacts(ctx, w->scratch.crushing, &m->crushing, &w->bodies, &w->shapes, &w->floes,
                                           &w->edge_supports, &w->pairs, &w->scratch.patch_pairs, &m->policies,
                                           &w->scratch.patches, &w->scratch.contacts, error);
    edge_job edges = {&m->crushing.edges, m->time_step, &w->bodies, &w->floes, &w->edge_supports, &w->memory};
    if (status == FRAM_OK &&
        !edge_rows_set(ctx, &edges, &w->scratch.edge_rows, &w->scratch.patches, &w->scratch.contacts))
        return error_memory(error);
    return status;
}

/* 4. New velocities. */
static fram_status solve_velocities(context *ctx, const model *m, world *w, fram_error *error)
{
    rest_media around = rest_media_now(m, w);
    rest_wake_struck(&m->rest, &around, &w->bodies, &w->scratch.contacts, &w->rest);
    fram_status status =
        solver_solve(ctx, w->scratch.solve, &m->solver, m->time_step, &w->bodies, w->scratch.loads.data, &w->joints,
                     &w->scratch.contacts, &w->memory, &w->scratch.solver, error);
    if (status == FRAM_OK) {
        rest_note(&m->rest, &around, m->time_step, &w->bodies, &w->shapes, &w->scratch.contacts, &w->rest);
        add_carried_mass(m, w);
        feed_load(m, w);
        status = wall_watch(ctx, m, w) ? FRAM_OK : error_memory(error);
    }
    return status;
}

/* 5. Fracture of breakable floes, from the solved impulses. */
static fram_status break_floes(context *ctx, const model *m, world *w, fram_error *error)
{
    fracture_state state = {.bodies = &w->bodies,
                            .shapes = &w->shapes,
                            .floes = &w->floes,
                            .contacts = &w->scratch.contacts,
                            .memory = &w->memory,
                            .next_number = w->clock.next_floe,
                            .crushed = w->clock.ice_crushed,
                            .gained = w->clock.ice_gained,
                            .edge_loads = &w->edge_loads,
                            .supports = &w->edge_supports,
                            .retreats = &w->hull_retreats};
    fracture_settings settings = m->fracture;
    settings.tiles = feed_grid(m, w);
    array_clear(&w->scratch.fractures);
    fram_status status = fracture_run(ctx, w->scratch.fracture, &settings, w->scratch.plane, &w->scratch.patches,
                                      &state, &w->scratch.fractures, error);
    for (int32_t i = 0; i < w->scratch.fractures.count; i++) {
        const fracture_event *e = &w->scratch.fractures.data[i];
        w->clock.splits[0] += e->kind == FRACTURE_SPLIT;
        w->clock.bendings[0] += e->kind == FRACTURE_BENDING;
        w->clock.ice_gained[0] += e->mass_gained;
        *(m->brash ? w->clock.brash_mass : w->clock.ice_lost) += e->mass_lost;
        if (m->brash)
            w->clock.brash_momentum[0] = vec3_add(w->clock.brash_momentum[0], e->momentum_lost);
    }
    mechanisms_sum(w);
    return status;
}

/* 6. Time integration, then position correction. */
static fram_status integrate(context *ctx, const model *m, world *w, fram_error *error)
{
    integrate_poses(ctx, &w->bodies, m->time_step);
    return solver_correct_positions(ctx, w->scratch.solve, &m->solver, m->time_step, &w->bodies, &w->joints,
                                    &w->scratch.contacts, error);
}

/* Floes whose centre left an open domain by more than their radius are taken out, and their mass is booked; the tiles
   of a sheet that drifts leave with their cells, and those of one that is held stay where it reaches out of the domain.
   Where none drifts, what sleeps has not moved since it was looked at here: it fell asleep after that, at the end of
   its step. */
static void remove_strays(const model *m, world *w)
{
    for (int32_t i = 0; i < w->floes.count; i++) {
        int32_t body = w->floes.body[i];
        bool stays =
            body < 0 || w->floes.tile[i] != 0 || (w->drift.count == 0 && w->bodies.motion[body] == MOTION_ASLEEP);
        if (stays)
            continue;
        vec3 r = w->bodies.position[body];
        double reach = w->shapes.shapes.radius[w->bodies.shape[body]];
        if (r.x + reach >= m->domain.lo.x && r.x - reach <= m->domain.hi.x && r.y + reach >= m->domain.lo.y &&
            r.y - reach <= m->domain.hi.y)
            continue;
        w->clock.ice_left[0] += w->bodies.mass[body];
        floe_remove(&w->bodies, &w->shapes, &w->floes, i);
    }
}

/* What the edge of the domain takes, and gives; then the shapes that nobody has any more go, those of floes that broke
   in a basin with walls too.  At last what rests falls asleep. */
static fram_status cross_edge(context *ctx, const model *m, world *w, fram_error *error)
{
    if (m->boundary == DOMAIN_OPEN || w->drift.count > 0)
        remove_strays(m, w);
    fram_status status = m->boundary == DOMAIN_FEEDING ? feed_step(ctx, m, w, error) : FRAM_OK;
    if (status != FRAM_OK)
        return status;
    if (shape_compact(ctx, &w->shapes) != FRAM_OK)
        return error_memory(error);
    rest_media around = rest_media_now(m, w);
    rest_settle(&m->rest, &around, &w->bodies, &w->scratch.contacts, &w->rest, &w->scratch.rest_seen);
    return FRAM_OK;
}

static fram_status refuse_state(const world *w, int32_t body, const char *what, fram_error *error)
{
    const body_table *b = &w->bodies;
    vec3 r = b->position[body];
    const char *kind = b->material[body] == MATERIAL_ICE    ? "floe"
                       : b->material[body] == MATERIAL_HULL ? "vessel"
                                                            : "wall or carriage";
    return error_set(error, FRAM_ERROR_SIMULATION, NULL, 0, NULL,
                     "the simulation went wrong in step %lld (t = %g s): body %d (%s, %g kg) at (%s, %s, %g) m %s; %s",
                     (long long)w->clock.step[0], w->clock.time[0], (int)body, kind, b->mass[body],
                     coordinate_text_of(r.x).text, coordinate_text_of(r.y).text, r.z, what, astray_remedy(w, body));
}

static fram_status tell_state(const model *m, const world *w, int32_t body, fram_error *error)
{
    char what[120];
    double speed = vec3_length(w->bodies.velocity[body]), turn = vec3_length(w->bodies.angular_velocity[body]);
    if (!(isfinite(speed) && isfinite(turn) && isfinite(vec3_length(w->bodies.position[body]))))
        return refuse_state(w, body, "has a place or velocity that is no finite number", error);
    double reach = world_reach_about(w, body, w->bodies.angular_velocity[body]);
    if (speed > m->speed_limit)
        snprintf(what, sizeof what, "moves at %.4g m/s, and run.speed_limit is %g m/s", speed, m->speed_limit);
    else
        snprintf(what, sizeof what,
                 "turns at %.4g rad/s, its rim %.4g m off at %.4g m/s, and run.speed_limit is %g m/s", turn, reach,
                 turn * reach, m->speed_limit);
    return refuse_state(w, body, what, error);
}

typedef struct state_check {
    const world *w;
    double speed_limit;
} state_check;

/* A strip turns about its own length more often than about anything else: where a bound by its whole reach does not do,
   its rim is looked at.  Comparisons are written so that a value that is no number fails them. */
static bool is_slow(const world *w, int32_t body, double most)
{
    vec3 v = w->bodies.velocity[body], o = w->bodies.angular_velocity[body];
    double reach = world_reach(w, body), limit = most * most;
    return vec3_dot(v, v) <= limit &&
           (vec3_dot(o, o) * reach * reach <= limit || vec3_length(o) * world_reach_about(w, body, o) <= most);
}

/* The first body that moves and has gone astray. */
static int32_t find_astray(const void *arg, int32_t first, int32_t end)
{
    const state_check *check = arg;
    const body_table *b = &check->w->bodies;
    for (int32_t i = body_next_moving(b, first, end); i < end; i = body_next_moving(b, i + 1, end)) {
        vec3 r = b->position[i];
        bool finite = isfinite(r.x) && isfinite(r.y) && isfinite(r.z);
        if (!finite || !is_slow(check->w, i, check->speed_limit))
            return i;
    }
    return end;
}

static void count_step(const model *m, world *w)
{
    w->clock.step[0]++;
    w->clock.time[0] = (double)w->clock.step[0] * m->time_step;
}

/* A run that goes wrong stops with a diagnosis, never with silent nonsense.  Before what crosses the edge is taken out:
   a floe that flew off would be gone. */
static fram_status check_state(context *ctx, const model *m, world *w, fram_error *error)
{
    int32_t body = pool_find(ctx, find_astray, &(state_check){w, m->speed_limit}, w->bodies.count);
    if (body == w->bodies.count)
        return FRAM_OK;
    count_step(m, w);
    return tell_state(m, w, body, error);
}

/* The rooms below tell a polygon or a table that cannot be as bad input; in a step nobody has given it: the simulation
   failed. */
static fram_status stage_failure(const world *w, fram_status status, fram_error *error)
{
    if (status != FRAM_ERROR_INPUT && status != FRAM_ERROR_USAGE)
        return status;
    char why[sizeof error->message] = "";
    if (error)
        memcpy(why, error->message, sizeof why);
    return error_set(error, FRAM_ERROR_SIMULATION, NULL, 0, NULL,
                     "the simulation could not go on in step %lld (t = %g s): %s", (long long)w->clock.step[0] + 1,
                     w->clock.time[0], why);
}

#ifndef NDEBUG
/* Stops the program where an invariant does not hold, and says which. */
static void assert_invariant(context *ctx, const world *w, bool is_broken, const char *text)
{
    if (is_broken)
        log_write(ctx, LOG_ERROR, "step %lld: %s", (long long)w->clock.step[0], text);
    assert(!is_broken);
}

static void assert_stage(context *ctx, const model *m, const world *w, int stage)
{
    char text[INVARIANT_TEXT] = "";
    if (stage == STAGE_SOLVE)
        assert_invariant(ctx, w, contact_invariant_broken(w, text), text);
    if (stage == STAGE_EDGE)
        assert_invariant(ctx, w, world_invariant_broken(m, w, text), text);
}
#endif

static fram_status run_stages(context *ctx, const model *m, world *w, const step_watch *watch, fram_error *error)
{
    typedef fram_status (*stage)(context *, const model *, world *, fram_error *);
    static const stage stages[STAGE_COUNT] = {
        [STAGE_FORCES] = external_forces, [STAGE_DETECTION] = detect_contacts, [STAGE_CRUSHING] = limit_crushing,
        [STAGE_SOLVE] = solve_velocities, [STAGE_LOADS] = sum_ice_loads,       [STAGE_FRACTURE] = break_floes,
        [STAGE_INTEGRATION] = integrate,  [STAGE_EDGE] = cross_edge,
    };
#ifndef NDEBUG
    world_poison_scratch(w);
#endif
    for (int i = 0; i < STAGE_COUNT; i++) {
        fram_status status = stages[i](ctx, m, w, error);
        if (status != FRAM_OK)
            return stage_failure(w, status, error);
#ifndef NDEBUG
        assert_stage(ctx, m, w, i);
#endif
        if (i == STAGE_INTEGRATION)
            status = check_state(ctx, m, w, error);
        if (status != FRAM_OK)
            return status;
        if (watch)
            watch->done(watch->user, (step_stage)i);
    }
    return FRAM_OK;
}

fram_status world_step_watched(context *ctx, const model *m, world *w, const step_watch *watch, fram_error *error)
{
    fram_status status = run_stages(ctx, m, w, watch, error);
    input_drop(&w->inputs, INPUT_WRENCH); /* used up, and till here known to who tells why a step failed */
    if (status != FRAM_OK)
        return status;
    count_step(m, w);
    w->scratch.step = w->clock.step[0];
    return lent_threads_check(ctx, error);
}

fram_status world_step(context *ctx, const model *m, world *w, fram_error *error)
{
    return world_step_watched(ctx, m, w, NULL, error);
}

fram_status world_add_wrench(context *ctx, world *w, int32_t slot, wrench load, fram_error *error)
{
    rest_wake(&w->bodies, &w->rest, slot);
    int32_t row = input_row(ctx, &w->inputs, INPUT_WRENCH, slot);
    if (row < 0)
        return error_memory(error);
    w->inputs.first[row] = vec3_add(w->inputs.first[row], load.force);
    w->inputs.second[row] = vec3_add(w->inputs.second[row], load.moment);
    return FRAM_OK;
}
