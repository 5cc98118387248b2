/* Radial cracks: where they start, which way they run, and floes that split along them (Metrikin 2014, 5.5, Algorithms
   7 and 8, and his checks of the children). */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"

#include <assert.h>

/* ---- the start ---- */

static vec2 edge_vector(polygon p, int32_t i) { return vec2_sub(p.vertex[i + 1 < p.count ? i + 1 : 0], p.vertex[i]); }

/* Inward unit normal of an edge of a counter-clockwise ring. */
static vec2 inward_normal(polygon p, int32_t i)
{
    vec2 e = edge_vector(p, i);
    double length = vec2_length(e);
    return length > 0 ? (vec2){-e.y / length, e.x / length} : (vec2){0, 0};
}

crack_start crack_start_of(polygon p, vec2 load, double snap)
{
    crack_start c;
    c.point = polygon_nearest_boundary(p, load, &c.edge);
    c.distance = vec2_length(vec2_sub(c.point, load));
    int32_t next = c.edge + 1 < p.count ? c.edge + 1 : 0;
    bool at_next = vec2_length(vec2_sub(p.vertex[next], c.point)) <= snap;
    if (at_next)
        c.edge = next;
    c.direction = inward_normal(p, c.edge);
    if (at_next || vec2_length(vec2_sub(p.vertex[c.edge], c.point)) <= snap) {
        c.point = p.vertex[c.edge];
        vec2 mean = vec2_add(c.direction, inward_normal(p, c.edge > 0 ? c.edge - 1 : p.count - 1));
        double length = vec2_length(mean);
        if (length > 0)
            c.direction = vec2_scale(mean, 1 / length);
    }
    return c;
}

/* ---- the way through ---- */

static bool touches_start(polygon p, int32_t i, const crack_start *start)
{
    vec2 a = p.vertex[i], b = p.vertex[i + 1 < p.count ? i + 1 : 0], s = start->point;
    return i == start->edge || (a.x == s.x && a.y == s.y) || (b.x == s.x && b.y == s.y);
}

static bool crack_meets(const crack_start *start, vec2 a, vec2 b, double *length)
{
    vec2 from = vec2_sub(a, start->point), to = vec2_sub(b, start->point);
    double side_a = vec2_cross(start->direction, from), side_b = vec2_cross(start->direction, to);
    if ((side_a > 0) == (side_b > 0))
        return false;
    double share = side_a / (side_a - side_b);
    *length = (1 - share) * vec2_dot(start->direction, from) + share * vec2_dot(start->direction, to);
    return true;
}

void crack_shorten(const crack_start *start, vec2 a, vec2 b, double snap, double *least)
{
    double length;
    if (vec2_length(vec2_sub(segment_nearest(a, b, start->point), start->point)) > snap &&
        crack_meets(start, a, b, &length) && length > 0 && length < *least)
        *least = length;
}

double crack_length(polygon p, const crack_start *start, int32_t *edge)
{
    double least = HUGE_VAL;
    *edge = -1;
    for (int32_t i = 0; i < p.count; i++) {
        if (touches_start(p, i, start))
            continue;
        double length;
        if (crack_meets(start, p.vertex[i], p.vertex[i + 1 < p.count ? i + 1 : 0], &length) && length > 0 &&
            length < least) {
            least = length;
            *edge = i;
        }
    }
    return least;
}

/* ---- the criterion ---- */

/* Finite elements of an edge crack in a rectangular plate (validation/splitting_factors.py), within 0.1 % at these
   nodes. The factor over sqrt(the smaller side over the length).  A larger side under SIDES[0] is that of a narrower
   plate whose far end is of no consequence. */
static const double SIDES[] = {0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1, 1.25}; /* the larger side over the length */
enum { SIDE_ROWS = sizeof SIDES / sizeof *SIDES, RATIOS = 8 };
static const double FACTORS[SIDE_ROWS][RATIOS + 1] = {
    /* the smaller side over the larger: 0, 1/8, ... 1 */
    {0.2985, 0.2986, 0.2986, 0.2974, 0.2943, 0.2893, 0.2827, 0.2750, 0.2668},
    {0.2983, 0.2987, 0.2986, 0.2975, 0.2944, 0.2893, 0.2827, 0.2750, 0.2667},
    {0.2984, 0.2988, 0.2987, 0.2975, 0.2944, 0.2892, 0.2821, 0.2736, 0.2642},
    {0.2985, 0.2988, 0.2987, 0.2975, 0.2938, 0.2872, 0.2779, 0.2666, 0.2546},
    {0.2986, 0.2988, 0.2987, 0.2969, 0.2914, 0.2813, 0.2681, 0.2537, 0.2397},
    {0.2986, 0.2988, 0.2986, 0.2953, 0.2862, 0.2717, 0.2550, 0.2388, 0.2243},
    {0.2987, 0.2988, 0.2982, 0.2924, 0.2787, 0.2601, 0.2413, 0.2246, 0.2104},
    {0.2987, 0.2988, 0.2963, 0.2828, 0.2602, 0.2370, 0.2173, 0.2013, 0.1883},
};

