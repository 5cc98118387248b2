/* Does a ring cross or touch itself? */
#include "geometry/polygon.h"
#include "geometry/predicate.h"
#include <stdlib.h>

/* Rings under this many vertices are not worth a sort. */
#define SWEEP_FROM 32

static vec2 edge_end(polygon p, int32_t i) { return p.vertex[i + 1 < p.count ? i + 1 : 0]; }

static bool edge_is_point(polygon p, int32_t i) { return vec2_equal(p.vertex[i], edge_end(p, i)); }

/* The next edge with a length; i itself when there is none. */
static int32_t next_edge(polygon p, int32_t i)
{
    int32_t k = i;
    do {
        k = k + 1 < p.count ? k + 1 : 0;
    } while (k != i && edge_is_point(p, k));
    return k;
}

static bool edges_touch(polygon p, int32_t i, int32_t j)
{
    return segments_touch(p.vertex[i], edge_end(p, i), p.vertex[j], edge_end(p, j)) && next_edge(p, i) != j &&
           next_edge(p, j) != i;
}

/* The first pair over all pairs. */
static bool touch_by_pairs(polygon p, int32_t pair[2])
{
    for (int32_t i = 0; i < p.count; i++) {
        if (edge_is_point(p, i))
            continue;
        for (int32_t j = i + 1; j < p.count; j++)
            if (!edge_is_point(p, j) && edges_touch(p, i, j)) {
                pair[0] = i;
                pair[1] = j;
                return true;
            }
    }
    return false;
}

/* The extent of an edge along the sweep. */
typedef struct interval {
    double lo, hi;
    int32_t edge;
} interval;

static int compare_intervals(const void *a, const void *b)
{
    const interval *x = a, *y = b;
    if (x->lo != y->lo)
        return x->lo < y->lo ? -1 : 1;
    return (x->edge > y->edge) - (x->edge < y->edge);
}

static int32_t list_intervals(polygon p, interval *list)
{
    box2 box = polygon_bounds(p);
    bool along_x = box.hi.x - box.lo.x >= box.hi.y - box.lo.y;
    int32_t n = 0;
    for (int32_t i = 0; i < p.count; i++) {
        vec2 a = p.vertex[i], b = edge_end(p, i);
        if (edge_is_point(p, i))
            continue;
        list[n++] = along_x ? (interval){real_min(a.x, b.x), real_max(a.x, b.x), i}
                            : (interval){real_min(a.y, b.y), real_max(a.y, b.y), i};
    }
    qsort(list, (size_t)n, sizeof *list, compare_intervals);
    return n;
}

/* The first pair by a sweep: an edge is tried against those that begin before it ends. */
static bool touch_by_sweep(polygon p, interval *list, int32_t pair[2])
{
    int32_t n = list_intervals(p, list);
    bool found = false;
    for (int32_t k = 0; k < n; k++)
        for (int32_t m = k + 1; m < n && list[m].lo <= list[k].hi; m++) {
            int32_t i = list[k].edge, j = list[m].edge, a = i < j ? i : j, b = i < j ? j : i;
            bool later = found && (a > pair[0] || (a == pair[0] && b > pair[1]));
            if (!later && edges_touch(p, a, b)) {
                found = true;
                pair[0] = a;
                pair[1] = b;
            }
        }
    return found;
}

bool polygon_self_intersects(context *ctx, polygon p, int32_t *edge_a, int32_t *edge_b)
{
    int32_t pair[2] = {-1, -1};
    interval *list = p.count < SWEEP_FROM ? NULL : memory_array(ctx, (size_t)p.count, sizeof *list);
    bool found = list ? touch_by_sweep(p, list, pair) : touch_by_pairs(p, pair);
    memory_free(ctx, list);
    if (found && edge_a)
        *edge_a = pair[0];
    if (found && edge_b)
        *edge_b = pair[1];
    return found;
}

/* ---- clearance ---- */

static bool is_near(polygon p, int32_t edge, int32_t vertex, double reach)
{
    vec2 a = p.vertex[edge], b = edge_end(p, edge), v = p.vertex[vertex];
    if (vertex == edge || vertex == (edge + 1 < p.count ? edge + 1 : 0) || real_min(a.x, b.x) - v.x > reach ||
        v.x - real_max(a.x, b.x) > reach || real_min(a.y, b.y) - v.y > reach || v.y - real_max(a.y, b.y) > reach)
        return false;
    return vec2_length(vec2_sub(segment_nearest(a, b, v), v)) <= reach;
}

static bool near_by_pairs(polygon p, double reach)
{
    for (int32_t i = 0; i < p.count; i++)
        for (int32_t k = 0; k < p.count; k++)
            if (is_near(p, i, k, reach))
                return true;
    return false;
}

/* Edges in the order of their lower ends along the sweep, against the vertices from there to their upper ends. */
static bool near_by_sweep(polygon p, double reach, interval *list)
{
    box2 box = polygon_bounds(p);
    bool along_x = box.hi.x - box.lo.x >= box.hi.y - box.lo.y;
    for (int32_t i = 0; i < p.count; i++) {
        double at = along_x ? p.vertex[i].x : p.vertex[i].y;
        list[i] = (interval){at, at, i};
    }
    qsort(list, (size_t)p.count, sizeof *list, compare_intervals);
    for (int32_t i = 0; i < p.count; i++) {
        /* The neighbours of vertex i in the sorted list, both ways, as far as the edge from it goes. */
        int32_t edge = list[i].edge;
        double from = list[i].lo, to = along_x ? edge_end(p, edge).x : edge_end(p, edge).y;
        double lo = real_min(from, to) - 2 * reach, hi = real_max(from, to) + 2 * reach;
        for (int32_t k = i; k >= 0 && list[k].lo >= lo; k--)
            if (is_near(p, edge, list[k].edge, reach))
                return true;
        for (int32_t k = i + 1; k < p.count && list[k].lo <= hi; k++)
            if (is_near(p, edge, list[k].edge, reach))
                return true;
    }
    return false;
}

bool polygon_has_clearance(context *ctx, polygon p, double reach)
{
    interval *list = p.count < SWEEP_FROM ? NULL : memory_array(ctx, (size_t)p.count, sizeof *list);
    bool near = list ? near_by_sweep(p, reach, list) : near_by_pairs(p, reach);
    memory_free(ctx, list);
    return !near;
}
