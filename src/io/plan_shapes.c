/* How a prism stands in a plan view, which lies over which, which part is to be shown, and what is seen of all. */
#include "io/plan_view.h"

#include "geometry/predicate.h"

#include <math.h>
#include <stdlib.h>

void plan_shape_stand(plan_shape *s, vec3 position, quat orientation, double thickness)
{
    vec3 axis = mat3_column(quat_matrix(orientation), 2);
    double down = axis.z < 0 ? thickness : -thickness;
    s->drop = vec2_make(down * axis.x, down * axis.y);
    s->height = position.z + 0.5 * thickness * fabs(axis.z);
}

static int compare_heights(const void *a, const void *b)
{
    const plan_shape *x = a, *y = b;
    if (x->height != y->height)
        return x->height < y->height ? -1 : 1;
    if (x->style != y->style)
        return x->style < y->style ? -1 : 1;
    return x->outline.vertex < y->outline.vertex ? -1 : x->outline.vertex > y->outline.vertex;
}

void plan_shapes_sort(plan_shape *shapes, int32_t count)
{
    if (count > 1)
        qsort(shapes, (size_t)count, sizeof *shapes, compare_heights);
}

/* Water around a hull outside the usual window, over its larger side. */
#define HULL_MARGIN 0.5
/* How many times the larger side of the usual window one with everything in it may have. */
#define EXTENDED_MOST 4

static box2 boxes_joined(box2 a, box2 b)
{
    return (box2){{fmin(a.lo.x, b.lo.x), fmin(a.lo.y, b.lo.y)}, {fmax(a.hi.x, b.hi.x), fmax(a.hi.y, b.hi.y)}};
}

static bool boxes_meet(box2 a, box2 b)
{
    return a.lo.x < b.hi.x && b.lo.x < a.hi.x && a.lo.y < b.hi.y && b.lo.y < a.hi.y;
}

/* Something of an edge lies inside: their bounds meet, and not all of the box is on one side of the edge's line. */
static bool edge_meets(vec2 a, vec2 b, box2 box)
{
    const vec2 end[2] = {a, b}, corner[4] = {box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
    bool left = false, right = false;
    if (!boxes_meet(polygon_bounds((polygon){end, 2}), box))
        return false;
    for (int i = 0; i < 4; i++) {
        int side = orientation(a, b, corner[i]);
        left = left || side > 0;
        right = right || side < 0;
    }
    return left == right; /* neither: an edge that is a point */
}

/* Something of an outline lies inside: of an edge, or the whole box lies in the outline. */
static bool outline_meets(polygon p, box2 box)
{
    if (!boxes_meet(polygon_bounds(p), box))
        return false;
    for (int32_t i = 0; i < p.count; i++)
        if (edge_meets(p.vertex[i], p.vertex[i + 1 < p.count ? i + 1 : 0], box))
            return true;
    return polygon_contains(p, vec2_scale(vec2_add(box.lo, box.hi), 0.5));
}

/* What a run that came to no numbers leaves is not: fmin and fmax pass over a NaN. */
static bool is_finite(box2 b) { return isfinite(b.lo.x) && isfinite(b.lo.y) && isfinite(b.hi.x) && isfinite(b.hi.y); }

static double larger_side(box2 b) { return fmax(b.hi.x - b.lo.x, b.hi.y - b.lo.y); }

static box2 box_widened(box2 b, double by) { return (box2){{b.lo.x - by, b.lo.y - by}, {b.hi.x + by, b.hi.y + by}}; }

/* As large as the usual one, or as the hull is. */
static box2 window_around(box2 usual, box2 hull)
{
    vec2 middle = vec2_scale(vec2_add(hull.lo, hull.hi), 0.5), half = vec2_scale(vec2_sub(usual.hi, usual.lo), 0.5);
    return boxes_joined((box2){vec2_sub(middle, half), vec2_add(middle, half)}, hull);
}

/* Widened about its middle to the proportions of the usual one: pictures of a run are of one size, and make a film. */
static box2 in_proportion(box2 b, box2 usual)
{
    vec2 middle = vec2_scale(vec2_add(b.lo, b.hi), 0.5), full = vec2_sub(usual.hi, usual.lo);
    double times = fmax((b.hi.x - b.lo.x) / full.x, (b.hi.y - b.lo.y) / full.y);
    vec2 half = vec2_scale(full, 0.5 * times);
    return (box2){vec2_sub(middle, half), vec2_add(middle, half)};
}

static bool is_hull(const plan_shape *s) { return s->style == PLAN_DECK || s->style == PLAN_WATERLINE; }

/* Around all parts of the hull whose owner is the next after *owner, with the water around it; false: no more. */
static bool next_hull(const plan_shape *shapes, int32_t count, int32_t *owner, box2 *hull)
{
    const int32_t after = *owner;
    bool found = false;
    for (int32_t i = 0; i < count; i++) {
        const plan_shape *s = &shapes[i];
        if (!is_hull(s) || s->owner <= after || (found && s->owner > *owner))
            continue;
        box2 part = polygon_bounds(s->outline);
        if (!is_finite(part))
            continue;
        *hull = found && s->owner == *owner ? boxes_joined(*hull, part) : part;
        *owner = s->owner;
        found = true;
    }
    if (found)
        *hull = box_widened(*hull, HULL_MARGIN * larger_side(*hull));
    return found;
}

box2 plan_window(box2 usual, const plan_shape *shapes, int32_t count)
{
    box2 first, next;
    int32_t owner = INT32_MIN;
    for (int32_t i = 0; i < count; i++)
        if (is_hull(&shapes[i]) && outline_meets(shapes[i].outline, usual))
            return usual;
    if (!next_hull(shapes, count, &owner, &first))
        return usual;
    box2 all = boxes_joined(usual, first);
    while (next_hull(shapes, count, &owner, &next))
        all = boxes_joined(all, next);
    all = in_proportion(all, usual);
    bool near = larger_side(all) <= EXTENDED_MOST * larger_side(usual);
    return near ? all : in_proportion(window_around(usual, first), usual);
}

static box2 box_moved(box2 b, vec2 way) { return (box2){vec2_add(b.lo, way), vec2_add(b.hi, way)}; }

/* Of a prism that tilts its upper face, or a side. */
static bool shape_meets(const plan_shape *s, box2 window)
{
    polygon p = s->outline;
    vec2 half = vec2_scale(s->drop, 0.5);
    if (outline_meets(p, box_moved(window, half)))
        return true;
    for (int32_t i = 0; i < p.count && vec2_length(s->drop) > 0; i++) {
        vec2 a = p.vertex[i], b = p.vertex[i + 1 < p.count ? i + 1 : 0];
        const vec2 side[4] = {vec2_sub(a, half), vec2_sub(b, half), vec2_add(b, half), vec2_add(a, half)};
        if (outline_meets((polygon){side, 4}, window))
            return true;
    }
    return false;
}

plan_used plan_find_used(const plan_view *view)
{
    plan_used seen = {.line = false};
    for (int32_t i = 0; i < view->shape_count; i++) {
        const plan_shape *s = &view->shapes[i];
        seen.style[s->style] = seen.style[s->style] || shape_meets(s, view->window);
    }
    for (int32_t i = 0; i < view->line_count; i++)
        seen.line = seen.line || edge_meets(view->lines[i].upper, view->lines[i].anchor, view->window);
    return seen;
}
