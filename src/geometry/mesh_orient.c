/* Turning triangles to agree; see mesh_repair.h. */
#include "geometry/mesh_parts.h"
#include "geometry/mesh_repair.h"

static void turn_face(mesh *m, mesh_adjacency *adjacency, int32_t face)
{
    int32_t *v = m->face.data[face].v, *n = &adjacency->neighbour.data[3 * face];
    int32_t swap = v[1];
    v[1] = v[2];
    v[2] = swap;
    swap = n[0];
    n[0] = n[2];
    n[2] = swap;
}

/* Two faces run along their common edge, edge k of f, in one direction. */
static bool disagree(const mesh *m, int32_t f, int k, int32_t g)
{
    int32_t a = m->face.data[f].v[k], b = m->face.data[f].v[(k + 1) % 3];
    const int32_t *w = m->face.data[g].v;
    return (w[0] == a && w[1] == b) || (w[1] == a && w[2] == b) || (w[2] == a && w[0] == b);
}

/* Everything that hangs together with `seed` turns as it does; false at a part without two sides. */
static bool spread(mesh *m, mesh_adjacency *adjacency, int32_t seed, uint8_t *seen, int32_t *waiting, int32_t *flipped,
                   int32_t *face)
{
    int32_t count = 0;
    waiting[count++] = seed;
    seen[seed] = 1;
    while (count) {
        int32_t f = waiting[--count];
        for (int k = 0; k < 3; k++) {
            int32_t g = adjacency->neighbour.data[3 * f + k];
            if (g < 0)
                continue;
            bool turned = disagree(m, f, k, g);
            if (seen[g] && turned) {
                *face = g;
                return false;
            }
            if (seen[g])
                continue;
            if (turned) {
                turn_face(m, adjacency, g);
                ++*flipped;
            }
            seen[g] = 1;
            waiting[count++] = g;
        }
    }
    return true;
}

static fram_status agree(context *ctx, mesh *m, mesh_adjacency *adjacency, int32_t *flipped, int32_t *face)
{
    uint8_t *seen = memory_array(ctx, (size_t)m->face.count + 1, 1);
    int32_t *waiting = memory_array(ctx, (size_t)m->face.count + 1, sizeof *waiting);
    fram_status status = seen && waiting ? FRAM_OK : FRAM_ERROR_MEMORY;
    for (int32_t f = 0; f < m->face.count && status == FRAM_OK; f++)
        if (!seen[f] && !spread(m, adjacency, f, seen, waiting, flipped, face))
            status = FRAM_ERROR_INPUT;
    memory_free(ctx, waiting);
    memory_free(ctx, seen);
    return status;
}

static void flip_part(mesh *m, mesh_adjacency *adjacency, mesh_parts *parts, int32_t part, int32_t *flipped)
{
    for (int32_t f = 0; f < m->face.count; f++)
        if (parts->of_face.data[f] == part)
            turn_face(m, adjacency, f);
    *flipped += parts->part.data[part].face_count;
    parts->part.data[part].volume = -parts->part.data[part].volume;
}

/* Parts with an open edge have no inside: let them pass for sound in the next search. */
static void pass_open_parts(const mesh_adjacency *adjacency, mesh_parts *parts, bool nested)
{
    for (int32_t h = 0; h < adjacency->neighbour.count; h++)
        if (adjacency->neighbour.data[h] < 0)
            parts->part.data[parts->of_face.data[h / 3]].volume = nested ? -1 : 1;
}

fram_status mesh_orient(context *ctx, mesh *m, int32_t *flipped, int32_t *face)
{
    *flipped = 0;
    *face = -1;
    mesh_adjacency adjacency = {0};
    mesh_parts parts = {0};
    fram_status status = mesh_adjacency_build(ctx, m, &adjacency);
    if (status == FRAM_OK)
        status = agree(ctx, m, &adjacency, flipped, face);
    if (status == FRAM_OK)
        status = mesh_parts_build(ctx, m, &adjacency, &parts);
    /* Outer parts first: whether a part is a cavity depends on what is around it.  A part is turned once a round. */
    for (int nested = 0; nested < 2 && status == FRAM_OK; nested++) {
        pass_open_parts(&adjacency, &parts, nested);
        for (int32_t turns = 0; turns < parts.part.count; turns++) {
            int32_t part = mesh_parts_first_inverted(m, &parts, nested);
            if (part < 0)
                break;
            flip_part(m, &adjacency, &parts, part, flipped);
        }
    }
    mesh_parts_free(ctx, &parts);
    mesh_adjacency_free(ctx, &adjacency);
    return status;
}
