/* The outer skin of a hull, and halves of hulls; see hull_skin.h. */
#include "io/hull_skin.h"

#include "geometry/mesh_parts.h"
#include "geometry/mesh_repair.h"
#include "io/hull_top.h"

#include <math.h>

/* ---- the outer skin ---- */

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

/* ---- halves ---- */

/* The planes of `may_end` in which an edge lies. */
static int planes_of(vec3 a, vec3 b, int may_end, double tolerance)
{
    int x = fmax(fabs(a.x), fabs(b.x)) <= tolerance ? HULL_HALF_X : 0;
    int y = fmax(fabs(a.y), fabs(b.y)) <= tolerance ? HULL_HALF_Y : 0;
    return (x | y) & may_end;
}

/* The planes of `may_end` in which edges are open, not counting those of an open top; none where others are open.  An
   edge in both planes is one of either. */
static int find_planes(const mesh *m, const mesh_adjacency *adjacency, int may_end, double top, double tolerance)
{
    int found = 0;
    for (int32_t h = 0; h < adjacency->neighbour.count; h++) {
        if (adjacency->neighbour.data[h] >= 0)
            continue;
        vec3 a = m->vertex.data[m->face.data[h / 3].v[h % 3]];
        vec3 b = m->vertex.data[m->face.data[h / 3].v[(h % 3 + 1) % 3]];
        int planes = planes_of(a, b, may_end, tolerance);
        if (fmin(a.z, b.z) >= hull_top_low(top, tolerance))
            continue;
        if (planes == 0)
            return 0;
        found |= planes == HULL_QUARTER ? 0 : planes;
    }
    return found;
}

bool hull_find_half(context *ctx, const mesh *m, double tolerance, hull_half *half)
{
    box3 box = mesh_bounds(m);
    int may_end = (box.lo.x < -tolerance && box.hi.x > tolerance ? 0 : HULL_HALF_X) |
                  (box.lo.y < -tolerance && box.hi.y > tolerance ? 0 : HULL_HALF_Y);
    *half = HULL_WHOLE;
    if (may_end == 0)
        return true;
    mesh_adjacency adjacency = {0};
    bool done = mesh_adjacency_build(ctx, m, &adjacency) == FRAM_OK;
    if (done)
        *half = (hull_half)find_planes(m, &adjacency, may_end, box.hi.z, tolerance);
    mesh_adjacency_free(ctx, &adjacency);
    return done;
}

const char *hull_half_words(hull_half half)
{
    static const char *const words[] = {
        [HULL_WHOLE] = "a whole hull",
        [HULL_HALF_X] = "half a hull, or one without its end, open along x = 0",
        [HULL_HALF_Y] = "half a hull, open along its centre plane y = 0",
        [HULL_QUARTER] = "a quarter of a hull, open along x = 0 and y = 0",
    };
    return words[half];
}

/* ---- wells ---- */

bool hull_find_well(context *ctx, const mesh *m, double *part)
{
    box3 box = mesh_bounds(m);
    double level = box.lo.z < 0 && box.hi.z > 0 ? 0 : 0.5 * (box.lo.z + box.hi.z), round = 0, holes = 0;
    polygon_list rings = {0};
    fram_status status = mesh_section(ctx, m, level, &rings, NULL);
    for (int32_t i = 0; i < polygon_list_count(&rings) && status == FRAM_OK; i++) {
        double area = polygon_area(polygon_list_get(&rings, i));
        round += fmax(area, 0);
        holes += fmax(-area, 0);
    }
    polygon_list_free(ctx, &rings);
    *part = round > 0 ? holes / round : 0;
    return status != FRAM_ERROR_MEMORY;
}
