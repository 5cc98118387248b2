/* Which bodies may touch.  Every body has a fat box (broad_boxes.c); pairs of overlapping fat boxes are kept until they
   part.  New pairs are looked for around renewed boxes only, in grids of the plane: one grid
   for each power of two of box size, so that a hull of 200 m and walls of a kilometre stand in coarse grids of their
   own and cost the floes nothing. */
#include "dynamics/collision_scratch.h"

#include <stdlib.h>
#include <string.h>

collision_scratch *collision_scratch_create(context *ctx) { return memory_array(ctx, 1, sizeof(collision_scratch)); }

static void free_room(context *ctx, narrow_room *room)
{
    polyhedron_free(ctx, &room->piece_a);
    polyhedron_free(ctx, &room->piece_b);
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

/* ---- grids ---- */

/* Cells of level L are 2^L metres wide, larger than every box filed there. */
enum { LEVEL_LEAST = -16, LEVEL_MOST = 47 };

static int level_of(box3 box)
{
    int level;
    (void)frexp(fmax(box.hi.x - box.lo.x, box.hi.y - box.lo.y), &level);
    return level < LEVEL_LEAST ? LEVEL_LEAST : level > LEVEL_MOST ? LEVEL_MOST : level;
}

static int64_t cell_of(double x, double cell) { return (int64_t)floor(x / cell); }

static uint32_t hash_cell(int level, int64_t column, int64_t row)
{
    uint64_t h = (uint64_t)column * 0x9e3779b97f4a7c15ULL ^ (uint64_t)row * 0xc2b2ae3d27d4eb4fULL ^
                 (uint64_t)((uint32_t)level - (uint32_t)LEVEL_LEAST) * 0x165667b19e3779f9ULL;
    h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9ULL;
    return (uint32_t)(h >> 32);
}

typedef struct grid {
    const collision_scratch *scratch;
    uint32_t mask;                                  /* buckets - 1 */
    int32_t in_level[LEVEL_MOST - LEVEL_LEAST + 1]; /* bodies of each level */
} grid;

static grid_entry entry_of(const broad_table *boxes, int32_t slot)
{
    box3 box = fat_box(boxes, slot);
    int level = level_of(box);
    double cell = ldexp(1, level);
    return (grid_entry){cell_of(0.5 * (box.lo.x + box.hi.x), cell), cell_of(0.5 * (box.lo.y + box.hi.y), cell), slot,
                        level};
}

/* Counting sort of all boxed bodies into hash buckets, each in slot order. */
static bool build_grid(context *ctx, const broad_table *boxes, collision_scratch *s, grid *g)
{
    *g = (grid){.scratch = s, .mask = 63};
    while (g->mask < 2 * (uint32_t)boxes->count)
        g->mask = 2 * g->mask + 1;
    int32_t buckets = (int32_t)g->mask + 1;
    if (!array_resize(ctx, &s->bucket_start, buckets + 1) || !array_resize(ctx, &s->bucket, boxes->count) ||
        !array_resize(ctx, &s->filed, boxes->count))
        return false;
    memset(s->bucket_start.data, 0, (size_t)(buckets + 1) * sizeof *s->bucket_start.data);
    for (int32_t i = 0; i < boxes->count; i++) {
        if (boxes->generation[i] == 0)
            continue;
        grid_entry e = s->filed.data[i] = entry_of(boxes, i);
        s->bucket.data[i] = (int32_t)(hash_cell(e.level, e.column, e.row) & g->mask);
        s->bucket_start.data[s->bucket.data[i]]++;
        g->in_level[e.level - LEVEL_LEAST]++;
    }
    for (int32_t i = 0; i < buckets; i++)
        s->bucket_start.data[i + 1] += s->bucket_start.data[i]; /* now the end of each bucket, and the whole count */
    if (!array_resize(ctx, &s->entries, s->bucket_start.data[buckets]))
        return false;
    for (int32_t i = boxes->count - 1; i >= 0; i--) {
        if (boxes->generation[i] == 0)
            continue;
        /* Filled from the back: the ends become starts. */
        s->entries.data[--s->bucket_start.data[s->bucket.data[i]]] = s->filed.data[i];
    }
    return true;
}

static bool consider(context *ctx, const broad_table *boxes, collision_scratch *s, int32_t slot, int32_t other)
{
    bool twice = s->change.data[other] != BOX_KEPT && other <= slot; /* it finds us itself */
    if (twice || (boxes->fixed[slot] && boxes->fixed[other]) || !box3_meet(fat_box(boxes, slot), fat_box(boxes, other)))
        return true;
    uint64_t low = (uint64_t)(slot < other ? slot : other), high = (uint64_t)(slot < other ? other : slot);
    return array_push(ctx, &s->fresh, low << 32 | high);
}

static bool search_cell(context *ctx, const grid *g, const broad_table *boxes, collision_scratch *s, int32_t slot,
                        int level, int64_t column, int64_t row)
{
    uint32_t bucket = hash_cell(level, column, row) & g->mask;
    for (int32_t i = s->bucket_start.data[bucket]; i < s->bucket_start.data[bucket + 1]; i++) {
        const grid_entry *e = &s->entries.data[i];
        if (e->level == level && e->column == column && e->row == row && !consider(ctx, boxes, s, slot, e->slot))
            return false;
    }
    return true;
}

/* Bodies whose middle lies within half a cell of the box; a box with more cells than the level has bodies walks those.
 */
static bool search_level(context *ctx, const grid *g, const broad_table *boxes, collision_scratch *s, int32_t slot,
                         int level)
{
    double cell = ldexp(1, level), half = 0.5 * cell;
    box3 box = fat_box(boxes, slot);
    int64_t left = cell_of(box.lo.x - half, cell), right = cell_of(box.hi.x + half, cell);
    int64_t low = cell_of(box.lo.y - half, cell), high = cell_of(box.hi.y + half, cell);
    double cells = (double)(right - left + 1) * (double)(high - low + 1);
    if (cells > s->entries.count) {
        for (int32_t i = 0; i < s->entries.count; i++)
            if (s->entries.data[i].level == level && !consider(ctx, boxes, s, slot, s->entries.data[i].slot))
                return false;
        return true;
    }
    for (int64_t row = low; row <= high; row++)
        for (int64_t column = left; column <= right; column++)
            if (!search_cell(ctx, g, boxes, s, slot, level, column, row))
                return false;
    return true;
}

/* ---- pairs ---- */

static bool still_a_pair(const broad_table *boxes, const collision_scratch *s, int32_t a, int32_t b)
{
    return boxes->generation[a] != 0 && boxes->generation[b] != 0 && s->change.data[a] != BOX_NEW &&
           s->change.data[b] != BOX_NEW && box3_meet(fat_box(boxes, a), fat_box(boxes, b));
}

static void drop_parted(const broad_table *boxes, const collision_scratch *s, pair_table *pairs)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < pairs->count; i++) {
        if (!still_a_pair(boxes, s, pairs->a[i], pairs->b[i]))
            continue;
        table_move_row(pairs, &pair_table_info, kept, i);
        kept++;
    }
    pairs->count = kept;
}

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Fresh pairs into the list, which stays ascending; a pair that is there already keeps its axis. */
static bool merge_fresh(context *ctx, collision_scratch *s, pair_table *pairs)
{
    if (s->fresh.count == 0)
        return true;
    qsort(s->fresh.data, (size_t)s->fresh.count, sizeof *s->fresh.data, compare_keys);
    pair_table *out = &s->merged;
    if (!table_reserve(ctx, out, &pair_table_info, pairs->count + s->fresh.count))
        return false;
    out->count = 0;
    for (int32_t i = 0, f = 0; i < pairs->count || f < s->fresh.count; out->count++) {
        uint64_t old = i < pairs->count ? (uint64_t)pairs->a[i] << 32 | (uint64_t)pairs->b[i] : UINT64_MAX;
        uint64_t new = f < s->fresh.count ? s->fresh.data[f] : UINT64_MAX;
        uint64_t key = old < new ? old : new;
        out->a[out->count] = (int32_t)(key >> 32);
        out->b[out->count] = (int32_t)(key & UINT32_MAX);
        out->axis[out->count] = old <= new ? pairs->axis[i] : vec3_make(0, 0, 0);
        out->clear[out->count] = old <= new ? pairs->clear[i] : 0;
        i += old == key;
        f += new == key;
    }
    pair_table old = *pairs;
    *pairs = *out;
    *out = old;
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
    drop_parted(boxes, scratch, pairs);
    grid g;
    if (!build_grid(ctx, boxes, scratch, &g))
        return error_memory(error);
    array_clear(&scratch->fresh);
    for (int32_t i = 0; i < boxes->count; i++) {
        if (scratch->change.data[i] == BOX_KEPT)
            continue;
        for (int level = LEVEL_LEAST; level <= LEVEL_MOST; level++)
            if (g.in_level[level - LEVEL_LEAST] > 0 && !search_level(ctx, &g, boxes, scratch, i, level))
                return error_memory(error);
    }
    return merge_fresh(ctx, scratch, pairs) ? FRAM_OK : error_memory(error);
}
