#include "sim/patch_area.h"

int32_t patch_area_points(const world *w, int32_t patch, vec3 own, vec3 out[PATCH_AREA_POINTS])
{
    out[0] = own;
    if (patch < 0)
        return 1;
    const crushing_patch *p = &w->scratch.patches.data[patch];
    const contact *c = &w->scratch.contacts.data[p->contact_first];
    int32_t count = p->contact_count < PATCH_AREA_POINTS ? p->contact_count : PATCH_AREA_POINTS;
    for (int32_t i = 0; i < count; i++)
        out[i] = c[i].point;
    return count;
}

patch_area patch_area_of(const vec3 *point, int32_t count)
{
    /* Points at the half sides over sqrt(3) have the second moments of a rectangle. */
    const double reach = 1.7320508075688772;
    patch_area area = {0};
    for (int32_t i = 0; i < count; i++)
        area.middle = vec3_mad(area.middle, point[i], 1.0 / count);
    vec3 u = vec3_scale(vec3_sub(point[0], area.middle), reach);
    if (count == 2)
        area.a = u;
    for (int32_t i = 1; i < 4 && count == 4; i++) {
        /* Beside the first point, not across from it: half their sum and half their difference are the sides. */
        vec3 v = vec3_scale(vec3_sub(point[i], area.middle), reach);
        if (vec3_length(vec3_add(u, v)) < 1e-6 * vec3_length(u))
            continue;
        area.a = vec3_scale(vec3_add(u, v), 0.5);
        area.b = vec3_scale(vec3_sub(u, v), 0.5);
        break;
    }
    return area;
}

patch_area patch_area_part(const patch_area *all, vec3 point)
{
    vec3 u = vec3_sub(point, all->middle);
    vec3 a = vec3_scale(all->a, vec3_dot(u, all->a) < 0 ? -1 : 1);
    vec3 b = vec3_scale(all->b, vec3_dot(u, all->b) < 0 ? -1 : 1);
    return (patch_area){all->middle, a, b};
}

/* ---- zones ---- */

/* Where on a line from `at` (0) along `way` (1) a coordinate passes a limit; 1: beyond it, or never. */
static double crossing(double at, double way, double limit)
{
    double t = way != 0 ? (limit - at) / way : 1;
    return t > 0 && t < 1 ? t : 1;
}

static void put_in_order(double *value, int32_t count)
{
    for (int32_t i = 1; i < count; i++)
        for (int32_t k = i; k > 0 && value[k - 1] > value[k]; k--) {
            double larger = value[k - 1];
            value[k - 1] = value[k];
            value[k] = larger;
        }
}

static void share_line(const hull_zones *z, vec3 at, vec3 way, double part[ZONE_COUNT])
{
    enum { CUTS = 5 };
    double cut[CUTS] = {crossing(at.x, way.x, z->bow), crossing(at.x, way.x, z->shoulder),
                        crossing(at.x, way.x, z->stern), crossing(at.z, way.z, z->bottom), 1};
    put_in_order(cut, CUTS);
    double from = 0;
    for (int i = 0; i < CUTS; i++) {
        part[hull_zone_at(z, vec3_mad(at, way, 0.5 * (from + cut[i])))] += cut[i] - from;
        from = cut[i];
    }
}

void patch_area_zones(const world *w, int32_t vessel, int32_t patch, vec3 point, double part[ZONE_COUNT])
{
    const hull_zones *zones = &w->vessels.zones[vessel];
    vec3 own = vessel_ship_coordinates(&w->vessels, &w->bodies, vessel, point), all[PATCH_AREA_POINTS];
    int32_t count = patch_area_points(w, patch, point, all);
    for (int32_t i = 0; i < count; i++)
        all[i] = vessel_ship_coordinates(&w->vessels, &w->bodies, vessel, all[i]);
    const patch_area whole = patch_area_of(all, count), mine = patch_area_part(&whole, own);
    bool along_a = vec3_dot(mine.a, mine.a) >= vec3_dot(mine.b, mine.b);
    vec3 way = along_a ? mine.a : mine.b, at = vec3_mad(mine.middle, along_a ? mine.b : mine.a, 0.5);
    for (int i = 0; i < ZONE_COUNT; i++)
        part[i] = 0;
    /* Zones are convex: what begins and ends in one lies in it. */
    hull_zone first = hull_zone_at(zones, at);
    if (first == hull_zone_at(zones, vec3_add(at, way)))
        part[first] = 1;
    else
        share_line(zones, at, way, part);
}
