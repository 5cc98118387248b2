/* Whether the two halves of a series are of one process.  Knows numbers only. */
#ifndef STUDY_STEADINESS_H
#define STUDY_STEADINESS_H

#include "study/series_set.h"

/* By how many of its standard deviations the difference of the means of the first and the second halves of the parts is
   larger than chance has it once in 700 times, by Student's t of the means of batches, or of the differences of eight
   parts or more; 0: it is not, or there are too few batches to judge by.  FRAM_ERROR_MEMORY. */
fram_status halves_differ(context *ctx, const series_set *s, double *deviations, fram_error *error);

#endif
