/* Work on lists of convex cells; see field_cells.h. */
#include "ice/field_cells.h"

/* Corners whose edges turn by less are left alone (sine of the turn). */
static const double STRAIGHT_CORNER = 0.05;

/* Area that counts as met, relative; and the steps after which rounding must be all that is left. */
static const double AREA_MET = 1e-12;
enum { MOST_STEPS = 60 };

/* Vertices nearer than this part of the perimeter are one: three lines that meet in a point, but for rounding. */
static const double SAME_VERTEX = 1e-10;

/* Turn between two neighbouring tangents of a grown corner at most: cosine of a little less than 45 degrees, so that
   rounding does not decide whether the halves of a right angle are halved again. */
static const double TANGENT_TURN = 0.7072;

void cells_scratch_free(context *ctx, cells_scratch *s)
{
    array_free(ctx, &s->a);
    array_free(ctx, &s->b);
    array_free(ctx, &s->rest);
}

static polygon view(const vec2_array *a) { return (polygon){a->data, a->count}; }

static vec2 ring_vertex(polygon p, int32_t i) { return p.vertex[i < 0 ? i + p.count : i >= p.count ? i - p.count : i]; }

/* Unit outward normal of the edge from a to b; zero for an edge without length. */
static vec2 edge_normal(vec2 a, vec2 b)
{
    vec2 e = vec2_sub(b, a);
    double length = vec2_length(e);
    return length > 0 ? (vec2){e.y / length, -e.x / length} : (vec2){0, 0};
}

fram_status field_area_check(box2 domain, double concentration, const polygon_list *zones, double margin,
                             fram_error *error)
{
    vec2 size = vec2_sub(domain.hi, domain.lo);
    if (!(size.x > 0 && size.y > 0 && size.x * size.y < HUGE_VAL))
        return error_value(error, "domain", "an area over 0 m2", size.x * size.y);
    if (!(concentration > 0 && concentration < 1))
        return error_value(error, "concentration", "a number over 0 and under 1", concentration);
    if (!(margin >= 0 && margin < HUGE_VAL))
        return error_value(error, "keep_out_margin", "a distance of 0 m or more", margin);
    for (int32_t i = 0; zones && i < polygon_list_count(zones); i++) {
        polygon zone = polygon_list_get(zones, i);
        if (!(polygon_area(zone) > 0) || !polygon_is_convex(zone))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "keep_out",
                             "zone %d must be convex, counter-clockwise and have an area; cut it into convex zones", i);
    }
    return FRAM_OK;
}

fram_status field_room_check(double free_area, fram_error *error)
{
    if (free_area > 0)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "keep_out",
                     "no water is left for ice beside the vessels and the zones without ice: make the domain larger or "
                     "the zones smaller");
}

fram_status field_width_check(box2 domain, double largest, fram_error *error)
{
    double narrow = fmin(domain.hi.x - domain.lo.x, domain.hi.y - domain.lo.y);
    if (!(largest > narrow))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "domain",
                     "the largest floe drawn is %g m across and the domain only %g m wide; make the domain larger or "
                     "the floes smaller",
                     largest, narrow);
}

/* ---- zones ---- */

/* Corners of tangents to the circle of `margin` about v, whose normals turn from n1 to n2 counter-clockwise. */
static bool grow_corner(context *ctx, vec2 v, vec2 n1, vec2 n2, double margin, vec2_array *out)
{
    double cosine = vec2_dot(n1, n2);
    if (cosine >= TANGENT_TURN)
        return array_push(ctx, out, vec2_add(v, vec2_scale(vec2_add(n1, n2), margin / (1 + cosine))));
    /* A spike turns by nearly half a circle: there the sum of both normals says nothing. */
    vec2 middle = cosine > -0.999 ? vec2_add(n1, n2) : vec2_perp(n1);
    middle = vec2_scale(middle, 1 / vec2_length(middle));
    return grow_corner(ctx, v, n1, middle, margin, out) && grow_corner(ctx, v, middle, n2, margin, out);
}

