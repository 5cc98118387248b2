/* How a floe fits at a place: how deep it overlaps what is there, and at which angle least. */
#include "ice/packing_work.h"

#include "base/transcendental.h"

/* Angles that are tried. */
enum { TURNS = 8 };

/* Deepest overlap of a piece with what the search grid lists around it. */
static double piece_depth(const pack_work *w, const pack_piece *p)
{
    box2 d = w->request->domain;
    double deepest = 0;
    if (w->period.x == 0)
        deepest = fmax(deepest, fmax(d.lo.x - p->box.lo.x, p->box.hi.x - d.hi.x));
    if (w->period.y == 0)
        deepest = fmax(deepest, fmax(d.lo.y - p->box.lo.y, p->box.hi.y - d.hi.y));
    int32_t lo[2], hi[2];
    pack_grid_range(&w->search.grid, p->box, lo, hi);
    for (int32_t y = lo[1]; y <= hi[1]; y++)
        for (int32_t x = lo[0]; x <= hi[0]; x++) {
            int32_t cell = y * w->search.grid.nx + x;
            for (int32_t k = w->search.cell_start.data[cell]; k < w->search.cell_start.data[cell + 1]; k++) {
                const pack_item *item = &w->search.items.data[w->search.cell_item.data[k]];
                const pack_piece *q = &w->layout.pieces.data[item->piece];
                vec2 shift = {item->shift_x * w->period.x, item->shift_y * w->period.y};
                if (q->body != p->body)
                    deepest = fmax(deepest, pack_depth(&w->layout, p, q, shift, deepest));
            }
        }
    return deepest;
}

/* Deepest overlap of a body with those that were carried since the last search, which the grid lists at their old
   places. */
static double carried_depth(const pack_work *w, int32_t body, const int32_array *carried)
{
    const pack_body *b = &w->layout.bodies.data[body];
    double deepest = 0;
    for (int32_t i = 0; i < carried->count; i++) {
        const pack_body *c = &w->layout.bodies.data[carried->data[i]];
        vec2 shift = pack_image_shift(w, b->centre, c->centre);
        vec2 way = vec2_add(vec2_sub(c->centre, b->centre), shift);
        double reach = (b->radius + c->radius) * w->layout.scale;
        if (vec2_dot(way, way) >= reach * reach)
            continue;
        for (int32_t p = b->piece; p < b->piece + b->piece_count; p++)
            for (int32_t q = c->piece; q < c->piece + c->piece_count; q++)
                deepest = fmax(deepest, pack_depth(&w->layout, &w->layout.pieces.data[p], &w->layout.pieces.data[q],
                                                   shift, deepest));
    }
    return deepest;
}

double pack_turn_best(pack_work *w, int32_t body, double first, double bound, const int32_array *carried)
{
    pack_body *b = &w->layout.bodies.data[body];
    double best = bound;
    vec2 turn = b->turn;
    for (int k = 0; k < TURNS; k++) {
        double angle = first + k * 2 * PI / TURNS;
        b->turn = (vec2){real_cos(angle), real_sin(angle)};
        pack_place_body(&w->layout, body);
        double depth = carried_depth(w, body, carried);
        for (int32_t p = b->piece; p < b->piece + b->piece_count && depth < best; p++)
            depth = fmax(depth, piece_depth(w, &w->layout.pieces.data[p]));
        if (depth < best) {
            best = depth;
            turn = b->turn;
        }
    }
    b->turn = turn;
    pack_place_body(&w->layout, body);
    return best;
}
