/* Which bodies may come to touch for a good while: pairs of wide boxes, each around a fat box with room for it to move
   in.  While fat boxes stay inside their wide ones, all pairs of fat boxes are among these pairs, and nobody has to
   look for any.  Looked for is around renewed wide boxes only.

   All of this is memory of what could be made again at any time; no result depends on it, as long as it is told when
   boxes become those of another state (collision_scratch_forget). */
#include "base/pool.h"
#include "dynamics/collision_scratch.h"

#include <string.h>

/* Room of a fat box in its wide one, in margins of fat boxes: more of it makes more pairs to look through whenever some
   fat box changes, less of it more searches (docs/decisions/0240-pairs-of-wider-boxes.md). */
#define WIDE_MARGINS 8.0

/* ---- searches ---- */

typedef struct box_search {
    context *ctx;
    collision_scratch *s;
} box_search;

/* Of one renewed box. */
typedef struct search_around {
    const box_search *search;
    pair_key_array *found;
    int32_t slot, grid;
} search_around;

static bool consider(void *user, int32_t other)
{
    const search_around *around = user;
    const collision_scratch *s = around->search->s;
    int32_t slot = around->slot, grid = box_grid_of(&s->grid, other);
    const wide_box *a = &s->wide.data[slot], *b = &s->wide.data[other];
    /* Of two that are both renewed the smaller one finds the other. */
    bool finds_us = b->renewed && (grid < around->grid || (grid == around->grid && other <= slot));
    if (finds_us || (a->fixed && b->fixed) || !box3_meet(a->box, b->box))
        return true;
    uint64_t low = (uint64_t)(slot < other ? slot : other), high = (uint64_t)(slot < other ? other : slot);
    return array_push(around->search->ctx, around->found, low << 32 | high);
}

static bool search_all(const box_search *search, int32_t slot, pair_key_array *found)
{
    const collision_scratch *s = search->s;
    search_around around = {search, found, slot, box_grid_of(&s->grid, slot)};
    for (int32_t grid = 0; grid < BOX_GRIDS; grid++) {
        bool all_find_us = grid < around.grid && s->renewed_of[grid] == s->grid.member[grid].count;
        if (!all_find_us && !box_grid_search(&s->grid, grid, s->wide.data[slot].box, consider, &around))
            return false;
    }
    return true;
}

enum { SEARCH_BLOCK = 64 };

