/* Walking around cuts, and the plan outline of a level section.  Knows nothing of water. */
#include "geometry/mesh_edges.h"
#include "geometry/mesh_rings.h"

int mesh_edge_up(const mesh *m, int32_t face, const uint8_t *above)
{
    const int32_t *v = m->face.data[face].v;
    for (int k = 0; k < 3; k++)
        if (!above[v[k]] && above[v[(k + 1) % 3]])
            return k;
    return -1;
}

/* A triangle that is cut has one edge up and one down.  Seen from outside with up on top, the edge up is on the right:
   leaving through it keeps the solid to the left, and enters the next triangle through its edge down. */
static fram_status walk(context *ctx, const mesh *m, const mesh_adjacency *adjacency, const uint8_t *above,
                        int32_t first, uint8_t *visited, mesh_rings *out, int32_t *edge)
{
    int32_t h = 3 * first + mesh_edge_up(m, first, above);
    while (!visited[h / 3]) {
        visited[h / 3] = 1;
        if (!array_push(ctx, &out->half_edge, h))
            return FRAM_ERROR_MEMORY;
        int32_t f = adjacency->neighbour.data[h];
        int32_t next = f >= 0 ? 3 * f + mesh_edge_up(m, f, above) : -1;
        if (f < 0 || same_edge(m, next, h) || (visited[f] && f != first)) {
            *edge = h;
            return FRAM_ERROR_INPUT;
        }
        h = next;
    }
    return FRAM_OK;
}

fram_status mesh_rings_build(context *ctx, const mesh *m, const mesh_adjacency *adjacency, const uint8_t *above,
                             mesh_rings *out, int32_t *edge)
{
    *edge = -1;
    array_clear(&out->half_edge);
    array_clear(&out->start);
    uint8_t *visited = memory_array(ctx, (size_t)m->face.count, 1);
    fram_status status = visited && array_push(ctx, &out->start, 0) ? FRAM_OK : FRAM_ERROR_MEMORY;
    for (int32_t f = 0; f < m->face.count && status == FRAM_OK; f++) {
        if (visited[f] || mesh_edge_up(m, f, above) < 0)
            continue;
        status = walk(ctx, m, adjacency, above, f, visited, out, edge);
        if (status == FRAM_OK && !array_push(ctx, &out->start, out->half_edge.count))
            status = FRAM_ERROR_MEMORY;
    }
    memory_free(ctx, visited);
    return status;
}

void mesh_rings_free(context *ctx, mesh_rings *r)
{
    array_free(ctx, &r->half_edge);
    array_free(ctx, &r->start);
}

fram_status mesh_open_error(const mesh *m, int32_t half_edge, fram_error *error)
{
    int32_t a = half_edge_from(m, half_edge), b = half_edge_to(m, half_edge);
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL,
                     "the surface is not closed, or turns over, at the edge between vertices %d and %d of triangle %d",
                     a, b, half_edge / 3);
}

/* Where a half-edge that runs up meets the level.  A vertex on the level counts as above and is its own crossing. */
static vec2 level_crossing(const mesh *m, int32_t h, double level)
{
    vec3 low = m->vertex.data[half_edge_from(m, h)], high = m->vertex.data[half_edge_to(m, h)];
    vec3 p = segment_crossing(low, low.z - level, high, high.z - level);
    return (vec2){p.x, p.y};
}

/* The points of ring i without repetition; false: no memory. */
static bool ring_points(context *ctx, const mesh *m, const mesh_rings *rings, int32_t i, double level, vec2_array *out)
{
    array_clear(out);
    for (int32_t k = rings->start.data[i]; k < rings->start.data[i + 1]; k++) {
        vec2 p = level_crossing(m, rings->half_edge.data[k], level);
        if (out->count && out->data[out->count - 1].x == p.x && out->data[out->count - 1].y == p.y)
            continue;
        if (!array_push(ctx, out, p))
            return false;
    }
    while (out->count > 1 && out->data[0].x == out->data[out->count - 1].x &&
           out->data[0].y == out->data[out->count - 1].y)
        out->count--;
    return true;
}

static bool push_rings(context *ctx, const mesh *m, const mesh_rings *rings, double level, polygon_list *out)
{
    vec2_array points = {0};
    bool done = true;
    for (int32_t i = 0; done && i < mesh_rings_count(rings); i++) {
        done = ring_points(ctx, m, rings, i, level, &points);
        polygon ring = {points.data, points.count};
        if (done && ring.count >= 3 && polygon_area(ring) != 0)
            done = polygon_list_push(ctx, out, ring);
    }
    array_free(ctx, &points);
    return done;
}

fram_status mesh_section_along(context *ctx, const mesh *m, const mesh_adjacency *adjacency, double level,
                               polygon_list *out, fram_error *error)
{
    mesh_rings rings = {0};
    int32_t edge = -1;
    uint8_t *above = memory_array(ctx, (size_t)m->vertex.count, 1);
    for (int32_t i = 0; above && i < m->vertex.count; i++)
        above[i] = m->vertex.data[i].z >= level;
    fram_status status = above ? mesh_rings_build(ctx, m, adjacency, above, &rings, &edge) : FRAM_ERROR_MEMORY;
    if (status == FRAM_OK && !push_rings(ctx, m, &rings, level, out))
        status = FRAM_ERROR_MEMORY;
    mesh_rings_free(ctx, &rings);
    memory_free(ctx, above);
    if (edge >= 0)
        mesh_open_error(m, edge, error);
    return status == FRAM_ERROR_MEMORY ? error_memory(error) : status;
}

fram_status mesh_section(context *ctx, const mesh *m, double level, polygon_list *out, fram_error *error)
{
    mesh_adjacency adjacency = {0};
    fram_status status = mesh_adjacency_build(ctx, m, &adjacency);
    status = status == FRAM_OK ? mesh_section_along(ctx, m, &adjacency, level, out, error) : error_memory(error);
    mesh_adjacency_free(ctx, &adjacency);
    return status;
}
