/* The solver that judges the others: the same rows, swept until nothing is left to do, sped up by nonlinear conjugate
   gradients over the sweeps (Silcowitz, Niebe and Erleben 2010, A nonsmooth nonlinear conjugate gradient method for
   interactive contact force problems). */
#include "dynamics/solver_rows.h"

#include <string.h>

/* All multipliers as one vector: contacts, then joints. */
static int32_t multiplier_count(const solver *s) { return 3 * s->contacts.count + JOINT_MOST_ROWS * s->joints.count; }

static double *multiplier_of(solver *s, int32_t i)
{
    int32_t contacts = 3 * s->contacts.count;
    if (i < contacts)
        return &s->contacts.data[i / 3].impulse[i % 3];
    i -= contacts;
    return &s->joints.data[i / JOINT_MOST_ROWS].impulse[i % JOINT_MOST_ROWS];
}

static void add_multipliers(solver *s, const double *step, double scale)
{
    int32_t at = 0;
    for (int32_t i = 0; i < s->contacts.count; i++) {
        contact_row *row = &s->contacts.data[i];
        for (int k = 0; k < 3; k++, at++) {
            row->impulse[k] += scale * step[at];
            row_axis_push(&row->axis[k], &s->bodies.data[row->a], &s->bodies.data[row->b], scale * step[at]);
        }
    }
    for (int32_t i = 0; i < s->joints.count; i++, at += JOINT_MOST_ROWS) {
        joint_block *j = &s->joints.data[i];
        for (int r = 0; r < j->count; r++) {
            j->impulse[r] += scale * step[at + r];
            row_axis_push(&j->axis[r], &s->bodies.data[j->body], &s->bodies.data[j->base], scale * step[at + r]);
        }
    }
}

static double largest_residual(const solver *s)
{
    double largest = 0;
    for (int32_t i = 0; i < s->contacts.count; i++) {
        const contact_row *row = &s->contacts.data[i];
        largest = fmax(largest, fmax(contact_row_residual(s, row), contact_row_slip_residual(s, row)));
    }
    for (int32_t i = 0; i < s->joints.count; i++)
        largest = fmax(largest, joint_row_residual(s, &s->joints.data[i]));
    return largest;
}

/* One sweep; the squared change of the multipliers stands for the squared gradient. before keeps the change. */
static double sweep_change(solver *s, int32_t count)
{
    double *before = s->before.data, square = 0;
    for (int32_t i = 0; i < count; i++)
        before[i] = *multiplier_of(s, i);
    joint_row_sweep(s);
    contact_row_sweep(s, false);
    for (int32_t i = 0; i < count; i++) {
        before[i] = *multiplier_of(s, i) - before[i];
        square += before[i] * before[i];
    }
    return square;
}

fram_status solver_iterate_accurately(solver *s, const solver_settings *settings, int32_t *sweeps)
{
    int32_t count = multiplier_count(s);
    if (!array_resize(s->ctx, &s->before, count) || !array_resize(s->ctx, &s->direction, count))
        return FRAM_ERROR_MEMORY;
    double *direction = s->direction.data, last = 0;
    for (int32_t i = 0; i < count; i++)
        direction[i] = 0;
    for (*sweeps = 0; *sweeps < settings->most_iterations;) {
        double square = sweep_change(s, count), beta = last > 0 ? square / last : 0;
        last = square;
        /* Judged right after a sweep, where all impulses are within their bounds. */
        if (++*sweeps == settings->most_iterations || largest_residual(s) <= settings->tolerance)
            break;
        if (beta > 1) {
            memset(direction, 0, (size_t)count * sizeof *direction);
            continue;
        }
        add_multipliers(s, direction, beta);
        for (int32_t i = 0; i < count; i++)
            direction[i] = beta * direction[i] + s->before.data[i];
    }
    return FRAM_OK;
}
