/* Intervals of levels of Gumbel's law that are exact for samples of any size: given how the values lie to one another
   (their ancillary statistic), location and scale have a known joint law, over which is integrated (Lawless 1978,
   Technometrics 20, 355; Lawless 1982, section 4.1.2, of least values).  Knows numbers only; the same to the bit
   everywhere. */
#ifndef STUDY_PIVOT_H
#define STUDY_PIVOT_H

#include "base/random.h"
#include "study/profile.h"

/* Points of the integral over the scale. */
enum { PIVOT_POINTS = 120 };

/* Law of the scale, of which each point has a part, given the sample. */
typedef struct gumbel_pivot {
    double location, scale; /* the fit that all is measured by */
    double log_factorial;   /* of count - 1 */
    int32_t count;
    double ratio[PIVOT_POINTS];   /* fitted scale over scale */
    double log_sum[PIVOT_POINTS]; /* log sum exp(-(x - location)/scale) */
    double weight[PIVOT_POINTS];
} gumbel_pivot;

/* Of values in any order and a fit to them, by likelihood or L-moments: the interval does not depend on which. */
void gumbel_pivot_make(const double *value, int32_t count, const extreme_law *fit, gumbel_pivot *out);
/* How sure the sample is that the level with `exponent` expected exceedances a block lies below x. */
double gumbel_pivot_below(const gumbel_pivot *p, double exponent, double x);
/* Of the level with `exponent` expected exceedances a block. */
level_interval gumbel_pivot_interval(const gumbel_pivot *p, double exponent, double confidence);

/* A law that the values may be of: location and scale drawn from that joint law (the fiducial law of Gumbel's). */
void gumbel_pivot_draw(const gumbel_pivot *p, random_stream *random, extreme_law *out);

#endif
