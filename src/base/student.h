/* Student's t distribution, for confidence intervals of means. */
#ifndef BASE_STUDENT_H
#define BASE_STUDENT_H

/* P(|T| <= t) for t >= 0 and `freedom` >= 1 degrees of freedom, by the finite sums for whole numbers of them
   (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4). */
double student_within(double t, int freedom);
/* The t with student_within(t, freedom) = confidence, 0 < confidence < 1.  NaN without a degree of freedom. */
double student_quantile(double confidence, int freedom);
/* Half the interval of a mean that has this variance, by so many degrees; NaN without one, and where the sums that made
   the variance were too large for a number. */
double student_half(double confidence, int freedom, double variance);

#endif
