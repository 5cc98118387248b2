/* Rings and lists of rings in an order that depends on nothing but their vertices. */
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"
#include <stdlib.h>
#include <string.h>

void ring_reverse(vec2 *ring, int32_t n)
{
    for (int32_t i = 0, j = n - 1; i < j; i++, j--) {
        vec2 t = ring[i];
        ring[i] = ring[j];
        ring[j] = t;
    }
}

int32_t ring_normal_form(vec2 *ring, int32_t n)
{
    int32_t kept = 0, least = 0;
    for (int32_t i = 0; i < n; i++)
        if (kept == 0 || !vec2_equal(ring[i], ring[kept - 1]))
            ring[kept++] = ring[i];
    while (kept > 1 && vec2_equal(ring[kept - 1], ring[0]))
        kept--;
    int turn = polygon_orientation((polygon){ring, kept});
    if (turn == 0)
        return 0;
    if (turn < 0)
        ring_reverse(ring, kept);
    for (int32_t i = 1; i < kept; i++)
        least = vec2_compare(ring[i], ring[least]) < 0 ? i : least;
    /* Three reversals turn the ring so that `least` comes first. */
    ring_reverse(ring, least);
    ring_reverse(ring + least, kept - least);
    ring_reverse(ring, kept);
    return kept;
}

static int compare_rings(const void *a, const void *b)
{
    const polygon *p = a, *q = b;
    for (int32_t i = 0; i < p->count && i < q->count; i++) {
        int order = vec2_compare(p->vertex[i], q->vertex[i]);
        if (order != 0)
            return order;
    }
    return (p->count > q->count) - (p->count < q->count);
}

bool polygon_list_append_sorted(context *ctx, polygon_list *out, const polygon_list *list)
{
    int32_t n = polygon_list_count(list), rings_before = out->start.count, vertices_before = out->vertex.count;
    if (n == 0)
        return true;
    polygon *view = memory_array(ctx, (size_t)n, sizeof *view);
    if (!view)
        return false;
    for (int32_t i = 0; i < n; i++)
        view[i] = polygon_list_get(list, i);
    qsort(view, (size_t)n, sizeof *view, compare_rings);
    bool done = true;
    for (int32_t i = 0; done && i < n; i++)
        done = polygon_list_push(ctx, out, view[i]);
    memory_free(ctx, view);
    if (!done) {
        out->start.count = rings_before;
        out->vertex.count = vertices_before;
    }
    return done;
}

typedef struct numbered_vertex {
    vec2 at;
    int32_t index;
} numbered_vertex;

static int compare_numbered(const void *a, const void *b)
{
    const numbered_vertex *p = a, *q = b;
    int order = vec2_compare(p->at, q->at);
    return order ? order : (p->index > q->index) - (p->index < q->index);
}

int32_t vertex_places(context *ctx, const vec2 *vertex, int32_t n, vec2 *place, int32_t *number)
{
    numbered_vertex *sorted = memory_array(ctx, (size_t)n, sizeof *sorted);
    if (!sorted)
        return -1;
    for (int32_t i = 0; i < n; i++)
        sorted[i] = (numbered_vertex){vertex[i], i};
    qsort(sorted, (size_t)n, sizeof *sorted, compare_numbered);
    int32_t count = 0;
    for (int32_t i = 0; i < n; i++) {
        if (count == 0 || !vec2_equal(sorted[i].at, place[count - 1]))
            place[count++] = sorted[i].at;
        number[sorted[i].index] = count - 1;
    }
    memory_free(ctx, sorted);
    return count;
}
