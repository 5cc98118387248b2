/* The sectors of the benchmark's water, and the work shared out. */
#include "fluid/columns.h"

#include "base/pool.h"
#include "base/simd.h"
#include "base/transcendental.h"
#include "fluid/columns_kernel.h"

#include <string.h>

/* Groups a block. */
enum { BLOCK_GROUPS = 16 };

static int32_t groups_of(int32_t slots) { return slots / V8_LANES + (slots % V8_LANES != 0); }

static int32_t side_count(const body_table *bodies, const shape_store *shapes, int32_t slot)
{
    return slot < bodies->count && body_is_dynamic(bodies, slot) ? shape_outline(shapes, bodies->shape[slot]).count : 0;
}

static fram_status check_bodies(const body_table *bodies, const shape_store *shapes, fram_error *error)
{
    for (int32_t i = 0; i < bodies->count; i++) {
        if (!body_is_dynamic(bodies, i))
            continue;
        int32_t shape = bodies->shape[i];
        if (shape < 0 || shapes->shapes.kind[shape] != SHAPE_PRISM || shapes->shapes.piece_count[shape] != 1)
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, NULL, "body %d is no convex prism", (int)i);
    }
    return FRAM_OK;
}

/* How many rows each group needs. */
static bool count_rows(context *ctx, const body_table *bodies, const shape_store *shapes, column_water *w)
{
    int32_t groups = groups_of(bodies->count);
    if (!array_resize(ctx, &w->first, groups + 1))
        return false;
    w->first.data[0] = 0;
    for (int32_t g = 0; g < groups; g++) {
        int32_t most = 0;
        for (int32_t i = V8_LANES * g; i < V8_LANES * (g + 1); i++) {
            int32_t sides = side_count(bodies, shapes, i);
            most = sides > most ? sides : most;
        }
        w->first.data[g + 1] = w->first.data[g] + most;
    }
    return true;
}

static bool make_room(context *ctx, column_water *w)
{
    int32_t groups = w->first.count - 1, lanes = V8_LANES * groups, cells = V8_LANES * w->first.data[groups];
    if (!array_resize(ctx, &w->area, cells) || !array_resize(ctx, &w->x, cells) || !array_resize(ctx, &w->y, cells) ||
        !array_resize(ctx, &w->thickness, lanes) || !array_resize(ctx, &w->rim, lanes) ||
        !array_resize(ctx, &w->sides, lanes))
        return false;
    for (int32_t i = 0; i < cells; i++)
        w->area.data[i] = w->x.data[i] = w->y.data[i] = 0;
    for (int32_t i = 0; i < lanes; i++)
        w->thickness.data[i] = w->rim.data[i] = w->sides.data[i] = 0;
    return true;
}

static void take_body(column_water *w, const shape_store *shapes, int32_t slot, int32_t shape)
{
    polygon outline = shape_outline(shapes, shape);
    w->thickness.data[slot] = 2 * shapes->shapes.half_height[shape];
    w->rim.data[slot] = polygon_perimeter(outline) / PI / outline.count;
    w->sides.data[slot] = outline.count;
    int32_t row = w->first.data[slot / V8_LANES], lane = slot % V8_LANES;
    for (int32_t k = 0; k < outline.count; k++) {
        vec2 a = outline.vertex[k], b = outline.vertex[k + 1 < outline.count ? k + 1 : 0];
        int32_t cell = V8_LANES * (row + k) + lane;
        w->area.data[cell] = 0.5 * vec2_cross(a, b);
        w->x.data[cell] = (a.x + b.x) / 3;
        w->y.data[cell] = (a.y + b.y) / 3;
    }
}

fram_status column_water_make(context *ctx, const column_medium *medium, const body_table *bodies,
                              const shape_store *shapes, column_water *out, fram_error *error)
{
    *out = (column_water){.medium = *medium, .slots = bodies->count};
    fram_status status = check_bodies(bodies, shapes, error);
    if (status != FRAM_OK)
        return status;
    if (!count_rows(ctx, bodies, shapes, out) || !make_room(ctx, out)) {
        column_water_free(ctx, out);
        return error_memory(error);
    }
    for (int32_t i = 0; i < bodies->count; i++)
        if (body_is_dynamic(bodies, i))
            take_body(out, shapes, i, bodies->shape[i]);
    return FRAM_OK;
}

void column_water_free(context *ctx, column_water *w)
{
    array_free(ctx, &w->first);
    array_free(ctx, &w->area);
    array_free(ctx, &w->x);
    array_free(ctx, &w->y);
    array_free(ctx, &w->thickness);
    array_free(ctx, &w->rim);
    array_free(ctx, &w->sides);
}

typedef struct column_work {
    context *ctx;
    const column_water *water;
    const body_table *bodies;
    wrench *loads;
} column_work;

static void apply_groups(void *arg, int32_t block, int32_t thread)
{
    (void)thread;
    const column_work *w = arg;
    int32_t groups = w->water->first.count - 1, first = block * BLOCK_GROUPS, end = first + BLOCK_GROUPS;
    KERNEL_PICK(w->ctx, column_groups)(w->water, w->bodies, first, end < groups ? end : groups, w->loads);
}

void column_water_apply(context *ctx, const column_water *w, const body_table *bodies, wrench *loads)
{
    column_work work = {ctx, w, bodies, loads};
    int32_t groups = w->first.count - 1;
    if (groups > 0)
        pool_run(ctx, apply_groups, &work, pool_blocks(groups, BLOCK_GROUPS));
}
