/* Does a ring cross or touch itself? */
#include "geometry/polygon.h"
#include "geometry/predicate.h"
#include "geometry/ring_tree.h"

/* Rings under this many vertices are not worth a tree. */
enum { TREE_FROM = 32 };

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

static box2 edge_box(polygon p, int32_t i)
{
    vec2 a = p.vertex[i], b = edge_end(p, i);
    return (box2){{real_min(a.x, b.x), real_min(a.y, b.y)}, {real_max(a.x, b.x), real_max(a.y, b.y)}};
}

/* The first of the edges behind i that touches it, -1 when none does; from run to run of those whose box meets its own.
 */
static int32_t touched_behind(polygon p, const ring_tree *edges, int32_t i)
{
    box2 box = edge_box(p, i);
    for (int32_t run = ring_tree_find(edges, box, i / RING_RUN); run >= 0; run = ring_tree_find(edges, box, run + 1)) {
        int32_t first = run * RING_RUN, end = first + RING_RUN < p.count ? first + RING_RUN : p.count;
        for (int32_t j = first > i ? first : i + 1; j < end; j++)
            if (!edge_is_point(p, j) && edges_touch(p, i, j))
                return j;
    }
    return -1;
}

/* The first pair by a tree over the edges. */
static bool touch_by_tree(polygon p, ring_tree *edges, int32_t pair[2])
{
    for (int32_t i = 0; i < p.count; i++)
        if (!edge_is_point(p, i))
            ring_tree_add(edges, i, edge_box(p, i));
    ring_tree_close(edges);
    for (int32_t i = 0; i < p.count; i++) {
        int32_t j = edge_is_point(p, i) ? -1 : touched_behind(p, edges, i);
        if (j >= 0) {
            pair[0] = i;
            pair[1] = j;
            return true;
        }
    }
    return false;
}

bool polygon_self_intersects(context *ctx, polygon p, int32_t *edge_a, int32_t *edge_b)
{
    int32_t pair[2] = {-1, -1};
    ring_tree edges;
    bool tree = p.count >= TREE_FROM && ring_tree_init(ctx, &edges, p.count);
    bool found = tree ? touch_by_tree(p, &edges, pair) : touch_by_pairs(p, pair);
    if (tree)
        ring_tree_free(ctx, &edges);
    if (found && edge_a)
        *edge_a = pair[0];
    if (found && edge_b)
        *edge_b = pair[1];
    return found;
}

/* ---- clearance ---- */

static bool edge_is_near(polygon p, int32_t edge, int32_t vertex, double reach)
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
            if (edge_is_near(p, i, k, reach))
                return true;
    return false;
}

/* Every edge against the corners in a box about it that is twice as wide as asked, so that rounding leaves none out. */
static bool near_by_tree(polygon p, double reach, ring_tree *corners)
{
    for (int32_t i = 0; i < p.count; i++)
        ring_tree_add(corners, i, (box2){p.vertex[i], p.vertex[i]});
    ring_tree_close(corners);
    vec2 wide = {2 * reach, 2 * reach};
    for (int32_t i = 0; i < p.count; i++) {
        box2 box = edge_box(p, i);
        box = (box2){vec2_sub(box.lo, wide), vec2_add(box.hi, wide)};
        for (int32_t run = ring_tree_find(corners, box, 0); run >= 0; run = ring_tree_find(corners, box, run + 1))
            for (int32_t k = run * RING_RUN; k < (run + 1) * RING_RUN && k < p.count; k++)
                if (edge_is_near(p, i, k, reach))
                    return true;
    }
    return false;
}

bool polygon_has_clearance(context *ctx, polygon p, double reach)
{
    ring_tree corners;
    bool tree = p.count >= TREE_FROM && ring_tree_init(ctx, &corners, p.count);
    bool near = tree ? near_by_tree(p, reach, &corners) : near_by_pairs(p, reach);
    if (tree)
        ring_tree_free(ctx, &corners);
    return !near;
}
