/* First places of the packing: by decreasing size, each floe at the clearest of a few random places, so that the field
   is even from the beginning and small floes lie between the large ones. */
#include "ice/packing_work.h"

#include "base/random.h"
#include "base/transcendental.h"
#include <stdlib.h>

enum { CANDIDATES = 20 };
/* After so many floes, some milliseconds, the caller is asked whether to go on. */
enum { BODIES_A_WORD = 256 };
/* Width of a search cell, and the clearance beyond which all places are equally good, in mean floe sizes. */
static const double START_CELL = 1.5, ENOUGH = 3;

/* Radius of the circle that stands for a floe: that of a disc of its area. */
static double disc_radius(const pack_body *b) { return 0.5641895835477563 * b->size; }

typedef struct ranked {
    double size;
    int32_t body;
} ranked;

static int larger_first(const void *a, const void *b)
{
    const ranked *p = a, *q = b;
    if (p->size != q->size)
        return p->size > q->size ? -1 : 1;
    return (p->body > q->body) - (p->body < q->body);
}

/* What lies in or near each cell: chains through `link`, newest first. */
typedef struct places {
    pack_grid grid;
    int32_array head;
    struct {
        int32_t body, next;
    } * link;
    int32_t count, room;
} places;

static bool add_link(context *ctx, places *p, int32_t cell, int32_t body)
{
    if (p->count == p->room) {
        int32_t room = p->room ? p->room + p->room / 2 : 1024;
        void *grown = memory_resize(ctx, p->link, (size_t)room * sizeof *p->link);
        if (!grown)
            return false;
        p->link = grown;
        p->room = room;
    }
    p->link[p->count].body = body;
    p->link[p->count].next = p->head.data[cell];
    p->head.data[cell] = p->count++;
    return true;
}

static int32_t wrapped(int32_t i, int32_t n, bool periodic)
{
    return periodic ? ((i % n) + n) % n : i < 0 || i >= n ? -1 : i;
}

/* Into every cell that the box meets. */
static bool add_to_cells(pack_work *w, places *p, int32_t body, box2 box)
{
    const pack_grid *g = &p->grid;
    int32_t x0 = (int32_t)floor((box.lo.x - g->origin.x) / g->width);
    int32_t x1 = (int32_t)floor((box.hi.x - g->origin.x) / g->width);
    int32_t y0 = (int32_t)floor((box.lo.y - g->origin.y) / g->width);
    int32_t y1 = (int32_t)floor((box.hi.y - g->origin.y) / g->width);
    x1 = x1 - x0 < g->nx ? x1 : x0 + g->nx - 1;
    y1 = y1 - y0 < g->ny ? y1 : y0 + g->ny - 1;
    for (int32_t j = y0; j <= y1; j++)
        for (int32_t i = x0; i <= x1; i++) {
            int32_t x = wrapped(i, g->nx, w->period.x > 0), y = wrapped(j, g->ny, w->period.y > 0);
            if (x >= 0 && y >= 0 && !add_link(w->ctx, p, y * g->nx + x, body))
                return false;
        }
    return true;
}

/* Distance of a point from a convex obstacle, from below; negative inside. */
static double obstacle_distance(const pack_layout *l, const pack_body *b, vec2 at)
{
    const pack_piece *p = &l->pieces.data[b->piece];
    double most = -HUGE_VAL;
    for (int32_t i = p->first; i < p->first + p->count; i++)
        most = fmax(most, vec2_dot(l->local_normal.data[i], vec2_sub(at, l->local.data[i])));
    return most;
}

