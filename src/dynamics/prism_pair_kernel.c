#include "dynamics/prism_pair_kernel.h"

#include "base/simd.h"

/* Blocks of eight vertices. */
enum { MOST_BLOCKS = (PIECE_MOST_VERTICES + V8_LANES - 1) / V8_LANES };

#define LANE_NUMBERS ((v8){0, 1, 2, 3, 4, 5, 6, 7})

/* Eight points from ring[first] on; what stands beyond `count` has no meaning. */
V8_INLINE void load_points(const prism *p, const vec2 *ring, int32_t first, v8 *x, v8 *y)
{
    if (first + V8_LANES <= p->readable) {
        v8_load_pairs(&ring[first].x, x, y);
        return;
    }
    double room[2 * V8_LANES];
    for (int32_t i = 0; i < V8_LANES; i++) {
        vec2 v = ring[first + i < p->count ? first + i : 0];
        room[2 * i] = v.x;
        room[2 * i + 1] = v.y;
    }
    v8_load_pairs(room, x, y);
}

V8_INLINE v8_mask real_lanes(const prism *p, int32_t first)
{
    return v8_less(LANE_NUMBERS + (double)first, v8_set(p->count));
}

/* Vertices first..first+7; from `count` on the first one again. */
V8_INLINE void load_vertices(const prism *p, int32_t first, v8 *x, v8 *y)
{
    v8_mask real = real_lanes(p, first);
    load_points(p, p->vertex, first, x, y);
    *x = v8_select(real, *x, v8_set(p->vertex[0].x));
    *y = v8_select(real, *y, v8_set(p->vertex[0].y));
}

/* ---- extents ---- */

/* Least and largest of n . v over the vertices. */
V8_INLINE void plan_span(const prism *p, double nx, double ny, double *low, double *high)
{
    v8 least = v8_set(HUGE_VAL), most = v8_set(-HUGE_VAL);
    for (int32_t first = 0; first < p->count; first += V8_LANES) {
        v8 x, y;
        load_vertices(p, first, &x, &y);
        v8 d = nx * x + ny * y;
        least = v8_min(d, least);
        most = v8_max(d, most);
    }
    *low = v8_least(least);
    *high = v8_most(most);
}

/* How far apart the two are along an axis from b to a. */
V8_INLINE double axis_gap(const prism *a, const prism *b, vec3 axis)
{
    vec3 na = mat3_tmul_vec(a->rotation, axis), nb = mat3_tmul_vec(b->rotation, axis);
    double low_a, high_a, low_b, high_b;
    plan_span(a, na.x, na.y, &low_a, &high_a);
    plan_span(b, nb.x, nb.y, &low_b, &high_b);
    double bottom = vec3_dot(axis, a->centre) + low_a - a->half_height * fabs(na.z);
    double top = vec3_dot(axis, b->centre) + high_b + b->half_height * fabs(nb.z);
    return bottom - top;
}

/* ---- sides ---- */

/* Sides of one prism. */
typedef struct side_block {
    v8 nx, ny; /* unit outward normals in its plan view */
    v8_mask real;
} side_block;

/* The other's frame as the holder of the sides sees it: r turns the other's coordinates into the holder's. */
typedef struct seen_frame {
    double r[3][3];
    vec3 t;
} seen_frame;

typedef struct best_of_sides {
    double depth;
    int32_t side;
} best_of_sides;

/* The side along which `other` reaches least deep into p. */
V8_INLINE best_of_sides search_all_sides(const prism *p, const prism *other, const seen_frame *f, side_block *blocks)
{
    best_of_sides best = {HUGE_VAL, 0};
    for (int32_t first = 0, k = 0; first < p->count; first += V8_LANES, k++) {
        side_block *s = &blocks[k];
        v8 x, y;
        load_points(p, p->vertex, first, &x, &y);
        load_points(p, p->side, first, &s->nx, &s->ny);
        s->real = real_lanes(p, first);
        v8 mx = f->r[0][0] * s->nx + f->r[1][0] * s->ny, my = f->r[0][1] * s->nx + f->r[1][1] * s->ny;
        v8 mz = f->r[0][2] * s->nx + f->r[1][2] * s->ny, low = v8_set(HUGE_VAL);
        for (int32_t i = 0; i < other->count; i++)
            low = v8_min(mx * other->vertex[i].x + my * other->vertex[i].y, low);
        low += s->nx * f->t.x + s->ny * f->t.y - other->half_height * v8_abs(mz);
        v8 depth = v8_select(s->real, s->nx * x + s->ny * y - low, v8_set(HUGE_VAL));
        double least = v8_least(depth);
        if (least < best.depth) {
            best.depth = least;
            best.side = first + __builtin_ctz(v8_bits(v8_less_equal(depth, v8_set(least))));
        }
    }
    return best;
}

/* Overlap along p's own axis: exactly, or any bound below it that is already more than `enough`. */
V8_INLINE double rise_of(const prism *p, const prism *other, const seen_frame *f, double enough)
{
    double reach = other->half_height * fabs(f->r[2][2]);
    double slope = sqrt(f->r[2][0] * f->r[2][0] + f->r[2][1] * f->r[2][1]);
    double bound = (p->half_height - fabs(f->t.z)) + (reach - slope * other->plan_radius);
    if (bound > enough)
        return bound;
    double low, high;
    plan_span(other, f->r[2][0], f->r[2][1], &low, &high);
    return f->t.z > 0 ? p->half_height - (f->t.z + low - reach) : (f->t.z + high + reach) + p->half_height;
}

V8_INLINE vec2 side_normal_of(const side_block *blocks, int32_t side)
{
    const side_block *s = &blocks[side / V8_LANES];
    return vec2_make(s->nx[side % V8_LANES], s->ny[side % V8_LANES]);
}

/* The side whose normal is most opposed to the plan direction d. */
V8_INLINE int32_t most_opposed_side(const side_block *blocks, int32_t count, double dx, double dy)
{
    double best = HUGE_VAL;
    int32_t side = 0;
    for (int32_t first = 0, k = 0; first < count; first += V8_LANES, k++) {
        v8 along = v8_select(blocks[k].real, blocks[k].nx * dx + blocks[k].ny * dy, v8_set(HUGE_VAL));
        double least = v8_least(along);
        if (least < best) {
            best = least;
            side = first + __builtin_ctz(v8_bits(v8_less_equal(along, v8_set(least))));
        }
    }
    return side;
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
    side_block of_a[MOST_BLOCKS], of_b[MOST_BLOCKS];
    best_of_sides in_a = search_all_sides(a, b, &b_in_a, of_a), in_b = search_all_sides(b, a, &a_in_b, of_b);
    if (in_a.depth < -slack || in_b.depth < -slack) {
        bool by_a = in_a.depth <= in_b.depth;
        out->gap = by_a ? -in_a.depth : -in_b.depth;
        out->axis = by_a ? vec3_neg(global_direction(a, side_normal_of(of_a, in_a.side)))
                         : global_direction(b, side_normal_of(of_b, in_b.side));
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
    vec2 n = side_normal_of(out->swapped ? of_b : of_a, best->side);
    out->kind = PRISMS_AT_SIDES;
    out->side = best->side;
    out->normal = n;
    out->opposed = most_opposed_side(out->swapped ? of_a : of_b, out->swapped ? a->count : b->count,
                                     f->r[0][0] * n.x + f->r[1][0] * n.y, f->r[0][1] * n.x + f->r[1][1] * n.y);
}
