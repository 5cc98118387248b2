#include "vessel/approach.h"

#define TABLE_SELF approach_table
TABLE_DEFINE(approach, APPROACH_FIELDS)
#undef TABLE_SELF

/* Least distance from the corners of a ring, moved by `shift`, to the edges of another. */
static double corners_distance(polygon corners, vec2 shift, polygon edges)
{
    double least = HUGE_VAL;
    for (int32_t i = 0; i < corners.count; i++) {
        vec2 at = vec2_add(corners.vertex[i], shift);
        vec2 off = vec2_sub(polygon_nearest_boundary(edges, at, NULL), at);
        least = fmin(least, vec2_dot(off, off));
    }
    return sqrt(least);
}

/* Whether an edge of `p` has all of `q`, moved by `shift`, on its outer side. */
static bool edge_parts(polygon p, polygon q, vec2 shift)
{
    for (int32_t i = 0; i < p.count; i++) {
        vec2 a = p.vertex[i], e = vec2_sub(p.vertex[i + 1 < p.count ? i + 1 : 0], a);
        bool outside = true;
        for (int32_t k = 0; k < q.count && outside; k++)
            outside = vec2_cross(e, vec2_sub(vec2_add(q.vertex[k], shift), a)) < 0;
        if (outside)
            return true;
    }
    return false;
}

/* Distance of two convex outlines, the second moved by `shift`; 0 where they overlap. */
static double distance_at(polygon a, polygon b, vec2 shift)
{
    vec2 back = vec2_scale(shift, -1);
    if (!edge_parts(a, b, shift) && !edge_parts(b, a, back))
        return 0;
    return fmin(corners_distance(b, shift, a), corners_distance(a, back, b));
}

/* What is nearest so close to the end of the look-ahead is so at its end, as a part of it [1]: above the rounding of
   places 1e7 m away at 0.1 mm/s, and below what anybody steers by. */
static const double AT_THE_END = 1e-6;

/* The distance of convex bodies that move straight is a convex function of time, so that halving finds its least
   value; of several least ones the earliest, since equal values drop the later part. */
approach_prediction approach_predict(const approach_hull *a, const approach_hull *b, double look_ahead)
{
    enum { THIRDS = 60 }; /* (2/3)^60 of the look-ahead: rounding */
    vec2 relative = vec2_sub(b->velocity, a->velocity);
    double lo = 0, hi = look_ahead;
    for (int i = 0; i < THIRDS; i++) {
        double first = lo + (hi - lo) / 3, second = hi - (hi - lo) / 3;
        if (distance_at(a->plan, b->plan, vec2_scale(relative, first)) <=
            distance_at(a->plan, b->plan, vec2_scale(relative, second)))
            hi = second;
        else
            lo = first;
    }
    /* Far from the origin distances round, so that equal ones drop the end of an approach that goes on beyond it. */
    if (look_ahead - hi < AT_THE_END * look_ahead)
        hi = look_ahead;
    return (approach_prediction){distance_at(a->plan, b->plan, vec2_scale(relative, hi)), hi,
                                 distance_at(a->plan, b->plan, vec2_make(0, 0))};
}

/* What the last event of the pair predicted [m]. */
static double told_gap(const event_table *events, int32_t vessel, int32_t other)
{
    for (int32_t i = events->count - 1; i >= 0; i--) {
        if (events->kind[i] == EVENT_APPROACH && events->vessel[i] == vessel && events->number[i] == other)
            return events->value[i];
    }
    return HUGE_VAL;
}

static bool tell_approach(context *ctx, const approach_table *t, int32_t row, const approach_prediction *predicted,
                          double time, event_table *events)
{
    if (!event_add(ctx, events, EVENT_APPROACH, time, t->vessel[row], t->other[row], predicted->gap))
        return false;
    events->ahead[events->count - 1] = predicted->time;
    return true;
}

bool approach_book(context *ctx, approach_table *t, int32_t row, const approach_settings *settings,
                   const approach_prediction *predicted, double time, double since, event_table *events)
{
    /* Nothing is nearer than hulls that touch: so they are told with a limit of 0. */
    bool near = predicted->gap < settings->limit || !(predicted->gap > 0), began = near && !t->close[row];
    t->clear_time[row] = near ? 0 : t->clear_time[row] + since;
    t->nearest[row] = began ? predicted->distance : fmin(t->nearest[row], predicted->distance);
    if (began || (near && predicted->gap < APPROACH_NEARER_PART * told_gap(events, t->vessel[row], t->other[row]))) {
        t->close[row] = 1;
        return tell_approach(ctx, t, row, predicted, time, events);
    }
    if (!t->close[row] || t->clear_time[row] < APPROACH_CLEAR_PART * settings->look_ahead)
        return true;
    t->close[row] = 0;
    return event_add(ctx, events, EVENT_APPROACH_OVER, time, t->vessel[row], t->other[row], t->nearest[row]);
}
