/* Pairs of concave floes that hook into each other: each piece has its own shortest way out of the other floe, and
   where two of these ways are opposite, their pushes cancel and the pair never comes apart.  Such a pair gets one row
   instead of all its own: along the direction in which the whole floe comes free of the other whole floe soonest. */
#include "ice/packing_work.h"

#include "base/transcendental.h"

#include <stdlib.h>
#include <string.h>

/* Overlaps of less than this part of the smaller floe's size and this many times the mean squeeze do not count as a
   hook: as long as all floes are squeezed, none is hooked that is squeezed like the others. */
static const double DEEP = 1e-3, DEEP_SQUEEZE = 2;
/* Ways out are opposite when the cosine between them is less than this. */
static const double OPPOSITE = -0.5;
/* Ways out are sought up to this many times the deepest overlap, and then ever so many times farther. */
static const double FIRST_REACH = 3, NEXT_REACH = 3;
/* Directions that are tried. */
enum { DIRECTIONS = 32 };

/* A deep row, by its pair. */
typedef struct deep_row {
    int32_t a, b; /* a < b */
    vec2 way;     /* of b out of a */
    double depth; /* [m] */
    int32_t row;
} deep_row;
typedef ARRAY(deep_row) deep_row_array;

/* Two bodies that hook into each other. */
typedef struct hooked_pair {
    int32_t a, b; /* a < b */
    double depth; /* of the deepest row [m] */
    bool parted;  /* has a row of its own */
} hooked_pair;
typedef ARRAY(hooked_pair) hooked_pair_array;

/* Of a row whether it is deeper than `least` floe sizes, and what it says of its pair. */
static bool take_deep(const pack_work *w, int32_t i, double least, deep_row *d)
{
    const pack_row *r = &w->contacts.rows.data[i];
    if (r->b < 0 || r->b >= w->layout.movable) /* walls and obstacles are convex, each a body of its own */
        return false;
    double size = fmin(w->layout.bodies.data[r->a].size, w->layout.bodies.data[r->b].size);
    bool ordered = r->a < r->b;
    *d = (deep_row){ordered ? r->a : r->b, ordered ? r->b : r->a,
                    ordered ? r->normal : (vec2){-r->normal.x, -r->normal.y}, -(r->gap + w->gap), i};
    return d->depth > least * size;
}

static int by_pair(const void *p, const void *q)
{
    const deep_row *x = p, *y = q;
    if (x->a != y->a)
        return x->a < y->a ? -1 : 1;
    if (x->b != y->b)
        return x->b < y->b ? -1 : 1;
    return (x->row > y->row) - (x->row < y->row);
}

/* Whether some two of the ways are opposite. */
static bool contradict(const deep_row *d, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        for (int32_t k = i + 1; k < count; k++)
            if (vec2_dot(d[i].way, d[k].way) < OPPOSITE)
                return true;
    return false;
}

/* An edge of a convex piece that another one, which moves, is inside of by `room`; negative: beyond. */
typedef struct edge_room {
    vec2 normal; /* against the motion of b */
    double room;
} edge_room;

/* While b moves along a direction, two pieces overlap between two lengths of the way. */
typedef struct span {
    double from, to;
} span;

/* What is worked out of a pair. */
typedef struct hook_work {
    ARRAY(edge_room) edges; /* of all pairs of pieces that may matter */
    int32_array start;      /* first edge of each, and the end */
    ARRAY(span) spans;
} hook_work;

/* Room inside the edges of p for q, moved by shift; sign: 1 where q moves, -1 where p does.  *near is cleared where q
   is farther away than `most`.  false: no memory. */
