/* Contact rows of the packing: of every pair of near pieces up to two points along the axis of least overlap, and of
   pieces beside a wall. */
#include "ice/packing_work.h"

/* Rows with a wider gap than this part of the search margin are left out. */
static const double ROW_REACH = 0.3;

/* An overlap of a piece is undone along a seam when that is this much shorter than along any outer edge. */
static const double SEAM_DEPTH = 1;

typedef struct axis {
    double gap;
    int32_t edge; /* of a: 0 .. ; of b: after a's; -1: none */
} axis;

/* Gap of q's vertices (moved by `shift`) beyond one edge of p. */
static double edge_gap(const pack_layout *l, const pack_piece *p, int32_t edge, const pack_piece *q, vec2 shift)
{
    vec2 n = l->normal.data[p->first + edge], from = l->vertex.data[p->first + edge];
    const vec2 *v = l->vertex.data + q->first;
    double least = HUGE_VAL, offset = n.x * (from.x - shift.x) + n.y * (from.y - shift.y);
    for (int32_t i = 0; i < q->count; i++) {
        double d = n.x * v[i].x + n.y * v[i].y;
        least = d < least ? d : least;
    }
    return least - offset;
}

/* The gap along one edge of either; seams part too, but nothing is pushed along them. */
static double gap_along(const pack_layout *l, const pack_piece *a, const pack_piece *b, vec2 shift, int32_t edge)
{
    if (edge < a->count)
        return edge_gap(l, a, edge, b, shift);
    return edge_gap(l, b, edge - a->count, a, (vec2){-shift.x, -shift.y});
}

static bool is_seam(const pack_layout *l, const pack_piece *a, const pack_piece *b, int32_t edge)
{
    return l->seam.data[edge < a->count ? a->first + edge : b->first + edge - a->count] != 0;
}

/* The outer edge with the widest gap; edge -1 when any edge, a seam included, keeps the two farther apart than `far`
   (left in *axis_kept). */
static axis widest_axis(const pack_layout *l, const pack_piece *a, const pack_piece *b, vec2 shift, double far,
                        int16_t *kept)
{
    axis best = {-HUGE_VAL, -1}, inner = {-HUGE_VAL, -1};
    /* An edge that looks away from the other piece's middle parts the two badly, if at all. */
    vec2 way = vec2_sub(vec2_add(b->middle, shift), a->middle);
    for (int32_t e = 0; e < a->count + b->count; e++) {
        double facing = e < a->count ? vec2_dot(l->normal.data[a->first + e], way)
                                     : -vec2_dot(l->normal.data[b->first + e - a->count], way);
        if (facing < 0 && !l->concave)
            continue;
        double gap = gap_along(l, a, b, shift, e);
        if (gap > far) {
            *kept = (int16_t)e;
            return (axis){gap, -1};
        }
        axis *slot = is_seam(l, a, b, e) ? &inner : &best;
        if (gap > slot->gap)
            *slot = (axis){gap, e};
    }
    /* Parted by a seam: the neighbour across it has the contact.  A piece with seams all round: any way out. */
    if (inner.gap > 0 && inner.gap > best.gap)
        return (axis){inner.gap, -1};
    return best.edge >= 0 && best.gap >= SEAM_DEPTH * inner.gap ? best : inner;
}

static bool push_row(pack_work *w, int32_t body_a, int32_t body_b, vec2 n, vec2 on_a, vec2 on_b, double gap)
{
    const pack_body *a = &w->layout.bodies.data[body_a], *b = body_b >= 0 ? &w->layout.bodies.data[body_b] : NULL;
    pack_row row = {
        .a = body_a, .b = body_b, .normal = n, .gap = fmax(gap - w->gap, -PACK_MOST_PUSH * w->layout.grain)};
    row.arm_a = vec2_cross(vec2_sub(on_a, a->centre), n);
    double k = a->weight + a->spin_weight * row.arm_a * row.arm_a;
    if (b) {
        row.arm_b = vec2_cross(vec2_sub(on_b, b->centre), n);
        k += b->weight + b->spin_weight * row.arm_b * row.arm_b;
    }
    row.mass = 1 / k;
    if (-gap > w->contacts.overlap)
        w->contacts.overlap = -gap;
    if (-gap > w->contacts.squeeze.data[body_a])
        w->contacts.squeeze.data[body_a] = -gap;
    if (b && -gap > w->contacts.squeeze.data[body_b])
        w->contacts.squeeze.data[body_b] = -gap;
    return array_push(w->ctx, &w->contacts.rows, row);
}

static int32_t edge_after(int32_t i, int32_t count) { return i + 1 < count ? i + 1 : 0; }

