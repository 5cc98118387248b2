/* Which bodies may come to touch for a good while: pairs of wide boxes, each around a fat box with room for it to move
   in.  While fat boxes stay inside their wide ones, all pairs of fat boxes are among these pairs, and nobody has to
   look for any.  Looked for is around renewed wide boxes only, in grids of the plane: one grid for each power of two of
   box size, so that a hull of 200 m and walls of a kilometre stand in coarse grids of their own and cost the floes
   nothing; and those that were renewed together stand in grids apart from the others, so that of two of them the
   smaller one looks for the larger, which has no need to look through fine grids.

   All of this is memory of what could be made again at any time; no result depends on it. */
#include "base/pool.h"
#include "dynamics/collision_scratch.h"

#include <string.h>

/* Room of a fat box in its wide one, in margins of fat boxes: more of it makes more pairs to look through whenever some
   fat box changes, less of it more searches (docs/decisions/0240-pairs-of-wider-boxes.md). */
#define WIDE_MARGINS 8.0

/* Bodies a block. */
enum { BLOCK_BODIES = 512 };

/* ---- grids ---- */

/* Cells of level L are 2^L metres wide, larger than every box filed there. */
enum { LEVEL_LEAST = -16, LEVEL_MOST = 47, LEVELS = LEVEL_MOST - LEVEL_LEAST + 1 };

/* Grids are numbered by level, that of renewed boxes after that of the others. */
enum { GRIDS = 2 * LEVELS };
static int grid_number(int level, bool renewed) { return 2 * (level - LEVEL_LEAST) + renewed; }
static bool grid_is_renewed(int number) { return number % 2 != 0; }
static double cell_width(int number) { return ldexp(1, number / 2 + LEVEL_LEAST); }

static int level_of(box3 box)
{
    int level;
    (void)frexp(fmax(box.hi.x - box.lo.x, box.hi.y - box.lo.y), &level);
    return level < LEVEL_LEAST ? LEVEL_LEAST : level > LEVEL_MOST ? LEVEL_MOST : level;
}

static int64_t cell_of(double x, double cell) { return (int64_t)floor(x / cell); }

static uint32_t hash_cell(int grid, int64_t column, int64_t row)
{
    uint64_t h = (uint64_t)column * 0x9e3779b97f4a7c15ULL ^ (uint64_t)row * 0xc2b2ae3d27d4eb4fULL ^
                 (uint64_t)(uint32_t)grid * 0x165667b19e3779f9ULL;
    h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9ULL;
    return (uint32_t)(h >> 32);
}

/* All of them, in one table. */
typedef struct grids {
    context *ctx;
    collision_scratch *scratch;
    uint32_t mask;        /* buckets - 1 */
    int32_t count[GRIDS]; /* bodies of each */
} grids;

static grid_entry entry_of(const wide_box *w, int32_t slot)
{
    int grid = grid_number(level_of(w->box), w->renewed);
    double cell = cell_width(grid);
    return (grid_entry){cell_of(0.5 * (w->box.lo.x + w->box.hi.x), cell),
                        cell_of(0.5 * (w->box.lo.y + w->box.hi.y), cell), slot, grid};
}

static void file_block(void *arg, int32_t block, int32_t thread)
{
    const grids *g = arg;
    collision_scratch *s = g->scratch;
    (void)thread;
    for (int32_t i = BLOCK_BODIES * block; i < pool_block_end(block, BLOCK_BODIES, s->wide.count); i++) {
        if (s->wide.data[i].generation == 0)
            continue;
        grid_entry e = s->filed.data[i] = entry_of(&s->wide.data[i], i);
        s->bucket.data[i] = (int32_t)(hash_cell(e.grid, e.column, e.row) & g->mask);
    }
}

