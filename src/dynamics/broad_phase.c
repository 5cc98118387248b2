/* Which bodies may touch.  Every body has a fat box (broad_boxes.c); pairs of overlapping fat boxes are kept until they
   part.  They are chosen from pairs of wider boxes, which change seldom (broad_candidates.c). */
#include "base/pool.h"
#include "dynamics/collision_scratch.h"

collision_scratch *collision_scratch_create(context *ctx) { return memory_array(ctx, 1, sizeof(collision_scratch)); }

static void free_room(context *ctx, narrow_room *room)
{
    polyhedron_free(ctx, &room->piece_a);
    polyhedron_free(ctx, &room->piece_b);
    array_free(ctx, &room->box_a);
    array_free(ctx, &room->box_b);
    array_free(ctx, &room->near_a);
    array_free(ctx, &room->near_b);
}

void collision_scratch_free(context *ctx, collision_scratch *s)
{
    if (!s)
        return;
    array_free(ctx, &s->change);
    array_free(ctx, &s->standing);
    array_free(ctx, &s->renewed);
    box_grid_free(ctx, &s->grid);
    for (int32_t t = 0; t < s->found.count; t++)
        array_free(ctx, &s->found.data[t].keys);
    array_free(ctx, &s->found);
    array_free(ctx, &s->fresh);
    array_free(ctx, &s->wide);
    array_free(ctx, &s->kept);
    array_free(ctx, &s->spare_keys);
    array_free(ctx, &s->candidates);
    array_free(ctx, &s->chosen);
    array_free(ctx, &s->chosen_end);
    table_free(ctx, &s->merged, &pair_table_info);
    array_free(ctx, &s->box_blocks);
    for (int32_t i = 0; i < s->pair_blocks_made; i++) {
        array_free(ctx, &s->pair_blocks.data[i].contacts);
        array_free(ctx, &s->pair_blocks.data[i].patch_pairs);
    }
    array_free(ctx, &s->pair_blocks);
    for (int32_t i = 0; i < s->rooms.count; i++)
        free_room(ctx, &s->rooms.data[i]);
    array_free(ctx, &s->rooms);
    memory_free(ctx, s);
}

/* ---- pairs ---- */

/* Whether two bodies make a pair, given that they are candidates; is_pair: they were one before. */
static bool is_still_pair(const broad_table *boxes, const uint8_t *change, int32_t a, int32_t b, bool is_pair)
{
    if (boxes->generation[a] == 0 || boxes->generation[b] == 0)
        return false;
    if (change[a] == BOX_KEPT && change[b] == BOX_KEPT)
        return is_pair;
    return box3_meet(fat_box(boxes, a), fat_box(boxes, b));
}

/* What becomes of a candidate, if it does not become the pair of this row again. */
enum { NO_PAIR = -2, NEW_PAIR = -1 };

typedef struct choice {
    const broad_table *boxes;
    collision_scratch *s;
    const pair_table *pairs;
} choice;
enum { CHOICE_BLOCK = 2048 };

static uint64_t pair_key(const pair_table *pairs, int32_t row)
{
    return (uint64_t)pairs->a[row] << 32 | (uint64_t)pairs->b[row];
}

/* The first pair whose key is not below this. */
static int32_t first_pair(const pair_table *pairs, uint64_t key)
{
    int32_t low = 0, high = pairs->count;
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        if (pair_key(pairs, middle) < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* A pair that was one keeps its axis, unless one of both is another body now. */
static void choose_block(void *arg, int32_t block, int32_t thread)
{
    const choice *w = arg;
    const uint8_t *change = w->s->change.data;
    const uint64_t *candidate = w->s->candidates.data;
    int32_t first = CHOICE_BLOCK * block, found = 0;
    int32_t old = first_pair(w->pairs, candidate[first]);
    (void)thread;
    for (int32_t k = first; k < pool_block_end(block, CHOICE_BLOCK, w->s->candidates.count); k++) {
        int32_t a = (int32_t)(candidate[k] >> 32), b = (int32_t)(candidate[k] & UINT32_MAX);
        while (old < w->pairs->count && pair_key(w->pairs, old) < candidate[k])
            old++;
        bool was = old < w->pairs->count && pair_key(w->pairs, old) == candidate[k];
        bool is = is_still_pair(w->boxes, change, a, b, was);
        bool same = was && change[a] != BOX_NEW && change[b] != BOX_NEW;
        w->s->chosen.data[k] = !is ? NO_PAIR : same ? old : NEW_PAIR;
        found += is;
    }
    w->s->chosen_end.data[block] = found;
}

static void put_block(void *arg, int32_t block, int32_t thread)
{
    const choice *w = arg;
    pair_table *out = &w->s->merged;
    int32_t at = block > 0 ? w->s->chosen_end.data[block - 1] : 0;
    (void)thread;
    for (int32_t k = CHOICE_BLOCK * block; k < pool_block_end(block, CHOICE_BLOCK, w->s->candidates.count); k++) {
        int32_t old = w->s->chosen.data[k];
        if (old == NO_PAIR)
            continue;
        out->a[at] = (int32_t)(w->s->candidates.data[k] >> 32);
        out->b[at] = (int32_t)(w->s->candidates.data[k] & UINT32_MAX);
        out->axis[at] = old >= 0 ? w->pairs->axis[old] : vec3_make(0, 0, 0);
        out->clear[at++] = old >= 0 ? w->pairs->clear[old] : 0;
    }
}

/* The pairs among the candidates, in their order, which is ascending. */
static bool choose_pairs(context *ctx, const broad_table *boxes, collision_scratch *s, pair_table *pairs)
{
    int32_t count = s->candidates.count, blocks = pool_blocks(count, CHOICE_BLOCK), found = 0;
    if (!array_resize(ctx, &s->chosen, count) || !array_resize(ctx, &s->chosen_end, blocks) ||
        !table_reserve(ctx, &s->merged, &pair_table_info, count))
        return false;
    choice work = {boxes, s, pairs};
    pool_run(ctx, choose_block, &work, blocks);
    for (int32_t block = 0; block < blocks; block++)
        found = s->chosen_end.data[block] += found;
    pool_run(ctx, put_block, &work, blocks);
    s->merged.count = found;
    pair_table before = *pairs;
    *pairs = s->merged;
    s->merged = before;
    return true;
}

fram_status broad_phase_update(context *ctx, const body_table *bodies, const shape_store *shapes,
                               const collision_settings *settings, broad_table *boxes, pair_table *pairs,
                               collision_scratch *scratch, fram_error *error)
{
    if (bodies->count > CONTACT_MOST_BODIES)
        return error_set(error, FRAM_ERROR_UNSUPPORTED, NULL, 0, NULL, "%d bodies; at most %d can be told apart",
                         (int)bodies->count, (int)CONTACT_MOST_BODIES);
    bool any;
    fram_status status = broad_boxes_update(ctx, bodies, shapes, settings, boxes, scratch, &any, error);
    if (status != FRAM_OK || !any)
        return status;
    if (!broad_candidates_update(ctx, settings, boxes, scratch) || !choose_pairs(ctx, boxes, scratch, pairs))
        return error_memory(error);
    return FRAM_OK;
}