static bool zone_grow(context *ctx, polygon zone, double margin, vec2_array *out)
{
    array_clear(out);
    vec2 before = {0, 0};
    for (int32_t i = zone.count - 1; i >= 0 && vec2_dot(before, before) == 0; i--)
        before = edge_normal(zone.vertex[i], ring_vertex(zone, i + 1));
    for (int32_t i = 0; i < zone.count; i++) {
        vec2 after = edge_normal(zone.vertex[i], ring_vertex(zone, i + 1));
        if (vec2_dot(after, after) == 0)
            continue;
        if (!grow_corner(ctx, zone.vertex[i], before, after, margin, out))
            return false;
        before = after;
    }
    return true;
}

bool zones_grow(context *ctx, const polygon_list *zones, double margin, polygon_list *out)
{
    vec2_array grown = {0};
    bool done = true;
    for (int32_t i = 0; done && i < polygon_list_count(zones); i++) {
        polygon zone = polygon_list_get(zones, i);
        if (margin > 0) {
            done = zone_grow(ctx, zone, margin, &grown);
            zone = view(&grown);
        }
        done = done && polygon_list_push(ctx, out, zone);
    }
    array_free(ctx, &grown);
    return done;
}

/* ---- parts outside zones ---- */

static bool boxes_apart(box2 a, box2 b)
{
    return a.hi.x <= b.lo.x || b.hi.x <= a.lo.x || a.hi.y <= b.lo.y || b.hi.y <= a.lo.y;
}

/* The edge of the zone with most of p outside it, -1 when nothing is outside any. */
static bool widest_side(context *ctx, polygon p, polygon zone, vec2_array *scratch, int32_t *edge)
{
    double most = 0;
    *edge = -1;
    for (int32_t i = 0; i < zone.count; i++) {
        vec2 n = edge_normal(zone.vertex[i], ring_vertex(zone, i + 1));
        if (!polygon_clip_half_plane(ctx, p, vec2_scale(n, -1), -vec2_dot(n, zone.vertex[i]), scratch))
            return false;
        double area = scratch->count >= 3 ? polygon_area(view(scratch)) : 0;
        if (area > most) {
            most = area;
            *edge = i;
        }
    }
    return true;
}

/* Appends the convex parts of p outside one zone. */
static bool part_outside_zone(context *ctx, polygon p, polygon zone, cells_scratch *s, polygon_list *out)
{
    if (boxes_apart(polygon_bounds(p), polygon_bounds(zone)))
        return polygon_list_push(ctx, out, p);
    array_clear(&s->rest);
    for (int32_t i = 0; i < p.count; i++)
        if (!array_push(ctx, &s->rest, p.vertex[i]))
            return false;
    /* Each turn takes off what lies outside one edge, and no edge has anything outside it twice. */
    for (int32_t turn = 0; turn < zone.count && s->rest.count >= 3; turn++) {
        int32_t edge;
        if (!widest_side(ctx, view(&s->rest), zone, &s->a, &edge))
            return false;
        if (edge < 0)
            break;
        vec2 n = edge_normal(zone.vertex[edge], ring_vertex(zone, edge + 1));
        double offset = vec2_dot(n, zone.vertex[edge]);
        if (!polygon_clip_half_plane(ctx, view(&s->rest), vec2_scale(n, -1), -offset, &s->a) ||
            !polygon_list_push(ctx, out, view(&s->a)) ||
            !polygon_clip_half_plane(ctx, view(&s->rest), n, offset, &s->b))
            return false;
        vec2_array swap = s->rest;
        s->rest = s->b;
        s->b = swap;
    }
    return true;
}

/* Cells between two questions whether to go on: a single floe asks nothing. */
enum { CELLS_A_WORD = 256 };

