/* Which bodies may come to touch for a good while: pairs of wide boxes, each around a fat box with room for it to move
   in.  While fat boxes stay inside their wide ones, all pairs of fat boxes are among these pairs, and nobody has to
   look for any.  Looked for is around renewed wide boxes only, in grids of the plane: one grid for each power of two of
   box size, so that a hull of 200 m and walls of a kilometre stand in coarse grids of their own and cost the floes
   nothing.

   All of this is memory of what could be made again at any time; no result depends on it. */
#include "dynamics/collision_scratch.h"

#include <stdlib.h>
#include <string.h>

/* Room of a fat box in its wide one, in margins of fat boxes: more of it makes more pairs to look through whenever some
   fat box changes, less of it more searches (docs/decisions/0240-pairs-of-wider-boxes.md). */
#define WIDE_MARGINS 8.0

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

static grid_entry entry_of(box3 box, int32_t slot)
{
    int level = level_of(box);
    double cell = ldexp(1, level);
    return (grid_entry){cell_of(0.5 * (box.lo.x + box.hi.x), cell), cell_of(0.5 * (box.lo.y + box.hi.y), cell), slot,
                        level};
}

/* Counting sort of all boxed bodies into hash buckets, each in slot order. */
static bool build_grid(context *ctx, collision_scratch *s, grid *g)
{
    const wide_box *wide = s->wide.data;
    int32_t count = s->wide.count;
    *g = (grid){.scratch = s, .mask = 63};
    while (g->mask < 2 * (uint32_t)count)
        g->mask = 2 * g->mask + 1;
    int32_t buckets = (int32_t)g->mask + 1;
    if (!array_resize(ctx, &s->bucket_start, buckets + 1) || !array_resize(ctx, &s->bucket, count) ||
        !array_resize(ctx, &s->filed, count))
        return false;
    memset(s->bucket_start.data, 0, (size_t)(buckets + 1) * sizeof *s->bucket_start.data);
    for (int32_t i = 0; i < count; i++) {
        if (wide[i].generation == 0)
            continue;
        grid_entry e = s->filed.data[i] = entry_of(wide[i].box, i);
        s->bucket.data[i] = (int32_t)(hash_cell(e.level, e.column, e.row) & g->mask);
        s->bucket_start.data[s->bucket.data[i]]++;
        g->in_level[e.level - LEVEL_LEAST]++;
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

static bool consider(context *ctx, collision_scratch *s, int32_t slot, int32_t other)
{
    const wide_box *a = &s->wide.data[slot], *b = &s->wide.data[other];
    bool twice = b->renewed && other <= slot; /* it finds us itself */
    if (twice || (a->fixed && b->fixed) || !box3_meet(a->box, b->box))
        return true;
    uint64_t low = (uint64_t)(slot < other ? slot : other), high = (uint64_t)(slot < other ? other : slot);
    return array_push(ctx, &s->fresh, low << 32 | high);
}

static bool search_cell(context *ctx, const grid *g, collision_scratch *s, int32_t slot, int level, int64_t column,
                        int64_t row)
{
    uint32_t bucket = hash_cell(level, column, row) & g->mask;
    for (int32_t i = s->bucket_start.data[bucket]; i < s->bucket_start.data[bucket + 1]; i++) {
        const grid_entry *e = &s->entries.data[i];
        if (e->level == level && e->column == column && e->row == row && !consider(ctx, s, slot, e->slot))
            return false;
    }
    return true;
}

/* Bodies whose middle lies within half a cell of the box; a box with more cells than the level has bodies walks those.
 */
static bool search_level(context *ctx, const grid *g, collision_scratch *s, int32_t slot, int level)
{
    double cell = ldexp(1, level), half = 0.5 * cell;
    box3 box = s->wide.data[slot].box;
    int64_t left = cell_of(box.lo.x - half, cell), right = cell_of(box.hi.x + half, cell);
    int64_t low = cell_of(box.lo.y - half, cell), high = cell_of(box.hi.y + half, cell);
    double cells = (double)(right - left + 1) * (double)(high - low + 1);
    if (cells > s->entries.count) {
        for (int32_t i = 0; i < s->entries.count; i++)
            if (s->entries.data[i].level == level && !consider(ctx, s, slot, s->entries.data[i].slot))
                return false;
        return true;
    }
    for (int64_t row = low; row <= high; row++)
        for (int64_t column = left; column <= right; column++)
            if (!search_cell(ctx, g, s, slot, level, column, row))
                return false;
    return true;
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

/* Whether some body has no wide box that will do; those of bodies that are gone go.  All are looked at, since a state
   may have been loaded since. */
static bool any_outside(const broad_table *boxes, collision_scratch *s)
{
    bool found = false;
    for (int32_t i = 0; i < boxes->count; i++) {
        wide_box *w = &s->wide.data[i];
        w->renewed = false;
        if (boxes->generation[i] == 0)
            w->generation = 0;
        else
            found = found || is_outside(boxes, w, i);
    }
    return found;
}

/* Those that have used up half of their room get new boxes, too, so that the next one is a while off. */
static void renew_wide_boxes(const broad_table *boxes, double room, collision_scratch *s)
{
    for (int32_t i = 0; i < boxes->count; i++) {
        wide_box *w = &s->wide.data[i];
        if (boxes->generation[i] == 0)
            continue;
        if (!is_outside(boxes, w, i) && box_holds(w->box, box_grown(fat_box(boxes, i), 0.5 * room)))
            continue;
        *w = (wide_box){box_grown(fat_box(boxes, i), room), boxes->generation[i], boxes->fixed[i], true};
    }
}

/* ---- pairs ---- */

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Pairs of wide boxes that stayed as they are; those of renewed ones are found anew. */
static void keep_candidates(collision_scratch *s)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < s->candidates.count; i++) {
        uint64_t key = s->candidates.data[i];
        const wide_box *a = &s->wide.data[key >> 32], *b = &s->wide.data[key & UINT32_MAX];
        if (a->generation != 0 && b->generation != 0 && !a->renewed && !b->renewed)
            s->candidates.data[kept++] = key;
    }
    s->candidates.count = kept;
}

/* Both lists have no pair in common. */
static bool merge_candidates(context *ctx, collision_scratch *s)
{
    if (s->fresh.count > 0) /* qsort takes no NULL */
        qsort(s->fresh.data, (size_t)s->fresh.count, sizeof *s->fresh.data, compare_keys);
    int32_t old = s->candidates.count, fresh = s->fresh.count;
    if (old > INT32_MAX - fresh || !array_resize(ctx, &s->candidates, old + fresh))
        return false;
    for (int32_t at = old + fresh; fresh > 0;) { /* from the back, in place */
        bool of_old = old > 0 && s->candidates.data[old - 1] > s->fresh.data[fresh - 1];
        s->candidates.data[--at] = of_old ? s->candidates.data[--old] : s->fresh.data[--fresh];
    }
    return true;
}

/* Pairs of renewed wide boxes, each once. */
static bool find_fresh(context *ctx, collision_scratch *s)
{
    grid g;
    if (!build_grid(ctx, s, &g))
        return false;
    array_clear(&s->fresh);
    for (int32_t i = 0; i < s->wide.count; i++) {
        for (int level = LEVEL_LEAST; s->wide.data[i].renewed && level <= LEVEL_MOST; level++)
            if (g.in_level[level - LEVEL_LEAST] > 0 && !search_level(ctx, &g, s, i, level))
                return false;
    }
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
    if (!any_outside(boxes, s))
        return true;
    renew_wide_boxes(boxes, WIDE_MARGINS * settings->margin, s);
    keep_candidates(s);
    bool found = find_fresh(ctx, s) && merge_candidates(ctx, s);
    if (!found)
        array_clear(&s->wide); /* boxes whose pairs are not known are none */
    return found;
}
