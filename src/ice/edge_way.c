/* Ways along the edge of the ice; see edge_way.h. */
#include "ice/edge_way.h"

#include "base/transcendental.h"
#include "geometry/predicate.h"

/* The segment nearest to a place, -1 without any; *near gets the point there. */
static int32_t nearest_segment(const tile_segment_array *line, vec2 place, vec2 *near)
{
    double least = HUGE_VAL;
    int32_t best = -1;
    for (int32_t i = 0; i < line->count; i++) {
        const tile_segment *e = &line->data[i];
        if (!segment_may_reach(e->a, e->b, place, least))
            continue;
        vec2 p = segment_nearest(e->a, e->b, place);
        double way = vec2_length(vec2_sub(p, place));
        if (way < least) {
            least = way;
            best = i;
            *near = p;
        }
    }
    return best;
}

/* Angle by which u turns clockwise to v, in (0, 2 pi]. */
static double clockwise(vec2 u, vec2 v)
{
    double angle = real_atan2(-vec2_cross(u, v), vec2_dot(u, v));
    return angle > 0 ? angle : angle + 2 * PI;
}

static vec2 end_of(const tile_segment *e, bool on) { return on ? e->b : e->a; }

/* The segment that follows i on, or back: of those at its end the one next to the ice that i lies along. */
static int32_t segment_after(const tile_segment_array *line, int32_t i, bool on, double snap)
{
    const tile_segment *own = &line->data[i];
    vec2 at = end_of(own, on), back = vec2_sub(end_of(own, !on), at);
    double least = HUGE_VAL;
    int32_t best = -1;
    for (int32_t k = 0; k < line->count; k++) {
        const tile_segment *e = &line->data[k];
        vec2 apart = vec2_sub(end_of(e, !on), at);
        /* Nearly all lie far off. */
        if (k == i || fabs(apart.x) > 2 * snap || !(vec2_length(apart) <= snap))
            continue;
        vec2 away = vec2_sub(end_of(e, on), end_of(e, !on));
        double turn = on ? clockwise(back, away) : clockwise(away, back);
        if (turn < least) {
            least = turn;
            best = k;
        }
    }
    return best;
}

static void walk(const tile_segment_array *line, int32_t first, vec2 start, bool on, double snap, double reach,
                 edge_arc_array *arcs)
{
    double way = vec2_length(vec2_sub(end_of(&line->data[first], on), start));
    int32_t i = first;
    for (int32_t turn = 0; turn < line->count && way < reach; turn++) {
        i = segment_after(line, i, on, snap);
        if (i < 0 || i == first)
            return;
        double *arc = on ? &arcs->data[i].on : &arcs->data[i].back;
        *arc = fmin(*arc, way);
        way += vec2_length(vec2_sub(line->data[i].b, line->data[i].a));
    }
}

bool edge_arcs(context *ctx, const tile_segment_array *line, vec2 start, double snap, double reach,
               edge_arc_array *arcs)
{
    if (!array_resize(ctx, arcs, line->count))
        return false;
    for (int32_t i = 0; i < line->count; i++)
        arcs->data[i] = (edge_arc){HUGE_VAL, HUGE_VAL};
    vec2 near;
    int32_t first = nearest_segment(line, start, &near);
    if (first < 0)
        return true;
    walk(line, first, start, true, snap, reach, arcs);
    walk(line, first, start, false, snap, reach, arcs);
    const tile_segment *own = &line->data[first];
    arcs->data[first] = (edge_arc){-vec2_length(vec2_sub(start, own->a)), -vec2_length(vec2_sub(start, own->b))};
    return true;
}

double edge_way(const tile_segment_array *line, const edge_arc_array *arcs, vec2 place, int32_t *segment)
{
    vec2 near;
    int32_t i = *segment = nearest_segment(line, place, &near);
    if (i < 0)
        return HUGE_VAL;
    double on = arcs->data[i].on + vec2_length(vec2_sub(near, line->data[i].a));
    double back = arcs->data[i].back + vec2_length(vec2_sub(near, line->data[i].b));
    /* On the start's own segment each is the other's opposite. */
    return on <= back || back < 0 ? on : -back;
}

/* Moment at the end of a load of 1 N/m that reaches from there to x along the edge, over the edge's strength. */
static double reach_share(edge_strength e, double x) { return x != 0 ? x / (e.wedges + 2 * e.metre * fabs(x)) : 0; }

double edge_share(edge_strength e, double width, double way)
{
    if (width > 0)
        return (reach_share(e, way + width / 2) - reach_share(e, way - width / 2)) / width;
    double bears = e.wedges + 2 * e.metre * fabs(way);
    return bears > 0 ? e.wedges / (bears * bears) : 0;
}
