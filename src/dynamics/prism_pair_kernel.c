#include "dynamics/prism_pair_kernel.h"

#include "base/parts.h"

/* Vertices and sides are taken one register at a time (V8_PART_LANES of them), whatever its width: what is asked of
   each is the same, and least and largest do not depend on the grouping. */
enum { LANES = V8_PART_LANES, EIGHT = 8 };

/* Which lanes from `first` on are vertices. */
V8_INLINE v8_part_mask real_lanes(const prism *p, int32_t first)
{
    return (v8_part_mask)(PART_NUMBERS < v8_part_set(p->count - first));
}

/* ---- extents ---- */

/* Least of n . v over the vertices. */
V8_INLINE double plan_least(const prism *p, double nx, double ny)
{
    v8_part least = v8_part_set(HUGE_VAL);
    for (int32_t first = 0; first < p->count; first += LANES) {
        v8_part x, y;
        load_points(p->vertex, p->count, p->readable, first, &x, &y);
        least = v8_part_min(v8_part_select(real_lanes(p, first), nx * x + ny * y, least), least);
    }
    return v8_part_least(least);
}

/* How far apart the two are along an axis from b to a. */
V8_INLINE double axis_gap(const prism *a, const prism *b, vec3 axis)
{
    vec3 na = mat3_tmul_vec(a->rotation, axis), nb = mat3_tmul_vec(b->rotation, axis);
    double bottom = vec3_dot(axis, a->centre) + plan_least(a, na.x, na.y) - a->half_height * fabs(na.z);
    double top = vec3_dot(axis, b->centre) - plan_least(b, -nb.x, -nb.y) + b->half_height * fabs(nb.z);
    return bottom - top;
}

/* ---- sides ---- */

/* The other's frame as the holder of the sides sees it: r turns the other's coordinates into the holder's. */
typedef struct seen_frame {
    double r[3][3];
    vec3 t;
} seen_frame;

typedef struct best_of_sides {
    double depth;
    int32_t side;
} best_of_sides;

/* The least lane and, of equal ones, the first. */
V8_INLINE void take_least(v8_part value, int32_t first, best_of_sides *best)
{
    double least = v8_part_least(value);
    if (least < best->depth) {
        best->depth = least;
        best->side = first + __builtin_ctz(v8_part_bits((v8_part_mask)(value <= v8_part_set(least))));
    }
}

/* The side along which `other` reaches least deep into p. */
V8_INLINE best_of_sides search_all_sides(const prism *p, const prism *other, const seen_frame *f)
{
    best_of_sides best = {HUGE_VAL, 0};
    for (int32_t first = 0; first < p->count; first += LANES) {
        v8_part x, y, nx, ny, low = v8_part_set(HUGE_VAL);
        load_points(p->vertex, p->count, p->readable, first, &x, &y);
        load_points(p->side, p->count, p->readable, first, &nx, &ny);
        v8_part mx = f->r[0][0] * nx + f->r[1][0] * ny, my = f->r[0][1] * nx + f->r[1][1] * ny;
        v8_part mz = f->r[0][2] * nx + f->r[1][2] * ny;
        for (int32_t i = 0; i < other->count; i += EIGHT)
            for (int32_t k = i; k < i + EIGHT; k++) { /* always eight: the end of a shorter loop is never foreseen */
                vec2 v = other->vertex[k < other->count ? k : 0];
                low = v8_part_min(mx * v.x + my * v.y, low);
            }
        low += nx * f->t.x + ny * f->t.y - other->half_height * v8_part_max(mz, -mz);
        take_least(v8_part_select(real_lanes(p, first), nx * x + ny * y - low, v8_part_set(HUGE_VAL)), first, &best);
    }
    return best;
}

/* The side whose normal is most opposed to the plan direction d. */
V8_INLINE int32_t most_opposed_side(const prism *p, double dx, double dy)
{
    best_of_sides best = {HUGE_VAL, 0};
    for (int32_t first = 0; first < p->count; first += LANES) {
        v8_part nx, ny;
        load_points(p->side, p->count, p->readable, first, &nx, &ny);
        take_least(v8_part_select(real_lanes(p, first), nx * dx + ny * dy, v8_part_set(HUGE_VAL)), first, &best);
    }
    return best.side;
}

