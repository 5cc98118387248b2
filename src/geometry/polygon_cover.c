/* Covers of polygons with fewer vertices; see polygon.h. */
#include "geometry/polygon.h"

/* A corner that grows out of an edge lies no farther from it than this part of its length: no spikes. */
static const double LONGEST_SPIKE = 1;

/* A vertex of the shrinking ring, and what it costs to do without it. */
typedef struct cover_vertex {
    vec2 at;
    int32_t before, after; /* in the ring */
    bool gone, bay;        /* bay: the vertex goes; otherwise it and the next become `corner` */
    double cost;           /* added area [m2]; infinite: cannot be done */
    vec2 corner;
} cover_vertex;

typedef struct cover_ring {
    cover_vertex *v;
    int32_t count, left, some; /* some: one that is left */
} cover_ring;

static double twice_area(vec2 a, vec2 b, vec2 c) { return vec2_cross(vec2_sub(b, a), vec2_sub(c, a)); }

/* Proper or touching, but for common ends. */
static bool segments_meet(vec2 a, vec2 b, vec2 c, vec2 d)
{
    double e = twice_area(a, b, c), f = twice_area(a, b, d), g = twice_area(c, d, a), h = twice_area(c, d, b);
    return ((e >= 0) != (f >= 0) || e == 0 || f == 0) && ((g >= 0) != (h >= 0) || g == 0 || h == 0);
}

/* Where the line from a through b meets that from d through c, beyond b and c; false: nowhere near. */
static bool outer_corner(vec2 a, vec2 b, vec2 c, vec2 d, vec2 *corner)
{
    vec2 u = vec2_sub(b, a), w = vec2_sub(c, d), way = vec2_sub(c, b);
    double turn = vec2_cross(u, w), most = LONGEST_SPIKE * vec2_length(way);
    if (!(turn < 0))
        return false;
    double t = vec2_cross(way, w) / turn;
    *corner = vec2_add(b, vec2_scale(u, t));
    return t > 0 && vec2_length(vec2_sub(*corner, b)) <= most && vec2_length(vec2_sub(*corner, c)) <= most;
}

static void price(cover_ring *r, int32_t i)
{
    cover_vertex *b = &r->v[i];
    const cover_vertex *a = &r->v[b->before], *c = &r->v[b->after], *d = &r->v[c->after];
    double bend = twice_area(a->at, b->at, c->at);
    b->cost = HUGE_VAL;
    b->bay = bend <= 0;
    if (b->bay)
        b->cost = -0.5 * bend;
    else if (twice_area(b->at, c->at, d->at) > 0 && outer_corner(a->at, b->at, c->at, d->at, &b->corner))
        b->cost = 0.5 * fabs(twice_area(b->at, b->corner, c->at));
}

/* Nothing of the rest of the ring comes into the triangle a, b, c, of which a and c are in the ring, and b may be. */
static bool is_clear(const cover_ring *r, int32_t first, vec2 a, vec2 b, vec2 c, int32_t stop)
{
    bool left = twice_area(a, b, c) > 0;
    for (int32_t i = first; i != stop; i = r->v[i].after) {
        vec2 p = r->v[i].at, q = r->v[r->v[i].after].at;
        bool inside = (twice_area(a, b, p) >= 0) == left && (twice_area(b, c, p) >= 0) == left &&
                      (twice_area(c, a, p) >= 0) == left;
        bool last = r->v[i].after == stop;
        if (inside || (!last && (segments_meet(p, q, a, b) || segments_meet(p, q, b, c))))
            return false;
    }
    return true;
}

/* A bay without its deepest vertex, or a corner for an edge, if the ring stays simple. */
static bool can_do(const cover_ring *r, int32_t i)
{
    const cover_vertex *b = &r->v[i], *c = &r->v[b->after];
    if (b->bay)
        return b->cost == 0 || is_clear(r, c->after, r->v[b->before].at, b->at, c->at, b->before);
    return is_clear(r, r->v[c->after].after, b->at, b->corner, c->at, b->before) &&
           !segments_meet(r->v[r->v[b->before].before].at, r->v[b->before].at, b->corner, c->at);
}

static void leave_out(cover_ring *r, int32_t i)
{
    cover_vertex *b = &r->v[i];
    r->v[b->before].after = b->after;
    r->v[b->after].before = b->before;
    b->gone = true;
    r->some = b->before;
    r->left--;
}

/* Does without vertex i, or moves it to the corner and does without the next; prices around it are new. */
static void simplify_at(cover_ring *r, int32_t i)
{
    cover_vertex *b = &r->v[i];
    int32_t near = b->before;
    if (b->bay) {
        leave_out(r, i);
    } else {
        b->at = b->corner;
        leave_out(r, b->after);
    }
    near = r->v[near].before;
    for (int k = 0; k < 5; k++) {
        price(r, near);
        near = r->v[near].after;
    }
}

static void simplify_ring(cover_ring *r, double budget)
{
    while (r->left > 3) {
        int32_t best = -1;
        for (int32_t i = 0; i < r->count; i++)
            if (!r->v[i].gone && r->v[i].cost <= budget && (best < 0 || r->v[i].cost < r->v[best].cost))
                best = i;
        if (best < 0)
            return;
        if (can_do(r, best)) {
            budget -= r->v[best].cost;
            simplify_at(r, best);
        } else {
            r->v[best].cost = HUGE_VAL; /* until something changes beside it */
        }
    }
}

bool polygon_cover(context *ctx, polygon p, double part, vec2_array *out)
{
    array_clear(out);
    cover_ring r = {.v = memory_array(ctx, (size_t)p.count + 1, sizeof *r.v), .count = p.count, .left = p.count};
    if (!r.v || !array_reserve(ctx, out, p.count)) {
        memory_free(ctx, r.v);
        return false;
    }
    for (int32_t i = 0; i < p.count; i++)
        r.v[i] = (cover_vertex){
            .at = p.vertex[i], .before = i > 0 ? i - 1 : p.count - 1, .after = i + 1 < p.count ? i + 1 : 0};
    for (int32_t i = 0; i < p.count; i++)
        price(&r, i);
    simplify_ring(&r, part * polygon_area(p));
    for (int32_t k = 0, i = r.some; k < r.left; k++, i = r.v[i].after)
        out->data[out->count++] = r.v[i].at;
    memory_free(ctx, r.v);
    return true;
}
