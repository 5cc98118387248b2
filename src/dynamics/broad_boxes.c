/* Fat boxes, and how far bodies have travelled.

   Travel is a bound on the way that any point of a body has gone: the way of its centre plus that of its outermost
   point about it.  While it has not used up the room that was left in the fat box when it was looked at last, the body
   needs no new look; and two bodies that were parted by a gap have not met before their travels have used it up
   (pair_table.clear).  So a step of a body that goes nowhere near a change costs a subtraction, and one of bodies that
   stand still, of which all slots of a chunk have one, next to nothing. */
#include "base/pool.h"
#include "dynamics/collision_scratch.h"

#include <assert.h>
#include <string.h>

/* Bodies a block, whole chunks. */
enum { BLOCK_BODIES = 256 };
static_assert(BLOCK_BODIES % BOX_CHUNK == 0, "a chunk is of one block");
/* Bounds are taken smaller by this share, far more than what rounding can take from them. */
#define SURE (1 - 1e-9)

/* ---- boxes ---- */

static box3 prism_box(polygon outline, double half_height, mat3 r)
{
    box3 box = box3_empty();
    for (int32_t i = 0; i < outline.count; i++) {
        vec2 p = outline.vertex[i];
        box = box3_add(box, vec3_make(r.m[0][0] * p.x + r.m[0][1] * p.y, r.m[1][0] * p.x + r.m[1][1] * p.y,
                                      r.m[2][0] * p.x + r.m[2][1] * p.y));
    }
    vec3 rise = vec3_make(half_height * fabs(r.m[0][2]), half_height * fabs(r.m[1][2]), half_height * fabs(r.m[2][2]));
    return (box3){vec3_sub(box.lo, rise), vec3_add(box.hi, rise)};
}

static box3 solid_box(const mesh *surface, mat3 r)
{
    box3 box = box3_empty();
    for (int32_t i = 0; i < surface->vertex.count; i++)
        box = box3_add(box, mat3_mul_vec(r, surface->vertex.data[i]));
    return box;
}

/* Of a body's shape, global frame. */
static box3 body_box(const body_table *bodies, const shape_store *shapes, int32_t slot)
{
    int32_t row = bodies->shape[slot];
    mat3 r = quat_matrix(bodies->orientation[slot]);
    box3 box = shapes->shapes.kind[row] == SHAPE_PRISM
                   ? prism_box(shape_outline(shapes, row), shapes->shapes.half_height[row], r)
                   : solid_box(&shape_solid(shapes, row)->surface, r);
    return (box3){vec3_add(box.lo, bodies->position[slot]), vec3_add(box.hi, bodies->position[slot])};
}

/* Least room between the faces of two boxes; negative when inner reaches out. */
static double box_room(box3 inner, box3 outer)
{
    double low = fmin(fmin(inner.lo.x - outer.lo.x, inner.lo.y - outer.lo.y), inner.lo.z - outer.lo.z);
    double high = fmin(fmin(outer.hi.x - inner.hi.x, outer.hi.y - inner.hi.y), outer.hi.z - inner.hi.z);
    return fmin(low, high);
}

static bool box_is_somewhere(box3 box)
{
    return isfinite(vec3_length(vec3_sub(box.hi, box.lo))) && isfinite(vec3_length(box.lo));
}

/* ---- travel ---- */

/* Way of the outermost point in a turn from p to q: at most 2 |q - p| times its distance, since a turn by t moves a
   point at distance 1 by 2 sin(t/2), and |q - p| = 2 sin(t/4). */
static double turn_way(quat p, quat q, double radius)
{
    double cosine = p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z, sign = cosine < 0 ? -1 : 1;
    double w = sign * q.w - p.w, x = sign * q.x - p.x, y = sign * q.y - p.y, z = sign * q.z - p.z;
    return 2 * radius * sqrt(w * w + x * x + y * y + z * z);
}

static void follow_body(const body_table *bodies, const shape_store *shapes, int32_t i, broad_table *boxes)
{
    double way = vec3_length(vec3_sub(bodies->position[i], boxes->position[i])) +
                 turn_way(boxes->orientation[i], bodies->orientation[i], shapes->shapes.radius[bodies->shape[i]]);
    boxes->travel[i] += way;
    boxes->position[i] = bodies->position[i];
    boxes->orientation[i] = bodies->orientation[i];
}

