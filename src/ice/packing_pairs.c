/* Pairs of pieces that come near: a grid of cells, rebuilt only when something may have moved out of its margin. */
#include "ice/packing_work.h"

#include <string.h>

/* Margin of the search, in mean floe sizes: pairs last while nothing moves by half of it. */
static const double MARGIN = 0.25;
/* Width of a cell in mean floe sizes. */
static const double PAIR_CELL = 1.6;
/* More cells than this per item would be mostly empty. */
enum { CELLS_PER_ITEM = 4, MOST_PAIR_CELLS = 1 << 26 };

/* Turning is not watched: a piece that turns without moving comes out of its margin late at worst, and the next search
   finds it. */
static bool moved_too_far(const pack_work *w)
{
    double most = 0.5 * MARGIN * w->layout.mean_size;
    for (int32_t i = 0; i < w->layout.movable; i++) {
        vec2 d = vec2_sub(w->layout.bodies.data[i].centre, w->search.pair_centre.data[i]);
        if (vec2_dot(d, d) > most * most)
            return true;
    }
    return false;
}

/* Centres back into the domain where it is periodic. */
static void wrap_centres(pack_work *w)
{
    vec2 lo = w->request->domain.lo;
    for (int32_t i = 0; i < w->layout.movable; i++) {
        vec2 *c = &w->layout.bodies.data[i].centre;
        if (w->period.x > 0)
            c->x -= w->period.x * floor((c->x - lo.x) / w->period.x);
        if (w->period.y > 0)
            c->y -= w->period.y * floor((c->y - lo.y) / w->period.y);
    }
}

vec2 pack_image_shift(const pack_work *w, vec2 from, vec2 to)
{
    vec2 shift = {0, 0};
    if (w->period.x > 0)
        shift.x = -w->period.x * floor((to.x - from.x) / w->period.x + 0.5);
    if (w->period.y > 0)
        shift.y = -w->period.y * floor((to.y - from.y) / w->period.y + 0.5);
    return shift;
}

static bool push_item(pack_work *w, int32_t piece, box2 box, int sx, int sy)
{
    double x = sx * w->period.x, y = sy * w->period.y;
    pack_item item = {{{box.lo.x + x, box.lo.y + y}, {box.hi.x + x, box.hi.y + y}}, piece, (int8_t)sx, (int8_t)sy};
    return array_push(w->ctx, &w->search.items, item);
}

/* Every piece with its margin, and its images where a neighbour across the edge could touch them. */
static bool list_items(pack_work *w, double margin, double reach)
{
    box2 d = w->request->domain;
    array_clear(&w->search.items);
    for (int32_t p = 0; p < w->layout.pieces.count; p++) {
        box2 b = w->layout.pieces.data[p].box;
        b = (box2){{b.lo.x - margin, b.lo.y - margin}, {b.hi.x + margin, b.hi.y + margin}};
        int x0 = w->period.x > 0 && b.hi.x > d.hi.x - reach ? -1 : 0, x1 = w->period.x > 0 && b.lo.x < d.lo.x + reach;
        int y0 = w->period.y > 0 && b.hi.y > d.hi.y - reach ? -1 : 0, y1 = w->period.y > 0 && b.lo.y < d.lo.y + reach;
        for (int sy = y0; sy <= y1; sy++)
            for (int sx = x0; sx <= x1; sx++)
                if (!push_item(w, p, b, sx, sy))
                    return false;
    }
    return true;
}

static int32_t grid_index(double x, double origin, double width, int32_t n)
{
    double i = floor((x - origin) / width);
    return i < 0 ? 0 : i >= n ? n - 1 : (int32_t)i;
}

void pack_grid_range(const pack_grid *g, box2 box, int32_t lo[2], int32_t hi[2])
{
    lo[0] = grid_index(box.lo.x, g->origin.x, g->width, g->nx);
    lo[1] = grid_index(box.lo.y, g->origin.y, g->width, g->ny);
    hi[0] = grid_index(box.hi.x, g->origin.x, g->width, g->nx);
    hi[1] = grid_index(box.hi.y, g->origin.y, g->width, g->ny);
}

