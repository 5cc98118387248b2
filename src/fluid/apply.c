/* Fluid and gravity on all bodies, in parallel over fixed blocks of slots. */
#include "base/pool.h"
#include "fluid/fluid.h"
#include "fluid/hull_load.h"
#include "fluid/level.h"
#include "fluid/tilted.h"

#include <string.h>

typedef struct fluid_work {
    context *ctx;
    const media *media;
    const drag_coefficients *coefficients;
    const body_table *bodies;
    const shape_store *shapes;
    prism_work prisms;
    prism_rooms rooms;
    wrench *loads;
    fluid_details details;
    int32_t block; /* slots of one, at most PRISM_BLOCK */
} fluid_work;
/* Slots of a block in a small field: so few that several threads find work, so many that floes of as many corners are
   still found for a batch. */
enum { LEAST_BLOCK = 32 };

static fluid_motion motion_of(const body_table *b, int32_t slot)
{
    return (fluid_motion){b->position[slot], quat_matrix(b->orientation[slot]), b->velocity[slot],
                          b->angular_velocity[slot]};
}

/* Prisms; solids have their turn later, several threads each. */
static fluid_load load_of_body(const fluid_work *w, int32_t slot)
{
    fluid_load load = {0};
    const body_table *b = w->bodies;
    const shape_table *s = &w->shapes->shapes;
    int32_t shape = b->shape[slot];
    if (shape < 0 || s->kind[shape] != SHAPE_PRISM)
        return load;
    fluid_motion state = motion_of(b, slot);
    fluid_load_prism(w->media, &w->coefficients[b->material[slot]], shape_outline(w->shapes, shape),
                     s->half_height[shape], &state, &load);
    return load;
}

/* Of water and air; in the order of prism_lanes.h. */
static wrench total_of(const fluid_load *load)
{
    wrench sum = load->hydrostatic;
    sum.force = vec3_add(sum.force, vec3_add(load->water_drag.force, load->wind_drag.force));
    sum.moment = vec3_add(sum.moment, vec3_add(load->water_drag.moment, load->wind_drag.moment));
    return sum;
}

static void clear_slots(const prism_output *out, int32_t at, int32_t count)
{
    memset(out->total + at, 0, (size_t)count * sizeof *out->total);
    memset(out->volume + at, 0, (size_t)count * sizeof *out->volume);
    if (out->load)
        memset(out->load + at, 0, (size_t)count * sizeof *out->load);
}

static void add_wrench(wrench *to, const wrench *w)
{
    to->force = vec3_add(to->force, w->force);
    to->moment = vec3_add(to->moment, w->moment);
}

/* What is missing from the pressure on a floe whose upper face is not flooded. */
static void flood(const fluid_work *w, int32_t slot, const prism_output *out, int32_t at)
{
    const body_table *b = w->bodies;
    const shape_table *s = &w->shapes->shapes;
    flooding_table *t = w->details.flooding;
    int32_t shape = b->shape[slot];
    if (!t || shape < 0 || s->kind[shape] != SHAPE_PRISM)
        return;
    flooding_state state = {0, FLOODING_NONE, false};
    if (t->generation[slot] == b->generation[slot])
        state = (flooding_state){t->water[slot], (flooding_face)t->face[slot], t->drowned[slot] != 0};
    mat3 rotation = quat_matrix(b->orientation[slot]);
    wrench missing = flooding_advance(w->media, shape_outline(w->shapes, shape), s->half_height[shape], &rotation,
                                      b->position[slot].z, w->details.time_step, &state);
    add_wrench(&out->total[at], &missing);
    if (out->load)
        add_wrench(&out->load[at].hydrostatic, &missing);
    t->generation[slot] = b->generation[slot];
    t->water[slot] = state.water;
    t->face[slot] = (uint8_t)state.face;
    t->drowned[slot] = state.drowned;
}

/* Level floes have their upper face above the water; those of `rest` are looked at one by one, what is no prism stays
   out. */
static void dry_level_faces(const fluid_work *w, int32_t first, int32_t end, const int32_t *rest, int32_t left)
{
    flooding_table *t = w->details.flooding;
    bool resting[PRISM_BLOCK] = {false};
    if (!t)
        return;
    for (int32_t i = 0; i < left; i++)
        resting[rest[i] - first] = true;
    for (int32_t slot = first; slot < end; slot++) {
        if (resting[slot - first])
            continue;
        bool follow = body_is_dynamic(w->bodies, slot);
        t->generation[slot] = follow ? w->bodies->generation[slot] : 0;
        t->water[slot] = 0;
        t->face[slot] = follow ? FLOODING_TOP : FLOODING_NONE;
        t->drowned[slot] = 0;
    }
}

