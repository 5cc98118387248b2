/* Convexity: test, hull, smallest oriented box, separating axis. */
#include "geometry/polygon.h"
#include "geometry/predicate.h"
#include <float.h>
#include <stdlib.h>

double polygon_rounding(polygon p)
{
    double extent = 0;
    for (int32_t i = 0; i < p.count; i++)
        extent = real_max(extent, real_max(fabs(p.vertex[i].x), fabs(p.vertex[i].y)));
    return 4 * DBL_EPSILON * extent;
}

int turn_sign(vec2 a, vec2 b, vec2 c, double rounding)
{
    vec2 e = vec2_sub(b, a), f = vec2_sub(c, b);
    double cross = vec2_cross(e, f), bound = rounding * (fabs(e.x) + fabs(e.y) + fabs(f.x) + fabs(f.y));
    return cross > bound ? 1 : cross < -bound ? -1 : 0;
}

static int32_t least_vertex(polygon p)
{
    int32_t least = 0;
    for (int32_t i = 1; i < p.count; i++)
        if (vec2_compare(p.vertex[i], p.vertex[least]) < 0)
            least = i;
    return least;
}

int polygon_orientation(polygon p)
{
    if (p.count < 3)
        return 0;
    int32_t tip = least_vertex(p), before = tip, after = tip;
    do
        before = before > 0 ? before - 1 : p.count - 1;
    while (before != tip && vec2_equal(p.vertex[before], p.vertex[tip]));
    do
        after = after + 1 < p.count ? after + 1 : 0;
    while (after != tip && vec2_equal(p.vertex[after], p.vertex[tip]));
    return orientation(p.vertex[before], p.vertex[tip], p.vertex[after]);
}

/* Turns of one sign alone allow a ring that winds twice (a pentagram).  Seen from the least vertex, which has all
   others within half a turn, a convex ring goes round one way only, so the triangles of that fan have the same sign
   as well. */
bool polygon_is_convex(polygon p)
{
    if (p.count < 3)
        return false;
    double rounding = polygon_rounding(p);
    int32_t least = least_vertex(p);
    vec2 tip = p.vertex[least], before = tip, a = tip;
    int sign = 0;
    bool closed = false; /* the turn at the tip has been seen */
    for (int32_t k = 1; !closed && k < 2 * p.count; k++) {
        vec2 b = p.vertex[(least + k) % p.count];
        if (vec2_equal(a, b))
            continue;
        closed = k > p.count;
        int turn = turn_sign(before, a, b, rounding), fan = turn_sign(tip, a, b, p.count * rounding);
        bool folded = turn == 0 && vec2_dot(vec2_sub(a, before), vec2_sub(b, a)) < 0;
        if (folded || turn * sign < 0 || fan * sign < 0 || turn * fan < 0)
            return false;
        if (turn + fan != 0)
            sign = turn + fan > 0 ? 1 : -1;
        before = a;
        a = b;
    }
    return sign != 0;
}

static int compare_points(const void *a, const void *b) { return vec2_compare(*(const vec2 *)a, *(const vec2 *)b); }

/* One chain over the sorted points, from the first to the last in the direction of `step`, without its last point. */
static int32_t hull_chain(const vec2 *point, int32_t n, bool backward, vec2 *out)
{
    int32_t count = 0;
    for (int32_t k = 0; k < n; k++) {
        vec2 p = point[backward ? n - 1 - k : k];
        while (count >= 2 && orientation(out[count - 2], out[count - 1], p) <= 0)
            count--;
        out[count++] = p;
    }
    return count - 1;
}

bool polygon_convex_hull(context *ctx, polygon p, vec2_array *out)
{
    array_clear(out);
    if (p.count == 0)
        return true;
    vec2 *sorted = memory_array(ctx, (size_t)p.count, sizeof *sorted);
    if (!sorted || p.count > INT32_MAX / 2 || !array_reserve(ctx, out, 2 * p.count)) {
        memory_free(ctx, sorted);
        return false;
    }
    int32_t n = 0;
    for (int32_t i = 0; i < p.count; i++)
        sorted[i] = p.vertex[i];
    qsort(sorted, (size_t)p.count, sizeof *sorted, compare_points);
    for (int32_t i = 0; i < p.count; i++)
        if (n == 0 || !vec2_equal(sorted[i], sorted[n - 1]))
            sorted[n++] = sorted[i];
    if (n == 1) {
        out->data[out->count++] = sorted[0];
    } else {
        out->count = hull_chain(sorted, n, false, out->data);
        out->count += hull_chain(sorted, n, true, out->data + out->count);
    }
    memory_free(ctx, sorted);
    return true;
}