/* Counting sort of all boxed bodies into hash buckets, each in slot order. */
static bool build_grids(context *ctx, collision_scratch *s, grids *g)
{
    const wide_box *wide = s->wide.data;
    int32_t count = s->wide.count;
    *g = (grids){.ctx = ctx, .scratch = s, .mask = 63};
    while (g->mask < 2 * (uint32_t)count)
        g->mask = 2 * g->mask + 1;
    int32_t buckets = (int32_t)g->mask + 1;
    if (!array_resize(ctx, &s->bucket_start, buckets + 1) || !array_resize(ctx, &s->bucket, count) ||
        !array_resize(ctx, &s->filed, count))
        return false;
    memset(s->bucket_start.data, 0, (size_t)(buckets + 1) * sizeof *s->bucket_start.data);
    pool_run(ctx, file_block, g, pool_blocks(count, BLOCK_BODIES));
    for (int32_t i = 0; i < count; i++) {
        if (wide[i].generation == 0)
            continue;
        s->bucket_start.data[s->bucket.data[i]]++;
        g->count[s->filed.data[i].grid]++;
    }
    for (int32_t i = 0; i < buckets; i++)
        s->bucket_start.data[i + 1] += s->bucket_start.data[i]; /* now the end of each bucket, and the whole count */
    if (!array_resize(ctx, &s->entries, s->bucket_start.data[buckets]))
        return false;
    for (int32_t i = count - 1; i >= 0; i--) {
        if (wide[i].generation == 0)
            continue;
        /* Filled from the back: the ends become starts. */
        s->entries.data[--s->bucket_start.data[s->bucket.data[i]]] = s->filed.data[i];
    }
    return true;
}

/* ---- searches ---- */

static bool consider(const grids *g, int32_t slot, const grid_entry *e, pair_key_array *found)
{
    const wide_box *a = &g->scratch->wide.data[slot], *b = &g->scratch->wide.data[e->slot];
    bool twice = e->slot <= slot && e->grid == g->scratch->filed.data[slot].grid; /* it finds us itself */
    if (twice || (a->fixed && b->fixed) || !box3_meet(a->box, b->box))
        return true;
    uint64_t low = (uint64_t)(slot < e->slot ? slot : e->slot), high = (uint64_t)(slot < e->slot ? e->slot : slot);
    return array_push(g->ctx, found, low << 32 | high);
}

static bool search_cell(const grids *g, int32_t slot, int grid, int64_t column, int64_t row, pair_key_array *found)
{
    const collision_scratch *s = g->scratch;
    uint32_t bucket = hash_cell(grid, column, row) & g->mask;
    for (int32_t i = s->bucket_start.data[bucket]; i < s->bucket_start.data[bucket + 1]; i++) {
        const grid_entry *e = &s->entries.data[i];
        if (e->grid == grid && e->column == column && e->row == row && !consider(g, slot, e, found))
            return false;
    }
    return true;
}

/* Bodies whose middle lies within half a cell of the box; a box with more cells than the grid has bodies walks those.
 */
static bool search_grid(const grids *g, int32_t slot, int grid, pair_key_array *found)
{
    const collision_scratch *s = g->scratch;
    double cell = cell_width(grid), half = 0.5 * cell;
    box3 box = s->wide.data[slot].box;
    int64_t left = cell_of(box.lo.x - half, cell), right = cell_of(box.hi.x + half, cell);
    int64_t low = cell_of(box.lo.y - half, cell), high = cell_of(box.hi.y + half, cell);
    double cells = (double)(right - left + 1) * (double)(high - low + 1);
    if (cells > s->entries.count) {
        for (int32_t i = 0; i < s->entries.count; i++)
            if (s->entries.data[i].grid == grid && !consider(g, slot, &s->entries.data[i], found))
                return false;
        return true;
    }
    for (int64_t row = low; row <= high; row++)
        for (int64_t column = left; column <= right; column++)
            if (!search_cell(g, slot, grid, column, row, found))
                return false;
    return true;
}

/* Whether a renewed box of one grid has to look through another: of two that are both renewed the smaller one looks. */
static bool has_to_search(int own, int grid) { return !grid_is_renewed(grid) || grid >= own; }

