/* Joining vertices.  Knows nothing of what a file left apart. */
#include "geometry/point_grid.h"

static bool finite_point(vec3 p) { return isfinite(p.x) && isfinite(p.y) && isfinite(p.z); }

static box3 finite_bounds(const mesh *m)
{
    box3 b = box3_empty();
    for (int32_t i = 0; i < m->vertex.count; i++)
        if (finite_point(m->vertex.data[i]))
            b = box3_add(b, m->vertex.data[i]);
    return b.lo.x <= b.hi.x ? b : (box3){{0, 0, 0}, {0, 0, 0}};
}

/* new_index[i]: the vertex that vertex i becomes; grid_index: the vertex that a point of the grid is; both have room
   for all. Vertices that are not finite stay alone. */
static bool join_vertices(context *ctx, const mesh *m, point_grid *grid, int32_t *grid_index, int32_t *new_index)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < m->vertex.count; i++) {
        vec3 p = m->vertex.data[i];
        bool finite = finite_point(p);
        int32_t twin = finite ? point_grid_find(grid, p) : -1;
        if (twin >= 0) {
            new_index[i] = grid_index[twin];
            continue;
        }
        if (finite) {
            grid_index[grid->point.count] = kept;
            if (!point_grid_add(ctx, grid, p))
                return false;
        }
        new_index[i] = kept++;
    }
    return true;
}

static void renumber(mesh *m, const int32_t *new_index, int32_t *joined)
{
    int32_t kept = 0, faces = 0;
    for (int32_t i = 0; i < m->vertex.count; i++)
        if (new_index[i] == kept)
            m->vertex.data[kept++] = m->vertex.data[i];
    for (int32_t f = 0; f < m->face.count; f++) {
        const int32_t *v = m->face.data[f].v;
        int32_t a = new_index[v[0]], b = new_index[v[1]], c = new_index[v[2]];
        if (a != b && b != c && c != a)
            m->face.data[faces++] = (triangle){{a, b, c}};
    }
    *joined = m->vertex.count - kept;
    m->vertex.count = kept;
    m->face.count = faces;
}

fram_status mesh_weld(context *ctx, mesh *m, double distance, int32_t *joined)
{
    *joined = 0;
    point_grid grid;
    int32_t *grid_index = memory_array(ctx, (size_t)m->vertex.count, sizeof *grid_index);
    int32_t *new_index = memory_array(ctx, (size_t)m->vertex.count, sizeof *new_index);
    bool done = point_grid_init(ctx, &grid, finite_bounds(m), distance, m->vertex.count);
    done = done && grid_index && new_index && join_vertices(ctx, m, &grid, grid_index, new_index);
    if (done)
        renumber(m, new_index, joined);
    point_grid_free(ctx, &grid);
    memory_free(ctx, grid_index);
    memory_free(ctx, new_index);
    return done ? FRAM_OK : FRAM_ERROR_MEMORY;
}
