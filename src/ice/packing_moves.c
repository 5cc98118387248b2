/* Moves of squeezed floes into open water: where the field is tight in one place and loose in another, carrying a small
   floe across is faster than pushing everything between. */
#include "ice/packing_work.h"

#include "base/random.h"
#include "base/transcendental.h"
#include <stdlib.h>
#include <string.h>

/* Cells of the water map per smallest floe size, which counts as no less than this part of the mean size. */
static const double CELLS = 4, LEAST_SIZE = 0.3;
enum { MOST_MAP_CELLS = 16000000 };
/* Chamfer distances (Borgefors 1986): 3 to the next cell, 4 across the corner. */
enum { CHAMFER_NEXT = 3, CHAMFER_CORNER = 4, CHAMFER_FAR = 1 << 24 };
/* The narrowest water of interest, radius in smallest floe sizes. */
static const double NARROWEST = 0.25;
/* A floe is squeezed when it overlaps by more than this part of its size. */
static const double SQUEEZED = 0.01;
/* A floe is tried where half its size over the radius of the water is within this range ... */
static const double LEAST_FILL = 0.7, MOST_FILL = 1.6;
/* ... and carried there when its overlap shrinks to less than this part. */
static const double GAIN = 0.7;
/* Floes tried per place. */
enum { TRIES = 4 };

typedef struct water_map {
    vec2 origin;
    double width;
    int32_t nx, ny;
    bool periodic_x, periodic_y;
    int32_t *clear; /* chamfer distance to the nearest ice or wall */
} water_map;

/* Index of a cell, -1 outside. */
static int64_t cell_of(const water_map *m, int32_t x, int32_t y)
{
    if (m->periodic_x)
        x = x < 0 ? x + m->nx : x >= m->nx ? x - m->nx : x;
    if (m->periodic_y)
        y = y < 0 ? y + m->ny : y >= m->ny ? y - m->ny : y;
    return x < 0 || y < 0 || x >= m->nx || y >= m->ny ? -1 : (int64_t)y * m->nx + x;
}

static int32_t clear_at(const water_map *m, int32_t x, int32_t y)
{
    int64_t i = cell_of(m, x, y);
    return i < 0 ? 0 : m->clear[i];
}

/* Cells whose centre is inside a convex piece have no open water. */
static void mark_piece(const pack_layout *l, const pack_piece *p, water_map *m)
{
    const vec2 *v = l->vertex.data + p->first;
    int32_t y0 = (int32_t)ceil((p->box.lo.y - m->origin.y) / m->width - 0.5);
    int32_t y1 = (int32_t)floor((p->box.hi.y - m->origin.y) / m->width - 0.5);
    for (int32_t y = y0; y <= y1; y++) {
        double at = m->origin.y + (y + 0.5) * m->width, lo = HUGE_VAL, hi = -HUGE_VAL;
        for (int32_t i = 0; i < p->count; i++) {
            vec2 a = v[i], b = v[i + 1 < p->count ? i + 1 : 0];
            if ((a.y <= at) == (b.y <= at))
                continue;
            double x = a.x + (b.x - a.x) * (at - a.y) / (b.y - a.y);
            lo = x < lo ? x : lo;
            hi = x > hi ? x : hi;
        }
        if (!(lo <= hi))
            continue;
        int32_t x0 = (int32_t)ceil((lo - m->origin.x) / m->width - 0.5);
        int32_t x1 = (int32_t)floor((hi - m->origin.x) / m->width - 0.5);
        for (int32_t x = x0; x <= x1; x++) {
            int64_t cell = cell_of(m, x, y);
            if (cell >= 0)
                m->clear[cell] = 0;
        }
    }
}

/* Distances by two passes there and back; the ones that wrap around need the second. */
static void spread(water_map *m)
{
    static const int32_t dx[4] = {-1, -1, 0, 1}, dy[4] = {0, -1, -1, -1};
    static const int32_t way[4] = {CHAMFER_NEXT, CHAMFER_CORNER, CHAMFER_NEXT, CHAMFER_CORNER};
    int passes = m->periodic_x || m->periodic_y ? 4 : 2;
    for (int pass = 0; pass < passes; pass++) {
        int32_t sign = pass % 2 ? -1 : 1;
        for (int32_t k = 0; k < m->ny; k++)
            for (int32_t i = 0; i < m->nx; i++) {
                int32_t y = sign > 0 ? k : m->ny - 1 - k, x = sign > 0 ? i : m->nx - 1 - i;
                int32_t *c = &m->clear[(int64_t)y * m->nx + x];
                for (int n = 0; n < 4 && *c > 0; n++) {
                    int32_t d = clear_at(m, x + sign * dx[n], y + sign * dy[n]) + way[n];
                    *c = d < *c ? d : *c;
                }
            }
    }
}

