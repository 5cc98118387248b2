/* Worlds of the public API: stepping, reading the state, acting on bodies. */
#include "api/arguments.h"
#include "api/handles.h"

#include "base/clock.h"
#include "fram/live.h"
#include "model/scenario_vessel.h"
#include "sim/build.h"
#include "sim/notes.h"

#include <math.h>

/* Beyond all that can be meant [N, N m]. */
#define WRENCH_MOST 1e200

/* ---- life ---- */

static void base_leave(context *ctx, world_base *base)
{
    if (!base || atomic_fetch_sub(&base->users, 1) > 1)
        return;
    model_free(ctx, &base->model);
    array_free(ctx, &base->controls);
    series_layout_free(ctx, &base->columns);
    memory_free(ctx, base);
}

fram_world *world_handle(const fram_scenario *s, world_base *base)
{
    context *ctx = &s->context->inner;
    fram_world *w = memory_array(ctx, 1, sizeof *w);
    if (!w)
        return NULL;
    w->scenario = s;
    w->aside = memory_array(ctx, 1, sizeof *w->aside);
    if (!w->aside) {
        world_handle_free(w);
        return NULL;
    }
    atomic_init(&w->aside->calls, 0);
    w->base = base;
    atomic_fetch_add(&base->users, 1);
    return w;
}

void world_handle_free(fram_world *w)
{
    context *ctx = &w->scenario->context->inner;
    base_leave(ctx, w->base);
    memory_free(ctx, w->row);
    if (w->aside)
        kept_free(&w->aside->kept, ctx);
    memory_free(ctx, w->aside);
    memory_free(ctx, w);
}

bool world_make_row(fram_world *w)
{
    w->row = memory_array(&w->scenario->context->inner, (size_t)w->base->columns.columns.count, sizeof *w->row);
    return w->row;
}

/* Model and world; then the lists that follow from them. */
static fram_status build(fram_world *w, fram_error *error)
{
    const fram_scenario *s = w->scenario;
    context *ctx = &s->context->inner;
    field_report report;
    fram_status status = world_find_inputs(w, error);
    if (status == FRAM_OK)
        status = build_model(ctx, &s->inner, &w->base->model, error);
    if (status != FRAM_OK)
        return status;
    status = build_world(ctx, &s->inner, &w->base->model, &w->inner, &report, error);
    if (status != FRAM_OK)
        return status;
    status = series_columns(ctx, &s->inner, &w->base->columns, error);
    if (status == FRAM_OK && !controls_list(ctx, &s->inner, &w->base->model, &w->inner, &w->base->controls))
        status = error_memory(error);
    if (status == FRAM_OK && !world_make_row(w))
        status = error_memory(error);
    if (status != FRAM_OK)
        world_free(ctx, &w->inner);
    return status;
}

fram_status fram_world_create(const fram_scenario *s, fram_world **out, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"scenario", s}, {"world", out});
    if (status != FRAM_OK)
        return status;
    context *ctx = &s->context->inner;
    world_base *base = memory_array(ctx, 1, sizeof *base);
    if (!base)
        return error_memory(error);
    atomic_init(&base->users, 0);
    fram_world *w = world_handle(s, base);
    if (!w) {
        memory_free(ctx, base);
        return error_memory(error);
    }
    status = build(w, error);
    if (status != FRAM_OK) {
        world_handle_free(w);
        return status;
    }
    *out = w;
    return FRAM_OK;
}

void fram_world_destroy(fram_world *w)
{
    if (!w || atomic_load_explicit(&w->aside->calls, memory_order_acquire) != 0)
        return;
    if (fram_world_is_recorded(w))
        (void)fram_world_record_end(w, NULL, NULL);
    world_free(&w->scenario->context->inner, &w->inner);
    world_handle_free(w);
}

/* ---- one call at a time ---- */

static fram_status taken(fram_error *error)
{
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "world",
                     "another call on it has not returned yet: use a world from one thread at a time, and not from a "
                     "function that a call on it calls");
}

fram_status world_enter(fram_world *w, fram_error *error)
{
    int none = 0;
    fram_status status = REFUSE_NULL(error, {"world", w});
    if (status == FRAM_OK && !atomic_compare_exchange_strong_explicit(&w->aside->calls, &none, CHANGED_BY_A_CALL,
                                                                      memory_order_acquire, memory_order_relaxed))
        status = taken(error);
    /* The parent's: not even freed, since threads that work for it are the parent's too. */
    if (status == FRAM_OK && w->recording && !fram_world_is_recorded(w)) {
        w->recording = NULL;
        w->live = NULL;
    }
    return status;
}

void world_leave(fram_world *w) { atomic_store_explicit(&w->aside->calls, 0, memory_order_release); }

