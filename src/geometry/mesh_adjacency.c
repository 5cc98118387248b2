/* Edges of a mesh and the faces across them. */
#include "geometry/mesh_edges.h"

#include <string.h>

/* Stable counting sort of half-edges by one end; `start` has room for a counter per vertex and one more. */
static void sort_by_end(const mesh *m, bool by_lower, const int32_t *in, int32_t *out, int32_t *start)
{
    int32_t count = 3 * m->face.count;
    memset(start, 0, ((size_t)m->vertex.count + 1) * sizeof *start);
    for (int pass = 0; pass < 2; pass++) {
        for (int32_t i = 0; i < count; i++) {
            int32_t h = in ? in[i] : i, a = half_edge_from(m, h), b = half_edge_to(m, h);
            int32_t key = (a < b) == by_lower ? a : b;
            if (pass == 0)
                start[key + 1]++;
            else
                out[start[key]++] = h;
        }
        for (int32_t v = 0; pass == 0 && v < m->vertex.count; v++)
            start[v + 1] += start[v];
    }
}

bool mesh_edges_sort(context *ctx, const mesh *m, int32_array *sorted)
{
    int32_t count = 3 * m->face.count;
    int32_t *by_higher = memory_array(ctx, (size_t)count + 1, sizeof *by_higher);
    int32_t *start = memory_array(ctx, (size_t)m->vertex.count + 1, sizeof *start);
    bool done = by_higher && start && array_resize(ctx, sorted, count);
    if (done) {
        sort_by_end(m, false, NULL, by_higher, start);
        sort_by_end(m, true, by_higher, sorted->data, start);
    }
    memory_free(ctx, start);
    memory_free(ctx, by_higher);
    return done;
}

int32_t mesh_edges_end(const mesh *m, const int32_array *sorted, int32_t first)
{
    int32_t end = first + 1;
    while (end < sorted->count && same_edge(m, sorted->data[first], sorted->data[end]))
        end++;
    return end;
}

fram_status mesh_adjacency_from_edges(context *ctx, const mesh *m, const int32_array *sorted, mesh_adjacency *out)
{
    if (!array_resize(ctx, &out->neighbour, sorted->count))
        return FRAM_ERROR_MEMORY;
    for (int32_t i = 0, end; i < sorted->count; i = end) {
        end = mesh_edges_end(m, sorted, i);
        for (int32_t j = i; j < end; j++)
            out->neighbour.data[sorted->data[j]] = end - i == 2 ? sorted->data[j == i ? i + 1 : i] / 3 : -1;
    }
    return FRAM_OK;
}

fram_status mesh_adjacency_build(context *ctx, const mesh *m, mesh_adjacency *out)
{
    int32_array sorted = {0};
    fram_status status = FRAM_ERROR_MEMORY;
    if (mesh_edges_sort(ctx, m, &sorted))
        status = mesh_adjacency_from_edges(ctx, m, &sorted, out);
    array_free(ctx, &sorted);
    return status;
}

void mesh_adjacency_free(context *ctx, mesh_adjacency *a) { array_free(ctx, &a->neighbour); }

int mesh_edge_to(const mesh_adjacency *a, int32_t face, int32_t neighbour)
{
    for (int k = 0; k < 3; k++)
        if (a->neighbour.data[3 * face + k] == neighbour)
            return k;
    return -1;
}
