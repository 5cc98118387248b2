/* A share of trials with its exact interval.  Knows numbers alone. */
#ifndef STUDY_PROPORTION_H
#define STUDY_PROPORTION_H

#include <stdint.h>

/* good of count trials, and the interval that holds the probability behind them with this confidence at least, each
   side with half of what is left (Clopper and Pearson 1934, Biometrika 26, 404).  NaN where there are no trials. */
typedef struct proportion {
    double share, low, high;
} proportion;
proportion proportion_of(int32_t good, int32_t count, double confidence);

#endif
