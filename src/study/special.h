/* Functions of mathematical statistics that the C library lacks, the same to the bit everywhere. */
#ifndef STUDY_SPECIAL_H
#define STUDY_SPECIAL_H

/* x with Phi(x) = p of the standard normal law, 0 < p < 1, to 1e-15 (Wichura 1988, AS 241). */
double normal_quantile(double p);
/* Gamma(x) for 0 < x < 100, to 1e-13 (Lanczos 1964). */
double gamma_function(double x);

#define EULER_GAMMA 0.57721566490153286061

#endif
