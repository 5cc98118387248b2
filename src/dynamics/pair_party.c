/* See pair_party.h. */
#include "dynamics/pair_party.h"

party party_of(const body_table *bodies, const shape_store *shapes, int32_t slot, vec3 origin)
{
    int32_t row = bodies->shape[slot];
    return (party){slot,
                   row,
                   quat_matrix(bodies->orientation[slot]),
                   vec3_sub(bodies->position[slot], origin),
                   shapes->shapes.kind[row] == SHAPE_PRISM,
                   shapes};
}

prism prism_piece(const party *p, int32_t piece)
{
    int32_t at = p->shapes->shapes.piece_first[p->shape] + piece, first = p->shapes->pieces.first[at];
    return (prism){.vertex = p->shapes->vertices.point + first,
                   .side = p->shapes->vertices.side + first,
                   .corner = p->shapes->vertices.corner + first,
                   .outline = shape_outline(p->shapes, p->shape),
                   .count = p->shapes->pieces.size[at],
                   .readable = p->shapes->vertices.count - first,
                   .half_height = p->shapes->shapes.half_height[p->shape],
                   .plan_radius = p->shapes->shapes.plan_radius[p->shape],
                   .seams = p->shapes->pieces.inner_edges[at],
                   .rotation = p->rotation,
                   .centre = p->centre};
}

/* ---- remembered axis ---- */

typedef struct span {
    double low, high;
} span;

static span span_of_hull(span s, vec3 n, const polyhedron *hull)
{
    for (int32_t i = 0; i < hull->vertex.count; i++) {
        double d = vec3_dot(n, hull->vertex.data[i]);
        s.low = d < s.low ? d : s.low;
        s.high = d > s.high ? d : s.high;
    }
    return s;
}

/* Extent along a unit axis, of a whole body or of one piece. */
enum { ALL_PIECES = -1 };
static span party_span(const party *p, int32_t piece, vec3 axis)
{
    vec3 n = mat3_tmul_vec(p->rotation, axis);
    double middle = vec3_dot(axis, p->centre), rise = 0;
    span s = {HUGE_VAL, -HUGE_VAL};
    if (p->is_prism) {
        polygon outline =
            piece == ALL_PIECES ? shape_outline(p->shapes, p->shape) : shape_piece(p->shapes, p->shape, piece);
        rise = p->shapes->shapes.half_height[p->shape] * fabs(n.z);
        for (int32_t i = 0; i < outline.count; i++) {
            double d = n.x * outline.vertex[i].x + n.y * outline.vertex[i].y;
            s.low = d < s.low ? d : s.low;
            s.high = d > s.high ? d : s.high;
        }
    } else {
        const polyhedron_array *pieces = solid_pieces(p);
        int32_t first = piece == ALL_PIECES ? 0 : piece, end = piece == ALL_PIECES ? pieces->count : piece + 1;
        for (int32_t k = first; k < end; k++)
            s = span_of_hull(s, n, &pieces->data[k]);
    }
    return (span){middle + s.low - rise, middle + s.high + rise};
}

double piece_axis_gap(const party *a, int32_t piece_a, const party *b, int32_t piece_b, vec3 axis)
{
    if (vec3_dot(axis, axis) == 0)
        return -HUGE_VAL;
    return party_span(a, piece_a, axis).low - party_span(b, piece_b, axis).high;
}

double axis_gap(const party *a, const party *b, vec3 axis)
{
    return piece_axis_gap(a, ALL_PIECES, b, ALL_PIECES, axis);
}

/* ---- pieces of compounds ---- */

static box3 piece_box(const party *p, int32_t piece)
{
    box3 box = box3_empty();
    if (!p->is_prism) {
        const polyhedron *hull = &solid_pieces(p)->data[piece];
        for (int32_t i = 0; i < hull->vertex.count; i++)
            box = box3_add(box, vec3_add(p->centre, mat3_mul_vec(p->rotation, hull->vertex.data[i])));
        return box;
    }
    prism q = prism_piece(p, piece);
    for (int32_t i = 0; i < 2 * q.count; i++) {
        double z = i < q.count ? q.half_height : -q.half_height;
        vec2 v = q.vertex[i < q.count ? i : i - q.count];
        box = box3_add(box, vec3_add(p->centre, mat3_mul_vec(p->rotation, vec3_make(v.x, v.y, z))));
    }
    return box;
}

bool party_boxes(context *ctx, const party *p, box3_array *boxes, box3 *whole)
{
    int32_t count = piece_count(p);
    if (!array_resize(ctx, boxes, count))
        return false;
    *whole = box3_empty();
    for (int32_t i = 0; i < count; i++) {
        boxes->data[i] = piece_box(p, i);
        *whole = box3_union(*whole, boxes->data[i]);
    }
    return true;
}

/* How far apart two boxes are along some edge of them; negative where they overlap along all. */
static double box_gap(box3 a, box3 b)
{
    double x = fmax(a.lo.x - b.hi.x, b.lo.x - a.hi.x), y = fmax(a.lo.y - b.hi.y, b.lo.y - a.hi.y);
    return fmax(fmax(x, y), fmax(a.lo.z - b.hi.z, b.lo.z - a.hi.z));
}

bool gather_pieces(context *ctx, const box3_array *boxes, box3 box, double slack, int32_array *near, double *apart)
{
    array_clear(near);
    for (int32_t i = 0; i < boxes->count; i++) {
        double gap = box_gap(boxes->data[i], box);
        if (boxes->count > 1 && gap > slack)
            *apart = fmin(*apart, gap);
        else if (!array_push(ctx, near, i))
            return false;
    }
    return true;
}
