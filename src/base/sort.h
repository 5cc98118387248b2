/* Numbers in ascending order, and the middle of them. */
#ifndef BASE_SORT_H
#define BASE_SORT_H

#include <stdint.h>

/* None of them may be NaN. */
void numbers_sort(double *value, int64_t count);
/* Of numbers in ascending order: the middle one, of an even number of them the mean of the two in the middle; infinite
   where one of those is, and NaN without any. */
double numbers_median(const double *value, int64_t count);

#endif
