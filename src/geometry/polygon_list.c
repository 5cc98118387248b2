/* Pools of polygons. */
#include "geometry/polygon.h"

#include <assert.h>
#include <string.h>

polygon polygon_list_get(const polygon_list *l, int32_t i)
{
    assert(i >= 0 && i + 1 < l->start.count);
    int32_t first = l->start.data[i];
    assert(first >= 0 && first <= l->start.data[i + 1] && l->start.data[i + 1] <= l->vertex.count);
    return (polygon){l->vertex.data ? l->vertex.data + first : NULL, l->start.data[i + 1] - first};
}

/* Where in the list's own memory, which moves when the list grows, a polygon stands; -1 for one of elsewhere. */
static ptrdiff_t own_vertex(const polygon_list *l, const vec2 *vertex)
{
    uintptr_t from = (uintptr_t)l->vertex.data, at = (uintptr_t)vertex;
    size_t bytes = (size_t)l->vertex.count * sizeof *vertex;
    return vertex && at >= from && at - from < bytes ? (ptrdiff_t)((at - from) / sizeof *vertex) : -1;
}

bool polygon_list_push(context *ctx, polygon_list *l, polygon p)
{
    ptrdiff_t own = own_vertex(l, p.vertex);
    bool fresh = l->start.count == 0;
    assert(p.count >= 0 && (fresh ? l->vertex.count : l->vertex.count - l->start.data[l->start.count - 1]) == 0);
    if (p.count > INT32_MAX - l->vertex.count || !array_reserve(ctx, &l->vertex, l->vertex.count + p.count) ||
        !array_reserve(ctx, &l->start, l->start.count + 1 + fresh))
        return false;
    if (own >= 0)
        p.vertex = l->vertex.data + own;
    if (p.count > 0)
        memcpy(l->vertex.data + l->vertex.count, p.vertex, (size_t)p.count * sizeof *p.vertex);
    l->vertex.count += p.count;
    if (fresh)
        l->start.data[l->start.count++] = 0;
    l->start.data[l->start.count++] = l->vertex.count;
    return true;
}

void polygon_list_clear(polygon_list *l)
{
    array_clear(&l->vertex);
    array_clear(&l->start);
}

void polygon_list_free(context *ctx, polygon_list *l)
{
    array_free(ctx, &l->vertex);
    array_free(ctx, &l->start);
}
