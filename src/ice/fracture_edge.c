/* The ice that a load stands on (docs/decisions/0044): what of the sectors of its stencil is ice, out to about
   R_bending along their axes, or as far as the floe goes in any direction if that is nearer (decision 0578). */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"

/* The sectors of a straight edge's N wedges around a start, one after the other, and the strip between them. */
typedef struct sectors {
    vec2 corner[3 * MOST_STENCIL + 4];
    int32_t size[MOST_STENCIL + 1];
    int wedges, count; /* those of the wedges, and all */
    double reach;      /* [m] */
} sectors;

static void add_strip(const crack_start *start, double radius, double width, sectors *out)
{
    vec2 d = start->direction, aside = vec2_scale((vec2){-d.y, d.x}, width / 2), end = vec2_scale(d, radius);
    vec2 left = vec2_add(start->point, aside), right = vec2_sub(start->point, aside);
    vec2 *at = out->corner + (ptrdiff_t)3 * out->count;
    at[0] = right;
    at[1] = vec2_add(right, end);
    at[2] = vec2_add(left, end);
    at[3] = left;
    out->size[out->count++] = 4;
}

/* length, farthest: of the ice along the first crack, and in any direction [m]. */
static void make_sectors(const fracture_job *j, const crack_start *start, double radius, double length, double farthest,
                         double width, sectors *out)
{
    const break_size size = {.side = fmin(fracture_wedge_side(j->settings, radius), farthest), .width = width};
    break_shape shape;
    fracture_shape(j->settings->wedges, start, &size, &shape);
    out->wedges = out->count = 2 * j->settings->wedges;
    out->reach = fmin(radius, length);
    for (int i = 0; i < out->count; i++) {
        out->size[i] = 3;
        for (int k = 0; k < 3; k++)
            out->corner[3 * i + k] = shape.part[i][k];
    }
    if (width > 0)
        add_strip(start, out->reach, width, out);
}

/* Ice in the sectors over that of the N whole ones that a straight edge has. */
static double part_of(const sectors *s, const double *area)
{
    double sum = 0, whole = 0;
    for (int i = 0; i < s->wedges; i++) {
        sum += area[i];
        whole += polygon_area((polygon){s->corner + 3 * i, 3});
    }
    return whole > 0 ? 2 * sum / whole : 0;
}

/* Rays of a fan from the start into the ice, at the middles of as many even parts of the half turn that is inside of an
   edge: none runs along the edge.  A corner of more than half a part has one that stays in it. */
enum { FAN_RAYS = 12 };

static crack_start fan_ray(const crack_start *start, int i)
{
    double angle = PI * ((i + 0.5) / FAN_RAYS - 0.5), c = real_cos(angle), s = real_sin(angle);
    vec2 d = start->direction;
    crack_start ray = *start;
    ray.direction = (vec2){c * d.x - s * d.y, s * d.x + c * d.y};
    return ray;
}

/* Rays across a strip besides the crack's own, at even distances. */
enum { STRIP_RAYS = 4 };

static crack_start ray_of(const crack_start *start, double width, int i)
{
    vec2 d = start->direction;
    double by = width * ((i + 0.5) / STRIP_RAYS - 0.5);
    crack_start ray = *start;
    ray.point = vec2_add(ray.point, vec2_make(-d.y * by, d.x * by));
    return ray;
}

/* A strip is as long as its longest part: a hole or a lead in a part of it makes no short beam of the whole, which
   would bear many times as much. */
static double floe_strip_length(polygon outline, const crack_start *start, double width, double snap, double length)
{
    for (int i = 0; i < STRIP_RAYS && width > 0; i++) {
        crack_start ray = ray_of(start, width, i);
        double least = HUGE_VAL;
        for (int32_t k = 0; k < outline.count; k++)
            crack_shorten(&ray, outline.vertex[k], outline.vertex[k + 1 < outline.count ? k + 1 : 0], snap, &least);
        if (least < HUGE_VAL)
            length = fmax(length, least);
    }
    return length;
}

/* Characteristic lengths beyond which the end of a strip is of no consequence: it bears a thousandth more there. */
static const double STRIP_ENDS = 5;

/* The same in a sheet, whose boundary is looked up as far as strips may end. */
static fram_status sheet_strip_length(const fracture_job *j, const fracture_load *l, double snap, double *length)
{
    tile_segment_array *boundary = &j->scratch->sheet.boundary;
    double ends =
        STRIP_ENDS * ice_characteristic_length(&l->ice, l->thickness, j->settings->water_density, j->settings->gravity);
    array_clear(boundary);
    fram_status status = fracture_sheet_boundary(j, l->start.point, ends + l->width / 2, boundary);
    *length = fracture_sheet_crack_length(j, &l->start, snap, true);
    for (int i = 0; i < STRIP_RAYS; i++) {
        crack_start ray = ray_of(&l->start, l->width, i);
        *length = fmax(*length, fracture_sheet_crack_length(j, &ray, snap, true));
    }
    return status;
}

