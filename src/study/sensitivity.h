/* Which input moves the answer: designs of samples in the unit cube, and the indices that follow from their answers.
   Knows numbers only.

   Sobol: variance-based indices by Saltelli's scheme: two samples A and B of N points, and for each input i the points
   of A with the i-th coordinate of B: N (k + 2) answers.  First-order index: the part of the variance that goes with
   input i alone; total: that in which it takes any part.  Estimators of Saltelli et al. (2010) and Jansen (1999).
   Morris (1991): r paths through a grid of `levels`, each a start and a step of every input in random order: r (k + 1)
   answers.  mu*: mean size of the effect of an input (Campolongo et al. 2007); sigma: how much it depends on the
   others. */
#ifndef STUDY_SENSITIVITY_H
#define STUDY_SENSITIVITY_H

#include "base/context.h"

enum { SOBOL_ROWS_LEAST = 10, SENSITIVITY_KEYS_MOST = 64, SENSITIVITY_LEVELS_MOST = 1000 };

/* Points in the unit cube, point after point: all of A, all of B, then A with the first coordinate of B, and so on.
   x: N (k + 2) x k.  A and B are Latin hypercubes. */
bool sobol_points(context *ctx, int32_t n, int32_t k, int64_t seed, double *x);
/* Path after path, k + 1 points each.  levels: even.  x: r (k + 1) x k. */
void morris_points(int32_t r, int32_t k, int32_t levels, int64_t seed, double *x);

typedef struct sobol_index {
    double first, first_low, first_high, total, total_low, total_high;
} sobol_index;
/* answers: in the order of the points; rows with an answer that is NaN are left out.  95 % intervals are percentiles of
   a bootstrap over rows, NaN where most of its draws have no variance.  Returns the number of rows that counted: with
   fewer than SOBOL_ROWS_LEAST, or of answers that are all equal, all is NaN; -1: no memory. */
int32_t sobol_indices(context *ctx, const double *answer, int32_t n, int32_t k, sobol_index *out);

typedef struct morris_effect {
    double mu, mu_star, sigma; /* of the answer over the whole range of the input */
    int32_t count;             /* of effects */
} morris_effect;
/* Effects of steps with an answer at both ends. */
void morris_effects(const double *answer, const double *x, int32_t r, int32_t k, morris_effect *out);

#endif