/* Overlap along p's own axis: exactly, or any bound below it that is already more than `enough`. */
V8_INLINE double rise_of(const prism *p, const prism *other, const seen_frame *f, double enough)
{
    double reach = other->half_height * fabs(f->r[2][2]);
    double slope = sqrt(f->r[2][0] * f->r[2][0] + f->r[2][1] * f->r[2][1]);
    double bound = (p->half_height - fabs(f->t.z)) + (reach - slope * other->plan_radius);
    if (bound > enough)
        return bound;
    if (f->t.z > 0)
        return p->half_height - (f->t.z + plan_least(other, f->r[2][0], f->r[2][1]) - reach);
    return (f->t.z - plan_least(other, -f->r[2][0], -f->r[2][1]) + reach) + p->half_height;
}

V8_INLINE vec3 global_direction(const prism *p, vec2 n) { return mat3_mul_vec(p->rotation, vec3_make(n.x, n.y, 0)); }

static void frames_make(const prism *a, const prism *b, seen_frame *b_in_a, seen_frame *a_in_b)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const double(*ra)[3] = a->rotation.m, (*rb)[3] = b->rotation.m;
            double x = ra[0][i] * rb[0][j] + ra[1][i] * rb[1][j] + ra[2][i] * rb[2][j];
            b_in_a->r[i][j] = x;
            a_in_b->r[j][i] = x;
        }
    }
    vec3 apart = vec3_sub(b->centre, a->centre);
    b_in_a->t = mat3_tmul_vec(a->rotation, apart);
    a_in_b->t = mat3_tmul_vec(b->rotation, vec3_neg(apart));
}

void KERNEL(prism_pair_test)(const prism *a, const prism *b, double slack, const vec3 *axis, prism_meeting *out)
{
    *out = (prism_meeting){.kind = PRISMS_APART};
    if (vec3_dot(*axis, *axis) > 0) {
        double gap = axis_gap(a, b, *axis);
        if (gap > slack) {
            out->gap = gap;
            out->axis = *axis;
            return;
        }
    }
    seen_frame b_in_a, a_in_b;
    frames_make(a, b, &b_in_a, &a_in_b);
    best_of_sides in_a = search_all_sides(a, b, &b_in_a), in_b = search_all_sides(b, a, &a_in_b);
    if (in_a.depth < -slack || in_b.depth < -slack) {
        bool by_a = in_a.depth <= in_b.depth;
        out->gap = by_a ? -in_a.depth : -in_b.depth;
        out->axis = by_a ? vec3_neg(global_direction(a, a->side[in_a.side])) : global_direction(b, b->side[in_b.side]);
        return;
    }
    /* Rises matter when they part the two, or are less than the best side's depth. */
    out->swapped = clearly_less(in_b.depth, in_a.depth, slack);
    const best_of_sides *best = out->swapped ? &in_b : &in_a;
    double enough = best->depth > 0 ? best->depth : 0;
    double rise_a = rise_of(a, b, &b_in_a, enough), rise_b = rise_of(b, a, &a_in_b, enough);
    if (rise_a < -slack || rise_b < -slack) {
        bool by_a = rise_a <= rise_b;
        vec3 up = mat3_column((by_a ? a : b)->rotation, 2);
        out->gap = by_a ? -rise_a : -rise_b;
        out->axis = vec3_scale(up, vec3_dot(up, vec3_sub(a->centre, b->centre)) < 0 ? -1 : 1);
        return;
    }
    if (fabs(b_in_a.r[2][2]) <= NEARLY_LEVEL || clearly_less(fmin(rise_a, rise_b), best->depth, slack)) {
        out->kind = PRISMS_TILTED;
        return;
    }
    const seen_frame *f = out->swapped ? &a_in_b : &b_in_a;
    vec2 n = (out->swapped ? b : a)->side[best->side];
    out->kind = PRISMS_AT_SIDES;
    out->side = best->side;
    out->normal = n;
    out->opposed = most_opposed_side(out->swapped ? a : b, f->r[0][0] * n.x + f->r[1][0] * n.y,
                                     f->r[0][1] * n.x + f->r[1][1] * n.y);
}
