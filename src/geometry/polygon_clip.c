/* Clipping by half planes and convex polygons. */
#include "geometry/convex_cut.h"
#include <string.h>

/* Vertices of both polygons together that need no memory of their own. */
#define CLIP_ROOM 64

static bool push_distinct(context *ctx, vec2_array *out, vec2 v)
{
    return (out->count > 0 && vec2_equal(out->data[out->count - 1], v)) || array_push(ctx, out, v);
}

bool polygon_clip_half_plane(context *ctx, polygon p, vec2 n, double d, vec2_array *out)
{
    array_clear(out);
    for (int32_t i = 0; i < p.count; i++) {
        vec2 a = p.vertex[i], b = p.vertex[i + 1 < p.count ? i + 1 : 0];
        double side_a = vec2_dot(n, a) - d, side_b = vec2_dot(n, b) - d;
        if (side_a <= 0 && !push_distinct(ctx, out, a))
            return false;
        bool crosses = (side_a < 0 && side_b > 0) || (side_a > 0 && side_b < 0);
        if (crosses && !push_distinct(ctx, out, line_crossing(a, side_a, b, side_b)))
            return false;
    }
    while (out->count > 1 && vec2_equal(out->data[out->count - 1], out->data[0]))
        out->count--;
    if (polygon_area((polygon){out->data, out->count}) == 0)
        array_clear(out);
    return true;
}

/* Signed distances from the line ab, positive to its right, times |ab|; returns the largest. */
static double right_of(vec2 a, vec2 b, const vec2 *vertex, int32_t n, double *side)
{
    vec2 e = vec2_sub(b, a);
    double most = -HUGE_VAL;
    for (int32_t i = 0; i < n; i++) {
        side[i] = vec2_cross(vec2_sub(vertex[i], a), e);
        most = real_max(most, side[i]);
    }
    return most;
}

/* Cut the ring in `from` by every edge of q; from and to change roles.  Returns the ring's place, its count in *n. */
static vec2 *cut_by_all(polygon q, double rounding, vec2 *from, vec2 *to, double *side, int32_t *n)
{
    for (int32_t i = 0; i<q.count && * n> 0; i++) {
        vec2 a = q.vertex[i], b = q.vertex[i + 1 < q.count ? i + 1 : 0];
        double slack = rounding * (fabs(b.x - a.x) + fabs(b.y - a.y));
        if (vec2_equal(a, b) || right_of(a, b, from, *n, side) <= slack)
            continue;
        *n = convex_cut(from, side, *n, slack, to);
        vec2 *cut = to;
        to = from;
        from = cut;
    }
    return from;
}

bool polygon_clip_convex(context *ctx, polygon p, polygon q, vec2_array *out)
{
    vec2 stack_vertex[CLIP_ROOM], *spare = stack_vertex;
    double stack_side[CLIP_ROOM], *side = stack_side;
    array_clear(out);
    if (p.count < 3 || q.count < 3)
        return true;
    if (p.count > INT32_MAX - q.count || !array_reserve(ctx, out, p.count + q.count))
        return false;
    if (p.count + q.count > CLIP_ROOM) {
        spare = memory_array(ctx, (size_t)p.count + (size_t)q.count, sizeof *spare + sizeof *side);
        if (!spare)
            return false;
        side = (double *)(spare + p.count + q.count);
    }
    int32_t n = p.count;
    memcpy(out->data, p.vertex, (size_t)n * sizeof *p.vertex);
    vec2 *ring = cut_by_all(q, real_max(polygon_rounding(p), polygon_rounding(q)), out->data, spare, side, &n);
    if (ring != out->data)
        memcpy(out->data, ring, (size_t)n * sizeof *ring);
    out->count = n >= 3 && polygon_area((polygon){ring, n}) > 0 ? n : 0;
    if (spare != stack_vertex)
        memory_free(ctx, spare);
    return true;
}
