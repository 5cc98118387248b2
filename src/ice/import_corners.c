/* A ring that touches itself at common corners alone, as the outline of a raster's cells does where two of them meet at
   a corner: cut there, exactly and in the time of a sort, where GEOS takes the square of it.

   Where a ring crosses itself nowhere the plane falls into parts that it winds round once and others that it does not.
   About each corner they take turns, and with them the edges that come and those that go.  So edge after edge about a
   part of the first kind is its outline, with holes that touch it: cut off where a corner comes again. */
#include "ice/import_parts.h"

#include "geometry/box_pairs.h"
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"

#include <stdlib.h>
#include <string.h>

/* An edge as it is seen from a corner that it leaves or comes to. */
typedef struct corner_arm {
    vec2 corner, end;
    int32_t edge; /* from vertex i to the next */
    bool leaves;
} corner_arm;
typedef ARRAY(corner_arm) corner_arm_array;

typedef struct corner_cut {
    context *ctx;
    vec2_array vertex;  /* of the ring, counter-clockwise */
    int32_array place;  /* of each vertex: the same for equal ones */
    int32_array visits; /* of each place */
    int32_array next;   /* of each edge: the one that follows it about the same part; -1: walked */
    int32_array depth;  /* of each place: where in the walk it was left; -1: it was not */
    int32_array walk;   /* edges */
    vec2_array ring;    /* scratch */
    polygon_list found; /* outlines, in normal form */
    int32_array inner;  /* of each: 1 where it lies in another one */
    bool holes;         /* some were left out */
    bool fits;          /* the ring is such a one */
} corner_cut;

/* ---- which edge follows which ---- */

/* Half a turn from the direction of x on, or the other half. */
static bool is_behind(const corner_arm *a)
{
    return a->end.y < a->corner.y || (a->end.y == a->corner.y && a->end.x < a->corner.x);
}

/* Counter-clockwise about their corner; 0: one lies on the other. */
static int by_direction(const void *a, const void *b)
{
    const corner_arm *p = a, *q = b;
    int behind = is_behind(p) - is_behind(q);
    return behind != 0 ? behind : -orientation(p->corner, p->end, q->end);
}

/* Those of one corner, sorted: what comes in has the part on its left, and goes on with what bounds that as well. */
static void join_arms(corner_cut *c, const corner_arm *arm, int32_t count)
{
    for (int32_t i = 0; i < count && c->fits; i++) {
        const corner_arm *before = &arm[i > 0 ? i - 1 : count - 1];
        c->fits = before->leaves != arm[i].leaves && by_direction(before, &arm[i]) != 0;
        if (!arm[i].leaves)
            c->next.data[arm[i].edge] = before->edge;
    }
}

static int32_t corner_before(const corner_cut *c, int32_t i) { return i > 0 ? i - 1 : c->vertex.count - 1; }
static int32_t corner_after(const corner_cut *c, int32_t i) { return i + 1 < c->vertex.count ? i + 1 : 0; }

static int32_t arms_at(const corner_cut *c, int32_t place)
{
    return c->visits.data[place] > 1 ? 2 * c->visits.data[place] : 0;
}

/* The two edges of every vertex whose place is visited more than once, one place after the other. */
static bool list_arms(corner_cut *c, int32_array *first, corner_arm_array *arms)
{
    int32_t places = c->visits.count, n = c->vertex.count;
    if (!array_resize(c->ctx, first, places + 1))
        return false;
    first->data[0] = 0;
    for (int32_t i = 0; i < places; i++)
        first->data[i + 1] = first->data[i] + arms_at(c, i);
    if (!array_resize(c->ctx, arms, first->data[places]))
        return false;
    for (int32_t i = 0; i < n; i++) {
        int32_t place = c->place.data[i], before = corner_before(c, i);
        if (arms_at(c, place) == 0)
            continue;
        const vec2 *v = c->vertex.data;
        corner_arm *arm = &arms->data[first->data[place]];
        arm[0] = (corner_arm){v[i], v[before], before, false};
        arm[1] = (corner_arm){v[i], v[corner_after(c, i)], i, true};
        first->data[place] += 2;
    }
    return true;
}

static bool join_edges(corner_cut *c)
{
    int32_array end = {0};
    corner_arm_array arms = {0};
    bool good = array_resize(c->ctx, &c->next, c->vertex.count) && list_arms(c, &end, &arms);
    for (int32_t i = 0; good && i < c->vertex.count; i++)
        c->next.data[i] = corner_after(c, i);
    for (int32_t i = 0; good && c->fits && i < c->visits.count; i++) {
        int32_t count = arms_at(c, i);
        if (count == 0)
            continue;
        corner_arm *arm = &arms.data[end.data[i] - count];
        qsort(arm, (size_t)count, sizeof *arm, by_direction);
        join_arms(c, arm, count);
    }
    array_free(c->ctx, &end);
    array_free(c->ctx, &arms);
    return good;
}

/* ---- outlines ---- */

/* As overlays leave out what is thinner than rounding. */
static bool is_thin(polygon p) { return polygon_area(p) <= polygon_rounding(p) * polygon_perimeter(p); }

/* The end of the walk, from `first` on, which is a simple ring: an outline, or a hole in one, which is filled. */
static bool take_ring(corner_cut *c, int32_t first, int *outlines)
{
    int32_t count = c->walk.count - first;
    if (!array_resize(c->ctx, &c->ring, count))
        return false;
    for (int32_t i = 0; i < count; i++) {
        int32_t k = c->walk.data[first + i];
        c->ring.data[i] = c->vertex.data[k];
        c->depth.data[c->place.data[k]] = -1;
    }
    c->walk.count = first;
    bool outline = polygon_orientation((polygon){c->ring.data, count}) > 0;
    *outlines += outline;
    c->holes = c->holes || !outline;
    polygon p = {c->ring.data, outline ? ring_normal_form(c->ring.data, count) : 0};
    return !outline || is_thin(p) || polygon_list_push(c->ctx, &c->found, p);
}

