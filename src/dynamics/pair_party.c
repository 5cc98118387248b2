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

/* Extent of a whole body along a unit axis. */
static void body_span(const party *p, vec3 axis, double *low, double *high)
{
    vec3 n = mat3_tmul_vec(p->rotation, axis);
    double middle = vec3_dot(axis, p->centre), least = HUGE_VAL, most = -HUGE_VAL, rise = 0;
    if (p->is_prism) {
        polygon outline = shape_outline(p->shapes, p->shape);
        rise = p->shapes->shapes.half_height[p->shape] * fabs(n.z);
        for (int32_t i = 0; i < outline.count; i++) {
            double d = n.x * outline.vertex[i].x + n.y * outline.vertex[i].y;
            least = d < least ? d : least;
            most = d > most ? d : most;
        }
    } else {
        const polyhedron_array *pieces = solid_pieces(p);
        for (int32_t k = 0; k < pieces->count; k++) {
            for (int32_t i = 0; i < pieces->data[k].vertex.count; i++) {
                double d = vec3_dot(n, pieces->data[k].vertex.data[i]);
                least = d < least ? d : least;
                most = d > most ? d : most;
            }
        }
    }
    *low = middle + least - rise;
    *high = middle + most + rise;
}

double axis_gap(const party *a, const party *b, vec3 axis)
{
    if (vec3_dot(axis, axis) == 0)
        return -HUGE_VAL;
    double low_a, high_a, low_b, high_b;
    body_span(a, axis, &low_a, &high_a);
    body_span(b, axis, &low_b, &high_b);
    return low_a - high_b;
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

bool gather_pieces(context *ctx, const box3_array *boxes, box3 box, int32_array *near)
{
    array_clear(near);
    for (int32_t i = 0; i < boxes->count; i++)
        if ((boxes->count == 1 || box3_meet(boxes->data[i], box)) && !array_push(ctx, near, i))
            return false;
    return true;
}