static bool map_make(pack_work *w, water_map *m)
{
    box2 d = w->request->domain;
    double wide = d.hi.x - d.lo.x, high = d.hi.y - d.lo.y;
    double least = fmax(w->layout.least_size, LEAST_SIZE * w->layout.mean_size);
    *m = (water_map){.origin = d.lo, .periodic_x = w->period.x > 0, .periodic_y = w->period.y > 0};
    m->width = fmax(least / CELLS, sqrt(wide * high / MOST_MAP_CELLS));
    m->nx = (int32_t)fmax(1, wide / m->width);
    m->ny = (int32_t)fmax(1, high / m->width);
    int64_t cells = (int64_t)m->nx * m->ny;
    m->clear = memory_array(w->ctx, (size_t)cells, sizeof *m->clear);
    if (!m->clear)
        return false;
    for (int64_t i = 0; i < cells; i++)
        m->clear[i] = CHAMFER_FAR;
    for (int32_t p = 0; p < w->layout.pieces.count; p++)
        mark_piece(&w->layout, &w->layout.pieces.data[p], m);
    spread(m);
    return true;
}

/* A place in open water that is at least as far from ice as the places around it. */
typedef struct hole {
    int32_t clear, x, y;
    uint32_t lot; /* decides between equals, so that no corner of the field is preferred */
} hole;
typedef ARRAY(hole) hole_array;

static int wider_first(const void *a, const void *b)
{
    const hole *p = a, *q = b;
    if (p->clear != q->clear)
        return p->clear > q->clear ? -1 : 1;
    if (p->lot != q->lot)
        return p->lot < q->lot ? -1 : 1;
    if (p->y != q->y)
        return p->y < q->y ? -1 : 1;
    return (p->x > q->x) - (p->x < q->x);
}

/* Of equally clear neighbours the first one counts. */
static bool is_widest(const water_map *m, int32_t x, int32_t y, int32_t clear)
{
    for (int k = 0; k < 9; k++) {
        int32_t other = k == 4 ? -1 : clear_at(m, x + k % 3 - 1, y + k / 3 - 1);
        if (other > clear || (k < 4 && other == clear))
            return false;
    }
    return true;
}

static bool find_holes(pack_work *w, const water_map *m, hole_array *holes)
{
    double least = fmax(w->layout.least_size, LEAST_SIZE * w->layout.mean_size);
    int32_t need = (int32_t)(NARROWEST * CHAMFER_NEXT * least / m->width);
    for (int32_t y = 0; y < m->ny; y++)
        for (int32_t x = 0; x < m->nx; x++) {
            int32_t clear = m->clear[(int64_t)y * m->nx + x];
            if (clear < need || clear == 0 || clear >= CHAMFER_FAR || !is_widest(m, x, y, clear))
                continue;
            random_stream r = random_begin(w->seed, PACK_STREAM_HOLE, (uint32_t)(y * m->nx + x));
            r.counter = (uint64_t)w->round;
            if (!array_push(w->ctx, holes, (hole){clear, x, y, (uint32_t)random_bits(&r)}))
                return false;
        }
    if (holes->count > 0)
        qsort(holes->data, (size_t)holes->count, sizeof *holes->data, wider_first);
    return true;
}

typedef struct squeezed {
    double part; /* overlap over size; 0: moved */
    int32_t body;
} squeezed;
typedef ARRAY(squeezed) squeezed_array;

static int worst_first(const void *a, const void *b)
{
    const squeezed *p = a, *q = b;
    if (p->part != q->part)
        return p->part > q->part ? -1 : 1;
    return (p->body > q->body) - (p->body < q->body);
}