static bool add_edges(context *ctx, const pack_layout *l, const pack_piece *p, const pack_piece *q, vec2 shift,
                      double sign, double most, hook_work *h, bool *near)
{
    for (int32_t e = p->first; e < p->first + p->count; e++) {
        vec2 n = l->normal.data[e];
        double offset = vec2_dot(n, vec2_sub(l->vertex.data[e], shift)), least = HUGE_VAL;
        for (int32_t i = q->first; i < q->first + q->count; i++) {
            double d = n.x * l->vertex.data[i].x + n.y * l->vertex.data[i].y;
            least = d < least ? d : least;
        }
        if (least - offset >= most) {
            *near = false;
            return true;
        }
        if (!array_push(ctx, &h->edges, (edge_room){vec2_scale(n, sign), offset - least}))
            return false;
    }
    return true;
}

/* Edges of all pieces of a and of b, moved by shift, that are nearer than `most`; false: no memory. */
static bool find_edges(pack_work *w, const pack_body *a, const pack_body *b, vec2 shift, double most, hook_work *h)
{
    array_clear(&h->edges);
    array_clear(&h->start);
    for (int32_t q = b->piece; q < b->piece + b->piece_count; q++) {
        const pack_piece *y = &w->layout.pieces.data[q];
        for (int32_t p = a->piece; p < a->piece + a->piece_count; p++) {
            const pack_piece *x = &w->layout.pieces.data[p];
            if (pack_boxes_far(x->box, y->box, shift, most))
                continue;
            int32_t first = h->edges.count;
            bool near = true;
            if (!add_edges(w->ctx, &w->layout, x, y, shift, 1, most, h, &near) ||
                (near && !add_edges(w->ctx, &w->layout, y, x, (vec2){-shift.x, -shift.y}, -1, most, h, &near)))
                return false;
            if (!near)
                h->edges.count = first;
            else if (!array_push(w->ctx, &h->start, first))
                return false;
        }
    }
    return array_push(w->ctx, &h->start, h->edges.count) && array_reserve(w->ctx, &h->spans, h->start.count);
}

static int by_start(const void *p, const void *q)
{
    const span *x = p, *y = q;
    return (x->from > y->from) - (x->from < y->from);
}

/* Where on its way along a direction b overlaps a. */
static void find_spans(hook_work *h, vec2 direction)
{
    array_clear(&h->spans);
    for (int32_t i = 0; i + 1 < h->start.count; i++) {
        span s = {0, HUGE_VAL};
        for (int32_t e = h->start.data[i]; e < h->start.data[i + 1] && s.from < s.to; e++) {
            const edge_room *r = &h->edges.data[e];
            double speed = vec2_dot(r->normal, direction);
            if (speed > 0)
                s.to = fmin(s.to, r->room / speed);
            else if (speed < 0)
                s.from = fmax(s.from, r->room / speed);
            else if (r->room <= 0)
                s.to = 0;
        }
        if (s.from < s.to)
            h->spans.data[h->spans.count++] = s;
    }
    if (h->spans.count > 0)
        qsort(h->spans.data, (size_t)h->spans.count, sizeof *h->spans.data, by_start);
}

/* The direction in which b, moved by shift, comes free of a soonest, and after how far: *way is less than `most` then.
   false: no memory. */
static bool find_way_out(pack_work *w, const pack_body *a, const pack_body *b, vec2 shift, double most, hook_work *h,
                         vec2 *direction, double *way)
{
    *way = most;
    if (!find_edges(w, a, b, shift, most, h))
        return false;
    for (int k = 0; k < DIRECTIONS; k++) {
        double angle = 2 * PI * k / DIRECTIONS, free = 0;
        vec2 d = {real_cos(angle), real_sin(angle)};
        find_spans(h, d);
        for (int32_t i = 0; i < h->spans.count && h->spans.data[i].from <= free; i++)
            free = fmax(free, h->spans.data[i].to);
        if (free < *way) {
            *way = free;
            *direction = d;
        }
    }
    return true;
}

