/* Fluid and gravity on all bodies, in parallel over fixed blocks of slots. */
#include "base/pool.h"
#include "fluid/fluid.h"
#include "fluid/hull_load.h"
#include "fluid/level.h"

typedef struct fluid_work {
    context *ctx;
    const media *media;
    const drag_coefficients *coefficients;
    const body_table *bodies;
    const shape_store *shapes;
    wrench *loads;
    fluid_load *detail;
} fluid_work;

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

static wrench total_of(const fluid_work *w, int32_t slot, const fluid_load *load)
{
    wrench sum = load->hydrostatic;
    sum.force = vec3_add(sum.force, vec3_add(load->water_drag.force, load->wind_drag.force));
    sum.moment = vec3_add(sum.moment, vec3_add(load->water_drag.moment, load->wind_drag.moment));
    sum.force.z -= w->bodies->mass[slot] * w->media->gravity;
    return sum;
}

/* Level floes together, all others one by one. */
static void apply_block(void *arg, int32_t block, int32_t thread)
{
    (void)thread;
    const fluid_work *w = arg;
    int32_t first = block * LEVEL_BLOCK, end = first + LEVEL_BLOCK, rest[LEVEL_BLOCK];
    if (end > w->bodies->count)
        end = w->bodies->count;
    fluid_load own[LEVEL_BLOCK], *load = w->detail ? w->detail + first : own;
    int32_t left = level_block(w->ctx, w->media, w->coefficients, w->bodies, w->shapes, first, end, load, rest);
    for (int32_t i = 0; i < left; i++)
        load[rest[i] - first] = load_of_body(w, rest[i]);
    for (int32_t slot = first; slot < end; slot++) {
        fluid_load *here = &load[slot - first];
        if (body_is_dynamic(w->bodies, slot)) {
            w->loads[slot] = total_of(w, slot, here);
        } else {
            *here = (fluid_load){0};
            w->loads[slot] = (wrench){{0, 0, 0}, {0, 0, 0}};
        }
    }
}

static void apply_solids(const fluid_work *w)
{
    const body_table *b = w->bodies;
    const shape_store *s = w->shapes;
    for (int32_t slot = 0; slot < b->count; slot++) {
        int32_t shape = b->shape[slot];
        if (!body_is_dynamic(b, slot) || shape < 0 || s->shapes.kind[shape] != SHAPE_SOLID)
            continue;
        fluid_motion state = motion_of(b, slot);
        fluid_load load;
        fluid_load_solid(w->ctx, w->media, &w->coefficients[b->material[slot]], &s->solids.data[s->shapes.solid[shape]],
                         &state, &load);
        w->loads[slot] = total_of(w, slot, &load);
        if (w->detail)
            w->detail[slot] = load;
    }
}

fram_status fluid_apply(context *ctx, const media *m, const drag_coefficients coefficients[MATERIAL_COUNT],
                        const body_table *bodies, const shape_store *shapes, wrench *loads, fluid_load *detail,
                        fram_error *error)
{
    (void)error;
    fluid_work work = {ctx, m, coefficients, bodies, shapes, loads, detail};
    int32_t blocks = bodies->count / LEVEL_BLOCK + (bodies->count % LEVEL_BLOCK != 0);
    if (blocks > 0)
        pool_run(ctx, apply_block, &work, blocks);
    apply_solids(&work);
    return FRAM_OK;
}