/* Distance of a point from the nearest wall, disc or obstacle, up to the clearance that is enough. */
static double clearance(const pack_work *w, const places *p, vec2 at)
{
    box2 d = w->request->domain;
    double clear = ENOUGH * w->layout.mean_size;
    if (w->period.x == 0)
        clear = fmin(clear, fmin(at.x - d.lo.x, d.hi.x - at.x));
    if (w->period.y == 0)
        clear = fmin(clear, fmin(at.y - d.lo.y, d.hi.y - at.y));
    int32_t lo[2], hi[2];
    pack_grid_range(&p->grid, (box2){at, at}, lo, hi);
    for (int32_t k = p->head.data[lo[1] * p->grid.nx + lo[0]]; k >= 0; k = p->link[k].next) {
        const pack_body *b = &w->layout.bodies.data[p->link[k].body];
        if (p->link[k].body >= w->layout.movable) {
            clear = fmin(clear, obstacle_distance(&w->layout, b, at));
            continue;
        }
        vec2 way = vec2_sub(b->centre, at);
        if (w->period.x > 0)
            way.x -= w->period.x * floor(way.x / w->period.x + 0.5);
        if (w->period.y > 0)
            way.y -= w->period.y * floor(way.y / w->period.y + 0.5);
        clear = fmin(clear, vec2_length(way) - disc_radius(b));
    }
    return clear;
}

static bool put_body(pack_work *w, places *p, int32_t body)
{
    box2 d = w->request->domain;
    pack_body *b = &w->layout.bodies.data[body];
    random_stream r = random_begin(w->seed, PACK_STREAM_START, (uint32_t)body);
    double angle = 2 * PI * random_unit(&r), best = -HUGE_VAL;
    b->turn = (vec2){real_cos(angle), real_sin(angle)};
    for (int k = 0; k < CANDIDATES; k++) {
        double x = random_uniform(&r, d.lo.x, d.hi.x), y = random_uniform(&r, d.lo.y, d.hi.y);
        vec2 at = {x, y};
        double clear = clearance(w, p, at);
        if (clear > best) {
            best = clear;
            b->centre = at;
        }
    }
    double reach = disc_radius(b) + ENOUGH * w->layout.mean_size;
    box2 box = {{b->centre.x - reach, b->centre.y - reach}, {b->centre.x + reach, b->centre.y + reach}};
    return add_to_cells(w, p, body, box);
}

static bool put_all(pack_work *w, places *p, ranked *order)
{
    double reach = ENOUGH * w->layout.mean_size;
    for (int32_t i = w->layout.movable; i < w->layout.bodies.count; i++) {
        box2 b = w->layout.pieces.data[w->layout.bodies.data[i].piece].box;
        if (!add_to_cells(w, p, i, (box2){{b.lo.x - reach, b.lo.y - reach}, {b.hi.x + reach, b.hi.y + reach}}))
            return false;
    }
    for (int32_t i = 0; i < w->layout.movable; i++)
        order[i] = (ranked){w->layout.bodies.data[i].size, i};
    qsort(order, (size_t)w->layout.movable, sizeof *order, larger_first);
    for (int32_t i = 0; i < w->layout.movable; i++) {
        if (i % BODIES_A_WORD == 0)
            w->status = work_continue(w->ctx, "packing the ice: first places", i, w->layout.movable, w->error);
        if (w->status != FRAM_OK || !put_body(w, p, order[i].body))
            return false;
    }
    return true;
}

bool pack_start(pack_work *w)
{
    box2 d = w->request->domain;
    double wide = d.hi.x - d.lo.x, high = d.hi.y - d.lo.y, width = START_CELL * w->layout.mean_size;
    while ((floor(wide / width) + 1) * (floor(high / width) + 1) > 4.0 * w->layout.bodies.count + 16)
        width *= 1.25;
    places p = {.grid = {.origin = d.lo, .width = width}};
    p.grid.nx = (int32_t)floor(wide / width) + 1;
    p.grid.ny = (int32_t)floor(high / width) + 1;
    pack_place(&w->layout); /* boxes of the obstacles */
    ranked *order = memory_array(w->ctx, (size_t)w->layout.movable + 1, sizeof *order);
    bool good = order && array_resize(w->ctx, &p.head, p.grid.nx * p.grid.ny);
    for (int32_t i = 0; good && i < p.head.count; i++)
        p.head.data[i] = -1;
    good = good && put_all(w, &p, order);
    memory_free(w->ctx, order);
    memory_free(w->ctx, p.link);
    array_free(w->ctx, &p.head);
    return good;
}
