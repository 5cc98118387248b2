#include "study/minimise.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

typedef struct simplex {
    minimise_function f;
    const void *of;
    int n;
    double x[MINIMISE_MOST + 1][MINIMISE_MOST], value[MINIMISE_MOST + 1];
} simplex;

/* Looks of one descent, beyond which nothing is gained any more. */
enum { DESCENT_LOOKS_MOST = 2000 };

static double look(const simplex *s, const double *x)
{
    double value = s->f(s->of, x);
    return isnan(value) ? (double)INFINITY : value;
}

static void begin(simplex *s, const double *x, const double *step)
{
    for (int i = 0; i <= s->n; i++) {
        for (int k = 0; k < s->n; k++)
            s->x[i][k] = x[k] + (i == k + 1 ? step[k] : 0);
        s->value[i] = look(s, s->x[i]);
    }
}

/* Corners in the order of their values; few enough for insertion. */
static void sort(simplex *s)
{
    for (int i = 1; i <= s->n; i++) {
        for (int k = i; k > 0 && s->value[k] < s->value[k - 1]; k--) {
            double value = s->value[k], x[MINIMISE_MOST];
            memcpy(x, s->x[k], sizeof x);
            s->value[k] = s->value[k - 1];
            memcpy(s->x[k], s->x[k - 1], sizeof x);
            s->value[k - 1] = value;
            memcpy(s->x[k - 1], x, sizeof x);
        }
    }
}

/* The worst corner is put at centre + along (worst - centre) when that is below `bound`. */
static bool replace(simplex *s, const double *centre, const double *worst, double along, double bound)
{
    double x[MINIMISE_MOST];
    for (int k = 0; k < s->n; k++)
        x[k] = centre[k] + along * (worst[k] - centre[k]);
    double value = look(s, x);
    if (!(value < bound))
        return false;
    memcpy(s->x[s->n], x, sizeof x);
    s->value[s->n] = value;
    return true;
}

static void shrink(simplex *s)
{
    for (int i = 1; i <= s->n; i++) {
        for (int k = 0; k < s->n; k++)
            s->x[i][k] = 0.5 * (s->x[i][k] + s->x[0][k]);
        s->value[i] = look(s, s->x[i]);
    }
}

static void advance(simplex *s)
{
    double centre[MINIMISE_MOST] = {0}, worst[MINIMISE_MOST];
    memcpy(worst, s->x[s->n], sizeof worst);
    for (int k = 0; k < s->n; k++)
        for (int i = 0; i < s->n; i++)
            centre[k] += s->x[i][k] / s->n;
    double before = s->value[s->n];
    if (replace(s, centre, worst, -1, s->value[s->n - 1])) {
        if (s->value[s->n] < s->value[0])
            (void)replace(s, centre, worst, -2, s->value[s->n]);
        return;
    }
    if (!replace(s, centre, worst, -0.5, before) && !replace(s, centre, worst, 0.5, before))
        shrink(s);
}

static bool is_small(const simplex *s, double tolerance)
{
    if (!(s->value[s->n] - s->value[0] <= tolerance))
        return false;
    for (int k = 0; k < s->n; k++)
        if (fabs(s->x[s->n][k] - s->x[0][k]) > sqrt(tolerance) * (1 + fabs(s->x[0][k])))
            return false;
    return true;
}

static void descend(simplex *s, double tolerance)
{
    sort(s);
    for (int i = 0; i < DESCENT_LOOKS_MOST && !is_small(s, tolerance); i++) {
        advance(s);
        sort(s);
    }
}

double minimise(minimise_function f, const void *of, int count, double *x, const double *step, double tolerance,
                int descents)
{
    simplex s = {.f = f, .of = of, .n = count};
    double around[MINIMISE_MOST] = {0}, before = (double)INFINITY;
    for (int k = 0; k < count; k++)
        around[k] = step[k];
    for (int i = 0; i < descents; i++) {
        begin(&s, x, around);
        descend(&s, tolerance);
        memcpy(x, s.x[0], (size_t)count * sizeof *x);
        if (!(before - s.value[0] > tolerance))
            break;
        before = s.value[0];
        for (int k = 0; k < count; k++)
            around[k] *= 0.25;
    }
    return s.value[0];
}
