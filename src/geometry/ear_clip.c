/* Ear clipping (Meisters 1975); see ear_clip.h.

   The ring that is left is a doubly linked list of vertex numbers.  It stays simple and keeps every straight vertex,
   because an ear is cut only when no other vertex touches its closed triangle; then two ears always exist.

   Where the ring touches itself, several vertices are at one place, each with its own wedge of the interior.  Wedges do
   not overlap, so an ear that keeps to the wedges of its three vertices has nothing to fear from their doubles. */
#include "geometry/ear_clip.h"
#include "geometry/predicate.h"
#include "geometry/ring_tree.h"

/* Rings under this many vertices are not worth a tree. */
enum { EAR_TREE_FROM = 32 };

typedef struct ring_node {
    int32_t previous, next;
    bool convex; /* strictly; a vertex that became so stays so */
    bool bars;   /* in the way of others' ears: in the ring, and not convex */
} ring_node;

typedef struct ring {
    const vec2 *vertex;
    ring_node *node;
    int32_t count, left;
    /* Of a ring that has them: the vertices that bar, and how many of them each run has. */
    bool has_tree;
    ring_tree tree;
    uint8_t *barred;
} ring;

static int turn(const ring *r, int32_t i)
{
    return orientation(r->vertex[r->node[i].previous], r->vertex[i], r->vertex[r->node[i].next]);
}

/* Link the vertices of p, runs of equal ones once. */
static void ring_link(ring *r, polygon p)
{
    int32_t last = -1;
    for (int32_t i = 0; i < p.count; i++) {
        if (last >= 0 && vec2_equal(p.vertex[i], p.vertex[last]))
            continue;
        if (last >= 0)
            r->node[last].next = i;
        r->node[i].previous = last;
        last = i;
        r->left++;
    }
    while (r->left > 1 && vec2_equal(p.vertex[last], p.vertex[0])) {
        last = r->node[last].previous;
        r->left--;
    }
    r->node[last].next = 0;
    r->node[0].previous = last;
}

static bool in_triangle(vec2 a, vec2 b, vec2 c, vec2 p)
{
    return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
}

/* The diagonal over the tip i, which is strictly convex, runs inside the wedges of the interior at both its ends. */
static bool diagonal_in_wedges(const ring *r, int32_t i)
{
    const ring_node *node = r->node;
    int32_t before = node[i].previous, after = node[i].next;
    vec2 a = r->vertex[before], c = r->vertex[after];
    return (!node[before].convex || orientation(r->vertex[node[before].previous], a, c) > 0) &&
           (!node[after].convex || orientation(c, r->vertex[node[after].next], a) > 0);
}

/* Vertex k is elsewhere and touches the triangle. */
static bool bars_triangle(const ring *r, int32_t k, const vec2 corner[3], const box2 *box)
{
    vec2 p = r->vertex[k], a = corner[0], b = corner[1], c = corner[2];
    bool near = p.x >= box->lo.x && p.x <= box->hi.x && p.y >= box->lo.y && p.y <= box->hi.y;
    return near && in_triangle(a, b, c, p) && !vec2_equal(p, a) && !vec2_equal(p, b) && !vec2_equal(p, c);
}

/* Any vertex that bars touches the triangle of the tip i elsewhere than at its corners. */
static bool is_barred(const ring *r, int32_t i)
{
    const ring_node *node = r->node;
    const vec2 corner[3] = {r->vertex[node[i].previous], r->vertex[i], r->vertex[node[i].next]};
    const box2 box = polygon_bounds((polygon){corner, 3});
    if (!r->has_tree) {
        for (int32_t k = node[node[i].next].next; k != node[i].previous; k = node[k].next)
            if (node[k].bars && bars_triangle(r, k, corner, &box))
                return true;
        return false;
    }
    for (int32_t run = ring_tree_find(&r->tree, box, 0); run >= 0; run = ring_tree_find(&r->tree, box, run + 1))
        for (int32_t k = run * RING_RUN; k < (run + 1) * RING_RUN && k < r->count; k++)
            if (node[k].bars && bars_triangle(r, k, corner, &box))
                return true;
    return false;
}