/* ---- the two passes ---- */

typedef struct box_work {
    const body_table *bodies;
    const shape_store *shapes;
    const collision_settings *settings;
    broad_table *boxes;
    collision_scratch *scratch;
} box_work;

static void forget_box(broad_table *boxes, int32_t slot)
{
    vec3 zero = {0, 0, 0};
    boxes->generation[slot] = 0;
    boxes->fixed[slot] = 0;
    boxes->travel[slot] = boxes->stay[slot] = 0;
    boxes->lo[slot] = boxes->hi[slot] = boxes->position[slot] = zero;
    boxes->orientation[slot] = (quat){0, 0, 0, 0};
}

/* Two of a rigid whole, the ground or a sheet that is carried, never meet; nor do two that are asleep. */
static uint8_t is_fixed(const body_table *bodies, int32_t i)
{
    uint8_t kind = bodies->motion[i];
    return kind == MOTION_STATIC || kind == MOTION_CARRIED || kind == MOTION_ASLEEP;
}

/* First pass: what became of each body's box. */
static void look_at_body(const box_work *w, int32_t i, box_block *found)
{
    broad_table *boxes = w->boxes;
    uint8_t *change = &w->scratch->change.data[i];
    *change = BOX_KEPT;
    if (!body_is_alive(w->bodies, i) || w->bodies->shape[i] < 0) {
        if (boxes->generation[i] != 0) {
            forget_box(boxes, i);
            found->changed = true;
        }
        return;
    }
    uint8_t fixed = is_fixed(w->bodies, i);
    if (boxes->generation[i] != w->bodies->generation[i] || boxes->fixed[i] != fixed) {
        *change = BOX_NEW;
        found->changed = true;
        return;
    }
    follow_body(w->bodies, w->shapes, i, boxes);
    if (boxes->travel[i] <= boxes->stay[i])
        return;
    box3 box = body_box(w->bodies, w->shapes, i);
    double room = box_room(box, fat_box(boxes, i));
    if (room >= 0 && box_is_somewhere(box)) {
        boxes->stay[i] = boxes->travel[i] + SURE * room;
        return;
    }
    *change = BOX_MOVED; /* also when the box is no place: the second pass says so */
    found->changed = true;
}

static int32_t chunk_end(int32_t first, int32_t block_end)
{
    return first + BOX_CHUNK < block_end ? first + BOX_CHUNK : block_end;
}

/* Every slot has the body that its box was made for, and none of them moves or has moved since the last look.  Places
   are compared, not orientations: what cannot move by itself is carried at most, and that without turning. */
static bool chunk_stands(const box_work *w, int32_t first, int32_t end)
{
    const body_table *b = w->bodies;
    const broad_table *boxes = w->boxes;
    size_t count = (size_t)(end - first);
    return body_next_moving(b, first, end) == end && body_slots_are_taken(b, first, end) &&
           !memchr(boxes->fixed + first, false, count) &&
           memcmp(boxes->generation + first, b->generation + first, count * sizeof *b->generation) == 0 &&
           memcmp(boxes->position + first, b->position + first, count * sizeof *b->position) == 0;
}

static void look_at_block(void *arg, int32_t block, int32_t thread)
{
    (void)thread;
    const box_work *w = arg;
    box_block *found = &w->scratch->box_blocks.data[block];
    *found = (box_block){false, -1};
    int32_t block_end = pool_block_end(block, BLOCK_BODIES, w->bodies->count);
    for (int32_t first = BLOCK_BODIES * block, end; first < block_end; first = end) {
        end = chunk_end(first, block_end);
        bool stands = chunk_stands(w, first, end);
        w->scratch->standing.data[first / BOX_CHUNK] = stands;
        if (stands)
            memset(w->scratch->change.data + first, BOX_KEPT, (size_t)(end - first));
        for (int32_t i = first; i < end && !stands; i++)
            look_at_body(w, i, found);
    }
}