bool world_reads(const fram_world *w)
{
    if (!w)
        return false;
    int calls = atomic_load_explicit(&w->aside->calls, memory_order_relaxed);
    while (calls != CHANGED_BY_A_CALL) {
        if (atomic_compare_exchange_weak_explicit(&w->aside->calls, &calls, calls + 1, memory_order_acquire,
                                                  memory_order_relaxed))
            return true;
    }
    return false;
}

fram_status world_begin_reading(const fram_world *w, fram_error *error)
{
    return world_reads(w) ? FRAM_OK : taken(error);
}

void world_end_reading(const fram_world *w) { atomic_fetch_sub_explicit(&w->aside->calls, 1, memory_order_release); }

bool world_can_be_read(const fram_world *w)
{
    return w && atomic_load_explicit(&w->aside->calls, memory_order_relaxed) != CHANGED_BY_A_CALL;
}

fram_status world_refuse_taken(const fram_world *w, fram_error *error)
{
    return world_can_be_read(w) ? FRAM_OK : taken(error);
}

/* ---- stepping ---- */

void world_changed(fram_world *w) { w->aside->row_is_new = false; }

fram_status world_refuse_failed(const fram_world *w, fram_error *error)
{
    if (!w->failed)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "world",
                     "its last step failed; load a good state before it goes on, or destroy it");
}

static fram_status step(fram_world *w, fram_error *error)
{
    fram_error local = {0};
    fram_status status = world_refuse_failed(w, error);
    if (status != FRAM_OK)
        return status;
    double before = clock_wall();
    world_changed(w);
    context *ctx = kept_context(&w->aside->kept, &w->scenario->context->inner, &w->inner.bodies);
    status = world_step(ctx, &w->base->model, &w->inner, &local);
    w->step_wall = clock_wall() - before;
    w->failed = status != FRAM_OK;
    if (status == FRAM_OK && w->recording)
        status = recording_step(w->recording, w->step_wall, &local);
    if (status != FRAM_OK) {
        recording_abandon(w, &local);
        if (error)
            *error = local;
    }
    return status;
}

fram_status fram_world_step(fram_world *w, fram_error *error)
{
    fram_status status = world_enter(w, error);
    if (status != FRAM_OK)
        return status;
    status = step(w, error);
    world_leave(w);
    return status;
}

fram_status fram_world_notes(const fram_world *w, char **text, fram_error *error)
{
    text_buffer notes = {0};
    fram_status status = REFUSE_NULL(error, {"world", w}, {"text", text});
    if (status == FRAM_OK)
        status = world_begin_reading(w, error);
    if (status != FRAM_OK)
        return status;
    context *ctx = &w->scenario->context->inner;
    notes_take_made(ctx, &w->scenario->inner, &w->base->model, &w->inner, &notes);
    world_end_reading(w);
    if (notes.failed) {
        text_free(ctx, &notes);
        return error_memory(error);
    }
    *text = notes.data;
    return FRAM_OK;
}

double fram_world_time(const fram_world *w) { return w ? w->inner.clock.time[0] : (double)NAN; }
int64_t fram_world_steps(const fram_world *w) { return w ? w->inner.clock.step[0] : 0; }

uint64_t fram_world_hash(const fram_world *w)
{
    if (!world_reads(w))
        return 0;
    uint64_t hash = world_hash(&w->inner);
    world_end_reading(w);
    return hash;
}

int fram_world_slots(const fram_world *w) { return w ? w->inner.bodies.count : 0; }

bool fram_world_body(const fram_world *w, int slot, fram_body_id *id)
{
    if (!world_can_be_read(w) || !id)
        return false;
    const body_table *b = &w->inner.bodies;
    if (slot < 0 || slot >= b->count || !body_is_alive(b, slot))
        return false;
    *id = (fram_body_id){slot, b->generation[slot]};
    return true;
}

bool fram_world_vessel(const fram_world *w, fram_body_id *id)
{
    return w && w->inner.vessels.count > 0 && fram_world_body(w, w->inner.vessels.body[0], id);
}

int fram_world_vessels(const fram_world *w) { return w ? w->inner.vessels.count : 0; }

bool fram_world_vessel_at(const fram_world *w, int vessel, fram_body_id *id)
{
    return w && vessel >= 0 && vessel < w->inner.vessels.count && fram_world_body(w, w->inner.vessels.body[vessel], id);
}

bool fram_world_vessel_named(const fram_world *w, const char *name, fram_body_id *id)
{
    return w && name && fram_world_vessel_at(w, scenario_find_vessel(&w->scenario->inner, name), id);
}

const char *fram_world_vessel_name(const fram_world *w, int vessel)
{
    if (!w || vessel < 0 || vessel >= w->inner.vessels.count)
        return NULL;
    return scenario_vessel_entry(&w->scenario->inner, vessel).keys->name;
}

