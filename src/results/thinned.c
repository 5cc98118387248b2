#include "results/thinned.h"
#include "base/sort.h"

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

double thinned_percentile(thinned *t, int percent)
{
    if (t->value.count == 0)
        return 0;
    numbers_sort(t->value.data, t->value.count);
    return t->value.data[(int64_t)(t->value.count - 1) * percent / 100];
}
