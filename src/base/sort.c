#include "base/sort.h"

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