static pack_grid make_grid(const pack_work *w)
{
    box2 all = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int32_t i = 0; i < w->search.items.count; i++) {
        box2 b = w->search.items.data[i].box;
        all.lo = (vec2){fmin(all.lo.x, b.lo.x), fmin(all.lo.y, b.lo.y)};
        all.hi = (vec2){fmax(all.hi.x, b.hi.x), fmax(all.hi.y, b.hi.y)};
    }
    pack_grid g = {.origin = all.lo, .width = PAIR_CELL * w->layout.mean_size};
    double wide = all.hi.x - all.lo.x, high = all.hi.y - all.lo.y;
    double most = fmin((double)CELLS_PER_ITEM * w->search.items.count + 16, MOST_PAIR_CELLS);
    while ((floor(wide / g.width) + 1) * (floor(high / g.width) + 1) > most)
        g.width *= 1.25;
    g.nx = (int32_t)floor(wide / g.width) + 1;
    g.ny = (int32_t)floor(high / g.width) + 1;
    return g;
}

/* Items by cell, in the order of the items; false: no memory. */
static bool fill_cells(pack_work *w, const pack_grid *g)
{
    int32_t cells = g->nx * g->ny;
    if (!array_resize(w->ctx, &w->search.cell_start, cells + 1))
        return false;
    int32_t *start = w->search.cell_start.data;
    memset(start, 0, ((size_t)cells + 1) * sizeof *start);
    for (int pass = 0; pass < 2; pass++) {
        for (int32_t k = w->search.items.count - 1; k >= 0; k--) {
            int32_t lo[2], hi[2];
            pack_grid_range(g, w->search.items.data[k].box, lo, hi);
            for (int32_t y = lo[1]; y <= hi[1]; y++)
                for (int32_t x = lo[0]; x <= hi[0]; x++) {
                    if (pass == 0)
                        start[y * g->nx + x]++;
                    else
                        w->search.cell_item.data[--start[y * g->nx + x]] = k;
                }
        }
        if (pass == 1)
            break;
        for (int32_t c = 1; c <= cells; c++)
            start[c] += start[c - 1];
        if (!array_resize(w->ctx, &w->search.cell_item, start[cells]))
            return false;
    }
    return true;
}

/* Pair of two items, once: in the cell of the lower corner of what their boxes share, and of a pair and its images only
   the one whose first piece is no image. */
static bool try_pair(pack_work *w, const pack_grid *g, int32_t cell, const pack_item *p, const pack_item *q)
{
    const pack_item *a = p->piece < q->piece ? p : q, *b = a == p ? q : p;
    int32_t body_a = w->layout.pieces.data[a->piece].body, body_b = w->layout.pieces.data[b->piece].body;
    if (a->shift_x != 0 || a->shift_y != 0 || body_a == body_b || body_a >= w->layout.movable)
        return true;
    if (a->box.hi.x < b->box.lo.x || b->box.hi.x < a->box.lo.x || a->box.hi.y < b->box.lo.y ||
        b->box.hi.y < a->box.lo.y)
        return true;
    int32_t x = grid_index(fmax(a->box.lo.x, b->box.lo.x), g->origin.x, g->width, g->nx);
    int32_t y = grid_index(fmax(a->box.lo.y, b->box.lo.y), g->origin.y, g->width, g->ny);
    if (y * g->nx + x != cell)
        return true;
    pack_pair pair = {a->piece, b->piece, b->shift_x, b->shift_y, -1};
    return array_push(w->ctx, &w->search.pairs, pair);
}

bool pack_find_pairs(pack_work *w, bool force)
{
    if (!force && !moved_too_far(w))
        return true;
    wrap_centres(w);
    pack_place(&w->layout);
    w->search.reach = MARGIN * w->layout.mean_size;
    double largest = 0;
    for (int32_t i = 0; i < w->layout.movable; i++)
        largest = fmax(largest, w->layout.bodies.data[i].radius);
    if (!list_items(w, 0.5 * w->search.reach + w->gap, largest * w->layout.scale + w->search.reach + 2 * w->gap))
        return false;
    array_clear(&w->search.pairs);
    for (int32_t i = 0; i < w->layout.bodies.count; i++)
        w->search.pair_centre.data[i] = w->layout.bodies.data[i].centre;
    if (w->search.items.count == 0)
        return true;
    w->search.grid = make_grid(w);
    if (!fill_cells(w, &w->search.grid))
        return false;
    const int32_t *start = w->search.cell_start.data, *item = w->search.cell_item.data;
    for (int32_t c = 0; c < w->search.grid.nx * w->search.grid.ny; c++)
        for (int32_t i = start[c]; i < start[c + 1]; i++)
            for (int32_t k = i + 1; k < start[c + 1]; k++)
                if (!try_pair(w, &w->search.grid, c, &w->search.items.data[item[i]], &w->search.items.data[item[k]]))
                    return false;
    return true;
}