static void search_block(void *arg, int32_t block, int32_t thread)
{
    const box_search *search = arg;
    const collision_scratch *s = search->s;
    found_pairs *found = &search->s->found.data[thread];
    for (int32_t i = SEARCH_BLOCK * block; i < pool_block_end(block, SEARCH_BLOCK, s->renewed.count); i++)
        if (s->wide.data[s->renewed.data[i]].renewed && !search_all(search, s->renewed.data[i], &found->keys))
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

typedef struct wide_work {
    const broad_table *boxes;
    double room;
    collision_scratch *s;
} wide_work;

/* The end of the boxes from here on that are as they were when they were last looked at. */
static int32_t pass_standing(const wide_work *w, int32_t i, int32_t end)
{
    while (i < end && i % BOX_CHUNK == 0 && w->s->standing.data[i / BOX_CHUNK])
        i += BOX_CHUNK;
    return i < end ? i : end;
}

static int32_t find_outside(const void *arg, int32_t first, int32_t end)
{
    const wide_work *w = arg;
    for (int32_t i = pass_standing(w, first, end); i < end; i = pass_standing(w, i + 1, end))
        if (w->boxes->generation[i] != 0 && is_outside(w->boxes, &w->s->wide.data[i], i))
            return i;
    return end;
}

/* Those that left their wide boxes get new ones, and those that have used up half of their room, so that the next one
   is a while off; those of bodies that are gone go. */
static int32_t pick_renewed(const void *arg, int32_t first, int32_t end, int32_t *out)
{
    const wide_work *work = arg;
    const broad_table *boxes = work->boxes;
    int32_t found = 0;
    for (int32_t i = pass_standing(work, first, end); i < end; i = pass_standing(work, i + 1, end)) {
        wide_box *w = &work->s->wide.data[i];
        if (boxes->generation[i] == 0) {
            if (w->generation == 0)
                continue;
            *w = (wide_box){.generation = 0};
        } else if (is_outside(boxes, w, i) || !box_holds(w->box, box_grown(fat_box(boxes, i), 0.5 * work->room))) {
            *w = (wide_box){box_grown(fat_box(boxes, i), work->room), boxes->generation[i], boxes->fixed[i], true};
        } else {
            continue;
        }
        out[found++] = i;
    }
    return found;
}

static bool file_renewed(context *ctx, collision_scratch *s)
{
    memset(s->renewed_of, 0, sizeof s->renewed_of);
    for (int32_t k = 0; k < s->renewed.count; k++) {
        int32_t i = s->renewed.data[k];
        if (!s->wide.data[i].renewed) {
            box_grid_take(&s->grid, i);
            continue;
        }
        if (!box_grid_put(ctx, &s->grid, i, s->wide.data[i].box))
            return false;
        s->renewed_of[box_grid_of(&s->grid, i)]++;
    }
    return true;
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

/* Sorts by eleven bits at a time: what it costs goes with the keys, not with the slots, of which there are fewer than
   2^22 (CONTACT_MOST_BODIES). */
enum { DIGIT_BITS = 11, DIGITS = 1 << DIGIT_BITS };

static int32_t digit_of(uint64_t key, int shift) { return (int32_t)(key >> shift & (DIGITS - 1)); }

/* One pass, by the digit that stands `shift` bits up, into *out, which has room for all. */
static void sort_by_digit(const pair_key_array *keys, int shift, pair_key_array *out)
{
    int32_t first[DIGITS + 1] = {0};
    for (int32_t i = 0; i < keys->count; i++)
        first[digit_of(keys->data[i], shift) + 1]++;
    for (int32_t d = 1; d < DIGITS; d++)
        first[d] += first[d - 1];
    for (int32_t i = 0; i < keys->count; i++)
        out->data[first[digit_of(keys->data[i], shift)]++] = keys->data[i];
}

static void swap_keys(pair_key_array *a, pair_key_array *b)
{
    pair_key_array before = *a;
    *a = *b;
    *b = before;
}

/* Ascending: by the higher slot of each pair first, then by the lower one. */
static bool sort_fresh(context *ctx, collision_scratch *s)
{
    if (!array_resize(ctx, &s->spare_keys, s->fresh.count))
        return false;
    for (int slot = 0; slot <= 32; slot += 32) {
        for (int digit = 0; (s->wide.count - 1) >> digit > 0; digit += DIGIT_BITS) {
            sort_by_digit(&s->fresh, slot + digit, &s->spare_keys);
            swap_keys(&s->fresh, &s->spare_keys);
        }
    }
    return true;
}

/* What all threads found, ascending. */
static bool gather_fresh(context *ctx, collision_scratch *s)
{
    array_clear(&s->fresh);
    for (int32_t t = 0; t < s->found.count; t++) {
        const pair_key_array *keys = &s->found.data[t].keys;
        int32_t at = s->fresh.count;
        if (s->found.data[t].memory_failed || keys->count > INT32_MAX - at ||
            !array_resize(ctx, &s->fresh, at + keys->count))
            return false;
        if (keys->count > 0)
            memcpy(s->fresh.data + at, keys->data, (size_t)keys->count * sizeof *keys->data);
    }
    return s->fresh.count == 0 || sort_fresh(ctx, s);
}

/* Pairs of renewed wide boxes, each once. */
static bool find_fresh(context *ctx, collision_scratch *s)
{
    box_search search = {ctx, s};
    if (!file_renewed(ctx, s) || !begin_search(ctx, s))
        return false;
    pool_run(ctx, search_block, &search, pool_blocks(s->renewed.count, SEARCH_BLOCK));
    return gather_fresh(ctx, s);
}

/* Both lists have no pair in common. */
static bool merge_candidates(context *ctx, collision_scratch *s)
{
    int32_t kept = s->kept.count, fresh = s->fresh.count;
    if (kept > INT32_MAX - fresh || !array_resize(ctx, &s->spare_keys, kept + fresh))
        return false;
    const uint64_t *old = s->candidates.data;
    for (int32_t at = 0, k = 0, f = 0; at < kept + fresh; at++) {
        bool of_old = f == fresh || (k < kept && old[s->kept.data[k]] < s->fresh.data[f]);
        s->spare_keys.data[at] = of_old ? old[s->kept.data[k++]] : s->fresh.data[f++];
    }
    swap_keys(&s->candidates, &s->spare_keys);
    return true;
}

void collision_scratch_forget(collision_scratch *s)
{
    array_clear(&s->wide);
    array_clear(&s->renewed);
    array_clear(&s->candidates);
    box_grid_clear(&s->grid);
}

bool broad_candidates_update(context *ctx, const collision_settings *settings, const broad_table *boxes,
                             collision_scratch *s)
{
    int32_t before = s->wide.count;
    if (!array_resize(ctx, &s->wide, boxes->count))
        return false;
    for (int32_t i = before; i < boxes->count; i++) {
        s->wide.data[i] = (wide_box){.generation = 0};
        s->standing.data[i / BOX_CHUNK] = false;
    }
    wide_work work = {boxes, WIDE_MARGINS * settings->margin, s};
    if (pool_find(ctx, find_outside, &work, boxes->count) == boxes->count)
        return true;
    for (int32_t k = 0; k < s->renewed.count; k++)
        s->wide.data[s->renewed.data[k]].renewed = false;
    bool found = pool_pick(ctx, pick_renewed, &work, boxes->count, &s->renewed) &&
                 pool_pick(ctx, pick_kept, s, s->candidates.count, &s->kept) && find_fresh(ctx, s) &&
                 merge_candidates(ctx, s);
    if (!found)
        collision_scratch_forget(s);
    return found;
}
