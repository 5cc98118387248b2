/* Polygons with holes as simple rings; see polygon_pieces.h.

   Each hole is joined to the outline by the shortest clear bridge, which makes one ring that touches itself; its ears
   are clipped, and the triangles merged again as long as the pieces stay simple.  What is left of the triangles' edges
   are the cuts: at least two per hole. */
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"
#include <string.h>

/* The rings, all vertices in one array; `next` and `previous` of a vertex are its neighbours in its own ring. */
typedef struct joining {
    context *ctx;
    const polygon_list *rings;
    vec2_array outline; /* the outline with the holes joined so far */
    bool *joined;       /* per ring */
} joining;

/* A bridge from a vertex of the outline to one of a hole. */
typedef struct bridge {
    int32_t from, hole, to;
    double square; /* of its length; HUGE_VAL: none found yet */
} bridge;

static vec2 vertex_before(polygon p, int32_t i) { return p.vertex[i > 0 ? i - 1 : p.count - 1]; }
static vec2 vertex_after(polygon p, int32_t i) { return p.vertex[i + 1 < p.count ? i + 1 : 0]; }

/* Point t is strictly inside the wedge of the interior at vertex i. */
static bool in_wedge(polygon p, int32_t i, vec2 t)
{
    vec2 before = vertex_before(p, i), v = p.vertex[i], after = vertex_after(p, i);
    bool left_of_first = orientation(before, v, t) > 0, left_of_second = orientation(v, after, t) > 0;
    return orientation(before, v, after) > 0 ? left_of_first && left_of_second : left_of_first || left_of_second;
}

/* The edge pq meets the bridge ab in more than a common end. */
static bool edge_blocks(vec2 a, vec2 b, vec2 p, vec2 q)
{
    bool p_is_end = vec2_equal(p, a) || vec2_equal(p, b), q_is_end = vec2_equal(q, a) || vec2_equal(q, b);
    if (!p_is_end && !q_is_end)
        return segments_touch(a, b, p, q);
    if (p_is_end && q_is_end)
        return true;
    vec2 end = p_is_end ? p : q, other = p_is_end ? q : p, far = vec2_equal(end, a) ? b : a;
    return segment_contains(a, b, other) || segment_contains(p, q, far);
}

static bool ring_blocks(polygon p, vec2 a, vec2 b)
{
    for (int32_t i = 0; i < p.count; i++)
        if (edge_blocks(a, b, p.vertex[i], vertex_after(p, i)))
            return true;
    return false;
}

/* The bridge runs inside the polygon all the way.  One without length is where a hole touches the outline: the hole
   must lie in the wedge of that vertex of the outline. */
static bool bridge_is_clear(const joining *j, polygon outline, polygon hole, const bridge *b)
{
    vec2 from = outline.vertex[b->from], to = hole.vertex[b->to];
    if (b->square == 0)
        return in_wedge(outline, b->from, vertex_before(hole, b->to)) &&
               in_wedge(outline, b->from, vertex_after(hole, b->to));
    if (!in_wedge(outline, b->from, to) || !in_wedge(hole, b->to, from) || ring_blocks(outline, from, to))
        return false;
    for (int32_t k = 1; k < polygon_list_count(j->rings); k++)
        if (!j->joined[k] && ring_blocks(polygon_list_get(j->rings, k), from, to))
            return false;
    return true;
}

/* The shortest clear bridge to any hole that is not joined yet; the first of equal ones. */
static bridge shortest_bridge(const joining *j)
{
    bridge best = {.square = HUGE_VAL};
    polygon outline = {j->outline.data, j->outline.count};
    for (int32_t k = 1; k < polygon_list_count(j->rings); k++) {
        polygon hole = polygon_list_get(j->rings, k);
        for (int32_t to = 0; !j->joined[k] && to < hole.count; to++)
            for (int32_t from = 0; from < outline.count; from++) {
                vec2 d = vec2_sub(hole.vertex[to], outline.vertex[from]);
                bridge b = {from, k, to, vec2_dot(d, d)};
                if (b.square < best.square && bridge_is_clear(j, outline, hole, &b))
                    best = b;
            }
    }
    return best;
}

/* Lead the outline over the bridge, round the hole and back. */
static bool cross_bridge(joining *j, bridge b)
{
    polygon hole = polygon_list_get(j->rings, b.hole);
    int32_t touching = b.square == 0, added = hole.count + 2 - 2 * touching, old = j->outline.count;
    if (!array_resize(j->ctx, &j->outline, old + added))
        return false;
    vec2 *at = j->outline.data + b.from + 1, back = at[-1];
    memmove(at + added, at, (size_t)(old - b.from - 1) * sizeof *at);
    for (int32_t i = touching; i < hole.count + 1 - touching; i++)
        *at++ = hole.vertex[(b.to + i) % hole.count];
    *at = back;
    j->joined[b.hole] = true;
    return true;
}

static fram_status join_holes(joining *j)
{
    polygon outline = polygon_list_get(j->rings, 0);
    if (!array_resize(j->ctx, &j->outline, outline.count))
        return FRAM_ERROR_MEMORY;
    memcpy(j->outline.data, outline.vertex, (size_t)outline.count * sizeof *outline.vertex);
    for (int32_t k = 1; k < polygon_list_count(j->rings); k++) {
        bridge b = shortest_bridge(j);
        if (b.square == HUGE_VAL)
            return FRAM_ERROR_INPUT;
        if (!cross_bridge(j, b))
            return FRAM_ERROR_MEMORY;
    }
    return FRAM_OK;
}

/* Cut a ring that may touch itself into simple ones. */
static fram_status cut_touching_ring(context *ctx, polygon p, polygon_list *out)
{
    index_array t = {0};
    vec2 *place = memory_array(ctx, (size_t)p.count, sizeof *place);
    int32_t *number = memory_array(ctx, (size_t)p.count, sizeof *number), places = -1;
    fram_status status = place && number ? polygon_triangulate_ears(ctx, p, &t) : FRAM_ERROR_MEMORY;
    if (status == FRAM_OK)
        places = vertex_places(ctx, p.vertex, p.count, place, number);
    for (int32_t i = 0; places >= 0 && i < t.count; i++)
        t.data[i] = number[t.data[i]];
    if (status == FRAM_OK && (places < 0 || !triangles_merge(ctx, place, places, &t, MERGE_SIMPLE, 0, out)))
        status = FRAM_ERROR_MEMORY;
    array_free(ctx, &t);
    memory_free(ctx, place);
    memory_free(ctx, number);
    return status;
}

fram_status polygon_cut_holes(context *ctx, const polygon_list *rings, polygon_list *out)
{
    int32_t count = polygon_list_count(rings);
    if (count < 1)
        return FRAM_OK;
    joining j = {.ctx = ctx, .rings = rings, .joined = memory_array(ctx, (size_t)count, sizeof *j.joined)};
    fram_status status = j.joined ? join_holes(&j) : FRAM_ERROR_MEMORY;
    if (status == FRAM_OK)
        status = cut_touching_ring(ctx, (polygon){j.outline.data, j.outline.count}, out);
    array_free(ctx, &j.outline);
    memory_free(ctx, j.joined);
    return status;
}