/* The margin on all sides, and in front of a moving body the way that it is about to go. */
static void make_fat_box(const box_work *w, int32_t i, box3 box)
{
    double margin = w->settings->margin;
    vec3 rim = vec3_make(margin, margin, margin), ahead = vec3_scale(w->bodies->velocity[i], w->settings->lookahead);
    vec3 back = {fmin(ahead.x, 0), fmin(ahead.y, 0), fmin(ahead.z, 0)};
    vec3 front = {fmax(ahead.x, 0), fmax(ahead.y, 0), fmax(ahead.z, 0)};
    w->boxes->lo[i] = vec3_add(vec3_sub(box.lo, rim), back);
    w->boxes->hi[i] = vec3_add(vec3_add(box.hi, rim), front);
    w->boxes->stay[i] = w->boxes->travel[i] + SURE * margin;
}

static bool all_have_room(const box_work *w, int32_t first, int32_t end)
{
    const double *stay = w->boxes->stay, *travel = w->boxes->travel;
    double least = 0.5 * w->settings->margin;
    for (int32_t i = first; i < end; i++)
        if (!(stay[i] - travel[i] >= least))
            return false;
    return true;
}

/* Second pass, when some body needs a new box: those that will soon need one get theirs now. */
static void renew_body(const box_work *w, int32_t i, box_block *found)
{
    broad_table *boxes = w->boxes;
    uint8_t *change = &w->scratch->change.data[i];
    if (boxes->generation[i] == 0 && *change != BOX_NEW)
        return;
    if (*change == BOX_KEPT && all_have_room(w, i, i + 1))
        return;
    box3 box = body_box(w->bodies, w->shapes, i);
    if (!box_is_somewhere(box)) {
        found->lost = found->lost < 0 ? i : found->lost;
        return;
    }
    if (*change == BOX_NEW) {
        boxes->generation[i] = w->bodies->generation[i];
        boxes->fixed[i] = is_fixed(w->bodies, i);
        boxes->travel[i] = 0;
        boxes->position[i] = w->bodies->position[i];
        boxes->orientation[i] = w->bodies->orientation[i];
    } else {
        *change = BOX_MOVED;
    }
    make_fat_box(w, i, box);
}

static void renew_block(void *arg, int32_t block, int32_t thread)
{
    (void)thread;
    const box_work *w = arg;
    int32_t block_end = pool_block_end(block, BLOCK_BODIES, w->bodies->count);
    for (int32_t first = BLOCK_BODIES * block, end; first < block_end; first = end) {
        end = chunk_end(first, block_end);
        uint8_t *stands = &w->scratch->standing.data[first / BOX_CHUNK];
        *stands = *stands && all_have_room(w, first, end);
        for (int32_t i = first; i < end && !*stands; i++)
            renew_body(w, i, &w->scratch->box_blocks.data[block]);
    }
}

fram_status broad_boxes_update(context *ctx, const body_table *bodies, const shape_store *shapes,
                               const collision_settings *settings, broad_table *boxes, collision_scratch *s, bool *any,
                               fram_error *error)
{
    *any = false;
    int32_t count = bodies->count, blocks = pool_blocks(count, BLOCK_BODIES);
    if (!table_resize(ctx, boxes, &broad_table_info, count) || !array_resize(ctx, &s->change, count) ||
        !array_resize(ctx, &s->standing, pool_blocks(count, BOX_CHUNK)) || !array_resize(ctx, &s->box_blocks, blocks))
        return error_memory(error);
    box_work work = {bodies, shapes, settings, boxes, s};
    if (blocks > 0)
        pool_run(ctx, look_at_block, &work, blocks);
    for (int32_t b = 0; b < blocks; b++)
        *any = *any || s->box_blocks.data[b].changed;
    if (!*any)
        return FRAM_OK;
    pool_run(ctx, renew_block, &work, blocks);
    for (int32_t b = 0; b < blocks; b++) {
        int32_t i = s->box_blocks.data[b].lost;
        if (i >= 0)
            return error_set(error, FRAM_ERROR_SIMULATION, NULL, 0, NULL,
                             "body %d is nowhere: its position is (%g, %g, %g) m", (int)i, bodies->position[i].x,
                             bodies->position[i].y, bodies->position[i].z);
    }
    return FRAM_OK;
}
