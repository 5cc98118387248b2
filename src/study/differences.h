/* Which conditions of a study are compared, and how much they differ: two runs of one seed see the same draws of
   chance, so that differences are taken seed by seed (common random numbers: Law 2015, Simulation Modeling and
   Analysis, 10.2 and 11.2).  Knows a study and numbers; must not know runs. */
#ifndef STUDY_DIFFERENCES_H
#define STUDY_DIFFERENCES_H

#include "study/seeds.h"

/* A condition and the first one that differs from it in this key alone, or any one before it where few conditions do
   not hang together so; key -1: they differ in several. */
typedef struct condition_pair {
    int32_t condition, reference, key;
} condition_pair;
typedef ARRAY(condition_pair) condition_pairs;

/* Conditions of larger studies are not compared: their number grows with the square. */
enum { COMPARED_MOST = 500, COMPARED_ALL = 6 };
/* By condition, then by key; none of a design of sensitivity, which has its own tables.  false: no memory. */
bool study_pairs(context *ctx, const study *s, condition_pairs *out);

/* Mean of a[i] - b[i] over the i at which both are numbers, with half its interval by Student's t; *pairs: their
   number. */
seed_interval difference_of_pairs(const double *a, const double *b, int32_t count, double confidence, int32_t *pairs);
/* Difference of the means of samples that have nothing in common and may scatter differently (Welch 1947), with half
   its interval: Student's t of *freedom degrees, by Satterthwaite (1946), rounded down.  NaNs are left out;
   values whose squares overflow have no interval, and no degrees. */
seed_interval difference_of_means(const double *a, int32_t a_count, const double *b, int32_t b_count, double confidence,
                                  int32_t *freedom);

#endif
