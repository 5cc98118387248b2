/* Ear clipping (Meisters 1975); see ear_clip.h.

   The ring that is left is a doubly linked list of vertex numbers.  It stays simple and keeps every straight vertex,
   because an ear is cut only when no other vertex touches its closed triangle; then two ears always exist.

   Where the ring touches itself, several vertices are at one place, each with its own wedge of the interior.  Wedges do
   not overlap, so an ear that keeps to the wedges of its three vertices has nothing to fear from their doubles. */
#include "geometry/ear_clip.h"
#include "geometry/predicate.h"

typedef struct ring_node {
    int32_t previous, next;
    bool convex; /* strictly; a vertex that became so stays so */
} ring_node;

typedef struct ring {
    const vec2 *vertex;
    ring_node *node;
    int32_t first, left;
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

/* The tip i is strictly convex, and no vertex elsewhere touches its triangle.  Only vertices that are not strictly
   convex can be the first to do so. */
static bool is_ear(const ring *r, int32_t i)
{
    const ring_node *node = r->node;
    if (!node[i].convex || !diagonal_in_wedges(r, i))
        return false;
    int32_t before = node[i].previous, after = node[i].next;
    vec2 a = r->vertex[before], b = r->vertex[i], c = r->vertex[after];
    double lo_x = real_min(real_min(a.x, b.x), c.x), hi_x = real_max(real_max(a.x, b.x), c.x);
    double lo_y = real_min(real_min(a.y, b.y), c.y), hi_y = real_max(real_max(a.y, b.y), c.y);
    for (int32_t k = node[after].next; k != before; k = node[k].next) {
        vec2 p = r->vertex[k];
        bool near = !node[k].convex && p.x >= lo_x && p.x <= hi_x && p.y >= lo_y && p.y <= hi_y;
        if (near && in_triangle(a, b, c, p) && !vec2_equal(p, a) && !vec2_equal(p, b) && !vec2_equal(p, c))
            return false;
    }
    return true;
}

static void add_triangle(const ring *r, int32_t i, index_array *out)
{
    out->data[out->count++] = r->node[i].previous;
    out->data[out->count++] = i;
    out->data[out->count++] = r->node[i].next;
}

static void ring_cut(ring *r, int32_t i)
{
    int32_t before = r->node[i].previous, after = r->node[i].next;
    r->node[before].next = after;
    r->node[after].previous = before;
    r->node[before].convex = turn(r, before) > 0;
    r->node[after].convex = turn(r, after) > 0;
    r->left--;
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
    ring r = {.vertex = p.vertex, .node = memory_array(ctx, (size_t)p.count, sizeof(ring_node))};
    if (!r.node)
        return FRAM_ERROR_MEMORY;
    ring_link(&r, p);
    fram_status status = FRAM_ERROR_INPUT;
    if (r.left >= 3) {
        int32_t i = 0;
        do {
            r.node[i].convex = turn(&r, i) > 0;
            i = r.node[i].next;
        } while (i != 0);
        status = ring_clip(&r, out);
    }
    memory_free(ctx, r.node);
    if (status != FRAM_OK)
        array_clear(out);
    return status;
}
