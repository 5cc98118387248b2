/* Worlds of the public API: stepping, reading the state, acting on bodies. */
#include "api/arguments.h"
#include "api/handles.h"

#include "sim/build.h"

#include <math.h>

fram_status fram_world_create(const fram_scenario *s, fram_world **out, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"scenario", s}, {"world", out});
    if (status != FRAM_OK)
        return status;
    context *ctx = &s->context->inner;
    fram_world *w = memory_array(ctx, 1, sizeof *w);
    if (!w)
        return error_memory(error);
    w->scenario = s;
    field_report report;
    status = build_model(ctx, &s->inner, &w->model, error);
    if (status == FRAM_OK) {
        status = build_world(ctx, &s->inner, &w->model, &w->inner, &report, error);
        if (status != FRAM_OK)
            model_free(ctx, &w->model);
    }
    if (status != FRAM_OK) {
        memory_free(ctx, w);
        return status;
    }
    *out = w;
    return FRAM_OK;
}

void fram_world_destroy(fram_world *w)
{
    if (!w)
        return;
    context *ctx = &w->scenario->context->inner;
    world_free(ctx, &w->inner);
    model_free(ctx, &w->model);
    memory_free(ctx, w);
}

fram_status fram_world_step(fram_world *w, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w});
    if (status != FRAM_OK)
        return status;
    return world_step(&w->scenario->context->inner, &w->model, &w->inner, error);
}

double fram_world_time(const fram_world *w) { return w ? w->inner.clock.time[0] : (double)NAN; }
int64_t fram_world_steps(const fram_world *w) { return w ? w->inner.clock.step[0] : 0; }
uint64_t fram_world_hash(const fram_world *w) { return w ? world_hash(&w->inner) : 0; }
int fram_world_slots(const fram_world *w) { return w ? w->inner.bodies.count : 0; }

bool fram_world_body(const fram_world *w, int slot, fram_body_id *id)
{
    if (!w || !id)
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

static bool lives(const body_table *b, fram_body_id id)
{
    return id.slot >= 0 && id.slot < b->count && body_is_alive(b, id.slot) && b->generation[id.slot] == id.generation;
}

static fram_status no_such_body(fram_body_id id, fram_error *error)
{
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "body", "there is no living body %d of generation %u",
                     (int)id.slot, (unsigned)id.generation);
}

static fram_body_kind kind_of(const body_table *b, int32_t slot)
{
    if (b->shape[slot] < 0)
        return FRAM_BODY_OTHER;
    switch ((material)b->material[slot]) {
    case MATERIAL_ICE:
        return FRAM_BODY_FLOE;
    case MATERIAL_HULL:
        return FRAM_BODY_VESSEL;
    case MATERIAL_WALL:
        return FRAM_BODY_WALL;
    case MATERIAL_COUNT:
        break;
    }
    return FRAM_BODY_OTHER;
}

static void copy3(double out[3], vec3 v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

fram_status fram_body_state_get(const fram_world *w, fram_body_id id, fram_body_state *state, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"state", state});
    if (status != FRAM_OK)
        return status;
    const body_table *b = &w->inner.bodies;
    if (!lives(b, id))
        return no_such_body(id, error);
    quat q = b->orientation[id.slot];
    state->kind = kind_of(b, id.slot);
    state->dynamic = body_is_dynamic(b, id.slot);
    state->mass = b->mass[id.slot];
    copy3(state->position, b->position[id.slot]);
    state->orientation[0] = q.w, state->orientation[1] = q.x, state->orientation[2] = q.y, state->orientation[3] = q.z;
    copy3(state->velocity, b->velocity[id.slot]);
    copy3(state->angular_velocity, b->angular_velocity[id.slot]);
    return FRAM_OK;
}

int fram_body_outline(const fram_world *w, fram_body_id id, double *xy, int room)
{
    if (!w)
        return 0;
    const body_table *b = &w->inner.bodies;
    const shape_store *s = &w->inner.shapes;
    if (!lives(b, id) || b->shape[id.slot] < 0 || s->shapes.kind[b->shape[id.slot]] != SHAPE_PRISM)
        return 0;
    polygon outline = shape_outline(s, b->shape[id.slot]);
    for (int32_t i = 0; xy && i < outline.count && i < room; i++) {
        vec3 p = body_to_global(b, id.slot, vec3_make(outline.vertex[i].x, outline.vertex[i].y, 0));
        xy[2 * i] = p.x, xy[2 * i + 1] = p.y;
    }
    return outline.count;
}

fram_status fram_body_apply_wrench(fram_world *w, fram_body_id id, const double force[3], const double moment[3],
                                   fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"force", force}, {"moment", moment});
    if (status != FRAM_OK)
        return status;
    if (!lives(&w->inner.bodies, id))
        return no_such_body(id, error);
    if (!body_is_dynamic(&w->inner.bodies, id.slot))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "body", "body %d is static or driven: forces do not move it",
                         (int)id.slot);
    wrench load = {{force[0], force[1], force[2]}, {moment[0], moment[1], moment[2]}};
    double sum = load.force.x + load.force.y + load.force.z + load.moment.x + load.moment.y + load.moment.z;
    if (!isfinite(sum))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "force", "a force or moment is not finite");
    return world_add_wrench(&w->scenario->context->inner, &w->inner, id.slot, load, error);
}

fram_status fram_world_ice_load(const fram_world *w, fram_body_id id, fram_ice_load *load, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"load", load});
    if (status != FRAM_OK)
        return status;
    const world *in = &w->inner;
    if (!lives(&in->bodies, id))
        return no_such_body(id, error);
    for (int32_t v = 0; v < in->vessels.count; v++) {
        if (in->vessels.body[v] != id.slot)
            continue;
        ice_load now = in->scratch.ice_loads.count > v ? in->scratch.ice_loads.data[v] : (ice_load){0};
        copy3(load->force, now.total.force);
        copy3(load->moment, now.total.moment);
        copy3(load->capped, now.capped.force);
        copy3(load->below_cap, now.below_cap.force);
        copy3(load->friction, now.friction.force);
        load->contacts = now.contacts;
        return FRAM_OK;
    }
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "body", "body %d is no vessel", (int)id.slot);
}
