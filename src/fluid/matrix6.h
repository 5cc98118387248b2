/* 6 x 6 matrices over surge, sway, heave, roll, pitch and yaw: a force and a moment about a point from a velocity of
   that point and an angular velocity, or from their rates.  Knows nothing of where they come from. */
#ifndef FLUID_MATRIX6_H
#define FLUID_MATRIX6_H

#include "base/vec.h"

#include <stdbool.h>

typedef struct matrix6 {
    double m[6][6];
} matrix6;

/* A linear and an angular vector: velocity and angular velocity, or force and moment. */
typedef struct pair6 {
    vec3 linear, angular;
} pair6;

pair6 matrix6_mul(const matrix6 *a, pair6 x);
matrix6 matrix6_sum(const matrix6 *a, const matrix6 *b, double scale); /* a + scale b */
/* From axes x forward, y to starboard, z down to x forward, y to port, z up, or back. */
matrix6 matrix6_turned_over(const matrix6 *a);
/* About another point: `a` is about P, the result about Q, arm = P - Q.  v_P = v_Q + w x arm. */
matrix6 matrix6_moved(const matrix6 *a, vec3 arm);
/* x of a x = b by elimination with the largest pivots; false when a is singular to rounding, x is then b. */
bool matrix6_solve(const matrix6 *a, pair6 b, pair6 *x);

#endif
