/* Which bodies may touch.  Every body has a fat box (broad_boxes.c); pairs of overlapping fat boxes are kept until they
   part.  They are chosen from pairs of wider boxes, which change seldom (broad_candidates.c). */
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
    array_free(ctx, &s->filed);
    array_free(ctx, &s->entries);
    array_free(ctx, &s->bucket);
    array_free(ctx, &s->bucket_start);
    array_free(ctx, &s->fresh);
    array_free(ctx, &s->wide);
    array_free(ctx, &s->candidates);
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

/* The pairs among the candidates, in their order, which is ascending.  A pair that was one keeps its axis, unless one
   of both is another body now. */
static bool choose_pairs(context *ctx, const broad_table *boxes, collision_scratch *s, pair_table *pairs)
{
    pair_table *out = &s->merged;
    const uint8_t *change = s->change.data;
    if (!table_reserve(ctx, out, &pair_table_info, s->candidates.count))
        return false;
    out->count = 0;
    for (int32_t k = 0, old = 0; k < s->candidates.count; k++) {
        uint64_t key = s->candidates.data[k];
        int32_t a = (int32_t)(key >> 32), b = (int32_t)(key & UINT32_MAX);
        while (old < pairs->count && ((uint64_t)pairs->a[old] << 32 | (uint64_t)pairs->b[old]) < key)
            old++;
        bool was = old < pairs->count && pairs->a[old] == a && pairs->b[old] == b;
        if (!is_still_pair(boxes, change, a, b, was))
            continue;
        bool same = was && change[a] != BOX_NEW && change[b] != BOX_NEW;
        out->a[out->count] = a;
        out->b[out->count] = b;
        out->axis[out->count] = same ? pairs->axis[old] : vec3_make(0, 0, 0);
        out->clear[out->count++] = same ? pairs->clear[old] : 0;
    }
    pair_table before = *pairs;
    *pairs = *out;
    *out = before;
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
