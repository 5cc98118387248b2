/* Laws of extreme values and their fits.  Shapes are positive for a heavy tail (xi of Coles 2001; scipy's genextreme
   has the other sign).  Knows numbers only; the same to the bit everywhere. */
#ifndef STUDY_EXTREME_LAW_H
#define STUDY_EXTREME_LAW_H

#include "base/context.h"

typedef enum law_kind {
    LAW_GUMBEL, /* of maxima: exp(-exp(-(x - location)/scale)) */
    LAW_GEV,    /* of maxima: exp(-(1 + shape (x - location)/scale)^(-1/shape)) */
    LAW_PARETO, /* of what is over a threshold (location): 1 - (1 + shape (x - location)/scale)^(-1/shape) */
    LAW_WEIBULL /* of peaks: 1 - exp(-((x - location)/scale)^shape); the location is given */
} law_kind;

typedef struct extreme_law {
    law_kind kind;
    double location, scale, shape;
} extreme_law;

typedef enum law_fit { FIT_LIKELIHOOD, FIT_MOMENTS } law_fit;

/* Least number of values of a fit: with fewer there is no answer. */
enum { LAW_VALUES_LEAST = 10 };

/* Least shape that is looked for, by a fit and by a profile: below -1 the likelihood has no maximum. */
#define SHAPE_LEAST (-0.999)
/* Greatest shapes that are looked for: by a fit, beyond which the mean is none (> 1), and by a profile. */
#define FIT_SHAPE_MOST 1.5
#define PROFILE_SHAPE_MOST 5.0
/* Maxima (ascending) so many of which are equal and the least, as of runs that met no ice, that the likelihood of laws
   up to a shape has no maximum: how many; 0: there are none, or not so many. */
int32_t extreme_law_tied(const double *sorted, int32_t count, double shape);

/* Fits to values in ascending order.  LAW_PARETO and LAW_WEIBULL: values over `location`, which is not fitted.  Maximum
   likelihood; or L-moments (Hosking 1990), which LAW_WEIBULL does not have here.  false: too few values, all of them
   equal, maxima that are tied, or no fit. */
bool extreme_law_fit(law_kind kind, law_fit how, const double *sorted, int32_t count, double location,
                     extreme_law *out);

/* -log of the probability that the law's variable stays below x, for laws of maxima; of the probability that it is
   above x for laws of peaks.  In other words: the expected number of exceedances in a block, and -log(survival). */
double extreme_law_exponent(const extreme_law *law, double x);
/* x where that is `exponent` > 0. */
double extreme_law_level(const extreme_law *law, double exponent);
/* -log likelihood; infinite where a value cannot be. */
double extreme_law_cost(const extreme_law *law, const double *value, int32_t count);

#endif
