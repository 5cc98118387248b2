/* Sums over bodies and combinations of vectors for solver_accelerate.c, declared in solver_sweep_kernel.h.  One
   register of lanes after the other, as there. */
#include "dynamics/solver_sweep_kernel.h"

#include "base/parts.h"

enum { LANES = V8_PART_LANES, PARTS = V8_PARTS };

/* Bodies' rows, one column per number. */
typedef struct lanes_rows {
    real column[BODY_ROW];
} lanes_rows;

V8_INLINE lanes_rows rows_load(const double *rows, int32_t first)
{
    lanes_rows r;
    static const int32_t next[BATCH_LANES] = {0, 1, 2, 3, 4, 5, 6, 7};
    v8_part_gather_rows(rows + (ptrdiff_t)BODY_ROW * first, next, r.column);
    return r;
}

V8_INLINE lanes_rows rows_subtract(lanes_rows a, lanes_rows b)
{
    a.column[0] = a.column[0] - b.column[0];
    a.column[1] = a.column[1] - b.column[1];
    a.column[2] = a.column[2] - b.column[2];
    a.column[3] = a.column[3] - b.column[3];
    a.column[4] = a.column[4] - b.column[4];
    a.column[5] = a.column[5] - b.column[5];
    return a;
}

/* Momentum and spin momentum of velocities. */
V8_INLINE lanes_rows weighted(const lanes_rows *mass, const lanes_rows *inertia, const lanes_rows *v)
{
    real3 linear = sym3_times(mass->column, (real3){v->column[0], v->column[1], v->column[2]});
    real3 angular = sym3_times(inertia->column, (real3){v->column[3], v->column[4], v->column[5]});
    return (lanes_rows){{linear.x, linear.y, linear.z, angular.x, angular.y, angular.z}};
}

V8_INLINE real rows_dot(const lanes_rows *a, const lanes_rows *b)
{
    return a->column[0] * b->column[0] + a->column[1] * b->column[1] + a->column[2] * b->column[2] +
           a->column[3] * b->column[3] + a->column[4] * b->column[4] + a->column[5] * b->column[5];
}

typedef struct product_sums {
    real direction[SEARCH_DIRECTIONS][PARTS], velocity[SEARCH_DIRECTIONS][PARTS], square[PARTS];
} product_sums;

V8_INLINE void products_part(const double *velocity, const double *start, double *const *direction, int directions,
                             const double *mass, const double *inertia, int32_t first, int part, product_sums *sums)
{
    lanes_rows m = rows_load(mass, first), j = rows_load(inertia, first), v = rows_load(velocity, first);
    lanes_rows now = rows_subtract(v, rows_load(start, first));
    lanes_rows momentum = weighted(&m, &j, &v), change = weighted(&m, &j, &now);
    sums->square[part] = sums->square[part] + rows_dot(&momentum, &v);
    sums->direction[0][part] = sums->direction[0][part] + rows_dot(&change, &now);
    sums->velocity[0][part] = sums->velocity[0][part] + rows_dot(&momentum, &now);
    for (int w = 1; w < directions; w++) {
        lanes_rows d = rows_load(direction[w], first);
        sums->direction[w][part] = sums->direction[w][part] + rows_dot(&change, &d);
        sums->velocity[w][part] = sums->velocity[w][part] + rows_dot(&momentum, &d);
    }
}

/* directions: a constant of the caller, so that sums stay in registers. */
V8_INLINE direction_products products_of(const double *velocity, const double *start, double *const *direction,
                                         int directions, const double *mass, const double *inertia, int32_t first,
                                         int32_t end)
{
    product_sums all;
    for (int h = 0; h < PARTS; h++) {
        for (int w = 0; w < SEARCH_DIRECTIONS; w++)
            all.direction[w][h] = all.velocity[w][h] = v8_part_set(0);
        all.square[h] = v8_part_set(0);
    }
    for (int32_t i = first; i < end; i += BATCH_LANES)
        for (int h = 0; h < PARTS; h++)
            products_part(velocity, start, direction, directions, mass, inertia, i + LANES * h, h, &all);
    direction_products sums = {.square = parts_sum(all.square)};
    for (int w = 0; w < SEARCH_DIRECTIONS; w++) {
        sums.direction[w] = parts_sum(all.direction[w]);
        sums.velocity[w] = parts_sum(all.velocity[w]);
    }
    return sums;
}

_Static_assert(SEARCH_DIRECTIONS == 4, "a case for each number of directions");

direction_products KERNEL(solver_products)(const double *velocity, const double *start, double *const *direction,
                                           int32_t directions, const double *mass, const double *inertia, int32_t first,
                                           int32_t end)
{
    switch (directions) {
    case 1:
        return products_of(velocity, start, direction, 1, mass, inertia, first, end);
    case 2:
        return products_of(velocity, start, direction, 2, mass, inertia, first, end);
    case 3:
        return products_of(velocity, start, direction, 3, mass, inertia, first, end);
    default:
        return products_of(velocity, start, direction, SEARCH_DIRECTIONS, mass, inertia, first, end);
    }
}

/* ---- solver_combine ---- */

void KERNEL(solver_combine)(double *x, double *start, double *kept, double *const *direction, int32_t directions,
                            const double share[SEARCH_DIRECTIONS], int64_t first, int64_t end)
{
    for (int64_t i = first; i < end; i += LANES) {
        real old = load(x + i), began = load(start + i), next = old + share[0] * (old - began);
        for (int32_t w = 1; w < directions; w++)
            next = next + share[w] * load(direction[w] + i);
        store(kept + i, old);
        store(direction[SEARCH_DIRECTIONS - 1] + i, next - began);
        store(start + i, next);
        store(x + i, next);
    }
}
