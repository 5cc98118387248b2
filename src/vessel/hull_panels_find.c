/* Which panel a point of the hull belongs to. */
#include "geometry/mesh_point.h"
#include "vessel/hull_panels.h"

/* What looks along the direction: within about 70 degrees of it. */
static const double FACING = 0.35;

static vec3 nearest_on(const mesh *m, int32_t face, vec3 point)
{
    vec3 c[3];
    mesh_face_points(m, face, c);
    return triangle_nearest_point(c[0], c[1], c[2], point);
}

/* The nearest triangle within `reach`, of those that face `outward` (or of all): the least of equal ones; -1: none. */
static bool search(context *ctx, hull_panels *p, vec3 point, vec3 outward, double least, double reach, int32_t *best)
{
    const box3 box = {vec3_sub(point, vec3_make(reach, reach, reach)), vec3_add(point, vec3_make(reach, reach, reach))};
    double nearest = reach;
    *best = -1;
    if (!mesh_bvh_query(ctx, &p->tree, box, &p->found))
        return false;
    for (int32_t i = 0; i < p->found.count; i++) {
        int32_t face = p->found.data[i];
        vec3 n = mesh_area_vector(&p->triangle, face);
        if (!(vec3_dot(n, outward) >= least * vec3_length(n)))
            continue;
        double way = vec3_length(vec3_sub(nearest_on(&p->triangle, face, point), point));
        if (way < nearest) {
            nearest = way;
            *best = face;
        }
    }
    return true;
}

bool hull_panel_at(context *ctx, hull_panels *p, vec3 point, vec3 outward, int32_t *panel)
{
    box3 box = p->bounds;
    double whole = vec3_length(vec3_sub(box.hi, box.lo)) + vec3_length(vec3_sub(point, box.lo));
    int32_t face = -1;
    bool good = true;
    *panel = -1;
    /* A contact lies in the ice it crushed, centimetres to a few metres from the surface. */
    for (double reach = 0.01 * whole; face < 0 && reach <= whole && good; reach *= 4)
        good = search(ctx, p, point, outward, FACING, reach, &face);
    if (good && face < 0)
        good = search(ctx, p, point, outward, -2, 2 * whole, &face);
    if (good && face >= 0)
        *panel = p->triangle_panel.data[face];
    return good;
}
