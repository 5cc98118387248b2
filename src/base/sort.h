/* Numbers in ascending order. */
#ifndef BASE_SORT_H
#define BASE_SORT_H

#include <stdint.h>

/* None of them may be NaN. */
void numbers_sort(double *value, int64_t count);

#endif