/* The tip i is strictly convex, and no vertex elsewhere touches its triangle.  Only vertices that are not strictly
   convex can be the first to do so. */
static bool is_ear(const ring *r, int32_t i)
{
    return r->node[i].convex && diagonal_in_wedges(r, i) && !is_barred(r, i);
}

static void add_triangle(const ring *r, int32_t i, index_array *out)
{
    out->data[out->count++] = r->node[i].previous;
    out->data[out->count++] = i;
    out->data[out->count++] = r->node[i].next;
}

static void judge(ring *r, int32_t i)
{
    ring_node *node = &r->node[i];
    bool barred = node->bars;
    node->convex = turn(r, i) > 0;
    node->bars = !node->convex;
    if (r->has_tree && barred && !node->bars && --r->barred[i / RING_RUN] == 0)
        ring_tree_leave_out(&r->tree, i / RING_RUN);
}

/* The tip is convex, and bars nothing. */
static void ring_cut(ring *r, int32_t i)
{
    int32_t before = r->node[i].previous, after = r->node[i].next;
    r->node[before].next = after;
    r->node[after].previous = before;
    judge(r, before);
    judge(r, after);
    r->left--;
}

/* A long ring has a tree, if there is memory for it. */
static void plant(context *ctx, ring *r)
{
    if (r->left < EAR_TREE_FROM || !ring_tree_init(ctx, &r->tree, r->count))
        return;
    r->barred = memory_array(ctx, (size_t)r->count / RING_RUN + 1, sizeof *r->barred);
    r->has_tree = r->barred != NULL;
    if (!r->has_tree)
        ring_tree_free(ctx, &r->tree);
    for (int32_t i = 0; r->has_tree && i < r->count; i++)
        if (r->node[i].bars) {
            ring_tree_add(&r->tree, i, (box2){r->vertex[i], r->vertex[i]});
            r->barred[i / RING_RUN]++;
        }
    if (r->has_tree)
        ring_tree_close(&r->tree);
}

static void fell(context *ctx, ring *r)
{
    if (r->has_tree)
        ring_tree_free(ctx, &r->tree);
    memory_free(ctx, r->barred);
}

static fram_status ring_clip(ring *r, index_array *out)
{
    int32_t current = 0;
    for (int32_t refused = 0; r->left > 3;) {
        if (refused > r->left)
            return FRAM_ERROR_INPUT;
        int32_t next = r->node[current].next;
        if (is_ear(r, current)) {
            add_triangle(r, current, out);
            ring_cut(r, current);
            refused = 0;
            next = r->node[next].next; /* leaving one out makes rounder triangles than a fan */
        } else {
            refused++;
        }
        current = next;
    }
    if (turn(r, current) <= 0)
        return FRAM_ERROR_INPUT;
    add_triangle(r, current, out);
    return FRAM_OK;
}

fram_status polygon_triangulate_ears(context *ctx, polygon p, index_array *out)
{
    array_clear(out);
    if (p.count < 3)
        return FRAM_ERROR_INPUT;
    if (p.count > INT32_MAX / 3 || !array_reserve(ctx, out, 3 * (p.count - 2)))
        return FRAM_ERROR_MEMORY;
    ring r = {.vertex = p.vertex, .node = memory_array(ctx, (size_t)p.count, sizeof(ring_node)), .count = p.count};
    if (!r.node)
        return FRAM_ERROR_MEMORY;
    ring_link(&r, p);
    fram_status status = FRAM_ERROR_INPUT;
    if (r.left >= 3) {
        int32_t i = 0;
        do {
            judge(&r, i);
            i = r.node[i].next;
        } while (i != 0);
        plant(ctx, &r);
        status = ring_clip(&r, out);
        fell(ctx, &r);
    }
    memory_free(ctx, r.node);
    if (status != FRAM_OK)
        array_clear(out);
    return status;
}