/* Points of the incident piece over the reference edge: its edge that faces the reference one, cut to its length. */
static int incident_points(const pack_layout *l, const pack_piece *ref, int32_t edge, const pack_piece *inc, vec2 shift,
                           vec2 point[2])
{
    vec2 n = l->normal.data[ref->first + edge];
    const vec2 *v = l->vertex.data + inc->first, *m = l->normal.data + inc->first;
    int32_t deepest = 0;
    double least = HUGE_VAL;
    for (int32_t i = 0; i < inc->count; i++) {
        double d = vec2_dot(n, v[i]);
        if (d < least) {
            least = d;
            deepest = i;
        }
    }
    int32_t before = deepest > 0 ? deepest - 1 : inc->count - 1;
    int32_t face = vec2_dot(n, m[before]) < vec2_dot(n, m[deepest]) ? before : deepest;
    vec2 from = l->vertex.data[ref->first + edge];
    vec2 to = l->vertex.data[ref->first + edge_after(edge, ref->count)];
    vec2 along = {-n.y, n.x};
    double lo = vec2_dot(along, from), hi = vec2_dot(along, to);
    vec2 p = vec2_add(v[face], shift), q = vec2_add(v[edge_after(face, inc->count)], shift);
    double tp = vec2_dot(along, p), tq = vec2_dot(along, q);
    if (lo > hi) {
        double swap = lo;
        lo = hi;
        hi = swap;
    }
    vec2 d = vec2_sub(q, p);
    double span = tq - tp;
    vec2 end[2] = {p, q};
    for (int k = 0; k < 2; k++) {
        double t = k == 0 ? tp : tq, kept = t < lo ? lo : t > hi ? hi : t;
        if (kept != t && fabs(span) > 0)
            end[k] = vec2_add(p, vec2_scale(d, fmin(1, fmax(0, (kept - tp) / span))));
    }
    point[0] = end[0];
    point[1] = end[1];
    vec2 between = vec2_sub(end[1], end[0]);
    return vec2_dot(between, between) > 1e-12 * l->mean_size * l->mean_size ? 2 : 1;
}

static bool add_pair_rows(pack_work *w, const pack_piece *a, const pack_piece *b, vec2 shift, axis best, double far)
{
    bool on_a = best.edge < a->count;
    const pack_piece *ref = on_a ? a : b, *inc = on_a ? b : a;
    int32_t edge = on_a ? best.edge : best.edge - a->count;
    vec2 n = w->layout.normal.data[ref->first + edge], from = w->layout.vertex.data[ref->first + edge], point[2];
    /* In the frame of the reference piece. */
    vec2 over = on_a ? shift : (vec2){-shift.x, -shift.y};
    int points = incident_points(&w->layout, ref, edge, inc, over, point);
    for (int k = 0; k < points; k++) {
        double gap = vec2_dot(n, vec2_sub(point[k], from));
        if (gap > far)
            continue;
        vec2 on_inc = vec2_sub(point[k], over); /* where the incident body stands itself */
        bool good = on_a ? push_row(w, a->body, b->body, n, point[k], on_inc, gap)
                         : push_row(w, a->body, b->body, (vec2){-n.x, -n.y}, on_inc, point[k], gap);
        if (!good)
            return false;
    }
    return true;
}

bool pack_boxes_far(box2 a, box2 b, vec2 shift, double far)
{
    return a.hi.x + far < b.lo.x + shift.x || b.hi.x + shift.x + far < a.lo.x || a.hi.y + far < b.lo.y + shift.y ||
           b.hi.y + shift.y + far < a.lo.y;
}

static bool find_pair_rows(pack_work *w, double far)
{
    for (int32_t i = 0; i < w->search.pairs.count; i++) {
        pack_pair *pair = &w->search.pairs.data[i];
        const pack_piece *a = &w->layout.pieces.data[pair->a], *b = &w->layout.pieces.data[pair->b];
        vec2 shift = {pair->shift_x * w->period.x, pair->shift_y * w->period.y};
        if (pack_boxes_far(a->box, b->box, shift, far))
            continue;
        if (pair->axis >= 0 && gap_along(&w->layout, a, b, shift, pair->axis) > far)
            continue;
        axis best = widest_axis(&w->layout, a, b, shift, far, &pair->axis);
        if (best.edge >= 0 && !add_pair_rows(w, a, b, shift, best, far))
            return false;
    }
    return true;
}

/* Rows of a piece and the wall n . x <= offset: every vertex that comes near (at most as many as the piece has). */
static bool find_wall_rows(pack_work *w, vec2 n, double offset, double far)
{
    for (int32_t p = 0; p < w->layout.pieces.count; p++) {
        const pack_piece *piece = &w->layout.pieces.data[p];
        if (piece->body >= w->layout.movable)
            break;
        double nearest = n.x > 0   ? offset - piece->box.hi.x
                         : n.x < 0 ? offset + piece->box.lo.x
                         : n.y > 0 ? offset - piece->box.hi.y
                                   : offset + piece->box.lo.y;
        if (nearest > far)
            continue;
        for (int32_t i = piece->first; i < piece->first + piece->count; i++) {
            vec2 v = w->layout.vertex.data[i];
            double gap = offset - vec2_dot(n, v);
            if (gap <= far && !push_row(w, piece->body, -1, n, v, v, gap))
                return false;
        }
    }
    return true;
}

bool pack_find_rows(pack_work *w)
{
    box2 d = w->request->domain;
    double far = w->gap + ROW_REACH * w->search.reach;
    array_clear(&w->contacts.rows);
    w->contacts.overlap = -HUGE_VAL;
    for (int32_t i = 0; i < w->layout.bodies.count; i++)
        w->contacts.squeeze.data[i] = 0;
    bool good = find_pair_rows(w, far);
    if (good && w->period.x == 0)
        good = find_wall_rows(w, (vec2){1, 0}, d.hi.x, far) && find_wall_rows(w, (vec2){-1, 0}, -d.lo.x, far);
    if (good && w->period.y == 0)
        good = find_wall_rows(w, (vec2){0, 1}, d.hi.y, far) && find_wall_rows(w, (vec2){0, -1}, -d.lo.y, far);
    return good && (!w->layout.concave || pack_part_hooked(w));
}

double pack_depth(const pack_layout *l, const pack_piece *a, const pack_piece *b, vec2 shift, double enough)
{
    if (pack_boxes_far(a->box, b->box, shift, -enough))
        return 0;
    int16_t kept;
    axis best = widest_axis(l, a, b, shift, -enough, &kept);
    return best.edge < 0 ? 0 : -best.gap;
}
