/* The least value of a function of a few variables without derivatives (Nelder and Mead 1965). */
#ifndef STUDY_MINIMISE_H
#define STUDY_MINIMISE_H

enum { MINIMISE_MOST = 4 }; /* variables */

/* Infinite values are allowed: such a place is never taken. */
typedef double (*minimise_function)(const void *of, const double *x);
/* x: where to begin, on return where the least value was found; step: how far to look first, of each variable.  Begun
   again from what was found until that gains nothing, `descents` times at most.  Returns the least value. */
double minimise(minimise_function f, const void *of, int count, double *x, const double *step, double tolerance,
                int descents);
enum { MINIMISE_TO_THE_END = 8 }; /* descents */

#endif