double fracture_splitting_factor(double length, double side, double other_side)
{
    double larger = fmin(fmax(side, other_side) / length, SIDES[SIDE_ROWS - 1]);
    double smaller = fmin(fmin(side, other_side) / length, larger);
    if (!(smaller > 0))
        return 0;
    int i = 0;
    while (i < SIDE_ROWS - 2 && SIDES[i + 1] <= larger)
        i++;
    double place = RATIOS * smaller / larger;
    int k = (int)fmin(place, RATIOS - 1);
    double u = fmax((larger - SIDES[i]) / (SIDES[i + 1] - SIDES[i]), 0), v = place - k;
    double low = (1 - v) * FACTORS[i][k] + v * FACTORS[i][k + 1];
    double high = (1 - v) * FACTORS[i + 1][k] + v * FACTORS[i + 1][k + 1];
    return ((1 - u) * low + u * high) * sqrt(smaller);
}

double fracture_splitting_force(double thickness, double toughness, double length, double side, double other_side)
{
    return fracture_splitting_factor(length, side, other_side) * thickness * toughness * sqrt(length);
}

/* How far the outline reaches to both sides of the crack. */
static void crack_sides(polygon p, const crack_start *start, double side[2])
{
    side[0] = side[1] = 0;
    for (int32_t i = 0; i < p.count; i++) {
        double at = vec2_cross(start->direction, vec2_sub(p.vertex[i], start->point));
        side[at > 0] = fmax(side[at > 0], fabs(at));
    }
}

double fracture_split_ratio(const fracture_settings *settings, polygon outline, const fracture_load *load,
                            double thickness, const crack_start *start, double *length)
{
    int32_t edge;
    double side[2];
    *length = crack_length(outline, start, &edge);
    crack_sides(outline, start, side);
    if (edge < 0 || !(fmin(side[0], side[1]) > 0))
        return 0;
    return load->opening_force / fracture_splitting_force(thickness, settings->toughness, *length, side[0], side[1]);
}

bool fracture_splits(const fracture_settings *settings, polygon outline, const fracture_load *load, double thickness,
                     const crack_start *start, double *length)
{
    int32_t edge;
    if (settings->splitting == SPLITTING_TOUGHNESS)
        return fracture_split_ratio(settings, outline, load, thickness, start, length) >= 1;
    if (settings->splitting == SPLITTING_NONE || load->radial_ratio < 1)
        return false;
    *length = crack_length(outline, start, &edge);
    double radius = load->stress.breaking_radius;
    if (edge < 0 || !(*length > radius))
        return false;
    return *length < settings->splitting_factor * radius;
}

/* ---- the children ---- */

/* From one crack point along the boundary to the other; equal points follow one another once. */
static bool take_side(context *ctx, polygon p, vec2 from, int32_t from_edge, vec2 to, int32_t to_edge, vec2_array *out)
{
    array_clear(out);
    if (!array_push(ctx, out, from))
        return false; /* nothing stands there to be compared with */
    bool good = true;
    int32_t i = from_edge;
    do {
        i = i + 1 < p.count ? i + 1 : 0;
        vec2 v = p.vertex[i], last = out->data[out->count - 1];
        if (v.x != last.x || v.y != last.y)
            good = good && array_push(ctx, out, v);
    } while (i != to_edge && good);
    vec2 last = out->data[out->count - 1];
    if (to.x != last.x || to.y != last.y)
        good = good && array_push(ctx, out, to);
    return good;
}

static bool child_is_sound(context *ctx, const fracture_settings *settings, polygon child, bool *memory)
{
    if (child.count < 3 || !(polygon_area(child) >= settings->smallest_floe_area) ||
        polygon_self_intersects(ctx, child, NULL, NULL))
        return false;
    oriented_box box;
    if (polygon_oriented_box(ctx, child, &box) != FRAM_OK) {
        *memory = true;
        return false;
    }
    return box.sides[0] <= settings->narrowness * box.sides[1];
}

/* A crack end so near to a corner that the edge between would be rounding becomes the corner. */
static const double SNAP = 1e-9;

static vec2 snapped_end(polygon p, int32_t edge, vec2 end, double reach)
{
    for (int k = 0; k < 2; k++) {
        vec2 v = p.vertex[(edge + k) % p.count];
        if (vec2_length(vec2_sub(v, end)) <= reach)
            return v;
    }
    return end;
}

bool fracture_split(context *ctx, const fracture_settings *settings, polygon outline, const crack_start *start,
                    polygon_list *out, bool *memory)
{
    int32_t edge, had = polygon_list_count(out);
    double length = crack_length(outline, start, &edge);
    if (edge < 0)
        return false;
    vec2 end = snapped_end(outline, edge, vec2_add(start->point, vec2_scale(start->direction, length)), SNAP * length);
    vec2_array side = {0};
    bool sound = true;
    for (int child = 0; child < 2 && sound; child++) {
        bool good = child == 0 ? take_side(ctx, outline, start->point, start->edge, end, edge, &side)
                               : take_side(ctx, outline, end, edge, start->point, start->edge, &side);
        polygon ring = {side.data, side.count};
        *memory = !good;
        sound = good && child_is_sound(ctx, settings, ring, memory);
        if (sound && !polygon_list_push(ctx, out, ring)) {
            *memory = true;
            sound = false;
        }
    }
    array_free(ctx, &side);
    assert(!sound || fabs(polygon_area(polygon_list_get(out, had)) + polygon_area(polygon_list_get(out, had + 1)) -
                          polygon_area(outline)) <= SNAP * length * polygon_perimeter(outline));
    if (!sound && polygon_list_count(out) > had) {
        out->vertex.count = out->start.data[had];
        out->start.count = had + 1;
    }
    return sound;
}
