/* Exchanging diagonals; see triangle_flip.h.  In a pass no triangle takes part in two exchanges, so that the neighbours
   found at its beginning hold. */
#include "geometry/triangle_flip.h"

#include "geometry/mesh.h"
#include "geometry/predicate.h"

/* Passes at most: thin ears along a straight run of n vertices take about log n. */
enum { MOST_FLIP_PASSES = 64 };
/* An exchange must better the shape by this part. */
#define LEAST_GAIN 1e-6

/* Height over the longest side, relative to it. */
static double shape(vec2 a, vec2 b, vec2 c)
{
    vec2 ab = vec2_sub(b, a), bc = vec2_sub(c, b), ca = vec2_sub(a, c);
    double longest = fmax(vec2_dot(ab, ab), fmax(vec2_dot(bc, bc), vec2_dot(ca, ca)));
    return longest > 0 ? vec2_cross(ab, vec2_sub(c, a)) / longest : 0;
}

/* Exchange edge k of face f, whose neighbour is g, if that helps. */
static bool exchange(mesh *m, const vec2 *p, int32_t f, int k, const mesh_adjacency *adjacency, int32_t g)
{
    int back = mesh_edge_to(adjacency, g, f);
    if (back < 0)
        return false;
    int32_t *v = m->face.data[f].v, *w = m->face.data[g].v;
    int32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3], d = w[(back + 2) % 3];
    if (c == d || orientation(p[d], p[b], p[c]) <= 0 || orientation(p[c], p[a], p[d]) <= 0)
        return false;
    double now = fmin(shape(p[a], p[b], p[c]), shape(p[b], p[a], p[d]));
    double then = fmin(shape(p[d], p[b], p[c]), shape(p[c], p[a], p[d]));
    if (!(then > now * (1 + LEAST_GAIN)))
        return false;
    m->face.data[f] = (triangle){{d, b, c}};
    m->face.data[g] = (triangle){{c, a, d}};
    return true;
}

static bool pass(mesh *m, const vec2 *p, const mesh_adjacency *adjacency, uint8_t *moved)
{
    bool any = false;
    for (int32_t f = 0; f < m->face.count; f++)
        moved[f] = 0;
    for (int32_t f = 0; f < m->face.count; f++)
        for (int k = 0; k < 3 && !moved[f]; k++) {
            int32_t g = adjacency->neighbour.data[3 * f + k];
            if (g < 0 || moved[g] || !exchange(m, p, f, k, adjacency, g))
                continue;
            moved[f] = moved[g] = 1;
            any = true;
        }
    return any;
}

bool polygon_flip_diagonals(context *ctx, polygon p, index_array *triangles)
{
    mesh m = {0};
    mesh_adjacency adjacency = {0};
    int32_t count = triangles->count / 3;
    uint8_t *moved = memory_array(ctx, (size_t)count + 1, sizeof *moved);
    bool done = moved && array_resize(ctx, &m.vertex, p.count) && array_resize(ctx, &m.face, count);
    for (int32_t f = 0; done && f < count; f++)
        for (int k = 0; k < 3; k++)
            m.face.data[f].v[k] = triangles->data[3 * f + k];
    for (int i = 0; done && i < MOST_FLIP_PASSES; i++) {
        done = mesh_adjacency_build(ctx, &m, &adjacency) == FRAM_OK;
        if (!done || !pass(&m, p.vertex, &adjacency, moved))
            break;
    }
    for (int32_t f = 0; done && f < count; f++)
        for (int k = 0; k < 3; k++)
            triangles->data[3 * f + k] = m.face.data[f].v[k];
    mesh_adjacency_free(ctx, &adjacency);
    mesh_free(ctx, &m);
    memory_free(ctx, moved);
    return done;
}
