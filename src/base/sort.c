#include "base/sort.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void numbers_sort(double *value, int64_t count)
{
    if (count > 1)
        qsort(value, (size_t)count, sizeof *value, ascending);
}

double numbers_median(const double *value, int64_t count)
{
    if (count < 1)
        return (double)NAN;
    return (value[(count - 1) / 2] + value[count / 2]) / 2;
}