/* About one part: one outline, unless what is walked about is what the ring does not wind round. */
static bool walk_from(corner_cut *c, int32_t start)
{
    int outlines = 0;
    int32_t edge = start;
    bool good = true;
    do {
        int32_t *depth = &c->depth.data[c->place.data[edge]], then = c->next.data[edge];
        if (*depth >= 0)
            good = take_ring(c, *depth, &outlines);
        *depth = c->walk.count;
        good = good && array_push(c->ctx, &c->walk, edge);
        c->next.data[edge] = -1;
        edge = then;
    } while (good && edge != start);
    good = good && take_ring(c, 0, &outlines);
    c->fits = c->fits && outlines == 1;
    return good;
}

static bool walk_all(corner_cut *c)
{
    bool good = array_resize(c->ctx, &c->depth, c->visits.count);
    for (int32_t i = 0; good && i < c->visits.count; i++)
        c->depth.data[i] = -1;
    for (int32_t i = 0; good && c->fits && i < c->vertex.count; i++)
        if (c->next.data[i] >= 0)
            good = walk_from(c, i);
    return good;
}

/* ---- outlines in filled holes ---- */

/* Outlines touch in common corners alone: an edge of one begins at a corner of the other, or clear of it. */
static bool lies_in(polygon inner, polygon outer)
{
    vec2 v = inner.vertex[0], w = inner.vertex[1];
    for (int32_t i = 0; i < outer.count; i++) {
        vec2 before = outer.vertex[i > 0 ? i - 1 : outer.count - 1], after = outer.vertex[(i + 1) % outer.count];
        if (!vec2_equal(outer.vertex[i], v))
            continue;
        if (orientation(before, v, after) >= 0)
            return orientation(v, after, w) > 0 && orientation(v, w, before) > 0;
        return !(orientation(v, before, w) > 0 && orientation(v, w, after) > 0);
    }
    return polygon_contains(outer, v);
}

static fram_status mark_inner(void *user, int32_t a, int32_t b, fram_error *error)
{
    (void)error;
    corner_cut *c = user;
    polygon p = polygon_list_get(&c->found, a), q = polygon_list_get(&c->found, b);
    if (polygon_area(p) < polygon_area(q))
        c->inner.data[a] |= lies_in(p, q);
    else
        c->inner.data[b] |= lies_in(q, p);
    return FRAM_OK;
}

/* What lies in a hole of another outline that was filled is part of it. */
static fram_status drop_inner(corner_cut *c, fram_error *error)
{
    int32_t count = polygon_list_count(&c->found);
    box2 *box = memory_array(c->ctx, (size_t)count, sizeof *box);
    fram_status status = box && array_resize(c->ctx, &c->inner, count) ? FRAM_OK : error_memory(error);
    for (int32_t i = 0; status == FRAM_OK && i < count; i++) {
        box[i] = polygon_bounds(polygon_list_get(&c->found, i));
        c->inner.data[i] = 0;
    }
    if (status == FRAM_OK)
        status = box_pairs(c->ctx, box, count, "looking at a crossed ring", mark_inner, c, error);
    memory_free(c->ctx, box);
    polygon_list all = c->found;
    c->found = (polygon_list){0};
    for (int32_t i = 0; status == FRAM_OK && i < count; i++)
        if (!c->inner.data[i] && !polygon_list_push(c->ctx, &c->found, polygon_list_get(&all, i)))
            status = error_memory(error);
    polygon_list_free(c->ctx, &all);
    return status;
}

/* ---- the cut ---- */

static bool begin_cut(corner_cut *c, polygon p)
{
    int32_t n = p.count;
    vec2 *at = memory_array(c->ctx, (size_t)n, sizeof *at);
    bool good = at && array_resize(c->ctx, &c->vertex, n) && array_resize(c->ctx, &c->place, n);
    int32_t places = -1;
    if (good) {
        memcpy(c->vertex.data, p.vertex, (size_t)n * sizeof *p.vertex);
        if (polygon_area(p) < 0)
            ring_reverse(c->vertex.data, n);
        places = vertex_places(c->ctx, c->vertex.data, n, at, c->place.data);
    }
    memory_free(c->ctx, at);
    good = places >= 0 && array_resize(c->ctx, &c->visits, places);
    for (int32_t i = 0; good && i < places; i++)
        c->visits.data[i] = 0;
    for (int32_t i = 0; good && i < n; i++)
        c->visits.data[c->place.data[i]]++;
    return good;
}

static void end_cut(corner_cut *c)
{
    array_free(c->ctx, &c->vertex);
    array_free(c->ctx, &c->place);
    array_free(c->ctx, &c->visits);
    array_free(c->ctx, &c->next);
    array_free(c->ctx, &c->depth);
    array_free(c->ctx, &c->walk);
    array_free(c->ctx, &c->ring);
    array_free(c->ctx, &c->inner);
    polygon_list_free(c->ctx, &c->found);
}

fram_status import_cut_at_corners(context *ctx, polygon p, polygon_list *out, bool *cut, fram_error *error)
{
    corner_cut c = {.ctx = ctx, .fits = true};
    bool good = begin_cut(&c, p) && join_edges(&c) && (!c.fits || walk_all(&c));
    fram_status status = good ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK && c.fits && c.holes)
        status = drop_inner(&c, error);
    *cut = status == FRAM_OK && c.fits;
    if (*cut && !polygon_list_append_sorted(ctx, out, &c.found))
        status = error_memory(error);
    end_cut(&c);
    return status;
}