/* The smaller floe of every pair that overlaps by more than a part of its size, once. */
static bool list_hooked(pack_work *w, double least, squeezed_array *list)
{
    for (int32_t i = 0; i < w->contacts.rows.count; i++) {
        const pack_row *r = &w->contacts.rows.data[i];
        bool other = r->b >= 0 && r->b < w->layout.movable &&
                     w->layout.bodies.data[r->b].size < w->layout.bodies.data[r->a].size;
        int32_t body = other ? r->b : r->a;
        double part = -(r->gap + w->gap) / w->layout.bodies.data[body].size;
        if (!(part > least) || w->contacts.squeeze.data[body] == 0)
            continue;
        w->contacts.squeeze.data[body] = 0; /* listed; nothing asks for it before the next round */
        if (!array_push(w->ctx, list, (squeezed){part, body}))
            return false;
    }
    return true;
}

static bool list_squeezed(pack_work *w, squeezed_array *list)
{
    for (int32_t i = 0; i < w->layout.movable; i++) {
        double part = w->contacts.squeeze.data[i] / w->layout.bodies.data[i].size;
        if (part > SQUEEZED && !array_push(w->ctx, list, (squeezed){part, i}))
            return false;
    }
    return true;
}

static bool find_squeezed(pack_work *w, double hooked, squeezed_array *list)
{
    if (!(hooked > 0 ? list_hooked(w, hooked, list) : list_squeezed(w, list)))
        return false;
    if (list->count > 0)
        qsort(list->data, (size_t)list->count, sizeof *list->data, worst_first);
    return true;
}

/* Tries a body at a place at several angles; it stays there if it overlaps less than `bound`. */
static bool try_place(pack_work *w, int32_t body, vec2 at, double bound, const int32_array *carried)
{
    pack_body *b = &w->layout.bodies.data[body], old = *b;
    random_stream r = random_begin(w->seed, PACK_STREAM_MOVE, (uint32_t)body);
    r.counter = (uint64_t)w->round;
    b->centre = at;
    bool better = pack_turn_best(w, body, 2 * PI * random_unit(&r), bound, carried) < bound;
    if (!better) {
        *b = old;
        pack_place_body(&w->layout, body);
    }
    return better;
}

/* Each hole gets the worst squeezed floe that does better there. */
static bool fill_holes(pack_work *w, const water_map *m, const hole_array *holes, squeezed_array *list, bool hooked,
                       int32_array *carried)
{
    for (int32_t h = 0; h < holes->count; h++) {
        const hole *at = &holes->data[h];
        vec2 centre = {m->origin.x + (at->x + 0.5) * m->width, m->origin.y + (at->y + 0.5) * m->width};
        double room = at->clear * m->width / CHAMFER_NEXT;
        int tried = 0;
        for (int32_t k = 0; k < list->count && tried < TRIES; k++) {
            squeezed *s = &list->data[k];
            double half = 0.5 * w->layout.bodies.data[s->body].size * w->layout.scale;
            if (s->part == 0 || (!hooked && (half > MOST_FILL * room || half < LEAST_FILL * room)))
                continue;
            tried++;
            double bound = hooked ? HUGE_VAL : GAIN * w->contacts.squeeze.data[s->body];
            if (!try_place(w, s->body, centre, bound, carried))
                continue;
            s->part = 0;
            if (!array_push(w->ctx, carried, s->body))
                return false;
            break;
        }
    }
    return true;
}

/* Floes that are still squeezed swap places with others. */
static bool swap_others(pack_work *w, const squeezed_array *list, int32_array *carried)
{
    bool good = true;
    for (int32_t k = 0; good && k < list->count; k++) {
        int32_t body = list->data[k].body;
        if (list->data[k].part > 0 && w->contacts.squeeze.data[body] > SQUEEZED * w->layout.bodies.data[body].size)
            good = pack_swap_squeezed(w, body, carried);
    }
    return good;
}

bool pack_move_squeezed(pack_work *w, double hooked, int32_t *moves)
{
    water_map map = {0};
    hole_array holes = {0};
    squeezed_array list = {0};
    int32_array carried = {0};
    bool good = pack_find_pairs(w, true) && pack_find_rows(w) && find_squeezed(w, hooked, &list);
    if (good && list.count > 0) {
        good = map_make(w, &map) && find_holes(w, &map, &holes);
        good = good && fill_holes(w, &map, &holes, &list, hooked > 0, &carried);
        good = good && (!w->layout.concave || hooked > 0 || swap_others(w, &list, &carried));
        *moves += carried.count;
    }
    memory_free(w->ctx, map.clear);
    array_free(w->ctx, &holes);
    array_free(w->ctx, &list);
    array_free(w->ctx, &carried);
    return good && pack_find_pairs(w, true);
}