/* A row for a pair in place of all that it has; false: no memory. */
static bool part_pair(pack_work *w, hooked_pair *pair, hook_work *h)
{
    const pack_body *a = &w->layout.bodies.data[pair->a], *b = &w->layout.bodies.data[pair->b];
    vec2 direction = {0, 0}, shift = pack_image_shift(w, a->centre, b->centre);
    double way = 0, most = FIRST_REACH * pair->depth, last = (a->radius + b->radius) * w->layout.scale;
    pair->parted = false;
    for (; !pair->parted && most < last; most *= NEXT_REACH) {
        if (!find_way_out(w, a, b, shift, most, h, &direction, &way))
            return false;
        pair->parted = way < most;
    }
    pack_row row = {.a = pair->a, .b = pair->b, .normal = direction, .mass = 1 / (a->weight + b->weight)};
    row.gap = fmax(-way - w->gap, -PACK_MOST_PUSH * w->layout.grain);
    return !pair->parted || array_push(w->ctx, &w->contacts.rows, row);
}

static int by_bodies(const void *p, const void *q)
{
    const hooked_pair *x = p, *y = q;
    return x->a != y->a ? (x->a < y->a ? -1 : 1) : (x->b > y->b) - (x->b < y->b);
}

/* Rows of the pairs that got one of their own take no more push. */
static void drop_rows(pack_contacts *c, int32_t end, const hooked_pair_array *pairs)
{
    for (int32_t i = 0; i < end; i++) {
        pack_row *r = &c->rows.data[i];
        if (r->b < 0 || c->steps.data[r->a].x == 0 || c->steps.data[r->b].x == 0)
            continue;
        hooked_pair key = {.a = r->a < r->b ? r->a : r->b, .b = r->a < r->b ? r->b : r->a};
        const hooked_pair *found = bsearch(&key, pairs->data, (size_t)pairs->count, sizeof *pairs->data, by_bodies);
        if (found && found->parted)
            r->mass = 0;
    }
}

static bool find_deep(pack_work *w, deep_row_array *deep)
{
    double least = DEEP + DEEP_SQUEEZE * pack_mean_squeeze(&w->layout, &w->contacts);
    deep_row d;
    for (int32_t i = 0; i < w->contacts.rows.count; i++)
        if (take_deep(w, i, least, &d) && !array_push(w->ctx, deep, d))
            return false;
    if (deep->count > 0)
        qsort(deep->data, (size_t)deep->count, sizeof *deep->data, by_pair);
    return true;
}

/* Pairs of which some two rows contradict each other; false: no memory. */
static bool find_hooked(pack_work *w, hooked_pair_array *pairs)
{
    deep_row_array deep = {0};
    bool good = find_deep(w, &deep);
    for (int32_t i = 0, end; good && i < deep.count; i = end) {
        const deep_row *d = &deep.data[i];
        double depth = 0;
        for (end = i; end < deep.count && deep.data[end].a == d->a && deep.data[end].b == d->b; end++)
            depth = fmax(depth, deep.data[end].depth);
        if (contradict(d, end - i))
            good = array_push(w->ctx, pairs, (hooked_pair){d->a, d->b, depth, false});
    }
    array_free(w->ctx, &deep);
    return good;
}

bool pack_part_hooked(pack_work *w)
{
    hooked_pair_array pairs = {0};
    hook_work h = {0};
    int32_t end = w->contacts.rows.count;
    bool good = find_hooked(w, &pairs);
    if (good && pairs.count > 0)
        memset(w->contacts.steps.data, 0, (size_t)w->layout.bodies.count * sizeof *w->contacts.steps.data);
    for (int32_t i = 0; good && i < pairs.count; i++) {
        hooked_pair *pair = &pairs.data[i];
        good = part_pair(w, pair, &h);
        w->contacts.steps.data[pair->a].x = w->contacts.steps.data[pair->b].x = 1;
    }
    if (good && pairs.count > 0)
        drop_rows(&w->contacts, end, &pairs);
    array_free(w->ctx, &pairs);
    array_free(w->ctx, &h.edges);
    array_free(w->ctx, &h.start);
    array_free(w->ctx, &h.spans);
    return good;
}
