/* See solver_bodies_kernel.h. */
#include "dynamics/solver_bodies_kernel.h"

#include "base/lanes.h"

/* Eight doubles of eight bodies into their rows, zero where the mask is not set.  Changes column. */
V8_INLINE void put_rows(double *rows, v8_mask mask, double factor, v8 column[BODY_ROW])
{
    for (int i = 0; i < BODY_ROW; i++)
        column[i] = v8_select(mask, factor * column[i], v8_set(0));
    v8_transpose(column);
    for (int i = 0; i < V8_LANES; i++)
        v8_store(rows + (ptrdiff_t)V8_LANES * i, column[i]);
}

/* Component `at` of the given rows of `stride` doubles. */
V8_INLINE v8 pick(const double *p, int stride, int at, const int32_t slot[V8_LANES])
{
    int32_t place[V8_LANES];
    for (int i = 0; i < V8_LANES; i++)
        place[i] = stride * slot[i] + at;
    return v8_gather(p, place);
}

V8_INLINE lanes3 pick3(const vec3 *v, const int32_t slot[V8_LANES])
{
    return (lanes3){pick(&v->x, 3, 0, slot), pick(&v->x, 3, 1, slot), pick(&v->x, 3, 2, slot)};
}

/* Inverse mass, global frame; `general`: lanes where it depends on the direction. */
V8_INLINE void inverse_mass(const body_table *bodies, const int32_t slot[V8_LANES], const lanes33 *r, v8 out[6],
                            v8_mask *general)
{
    v8 mass = pick(bodies->mass, 1, 0, slot), zero = v8_set(0);
    lanes3 added = pick3(bodies->added_mass, slot);
    *general = v8_less(zero, v8_max(v8_max(v8_abs(added.x), v8_abs(added.y)), v8_abs(added.z)));
    out[0] = out[1] = out[2] = 1 / mass;
    out[3] = out[4] = out[5] = zero;
    if (!v8_any(*general))
        return;
    v8 body[6] = {1 / (mass + added.x), 1 / (mass + added.y), 1 / (mass + added.z), zero, zero, zero}, turned[6];
    lanes_sym3_rotate(body, r, turned);
    for (int i = 0; i < 6; i++)
        out[i] = v8_select(*general, turned[i], out[i]);
}

void KERNEL(solver_masses)(const body_table *bodies, const int32_t slot[V8_LANES], double factor, const body_rows *rows)
{
    int32_t place[V8_LANES];
    double movable[V8_LANES];
    for (int i = 0; i < V8_LANES; i++) {
        movable[i] = slot[i] >= 0 && body_is_dynamic(bodies, slot[i]) ? 1 : 0;
        place[i] = slot[i] < 0 ? 0 : slot[i];
    }
    v8 zero = v8_set(0), one = v8_set(1);
    v8_mask moves = v8_less(zero, v8_load(movable)), general, none = v8_less(one, zero);
    const double *q = &bodies->orientation->w;
    lanes33 r = lanes_quat_matrix(
        (lanes_quat){pick(q, 4, 0, place), pick(q, 4, 1, place), pick(q, 4, 2, place), pick(q, 4, 3, place)});
    v8 inertia[6], inverse[INVERSE_ROW], mass[TENSOR_ROW];
    for (int i = 0; i < 6; i++)
        inertia[i] = pick(&bodies->inertia->xx, 6, i, place);
    lanes3 added = pick3(bodies->added_inertia, place);
    inertia[0] = inertia[0] + added.x;
    inertia[1] = inertia[1] + added.y;
    inertia[2] = inertia[2] + added.z;
    lanes_sym3_inverse(inertia, mass);
    lanes_sym3_rotate(mass, &r, inverse);
    inverse_mass(bodies, place, &r, mass, &general);
    v8 out[BODY_ROW] = {zero, zero, zero, zero, zero, zero, zero, zero};
    lanes_sym3_inverse(mass, out);
    put_rows(rows->mass, factor == 1 ? moves : none, 1, out);
    out[6] = out[7] = zero;
    lanes_sym3_inverse(inverse, out);
    put_rows(rows->inertia, factor == 1 ? moves : none, 1, out);
    for (int i = 0; i < 6; i++)
        out[i] = inverse[i];
    out[INVERSE_MASS] = mass[0];
    out[INVERSE_GENERAL] = v8_select(general, one / factor, zero);
    put_rows(rows->inverse, moves, factor, out);
    mass[6] = mass[7] = zero;
    put_rows(rows->tensor, moves, factor, mass);
}