static edge_ice ice_of(const fracture_job *j, const sectors *s, const double *area, double length)
{
    bool equal = j->settings->sharing == SHARING_EQUAL;
    return (edge_ice){.wedges = equal ? 1 : part_of(s, area),
                      .strip = s->count > s->wedges ? area[s->wedges] / s->reach : 0,
                      .length = length,
                      .rise = HUGE_VAL};
}

/* Length in a direction of an even load with the patch's mean square. */
static double extent(const double spread[3], vec2 t)
{
    double square = t.x * t.x * spread[0] + 2 * t.x * t.y * spread[1] + t.y * t.y * spread[2];
    return sqrt(12 * fmax(square, 0));
}

/* A contact this many times as long as it is deep lies along a straight edge; a stem's or a narrow cone's goes round.
 */
static const double STRAIGHT = 4;

/* None that is narrower than the ice is thick, since a beam of that width is none, nor of one that follows no edge. */
double fracture_contact_width(const fracture_job *j, const fracture_load *l, vec2 inward)
{
    if (!j->settings->wide_contacts)
        return 0;
    double width = extent(l->spread, vec2_make(-inward.y, inward.x));
    return width > l->thickness && width >= STRAIGHT * extent(l->spread, inward) ? width : 0;
}

edge_bend fracture_bend_of(const fracture_job *j, const fracture_load *l, const crack_start *start)
{
    double most = EDGE_MOST_DEFLECTION * l->thickness;
    /* Level ice is held; the slot of its tile may be a wedge's by now, of an earlier load. */
    bool floats = !l->tile && body_is_free(j->state->bodies, l->body);
    return (edge_bend){*start, fracture_break_size(j->settings, l), floats ? 0 : fmin(fmax(l->rise, -most), most),
                       l->rate};
}

break_size fracture_break_size(const fracture_settings *f, const fracture_load *l)
{
    bool wide = l->width > 0 && l->stress.strip_length > 0;
    double radius = l->stress.breaking_radius;
    break_size size = {radius, fracture_wedge_side(f, radius), wide ? l->width : 0, l->stress.strip_length};
    /* From the ends of the wedges' cracks that of the strip goes inwards no steeper than along it (decision 0558). */
    if (wide && !l->beam)
        size.strip_length = fmin(size.strip_length, size.side + size.width / 2);
    return size;
}

edge_compliance fracture_edges(const fracture_settings *f)
{
    return (edge_compliance){.gives = f->edges_give,
                             .inertia = f->edges_give && f->edge_inertia,
                             .water_density = f->water_density,
                             .gravity = f->gravity,
                             .wedges = f->wedges,
                             .thick_plate_radius = f->thick_plate_radius};
}

double fracture_edge_reach(const fracture_settings *f, const ice_material *ice, double thickness, double area)
{
    const edge_compliance e = fracture_edges(f);
    return edge_reach(&e, ice, thickness, area);
}

double fracture_reach(const fracture_job *j, fracture_load *l)
{
    if (!(l->reach > 0))
        l->reach = fracture_edge_reach(j->settings, &l->ice, l->thickness, l->horizontal_area);
    return l->reach;
}

/* ---- at least ---- */

/* Whether a point is in the triangle s a b, counter-clockwise, or on its border. */
static bool is_inside(vec2 s, vec2 a, vec2 b, vec2 p)
{
    return vec2_cross(vec2_sub(a, s), vec2_sub(p, s)) >= 0 && vec2_cross(vec2_sub(b, a), vec2_sub(p, a)) >= 0 &&
           vec2_cross(vec2_sub(s, b), vec2_sub(p, b)) >= 0;
}

/* The triangle between the crack, to `depth` into the ice, and the boundary from its start to vertex `corner`, as far
   as `depth` too, is ice if no other vertex is in it: an edge could not leave it again.  Twice its area over the depth;
   0: it may not be ice.  side: 1 where the vertex comes after the start on the ring, -1 before. */
static double ice_beside(polygon outline, const crack_start *start, int32_t corner, double depth, int side)
{
    vec2 s = start->point, edge = vec2_sub(outline.vertex[corner], s),
         end = vec2_add(s, vec2_scale(start->direction, depth));
    double length = vec2_length(edge);
    if (!(length > 0))
        return 0;
    vec2 a = vec2_add(s, vec2_scale(edge, fmin(1, depth / length)));
    double height = side * vec2_cross(vec2_sub(a, s), start->direction);
    for (int32_t i = 0; i < outline.count && height > 0; i++) {
        vec2 p = outline.vertex[i];
        if (i != corner && !(p.x == s.x && p.y == s.y) &&
            (side > 0 ? is_inside(s, a, end, p) : is_inside(s, end, a, p)))
            height = 0;
    }
    return fmax(height, 0);
}