static bool search_all(const grids *g, int32_t slot, pair_key_array *found)
{
    int own = g->scratch->filed.data[slot].grid;
    for (int grid = 0; grid < GRIDS; grid++)
        if (g->count[grid] > 0 && has_to_search(own, grid) && !search_grid(g, slot, grid, found))
            return false;
    return true;
}

static void search_block(void *arg, int32_t block, int32_t thread)
{
    const grids *g = arg;
    const collision_scratch *s = g->scratch;
    found_pairs *found = &s->found.data[thread];
    for (int32_t i = BLOCK_BODIES * block; i < pool_block_end(block, BLOCK_BODIES, s->wide.count); i++)
        if (s->wide.data[i].renewed && !search_all(g, i, &found->keys))
            found->memory_failed = true;
}

/* ---- wide boxes ---- */

static bool box_holds(box3 outer, box3 inner)
{
    return inner.lo.x >= outer.lo.x && inner.lo.y >= outer.lo.y && inner.lo.z >= outer.lo.z &&
           inner.hi.x <= outer.hi.x && inner.hi.y <= outer.hi.y && inner.hi.z <= outer.hi.z;
}

static box3 box_grown(box3 box, double by)
{
    vec3 rim = {by, by, by};
    return (box3){vec3_sub(box.lo, rim), vec3_add(box.hi, rim)};
}

/* A body whose wide box is not its own, or does not hold its fat box. */
static bool is_outside(const broad_table *boxes, const wide_box *w, int32_t i)
{
    return boxes->generation[i] != w->generation || boxes->fixed[i] != w->fixed ||
           !box_holds(w->box, fat_box(boxes, i));
}

/* Looked for among all in every step, since a state may have been loaded since. */
typedef struct wide_work {
    const broad_table *boxes;
    double room;
    collision_scratch *s;
} wide_work;

static int32_t find_outside(const void *arg, int32_t first, int32_t end)
{
    const wide_work *w = arg;
    while (first < end && (w->boxes->generation[first] == 0 || !is_outside(w->boxes, &w->s->wide.data[first], first)))
        first++;
    return first;
}

/* Those that have used up half of their room get new boxes, too, so that the next one is a while off; those of bodies
   that are gone go. */
static void renew_block(void *arg, int32_t block, int32_t thread)
{
    const wide_work *work = arg;
    const broad_table *boxes = work->boxes;
    (void)thread;
    for (int32_t i = BLOCK_BODIES * block; i < pool_block_end(block, BLOCK_BODIES, boxes->count); i++) {
        wide_box *w = &work->s->wide.data[i];
        w->renewed = false;
        if (boxes->generation[i] == 0)
            w->generation = 0;
        else if (is_outside(boxes, w, i) || !box_holds(w->box, box_grown(fat_box(boxes, i), 0.5 * work->room)))
            *w = (wide_box){box_grown(fat_box(boxes, i), work->room), boxes->generation[i], boxes->fixed[i], true};
    }
}

/* ---- pairs ---- */

/* Pairs of wide boxes that stayed as they are; those of renewed ones are found anew. */
static int32_t pick_kept(const void *arg, int32_t first, int32_t end, int32_t *out)
{
    const collision_scratch *s = arg;
    int32_t found = 0;
    for (int32_t i = first; i < end; i++) {
        uint64_t key = s->candidates.data[i];
        const wide_box *a = &s->wide.data[key >> 32], *b = &s->wide.data[key & UINT32_MAX];
        if (a->generation != 0 && b->generation != 0 && !a->renewed && !b->renewed)
            out[found++] = i;
    }
    return found;
}

static bool begin_search(context *ctx, collision_scratch *s)
{
    while (s->found.count < context_threads(ctx))
        if (!array_push(ctx, &s->found, (found_pairs){0}))
            return false;
    for (int32_t t = 0; t < s->found.count; t++) {
        array_clear(&s->found.data[t].keys);
        s->found.data[t].memory_failed = false;
    }
    return true;
}

