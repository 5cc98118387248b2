/* The gamma function, the same to the bit everywhere, and Euler's constant. */
#ifndef STUDY_SPECIAL_H
#define STUDY_SPECIAL_H

/* Gamma(x) for 0 < x < 100, to 1e-13 (Lanczos 1964). */
double gamma_function(double x);

#define EULER_GAMMA 0.57721566490153286061

#endif
