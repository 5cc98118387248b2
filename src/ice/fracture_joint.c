/* Loads near each other on the same ice bend its edge together (docs/decisions/0564): moments of a plate add up, and
   what a load makes at another's place falls with the way along the edge as under an even load (ice/edge_way.h). */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"
#include "ice/strip.h"

#include <stdlib.h>

/* Characteristic lengths beyond which a load bends an edge by less than a twentieth of what it does under itself. */
static const double NEAR = 3;

static int32_t ice_of_load(const fracture_load *l) { return l->tile ? -1 : l->body; }

static int compare_joint(const void *a, const void *b)
{
    const joint_load *x = a, *y = b;
    if (x->ice != y->ice)
        return x->ice < y->ice ? -1 : 1;
    return x->load < y->load ? -1 : x->load > y->load;
}

bool fracture_note_joint(const fracture_job *j)
{
    load_work *w = &j->scratch->load;
    array_clear(&w->joint);
    for (int32_t i = 0; i < w->all.count && j->settings->joint_loads; i++)
        if (!array_push(j->ctx, &w->joint, ((joint_load){ice_of_load(&w->all.data[i]), i})))
            return false;
    if (w->joint.count > 1)
        qsort(w->joint.data, (size_t)w->joint.count, sizeof *w->joint.data, compare_joint);
    return true;
}

/* The first of the loads on this ice. */
static int32_t first_on(const load_work *w, int32_t ice)
{
    int32_t lo = 0, hi = w->joint.count;
    while (lo < hi) {
        int32_t mid = lo + (hi - lo) / 2;
        if (w->joint.data[mid].ice < ice)
            lo = mid + 1;
        else
            hi = mid;
    }
    return lo;
}

static double length_of(const fracture_job *j, const fracture_load *l)
{
    return ice_characteristic_length(&l->ice, l->thickness, j->settings->water_density, j->settings->gravity);
}

/* Half of what a load is wide in any direction [m]. */
static double half_of(const fracture_load *l) { return sqrt(3 * (l->spread[0] + l->spread[2])); }

/* How far from each other the middles of two loads may be that are near. */
static double reach_of(const fracture_job *j, const fracture_load *l, const fracture_load *other)
{
    return NEAR * length_of(j, l) + half_of(l) + half_of(other);
}

/* Row `at` of the sorted loads, if it is another one than `l` that is near; NULL: it is none. */
static const fracture_load *near_load(const fracture_job *j, int32_t at, const fracture_load *l, double *reach)
{
    const load_work *w = &j->scratch->load;
    const fracture_load *other = &w->all.data[w->joint.data[at].load];
    *reach = reach_of(j, l, other);
    return other != l && vec2_length(vec2_sub(other->place, l->place)) < *reach ? other : NULL;
}

double fracture_near_force(const fracture_job *j, const fracture_load *l)
{
    const load_work *w = &j->scratch->load;
    double sum = 0, reach;
    int32_t ice = ice_of_load(l);
    for (int32_t i = first_on(w, ice); i < w->joint.count && w->joint.data[i].ice == ice; i++) {
        const fracture_load *other = near_load(j, i, l, &reach);
        sum += other ? other->force : 0;
    }
    return sum;
}

/* The boundary around a load's start: of a sheet as far as loads are near, of a floe all of it. */
static fram_status find_line(const fracture_job *j, const fracture_load *l, double reach)
{
    tile_segment_array *line = &j->scratch->load.line;
    array_clear(line);
    if (l->tile)
        return fracture_sheet_boundary(j, l->start.point, reach, line);
    polygon p = shape_outline(j->state->shapes, j->state->bodies->shape[l->body]);
    for (int32_t i = 0; i < p.count; i++) {
        vec2 a = p.vertex[i], b = p.vertex[i + 1 < p.count ? i + 1 : 0], e = vec2_sub(b, a);
        double length = vec2_length(e);
        if (length > 0 && !array_push(j->ctx, line, ((tile_segment){a, b, {-e.y / length, e.x / length}})))
            return error_memory(j->error);
    }
    return FRAM_OK;
}

