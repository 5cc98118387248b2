/* The outer skin of a hull; see hull_skin.h. */
#include "io/hull_skin.h"

#include "geometry/mesh_parts.h"
#include "geometry/mesh_repair.h"

static bool find_parts(context *ctx, const mesh *m, mesh_parts *out)
{
    mesh_adjacency adjacency = {0};
    bool done =
        mesh_adjacency_build(ctx, m, &adjacency) == FRAM_OK && mesh_parts_build(ctx, m, &adjacency, out) == FRAM_OK;
    mesh_adjacency_free(ctx, &adjacency);
    return done;
}

static bool is_cavity(const mesh_part *p) { return p->volume < 0; }

static int32_t count_cavities(const mesh_parts *parts)
{
    int32_t count = 0;
    for (int32_t i = 0; i < parts->part.count; i++)
        count += is_cavity(&parts->part.data[i]);
    return count;
}

/* Leaves out a part, or all cavities (-1). */
static void drop_parts(mesh *m, const mesh_parts *parts, int32_t part)
{
    int32_t kept = 0;
    for (int32_t f = 0; f < m->face.count; f++) {
        int32_t own = parts->of_face.data[f];
        if (part < 0 ? !is_cavity(&parts->part.data[own]) : own != part)
            m->face.data[kept++] = m->face.data[f];
    }
    m->face.count = kept;
}

bool hull_keep_outer_skin(context *ctx, mesh *m, hull_inside *inside)
{
    mesh_parts parts = {0};
    *inside = (hull_inside){0};
    bool done = find_parts(ctx, m, &parts);
    double before = mesh_solid_properties(m).volume;
    inside->parts = done ? count_cavities(&parts) : 0;
    if (inside->parts > 0)
        drop_parts(m, &parts, -1);
    /* What stood in a cavity lies inside of the hull itself now. */
    while (done && inside->parts > 0) {
        done = find_parts(ctx, m, &parts);
        int32_t part = done ? mesh_parts_first_inverted(m, &parts, true) : -1;
        if (part < 0)
            break;
        drop_parts(m, &parts, part);
        inside->parts++;
    }
    inside->volume = mesh_solid_properties(m).volume - before;
    mesh_parts_free(ctx, &parts);
    return done && (inside->parts == 0 || mesh_drop_unused_vertices(ctx, m));
}
