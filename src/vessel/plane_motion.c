#include "vessel/plane_motion.h"

/* The velocity of the old point is H v with H = [1 0 y; 0 1 -x; 0 0 1] for a new point at (x, y); energy is the same,
   so that the new matrix is H' M H (Fossen 2011, section 7.1, transformed to three degrees of freedom). */
mat3 plane_matrix_moved(mat3 about, double x, double y)
{
    const mat3 h = {{{1, 0, y}, {0, 1, -x}, {0, 0, 1}}};
    return mat3_mul(mat3_transpose(h), mat3_mul(about, h));
}

mat3 plane_matrix_flipped(mat3 m)
{
    static const double sign[3] = {1, -1, -1};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            m.m[r][c] *= sign[r] * sign[c];
    return m;
}
