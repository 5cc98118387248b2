/* What an interval by profile likelihood does not know of: the scatter of what was taken as known (Weibull's peaks),
   and how far a law over a threshold is from its limit (Pareto's).  One module with extremes, whose inside this is. */
#ifndef STUDY_EXTREMES_SPREAD_H
#define STUDY_EXTREMES_SPREAD_H

#include "study/profile.h"
#include "study/series_set.h"

/* Fits of Weibull's law to a series without one of its groups in turn. */
enum { JACKKNIFE_GROUPS = 40, JACKKNIFE_LEAST = 10 };
typedef struct weibull_jackknife {
    int groups; /* 0: the series is too short for it, or has too few peaks without one of the groups */
    extreme_law law[JACKKNIFE_GROUPS];
    double peaks[JACKKNIFE_GROUPS]; /* expected in the duration */
} weibull_jackknife;

/* Groups are pieces of the series of at least twenty time scales; of each remainder mean, peaks above it and law are
   found anew.  FRAM_ERROR_MEMORY, FRAM_INTERRUPTED. */
fram_status jackknife_weibull(context *ctx, const series_set *s, const series_nature *nature, double duration,
                              weibull_jackknife *out, fram_error *error);
/* The bound of the root of the deviance, of a level with this exponent: the deviance of peaks that are not independent,
   about a mean that is not known, is that of independent ones times a factor (Chandler and Bate 2007), here the ratio
   of the variance by the jackknife (Miller 1974) to that of the fit, at least a tenth; Student's t of as many degrees
   as there are groups less one.  law, count: the fit to all.  NaN without groups. */
double jackknife_bound(const weibull_jackknife *j, const extreme_law *law, int32_t count, double exponent,
                       double confidence);

/* The level of a Pareto law over a threshold, or of a law of maxima over its location, when the tail of the parent is
   Weibull's, as that of Gaussian loads is: then its shape goes to 0 with the inverse of the logarithm of the survival
   (Smith 1987), where the fit takes it as constant; that of the fit where the survival tells nothing.  survival: the
   part of all values over the threshold or location.  rare: the logarithm of the number of peaks, or blocks, over the
   number of exceedances asked for. */
double penultimate_level(const extreme_law *law, double survival, double rare);
/* What the level of the fit leaves out of that one [its unit]; positive where the fit is too low. */
double penultimate_shift(const extreme_law *law, double survival, double rare);

#endif