/* Counts, and then puts, keys by the slot that stands `shift` bits up. */
static void count_keys(const pair_key_array *keys, int shift, int32_t *count)
{
    for (int32_t i = 0; i < keys->count; i++)
        count[(keys->data[i] >> shift & UINT32_MAX) + 1]++;
}
static void put_keys(const pair_key_array *keys, int shift, int32_t *first, uint64_t *out)
{
    for (int32_t i = 0; i < keys->count; i++)
        out[first[keys->data[i] >> shift & UINT32_MAX]++] = keys->data[i];
}

/* One pass of a counting sort of the keys in `count` lists into *out, which has room for them. */
static void sort_keys(found_pairs *list, int32_t count, int shift, int32_array *first, pair_key_array *out)
{
    memset(first->data, 0, (size_t)first->count * sizeof *first->data);
    for (int32_t t = 0; t < count; t++)
        count_keys(&list[t].keys, shift, first->data);
    for (int32_t i = 1; i < first->count; i++)
        first->data[i] += first->data[i - 1];
    for (int32_t t = 0; t < count; t++)
        put_keys(&list[t].keys, shift, first->data, out->data);
}

/* What all threads found, ascending: by the higher slot of each pair first, then by the lower one. */
static bool gather_fresh(context *ctx, collision_scratch *s)
{
    int64_t count = 0;
    for (int32_t t = 0; t < s->found.count; t++) {
        if (s->found.data[t].memory_failed)
            return false;
        count += s->found.data[t].keys.count;
    }
    if (count > INT32_MAX || !array_resize(ctx, &s->fresh, (int32_t)count) ||
        !array_resize(ctx, &s->by_higher.keys, (int32_t)count) || !array_resize(ctx, &s->first_key, s->wide.count + 1))
        return false;
    if (count > 0) {
        sort_keys(s->found.data, s->found.count, 0, &s->first_key, &s->by_higher.keys);
        sort_keys(&s->by_higher, 1, 32, &s->first_key, &s->fresh);
    }
    return true;
}

/* Pairs of renewed wide boxes, each once. */
static bool find_fresh(context *ctx, collision_scratch *s)
{
    grids g;
    if (!build_grids(ctx, s, &g) || !begin_search(ctx, s))
        return false;
    pool_run(ctx, search_block, &g, pool_blocks(s->wide.count, BLOCK_BODIES));
    return gather_fresh(ctx, s);
}

/* Both lists have no pair in common. */
static bool merge_candidates(context *ctx, collision_scratch *s)
{
    int32_t kept = s->kept.count, fresh = s->fresh.count;
    if (kept > INT32_MAX - fresh || !array_resize(ctx, &s->merged_keys, kept + fresh))
        return false;
    const uint64_t *old = s->candidates.data;
    for (int32_t at = 0, k = 0, f = 0; at < kept + fresh; at++) {
        bool of_old = f == fresh || (k < kept && old[s->kept.data[k]] < s->fresh.data[f]);
        s->merged_keys.data[at] = of_old ? old[s->kept.data[k++]] : s->fresh.data[f++];
    }
    pair_key_array before = s->candidates;
    s->candidates = s->merged_keys;
    s->merged_keys = before;
    return true;
}

bool broad_candidates_update(context *ctx, const collision_settings *settings, const broad_table *boxes,
                             collision_scratch *s)
{
    int32_t before = s->wide.count;
    if (!array_resize(ctx, &s->wide, boxes->count))
        return false;
    for (int32_t i = before; i < boxes->count; i++)
        s->wide.data[i] = (wide_box){.generation = 0};
    wide_work work = {boxes, WIDE_MARGINS * settings->margin, s};
    if (pool_find(ctx, find_outside, &work, boxes->count) == boxes->count)
        return true;
    pool_run(ctx, renew_block, &work, pool_blocks(boxes->count, BLOCK_BODIES));
    bool found =
        pool_pick(ctx, pick_kept, s, s->candidates.count, &s->kept) && find_fresh(ctx, s) && merge_candidates(ctx, s);
    if (!found)
        array_clear(&s->wide); /* boxes whose pairs are not known are none */
    return found;
}