/* The boundary, and the ways along it to the farthest that may be near. */
static fram_status find_arcs(const fracture_job *j, const fracture_load *l)
{
    load_work *w = &j->scratch->load;
    double most = 0, reach, snap = CRACK_CORNER_REACH * l->stress.breaking_radius;
    int32_t ice = ice_of_load(l);
    for (int32_t i = first_on(w, ice); i < w->joint.count && w->joint.data[i].ice == ice; i++)
        most = near_load(j, i, l, &reach) ? fmax(most, reach) : most;
    fram_status status = find_line(j, l, most);
    if (status != FRAM_OK)
        return status;
    return edge_arcs(j->ctx, &w->line, l->start.point, snap, most, &w->arcs) ? FRAM_OK : error_memory(j->error);
}

/* The loads that are near along the edge. */
static fram_status find_parts(const fracture_job *j, const fracture_load *l)
{
    load_work *w = &j->scratch->load;
    int32_t ice = ice_of_load(l), segment;
    array_clear(&w->beside);
    fram_status status = find_arcs(j, l);
    for (int32_t i = first_on(w, ice); status == FRAM_OK && i < w->joint.count && w->joint.data[i].ice == ice; i++) {
        double reach;
        const fracture_load *other = near_load(j, i, l, &reach);
        double way = other ? edge_way(&w->line, &w->arcs, other->place, &segment) : HUGE_VAL;
        if (!(fabs(way) < reach))
            continue;
        joint_part p = {.load = w->joint.data[i].load,
                        .force = other->vector.z * l->vector.z < 0 ? -other->force : other->force,
                        .width = fracture_contact_width(j, other, w->line.data[segment].normal),
                        .way = way};
        if (!array_push(j->ctx, &w->beside, p))
            status = error_memory(j->error);
    }
    return status;
}

/* Loads of the edge's ice at its strength, by as much over those at rest as inertia makes; a narrow load's metre is one
   of a long strip. */
static edge_strength strength_of(const fracture_load *l, const edge_stress *s, edge_ice edge)
{
    double h = l->thickness, metre = l->ice.flexural_strength * h * h / 6;
    if (edge.strip > 0)
        metre = s->strip_capacity / edge.strip;
    else
        metre /= strip_solve(HUGE_VAL).moment * s->length * s->inertia;
    return (edge_strength){s->wedge_capacity - s->strip_capacity, metre};
}

/* What the loads that are near add to the bending of the edge at a place along it, over its strength. */
static double share_of_parts(const load_work *w, edge_strength e, double at)
{
    double sum = 0;
    for (int32_t i = 0; i < w->beside.count; i++)
        sum += w->beside.data[i].force * edge_share(e, w->beside.data[i].width, w->beside.data[i].way - at);
    return sum;
}

/* The load that bends the edge most in the middle of load i, which makes `own` there; of those that were looked at. */
static int32_t heaviest(const load_work *w, edge_strength e, int32_t i, double own)
{
    for (int32_t k = 0; k < w->beside.count; k++) {
        const joint_part *p = &w->beside.data[k];
        double share = p->force * edge_share(e, p->width, p->way);
        if (w->all.data[p->load].known && share > own) {
            own = share;
            i = p->load;
        }
    }
    return i;
}

fram_status fracture_join(const fracture_job *j, int32_t load)
{
    load_work *w = &j->scratch->load;
    fracture_load *l = &w->all.data[load];
    const edge_ice edge = w->edges.data[load];
    fram_status status = find_parts(j, l);
    if (status != FRAM_OK)
        return status;
    edge_strength e = strength_of(l, &l->stress, edge);
    fracture_load *worst = &w->all.data[heaviest(w, e, load, l->force * edge_share(e, edge.strip, 0))];
    if (worst != l) { /* the wedges of its ice stand on that one's area, which the ice would break under */
        edge_stress s =
            fracture_edge_stress(j->settings, &l->ice, l->thickness, l->force, worst->horizontal_area, edge);
        e = strength_of(l, &s, edge);
    }
    double end = edge.strip / 2, at_end = l->force * edge_share(e, edge.strip, end);
    double middle = l->force * edge_share(e, edge.strip, 0) + share_of_parts(w, e, 0);
    double most = fmax(middle, at_end + fmax(share_of_parts(w, e, end), share_of_parts(w, e, -end)));
    worst->joint_ratio = fmax(worst->joint_ratio, most);
    l->wedge_ratio = fmin(l->wedge_ratio, most); /* others may lift what it presses down */
    return FRAM_OK;
}
