#include "results/thinned.h"

#include <stdlib.h>

bool thinned_add(context *ctx, thinned *t, double value)
{
    if (t->step == 0)
        t->step = 1;
    if (t->seen++ % t->step != 0)
        return true;
    if (t->value.count == THINNED_MOST) {
        for (int32_t i = 0; i < THINNED_MOST / 2; i++)
            t->value.data[i] = t->value.data[2 * i];
        t->value.count = THINNED_MOST / 2;
        t->step *= 2;
    }
    return array_push(ctx, &t->value, value);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double thinned_percentile(thinned *t, int percent)
{
    if (t->value.count == 0)
        return 0;
    qsort(t->value.data, (size_t)t->value.count, sizeof *t->value.data, ascending);
    return t->value.data[(int64_t)(t->value.count - 1) * percent / 100];
}