fram_status cells_outside_zones(context *ctx, const polygon_list *cells, const polygon_list *zones, cells_scratch *s,
                                polygon_list *out, fram_error *error)
{
    polygon_list parts = {0}, next = {0};
    fram_status status = FRAM_OK;
    bool done = true;
    int32_t count = polygon_list_count(cells);
    for (int32_t i = 0; done && status == FRAM_OK && i < count; i++) {
        if (i % CELLS_A_WORD == CELLS_A_WORD - 1)
            status = work_continue(ctx, "cutting cells at open water", i, count, error);
        polygon_list_clear(&parts);
        polygon cell = polygon_list_get(cells, i);
        done = cell.count < 3 || polygon_list_push(ctx, &parts, cell);
        for (int32_t z = 0; done && z < polygon_list_count(zones); z++) {
            polygon_list_clear(&next);
            for (int32_t k = 0; done && k < polygon_list_count(&parts); k++)
                done = part_outside_zone(ctx, polygon_list_get(&parts, k), polygon_list_get(zones, z), s, &next);
            polygon_list swap = parts;
            parts = next;
            next = swap;
        }
        for (int32_t k = 0; done && k < polygon_list_count(&parts); k++)
            done = polygon_list_push(ctx, out, polygon_list_get(&parts, k));
    }
    polygon_list_free(ctx, &parts);
    polygon_list_free(ctx, &next);
    return done ? status : error_memory(error);
}

double cells_area(const polygon_list *cells)
{
    double area = 0;
    for (int32_t i = 0; i < polygon_list_count(cells); i++) {
        polygon p = polygon_list_get(cells, i);
        area += p.count >= 3 ? polygon_area(p) : 0;
    }
    return area;
}

/* ---- corners ---- */

/* Longest cut along an edge, in halves of the shorter edge at a corner: under 1, so that a bit of every edge stays. */
static const double LONGEST_CUT = 0.8;

/* How a corner is cut: unit directions from it along both edges, half the shorter edge, the sine between them. */
typedef struct corner {
    vec2 back, forth;
    double reach, sine;
} corner;

static corner corner_at(polygon p, int32_t i)
{
    vec2 back = vec2_sub(ring_vertex(p, i - 1), p.vertex[i]), forth = vec2_sub(ring_vertex(p, i + 1), p.vertex[i]);
    double back_length = vec2_length(back), forth_length = vec2_length(forth);
    if (!(back_length > 0 && forth_length > 0))
        return (corner){{0, 0}, {0, 0}, 0, 0};
    back = vec2_scale(back, 1 / back_length);
    forth = vec2_scale(forth, 1 / forth_length);
    return (corner){back, forth, fmin(back_length, forth_length) / 2, vec2_cross(forth, back)};
}

/* Cutting every corner back along both edges by `part` of half the shorter one takes part^2 times this area [m2]. */
static double cells_corner_area(const polygon_list *cells)
{
    double area = 0;
    for (int32_t i = 0; i < polygon_list_count(cells); i++) {
        polygon p = polygon_list_get(cells, i);
        for (int32_t k = 0; k < p.count; k++) {
            corner c = corner_at(p, k);
            if (c.sine > STRAIGHT_CORNER)
                area += c.reach * c.reach * c.sine / 2;
        }
    }
    return area;
}

/* The cells with their corners cut so; one ring per cell. */
static fram_status cells_cut_corners(context *ctx, const polygon_list *cells, double part, cells_scratch *s,
                                     polygon_list *out, fram_error *error)
{
    int32_t count = polygon_list_count(cells);
    for (int32_t i = 0; i < count; i++) {
        if (i % CELLS_A_WORD == CELLS_A_WORD - 1) {
            fram_status status = work_continue(ctx, "cutting corners", i, count, error);
            if (status != FRAM_OK)
                return status;
        }
        polygon p = polygon_list_get(cells, i);
        array_clear(&s->a);
        for (int32_t k = 0; k < p.count; k++) {
            corner c = corner_at(p, k);
            double length = part * c.reach;
            bool cut = length > 0 && c.sine > STRAIGHT_CORNER;
            if (!array_push(ctx, &s->a, vec2_add(p.vertex[k], vec2_scale(c.back, cut ? length : 0))) ||
                (cut && !array_push(ctx, &s->a, vec2_add(p.vertex[k], vec2_scale(c.forth, length)))))
                return error_memory(error);
        }
        if (!polygon_list_push(ctx, out, view(&s->a)))
            return error_memory(error);
    }
    return FRAM_OK;
}

/* ---- moving edges inwards ---- */