/* The box of the hull along one of its edges. */
static oriented_box box_along_edge(polygon hull, int32_t i)
{
    vec2 origin = hull.vertex[i], edge = vec2_sub(hull.vertex[(i + 1) % hull.count], origin);
    double length = vec2_length(edge);
    vec2 x = length > 0 ? vec2_scale(edge, 1 / length) : vec2_make(1, 0), y = vec2_perp(x), lo = {0, 0}, hi = {0, 0};
    for (int32_t k = 0; k < hull.count; k++) {
        vec2 d = vec2_sub(hull.vertex[k], origin);
        double along = vec2_dot(d, x), across = vec2_dot(d, y);
        lo = vec2_make(real_min(lo.x, along), real_min(lo.y, across));
        hi = vec2_make(real_max(hi.x, along), real_max(hi.y, across));
    }
    vec2 side = vec2_sub(hi, lo), middle = vec2_scale(vec2_add(lo, hi), 0.5);
    oriented_box box = {.centre = vec2_add(origin, vec2_add(vec2_scale(x, middle.x), vec2_scale(y, middle.y)))};
    bool along_edge = side.x >= side.y;
    box.axis = along_edge ? x : y;
    box.sides[0] = along_edge ? side.x : side.y;
    box.sides[1] = along_edge ? side.y : side.x;
    return box;
}

fram_status polygon_oriented_box(context *ctx, polygon p, oriented_box *box)
{
    if (p.count < 1)
        return FRAM_ERROR_INPUT;
    vec2_array hull = {0};
    if (!polygon_convex_hull(ctx, p, &hull)) {
        array_free(ctx, &hull);
        return FRAM_ERROR_MEMORY;
    }
    polygon ring = {hull.data, hull.count};
    for (int32_t i = 0; i < ring.count; i++) {
        oriented_box other = box_along_edge(ring, i);
        if (i == 0 || other.sides[0] * other.sides[1] < box->sides[0] * box->sides[1])
            *box = other;
    }
    array_free(ctx, &hull);
    return FRAM_OK;
}

static double square_between(polygon p, int32_t i, int32_t k)
{
    vec2 d = vec2_sub(p.vertex[i], p.vertex[k]);
    return vec2_dot(d, d);
}

/* Over the hull, whose farthest vertex from an edge goes on round it as the edges do (Shamos 1978). */
bool polygon_farthest_apart(context *ctx, polygon p, double *out)
{
    vec2_array ring = {0};
    bool good = polygon_convex_hull(ctx, p, &ring);
    polygon hull = {ring.data, good ? ring.count : 0};
    double most = hull.count == 2 ? square_between(hull, 0, 1) : 0;
    int32_t far = 1;
    for (int32_t i = 0; hull.count > 2 && i < hull.count; i++) {
        int32_t end = (i + 1) % hull.count;
        vec2 edge = vec2_sub(hull.vertex[end], hull.vertex[i]);
        for (int32_t turns = 0; turns < hull.count; turns++) {
            int32_t next = (far + 1) % hull.count;
            most = real_max(most, real_max(square_between(hull, i, far), square_between(hull, end, far)));
            if (vec2_cross(edge, vec2_sub(hull.vertex[next], hull.vertex[far])) <= 0)
                break;
            far = next;
        }
    }
    array_free(ctx, &ring);
    *out = sqrt(most);
    return good;
}

/* The edge of a whose outward normal keeps b farthest away: that distance, and the normal. */
static double edge_separation(polygon a, polygon b, vec2 *normal)
{
    double most = -HUGE_VAL;
    for (int32_t i = 0, j = a.count - 1; i < a.count; j = i++) {
        vec2 edge = vec2_sub(a.vertex[i], a.vertex[j]);
        double length = vec2_length(edge), gap = HUGE_VAL;
        if (length == 0)
            continue;
        vec2 n = {edge.y / length, -edge.x / length};
        for (int32_t k = 0; k < b.count; k++)
            gap = real_min(gap, vec2_dot(n, vec2_sub(b.vertex[k], a.vertex[i])));
        if (gap > most) {
            most = gap;
            *normal = n;
        }
    }
    return most;
}

double polygon_convex_depth(polygon a, polygon b, vec2 *axis)
{
    vec2 from_a = {1, 0}, from_b = {-1, 0};
    double gap_a = edge_separation(a, b, &from_a), gap_b = edge_separation(b, a, &from_b);
    if (axis)
        *axis = gap_a >= gap_b ? from_a : vec2_scale(from_b, -1);
    return -real_max(gap_a, gap_b);
}