static bool is_living(const body_table *b, fram_body_id id)
{
    return id.slot >= 0 && id.slot < b->count && body_is_alive(b, id.slot) && b->generation[id.slot] == id.generation;
}

static fram_status no_such_body(fram_body_id id, fram_error *error)
{
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "body", "there is no living body %d of generation %u",
                     (int)id.slot, (unsigned)id.generation);
}

fram_status(fram_body_state_get)(const fram_world *w, fram_body_id id, fram_body_state *state, fram_error *error,
                                 size_t size)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"state", state});
    if (status == FRAM_OK)
        status = RESULT_CHECK(state, size, fram_body_state, error);
    if (status == FRAM_OK)
        status = world_refuse_taken(w, error);
    if (status != FRAM_OK)
        return status;
    const body_table *b = &w->inner.bodies;
    if (!is_living(b, id))
        return no_such_body(id, error);
    quat q = b->orientation[id.slot];
    fram_body_state full = {.kind = world_body_kind(b, id.slot),
                            .dynamic = body_is_free(b, id.slot),
                            .mass = b->mass[id.slot],
                            .orientation = {q.w, q.x, q.y, q.z}};
    copy3(full.position, b->position[id.slot]);
    copy3(full.velocity, b->velocity[id.slot]);
    copy3(full.angular_velocity, b->angular_velocity[id.slot]);
    result_give(state, size, &full);
    return FRAM_OK;
}

int fram_body_outline(const fram_world *w, fram_body_id id, double *xy, int room)
{
    if (!world_can_be_read(w))
        return 0;
    const body_table *b = &w->inner.bodies;
    const shape_store *s = &w->inner.shapes;
    if (!is_living(b, id) || b->shape[id.slot] < 0 || s->shapes.kind[b->shape[id.slot]] != SHAPE_PRISM)
        return 0;
    polygon outline = shape_outline(s, b->shape[id.slot]);
    for (int32_t i = 0; xy && i < outline.count && i < room; i++) {
        vec3 p = body_to_global(b, id.slot, vec3_make(outline.vertex[i].x, outline.vertex[i].y, 0));
        xy[2 * i] = p.x, xy[2 * i + 1] = p.y;
    }
    return outline.count;
}

/* false for NaN, too. */
static bool is_of_use(vec3 v)
{
    return fabs(v.x) <= WRENCH_MOST && fabs(v.y) <= WRENCH_MOST && fabs(v.z) <= WRENCH_MOST;
}

static fram_status add_wrench(fram_world *w, fram_body_id id, const double force[3], const double moment[3],
                              fram_error *error)
{
    if (!is_living(&w->inner.bodies, id))
        return no_such_body(id, error);
    if (!body_is_free(&w->inner.bodies, id.slot))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "body", "body %d is static or driven: forces do not move it",
                         (int)id.slot);
    wrench load = {{force[0], force[1], force[2]}, {moment[0], moment[1], moment[2]}};
    bool is_force = is_of_use(load.force);
    if (!is_force || !is_of_use(load.moment))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, is_force ? "moment" : "force",
                         "a %s is not finite, or beyond all use", is_force ? "moment" : "force");
    return world_add_wrench(&w->scenario->context->inner, &w->inner, id.slot, load, error);
}

fram_status fram_body_apply_wrench(fram_world *w, fram_body_id id, const double force[3], const double moment[3],
                                   fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"force", force}, {"moment", moment});
    if (status == FRAM_OK)
        status = world_enter(w, error);
    if (status != FRAM_OK)
        return status;
    status = add_wrench(w, id, force, moment, error);
    world_leave(w);
    return status;
}

fram_status(fram_world_ice_load)(const fram_world *w, fram_body_id id, fram_ice_load *load, fram_error *error,
                                 size_t size)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"load", load});
    if (status == FRAM_OK)
        status = RESULT_CHECK(load, size, fram_ice_load, error);
    if (status == FRAM_OK)
        status = world_refuse_taken(w, error);
    if (status != FRAM_OK)
        return status;
    const world *in = &w->inner;
    if (!is_living(&in->bodies, id))
        return no_such_body(id, error);
    for (int32_t v = 0; v < in->vessels.count; v++) {
        if (in->vessels.body[v] != id.slot)
            continue;
        ice_load now = in->scratch.ice_loads.count > v ? in->scratch.ice_loads.data[v] : (ice_load){0};
        fram_ice_load full = {.contacts = now.contacts};
        copy3(full.force, now.total.force);
        copy3(full.moment, now.total.moment);
        copy3(full.capped, now.capped.force);
        copy3(full.below_cap, now.below_cap.force);
        copy3(full.friction, now.friction.force);
        result_give(load, size, &full);
        return FRAM_OK;
    }
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "body", "body %d is no vessel", (int)id.slot);
}