/* p with every edge moved inwards, left in s->a; empty when nothing is left. */
static bool inset_ring(context *ctx, polygon p, double inset, cells_scratch *s)
{
    array_clear(&s->a);
    for (int32_t i = 0; i < p.count; i++)
        if (!array_push(ctx, &s->a, p.vertex[i]))
            return false;
    for (int32_t i = 0; i < p.count && s->a.count > 0 && inset > 0; i++) {
        vec2 n = edge_normal(p.vertex[i], ring_vertex(p, i + 1));
        if (vec2_dot(n, n) == 0)
            continue;
        if (!polygon_clip_half_plane(ctx, view(&s->a), n, vec2_dot(n, p.vertex[i]) - inset, &s->b))
            return false;
        vec2_array swap = s->a;
        s->a = s->b;
        s->b = swap;
    }
    return true;
}

/* Drops vertices that differ from the one before by rounding only. */
static void join_vertices(vec2_array *ring)
{
    double least = SAME_VERTEX * polygon_perimeter(view(ring));
    int32_t kept = 0;
    for (int32_t i = 0; i < ring->count; i++)
        if (vec2_length(vec2_sub(ring->data[i], ring->data[kept > 0 ? kept - 1 : ring->count - 1])) > least)
            ring->data[kept++] = ring->data[i];
    ring->count = kept >= 3 ? kept : 0;
}

static fram_status inset_all(context *ctx, const polygon_list *cells, double inset, cells_scratch *s, polygon_list *out,
                             double *area, double *perimeter, fram_error *error)
{
    int32_t count = polygon_list_count(cells);
    polygon_list_clear(out);
    *area = *perimeter = 0;
    for (int32_t i = 0; i < count; i++) {
        fram_status status = work_continue(ctx, "shrinking cells to floes", i, count, error);
        if (status != FRAM_OK)
            return status;
        if (!inset_ring(ctx, polygon_list_get(cells, i), inset, s))
            return error_memory(error);
        join_vertices(&s->a);
        if (s->a.count >= 3) {
            *area += polygon_area(view(&s->a));
            *perimeter += polygon_perimeter(view(&s->a));
        }
        if (!polygon_list_push(ctx, out, view(&s->a)))
            return error_memory(error);
    }
    return FRAM_OK;
}

/* Every edge of every cell moved inwards by the one distance `inset` [m] that leaves `target` area [m2], at most the
   area there is.  out is made anew, one ring per cell, of 0 vertices where nothing is left. */
static fram_status cells_inset_to_area(context *ctx, const polygon_list *cells, double target, cells_scratch *s,
                                       polygon_list *out, double *inset, fram_error *error)
{
    /* The area of a convex cell falls with the inset at the rate of its perimeter, which falls too: Newton's method
       from zero comes from one side and cannot overshoot. */
    double area, perimeter;
    *inset = 0;
    for (int step = 0; step < MOST_STEPS; step++) {
        fram_status status = inset_all(ctx, cells, *inset, s, out, &area, &perimeter, error);
        if (status != FRAM_OK)
            return status;
        if (!(area - target > AREA_MET * target) || !(perimeter > 0))
            break;
        *inset += (area - target) / perimeter;
    }
    return FRAM_OK;
}

fram_status cells_shrink(context *ctx, const polygon_list *cells, double corners, double target, cells_scratch *s,
                         polygon_list *cut, polygon_list *out, double *inset, fram_error *error)
{
    double most = cells_corner_area(cells), wanted = corners * (cells_area(cells) - target);
    double part = most > 0 && wanted > 0 ? sqrt(wanted / most) : 0;
    polygon_list_clear(cut);
    fram_status status = cells_cut_corners(ctx, cells, fmin(part, LONGEST_CUT), s, cut, error);
    if (status != FRAM_OK)
        return status;
    return cells_inset_to_area(ctx, cut, target, s, out, inset, error);
}

fram_status cells_area_outside(context *ctx, polygon whole, const polygon_list *zones, double *area, fram_error *error)
{
    polygon_list domain = {0}, parts = {0};
    cells_scratch scratch = {0};
    fram_status status = polygon_list_push(ctx, &domain, whole) ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK)
        status = cells_outside_zones(ctx, &domain, zones, &scratch, &parts, error);
    *area = status == FRAM_OK ? cells_area(&parts) : 0;
    polygon_list_free(ctx, &domain);
    polygon_list_free(ctx, &parts);
    cells_scratch_free(ctx, &scratch);
    return status;
}