/* Level, sunken and tilted floes together, all others one by one. */
static void apply_block(void *arg, int32_t block, int32_t thread)
{
    const fluid_work *w = arg;
    const fluid_details *d = &w->details;
    int32_t first = block * w->block, end = first + w->block, rest[PRISM_BLOCK], others[PRISM_BLOCK];
    if (end > w->bodies->count)
        end = w->bodies->count;
    double own[PRISM_BLOCK];
    bool idle = !d->flooding && body_next_moving(w->bodies, first, end) == end;
    const prism_output out = {w->loads + first, d->volume ? d->volume + first : own, d->all ? d->all + first : NULL};
    if (idle) {
        clear_slots(&out, 0, end - first);
        return;
    }
    const prism_room room = prism_room_of(&w->rooms, thread);
    int32_t left = level_block(w->ctx, &w->prisms, first, end, &room, &out, rest);
    dry_level_faces(w, first, end, rest, left);
    int32_t walked = tilted_block(w->ctx, &w->prisms, first, rest, left, &room, &out, others);
    for (int32_t i = 0; i < walked; i++) {
        fluid_load load = load_of_body(w, others[i]);
        int32_t at = others[i] - first;
        out.total[at] = total_of(&load);
        out.volume[at] = load.submerged_volume;
        if (out.load)
            out.load[at] = load;
    }
    for (int32_t i = 0; i < left; i++)
        flood(w, rest[i], &out, rest[i] - first);
    for (int32_t slot = first; slot < end; slot++) {
        if (body_is_dynamic(w->bodies, slot))
            w->loads[slot].force.z -= w->bodies->mass[slot] * w->media->gravity;
        else
            clear_slots(&out, slot - first, 1);
    }
}

static void apply_solid(const fluid_work *w, int32_t slot, int32_t row)
{
    const body_table *b = w->bodies;
    const fluid_details *d = &w->details;
    fluid_motion state = motion_of(b, slot);
    fluid_load load;
    fluid_load_solid(w->ctx, w->media, &w->coefficients[b->material[slot]], &w->shapes->solids->data[row], &state,
                     &load);
    w->loads[slot] = total_of(&load);
    w->loads[slot].force.z -= b->mass[slot] * w->media->gravity;
    if (d->volume)
        d->volume[slot] = load.submerged_volume;
    if (d->solids)
        d->solids[row] = load;
    if (d->all)
        d->all[slot] = load;
}

fram_status fluid_apply(context *ctx, const media *m, const drag_coefficients coefficients[MATERIAL_COUNT],
                        const body_table *bodies, const shape_store *shapes, held_drag_table *held, wrench *loads,
                        const fluid_details *details, fram_error *error)
{
    if (held && !table_resize(ctx, held, &held_drag_table_info, held_drag_rows(bodies->count)))
        return error_memory(error);
    flooding_table *flooding = details ? details->flooding : NULL;
    if (flooding && !table_resize(ctx, flooding, &flooding_table_info, bodies->count))
        return error_memory(error);
    fluid_work work = {.ctx = ctx,
                       .media = m,
                       .coefficients = coefficients,
                       .bodies = bodies,
                       .shapes = shapes,
                       .prisms = prism_work_of(m, coefficients, bodies, shapes),
                       .loads = loads,
                       .block = pool_block(bodies->count, LEAST_BLOCK, PRISM_BLOCK)};
    if (details)
        work.details = *details;
    work.prisms.held = held;
    work.prisms.level_only = flooding != NULL;
    int32_t blocks = pool_blocks(bodies->count, work.block);
    if (blocks > 0) {
        if (!prism_rooms_make(ctx, &shapes->shapes, &work.rooms))
            return error_memory(error);
        pool_run(ctx, apply_block, &work, blocks);
        prism_rooms_free(ctx, &work.rooms);
    }
    int32_t count = bodies->count;
    for (int32_t slot = body_next_moving(bodies, 0, count); slot < count;
         slot = body_next_moving(bodies, slot + 1, count)) {
        int32_t shape = bodies->shape[slot];
        if (body_is_dynamic(bodies, slot) && shape >= 0 && shapes->shapes.kind[shape] == SHAPE_SOLID)
            apply_solid(&work, slot, shapes->shapes.solid[shape]);
    }
    return FRAM_OK;
}
