/* How many seeds a condition takes: told by the figures of its first seeds in their order, so that the answer does not
   depend on which runs end first. */
#ifndef STUDY_SEEDS_H
#define STUDY_SEEDS_H

#include "study/study.h"

/* A mean over seeds with half the width of its confidence interval (Student's t); NaN for fewer than two values, or
   too large ones. */
typedef struct seed_interval {
    double mean, half;
} seed_interval;
seed_interval seed_interval_of(const double *value, int32_t count, double confidence);

/* What is asked of the most probable largest load: how often the runs' time goes into the duration, by which law. */
typedef struct seeds_extreme {
    context *ctx;
    double times, confidence;
    bool gev;
} seeds_extreme;
seeds_extreme seeds_extreme_of(context *ctx, const study *s, double block);

/* Seeds that a condition takes, given the figures of its first `count` seeds in their order (a NaN for a run that
   failed, which counts as a seed and adds nothing): more than `count` as long as it needs more, then a batch of a
   quarter more at a time, which is the same for any number of processes.  No more where all failed, two or more.
   rare: where the rule asks for extreme_within. */
int32_t seeds_wanted(const study_seeds *rule, const double *mean, const double *largest, const seeds_extreme *rare,
                     int32_t count);

#endif
