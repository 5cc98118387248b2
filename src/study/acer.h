/* Average conditional exceedance rates (Naess and Gaidai 2009, Structural Safety 31): how often a level is exceeded by
   a value after k - 1 values that are below it, and the law that these rates follow in the tail.  k = 2 counts
   crossings upwards, so that rates of up-crossing (Naess and Gaidai 2008) are a case of it.  Knows numbers only. */
#ifndef STUDY_ACER_H
#define STUDY_ACER_H

#include "study/profile.h"
#include "study/series_set.h"

enum { ACER_LEVELS = 40, ACER_BATCHES_LEAST = 20, ACER_REPLICATES = 499 };

/* Rates at levels, counted by batches of the series, which stand for independent realizations.  They need not be of one
   length: a rate is over the values of the batches that it is counted in. */
typedef struct acer_rates {
    double level[ACER_LEVELS];
    int32_t levels;        /* 0: there are too few exceedances */
    int32_t batches;       /* that have values */
    ARRAY(int32_t) count;  /* batches x ACER_LEVELS: conditional exceedances */
    ARRAY(int32_t) values; /* of each batch: those that have k - 1 values of their part before them */
    int32_t full;          /* such values of a part that is just as long as a batch */
    double step;           /* between values [s] */
} acer_rates;

/* rate(x) = q exp(-a (x - b)^c) a value, from the first level on */
typedef struct acer_tail {
    double q, a, b, c;
} acer_tail;

/* Counts at levels from `tail` to the greatest value.  k: order, from 1.  batch: values of a batch, at
   least, where a part has as many.  Free with acer_free. */
bool acer_count(context *ctx, const series_set *s, int32_t k, double tail, int32_t batch, acer_rates *out);
void acer_free(context *ctx, acer_rates *r);
/* How often a level is exceeded, over all batches, and by how many values it could be. */
int64_t acer_exceedances(const acer_rates *r, int32_t level);
int64_t acer_values(const acer_rates *r);
/* As many batches of one length have rates of the same scatter (Kish 1965): (sum n)^2 / sum n^2 of the values of each,
   of which one that is longer than a batch has no more than a full one: it knows no less of its own. */
double acer_effective_batches(const acer_rates *r);

/* Fit by the weights of Naess and Gaidai, of logarithms of rates whose 95 % interval is bounded from below.  false:
   there are fewer than five such levels, or no law fits. */
bool acer_fit(const acer_rates *r, acer_tail *out);
/* Where the greatest value in a time [s] stays below with the probability exp(-exponent). */
double acer_level(const acer_tail *tail, double step, double time, double exponent);
/* Whether the power of the law is at a bound of those that were tried: its form is not determined. */
bool acer_is_at_bound(const acer_tail *tail);

/* What the draws of a bootstrap say of the fit: a tail that goes on as it begins is the same by all of its levels and
   by their upper half alone. */
typedef struct acer_doubt {
    double fitted;      /* the part of the draws that a law fits */
    double upper;       /* the first exponent's level by the upper half alone; NaN: too few levels */
    bool upper_differs; /* from the level by all, beyond what nearly all draws differ (UPPER_CONFIDENCE) */
} acer_doubt;

/* The same for several exponents, with the intervals of a bootstrap over batches (percentiles of ACER_REPLICATES draws
   of as many batches).  FRAM_ERROR_MEMORY, FRAM_INTERRUPTED. */
fram_status acer_intervals(context *ctx, const acer_rates *r, const acer_tail *fit, double time, const double *exponent,
                           int32_t count, double confidence, level_interval *out, acer_doubt *doubt, fram_error *error);

#endif
