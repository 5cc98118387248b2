/* Intervals of levels that two laws of block maxima share: Gumbel's and the generalized one, each with the weight that
   the sample gives it (Buckland, Burnham and Augustin 1997; intervals of averaged profiles: Fletcher and Turek 2011, J.
   Agric. Biol. Environ. Stat. 17, 38).  For maxima of blocks of a series, whose length alone does not say that they
   follow Gumbel's law already.  Knows numbers only; the same to the bit everywhere. */
#ifndef STUDY_AVERAGED_H
#define STUDY_AVERAGED_H

#include "study/pivot.h"

/* Weight of Gumbel's law beside the generalized one, from 0 to 1, by Akaike's criterion of both fits to the values, by
   likelihood, with the price of parameters that few values have (Hurvich and Tsai 1989).  count: LAW_VALUES_LEAST at
   least. */
double averaged_weight(const extreme_law *gumbel, const extreme_law *any, const double *value, int32_t count);

/* Each end is where the tail areas of both laws, with their weights, add up to half of what the confidence leaves.
   exact: Gumbel's interval, by the pivot; q: the question to the generalized law.  The level stays that of `exact`. */
level_interval averaged_interval(const gumbel_pivot *p, level_interval exact, const profile_question *q, double weight);

#endif