/* The stencil with cracks of length s has the area N s^2 sin(pi/N) in its N whole wedges and a disc of s cos(pi/2N) in
   it.  Two triangles of that depth have the part sum h / (2 N s sin(pi/2N)) of it, and N sin(pi/2N) < pi/2.  Where the
   first crack ends within the stencil, triangles as deep as that stand in the whole one. */
double fracture_least_ice(const fracture_job *j, fracture_load *l)
{
    if (j->settings->sharing == SHARING_EQUAL)
        return 1;
    if (l->tile || j->settings->wide_contacts)
        return 0;
    polygon outline = shape_outline(j->state->shapes, j->state->bodies->shape[l->body]);
    double reach = fracture_reach(j, l), angle = PI / 2 / j->settings->wedges;
    crack_start start = crack_start_of(outline, l->place, CRACK_CORNER_REACH * reach);
    int32_t end, at = start.edge, next = at + 1 < outline.count ? at + 1 : 0;
    double whole = fracture_wedge_side(j->settings, reach), side = fmin(whole, crack_length(outline, &start, &end));
    double depth = side * (1 - angle * angle / 2);
    vec2 first = outline.vertex[at];
    bool on_vertex = first.x == start.point.x && first.y == start.point.y;
    int32_t before = !on_vertex ? at : at > 0 ? at - 1 : outline.count - 1;
    double both = ice_beside(outline, &start, next, depth, 1) + ice_beside(outline, &start, before, depth, -1);
    return side > 0 ? both * side / (PI * whole * whole) : 0;
}

/* ---- all of it ---- */

/* A load that counts as one on a straight edge, wherever it is. */
static bool is_equal_everywhere(const fracture_job *j, const fracture_load *l)
{
    return j->settings->sharing == SHARING_EQUAL && !j->settings->wide_contacts && !(l->near > 0);
}

/* How far the ice goes from the start along the first crack, `length`, or along any ray of the fan where that ends
   within the sectors. */
static double floe_farthest(const fracture_job *j, polygon outline, const crack_start *start, double radius,
                            double length)
{
    double side = fracture_wedge_side(j->settings, radius);
    for (int i = 0; i < FAN_RAYS && length < side; i++) {
        crack_start ray = fan_ray(start, i);
        int32_t end;
        length = fmax(length, crack_length(outline, &ray, &end));
    }
    return length;
}

/* The same in a sheet. */
static double sheet_farthest(const fracture_job *j, const crack_start *start, double radius, double length)
{
    double side = fracture_wedge_side(j->settings, radius);
    for (int i = 0; i < FAN_RAYS && length < side; i++) {
        crack_start ray = fan_ray(start, i);
        length = fmax(length, fracture_sheet_crack_length(j, &ray, CRACK_CORNER_REACH * radius, false));
    }
    return length;
}

edge_ice fracture_floe_ice(const fracture_job *j, fracture_load *l)
{
    l->width = 0;
    if (is_equal_everywhere(j, l))
        return EDGE_STRAIGHT;
    double radius = fracture_reach(j, l);
    polygon outline = shape_outline(j->state->shapes, j->state->bodies->shape[l->body]);
    crack_start start = l->start = crack_start_of(outline, l->place, CRACK_CORNER_REACH * radius);
    int32_t end;
    double area[MOST_STENCIL + 1] = {0}, length = crack_length(outline, &start, &end);
    sectors s;
    l->width = fracture_contact_width(j, l, start.direction);
    double farthest = floe_farthest(j, outline, &start, radius, length);
    make_sectors(j, &start, radius, length, farthest, l->width, &s);
    const vec2 *at = s.corner;
    for (int i = 0; i < s.count; at += s.size[i], i++)
        area[i] = polygon_overlap_area(outline, (polygon){at, s.size[i]});
    length = floe_strip_length(outline, &start, l->width, CRACK_CORNER_REACH * radius, length);
    return ice_of(j, &s, area, length);
}

fram_status fracture_sheet_ice(const fracture_job *j, fracture_load *l, edge_ice *edge)
{
    *edge = EDGE_STRAIGHT;
    l->width = 0;
    l->start.distance = -1;
    if (is_equal_everywhere(j, l))
        return FRAM_OK;
    double radius = fracture_reach(j, l);
    crack_start start;
    bool found;
    fram_status status =
        fracture_sheet_start(j, l->place, fracture_sheet_reach(&j->settings->tiles), radius, &start, &found);
    if (status != FRAM_OK || !found)
        return status;
    l->start = start;
    double area[MOST_STENCIL + 1] = {0};
    double length = fracture_sheet_crack_length(j, &start, CRACK_CORNER_REACH * radius, false);
    sectors s;
    l->width = fracture_contact_width(j, l, start.direction);
    make_sectors(j, &start, radius, length, sheet_farthest(j, &start, radius, length), l->width, &s);
    status = fracture_sheet_areas(j, s.corner, s.size, s.count, area);
    if (status == FRAM_OK && l->width > 0)
        status = sheet_strip_length(j, l, CRACK_CORNER_REACH * radius, &length);
    *edge = ice_of(j, &s, area, length);
    return status;
}
