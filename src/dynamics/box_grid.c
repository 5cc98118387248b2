#include "dynamics/box_grid.h"

/* Cells of grid G are 2^(G + LEVEL_LEAST) metres wide, larger than every box filed there but for those that are larger
   than cells of the last. */
enum { LEVEL_LEAST = -16, LEVEL_MOST = LEVEL_LEAST + BOX_GRIDS - 1 };

static double cell_width(int32_t grid) { return ldexp(1, grid + LEVEL_LEAST); }

static int32_t grid_of(box3 box)
{
    int level;
    (void)frexp(fmax(box.hi.x - box.lo.x, box.hi.y - box.lo.y), &level);
    return (level < LEVEL_LEAST ? LEVEL_LEAST : level > LEVEL_MOST ? LEVEL_MOST : level) - LEVEL_LEAST;
}

static int64_t cell_of(double x, double cell) { return (int64_t)floor(x / cell); }

static int32_t *bucket_of(const box_grid *g, int32_t grid, int64_t column, int64_t row)
{
    uint64_t h = (uint64_t)column * 0x9e3779b97f4a7c15ULL ^ (uint64_t)row * 0xc2b2ae3d27d4eb4fULL ^
                 (uint64_t)(uint32_t)grid * 0x165667b19e3779f9ULL;
    h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9ULL;
    return &g->bucket.data[(uint32_t)(h >> 32) & ((uint32_t)g->bucket.count - 1)];
}

void box_grid_free(context *ctx, box_grid *g)
{
    array_free(ctx, &g->place);
    array_free(ctx, &g->bucket);
    for (int i = 0; i < BOX_GRIDS; i++)
        array_free(ctx, &g->member[i]);
}

void box_grid_clear(box_grid *g)
{
    array_clear(&g->place);
    array_clear(&g->bucket);
    for (int i = 0; i < BOX_GRIDS; i++)
        array_clear(&g->member[i]);
    g->count = 0;
}

static void link_place(box_grid *g, int32_t slot)
{
    grid_place *place = g->place.data, *p = &place[slot];
    int32_t *first = bucket_of(g, p->grid, p->column, p->row);
    p->before = -1;
    p->next = *first;
    if (*first >= 0)
        place[*first].before = slot;
    *first = slot;
}

static void unlink_place(box_grid *g, int32_t slot)
{
    grid_place *place = g->place.data, *p = &place[slot];
    if (p->before >= 0)
        place[p->before].next = p->next;
    else
        *bucket_of(g, p->grid, p->column, p->row) = p->next;
    if (p->next >= 0)
        place[p->next].before = p->before;
}

/* At least two buckets a slot, so that few slots share one. */
static bool make_room(context *ctx, box_grid *g)
{
    enum { BUCKETS_LEAST = 64, BUCKETS_MOST = 1 << 30 };
    int32_t buckets = g->bucket.count > 0 ? g->bucket.count : BUCKETS_LEAST;
    while (buckets < BUCKETS_MOST && buckets / 2 <= g->count)
        buckets *= 2;
    if (buckets == g->bucket.count)
        return true;
    if (!array_resize(ctx, &g->bucket, buckets))
        return false;
    for (int32_t i = 0; i < buckets; i++)
        g->bucket.data[i] = -1;
    for (int32_t i = 0; i < g->place.count; i++)
        if (g->place.data[i].grid >= 0)
            link_place(g, i);
    return true;
}

void box_grid_take(box_grid *g, int32_t slot)
{
    if (slot >= g->place.count || g->place.data[slot].grid < 0)
        return;
    grid_place *p = &g->place.data[slot];
    int32_array *member = &g->member[p->grid];
    int32_t last = member->data[--member->count];
    member->data[p->member] = last;
    g->place.data[last].member = p->member;
    unlink_place(g, slot);
    p->grid = -1;
    g->count--;
}

bool box_grid_put(context *ctx, box_grid *g, int32_t slot, box3 box)
{
    box_grid_take(g, slot);
    while (g->place.count <= slot)
        if (!array_push(ctx, &g->place, (grid_place){.grid = -1}))
            return false;
    int32_t grid = grid_of(box);
    double cell = cell_width(grid);
    if (!make_room(ctx, g) || !array_push(ctx, &g->member[grid], slot))
        return false;
    g->place.data[slot] = (grid_place){.column = cell_of(0.5 * (box.lo.x + box.hi.x), cell),
                                       .row = cell_of(0.5 * (box.lo.y + box.hi.y), cell),
                                       .grid = grid,
                                       .member = g->member[grid].count - 1};
    link_place(g, slot);
    g->count++;
    return true;
}

static bool search_cell(const box_grid *g, grid_place cell, box_grid_meet meet, void *user)
{
    for (int32_t i = *bucket_of(g, cell.grid, cell.column, cell.row); i >= 0; i = g->place.data[i].next) {
        const grid_place *p = &g->place.data[i];
        if (p->grid == cell.grid && p->column == cell.column && p->row == cell.row && !meet(user, i))
            return false;
    }
    return true;
}

/* Slots whose middle lies within half a cell of the box; a box with more cells than the grid has slots walks those. */
bool box_grid_search(const box_grid *g, int32_t grid, box3 box, box_grid_meet meet, void *user)
{
    const int32_array *member = &g->member[grid];
    if (member->count == 0)
        return true;
    double cell = cell_width(grid), half = 0.5 * cell;
    int64_t left = cell_of(box.lo.x - half, cell), right = cell_of(box.hi.x + half, cell);
    int64_t low = cell_of(box.lo.y - half, cell), high = cell_of(box.hi.y + half, cell);
    double cells = (double)(right - left + 1) * (double)(high - low + 1);
    if (cells > member->count) {
        for (int32_t i = 0; i < member->count; i++)
            if (!meet(user, member->data[i]))
                return false;
        return true;
    }
    for (int64_t row = low; row <= high; row++)
        for (int64_t column = left; column <= right; column++)
            if (!search_cell(g, (grid_place){.column = column, .row = row, .grid = grid}, meet, user))
                return false;
    return true;
}
