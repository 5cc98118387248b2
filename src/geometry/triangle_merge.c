/* Merging of triangles into larger pieces, over half edges; see polygon_pieces.h.

   A half edge runs from `vertex` to the vertex of its `next`, with its piece to the left.  Taking the two halves of
   a common edge out joins two rings into one.  The vertices of the region are all on its outline, so that two
   pieces never have a chain of edges in common that leaves a simple ring when it is taken out: one edge, or the
   union is not simple. */
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"
#include <stdlib.h>

typedef struct half_edge {
    int32_t vertex, next, previous;
    bool removed;
} half_edge;

/* An edge between two triangles. */
typedef struct common_edge {
    int32_t half, other;
    double square; /* of its length */
} common_edge;

typedef struct merging {
    context *ctx;
    const vec2 *vertex;
    half_edge *half;
    common_edge *edge;
    int32_t *seen; /* per vertex: the last round in which it was met */
    vec2 *ring;    /* one union on trial */
    int32_t half_count, edge_count, ring_count, round;
    double rounding;
} merging;

/* Longest first.  The numbers of half edges settle ties: they follow from the triangles alone. */
static int compare_lengths(const void *a, const void *b)
{
    const common_edge *e = a, *f = b;
    if (e->square != f->square)
        return e->square > f->square ? -1 : 1;
    return (e->half > f->half) - (e->half < f->half);
}

static bool make_edges(merging *m, const index_array *t, int32_t vertex_count)
{
    int32_array twin = {0};
    bool done = triangles_find_twins(m->ctx, t, vertex_count, &twin);
    m->half_count = t->count;
    for (int32_t i = 0; done && i < t->count; i++) {
        int32_t first = i - i % 3, next = first + (i + 1) % 3, previous = first + (i + 2) % 3;
        vec2 d = vec2_sub(m->vertex[t->data[next]], m->vertex[t->data[i]]);
        m->half[i] = (half_edge){t->data[i], next, previous, false};
        if (i < twin.data[i])
            m->edge[m->edge_count++] = (common_edge){i, twin.data[i], vec2_dot(d, d)};
    }
    array_free(m->ctx, &twin);
    if (done)
        qsort(m->edge, (size_t)m->edge_count, sizeof *m->edge, compare_lengths);
    return done;
}

static vec2 vertex_at(const merging *m, int32_t half) { return m->vertex[m->half[half].vertex]; }

/* The turn where the ring of `half` goes over into that of `other` when their common edge is taken out. */
static int joint_turn(const merging *m, int32_t half, int32_t other)
{
    const half_edge *h = m->half;
    return turn_sign(vertex_at(m, h[half].previous), vertex_at(m, half), vertex_at(m, h[h[other].next].next),
                     m->rounding);
}

static bool gather(merging *m, int32_t half, int32_t most)
{
    for (int32_t i = m->half[half].next; i != half; i = m->half[i].next) {
        if (m->ring_count == most)
            return false;
        m->ring[m->ring_count++] = vertex_at(m, i);
    }
    return true;
}

/* The turns at the joints rule most unions out; those that rounding calls straight may add up, so the whole ring is
   judged by the same test that is applied to a piece later. */
static bool union_is_convex(merging *m, int32_t half, int32_t other, int32_t most)
{
    if (joint_turn(m, half, other) < 0 || joint_turn(m, other, half) < 0)
        return false;
    m->ring_count = 0;
    return gather(m, half, most) && gather(m, other, most) && polygon_is_convex((polygon){m->ring, m->ring_count});
}

/* The two rings have no vertex in common but the ends of the edge. */
static bool union_is_simple(merging *m, int32_t half, int32_t other)
{
    int32_t common = 0, i = half;
    m->round++;
    do {
        m->seen[m->half[i].vertex] = m->round;
        i = m->half[i].next;
    } while (i != half);
    i = other;
    do {
        common += m->seen[m->half[i].vertex] == m->round;
        i = m->half[i].next;
    } while (i != other);
    return common == 2;
}

static void join(merging *m, int32_t a, int32_t b)
{
    m->half[a].next = b;
    m->half[b].previous = a;
}

static void remove_edge(merging *m, int32_t half, int32_t other)
{
    half_edge *h = m->half;
    join(m, h[half].previous, h[other].next);
    join(m, h[other].previous, h[half].next);
    h[half].removed = h[other].removed = true;
}

static bool push_pieces(merging *m, polygon_list *out)
{
    for (int32_t i = 0; i < m->half_count; i++) {
        m->ring_count = 0;
        for (int32_t k = i; !m->half[k].removed; k = m->half[k].next) {
            m->half[k].removed = true;
            m->ring[m->ring_count++] = vertex_at(m, k);
        }
        int32_t n = ring_normal_form(m->ring, m->ring_count);
        if (n >= 3 && !polygon_list_push(m->ctx, out, (polygon){m->ring, n}))
            return false;
    }
    return true;
}

bool triangles_merge(context *ctx, const vec2 *vertex, int32_t vertex_count, const index_array *t, merge_rule rule,
                     int32_t most, polygon_list *out)
{
    if (t->count == 0)
        return true;
    merging m = {.ctx = ctx, .vertex = vertex, .rounding = polygon_rounding((polygon){vertex, vertex_count})};
    m.half = memory_array(ctx, (size_t)t->count, sizeof *m.half);
    m.edge = memory_array(ctx, (size_t)t->count, sizeof *m.edge);
    m.seen = memory_array(ctx, (size_t)vertex_count, sizeof *m.seen);
    m.ring = memory_array(ctx, (size_t)t->count, sizeof *m.ring); /* a piece has no more corners than its triangles */
    bool done = m.half && m.edge && m.seen && m.ring && make_edges(&m, t, vertex_count);
    if (done) {
        for (int32_t i = 0; i < m.edge_count; i++) {
            int32_t half = m.edge[i].half, other = m.edge[i].other;
            bool fits =
                rule == MERGE_CONVEX ? union_is_convex(&m, half, other, most) : union_is_simple(&m, half, other);
            if (fits)
                remove_edge(&m, half, other);
        }
        done = push_pieces(&m, out);
    }
    memory_free(ctx, m.half);
    memory_free(ctx, m.edge);
    memory_free(ctx, m.seen);
    memory_free(ctx, m.ring);
    return done;
}
