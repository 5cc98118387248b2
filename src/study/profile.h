/* Confidence intervals by profile likelihood (Coles 2001, 2.6.6): all values of a quantile that the data do not speak
   against, by Wilks's theorem with Student's t in place of the normal law.  Knows laws and samples; the same to the bit
   everywhere. */
#ifndef STUDY_PROFILE_H
#define STUDY_PROFILE_H

#include "study/extreme_law.h"

/* What is asked: the level that the greatest value in a time stays below with the probability p. */
typedef struct profile_question {
    const extreme_law *law; /* the fit, by maximum likelihood */
    const double *sorted;
    int32_t count;
    double exposure;   /* laws of maxima: blocks in that time; laws of peaks: that time over the time of the sample, so
                          that exposure x count peaks are expected in it */
    double exponent;   /* -log p */
    double confidence; /* 0.95 */
    double bound;      /* of the root of the deviance; NaN or 0: Student's t, see profile_interval */
    context *ctx;      /* is told how far it is; with its stop asked for no answer is one; may be NULL */
} profile_question;

typedef struct level_interval {
    double level, low, high; /* high may be infinite: nothing bounds it from above */
} level_interval;

/* The level of the law and its interval.  The number of peaks over a threshold is taken as Poisson's; that of Weibull's
   peaks as known. */
level_interval profile_interval(const profile_question *q);

/* The cost at the level of the law, against which that of others is measured. */
double profile_least(const profile_question *q);
/* The part of a level's law, as the profile tells it, that lies beyond x: above it, or below. */
double profile_beyond(const profile_question *q, double least, double x, bool above);

#endif
