#include "fluid/matrix6.h"

#include <math.h>

static void to_array(pair6 x, double out[6])
{
    out[0] = x.linear.x, out[1] = x.linear.y, out[2] = x.linear.z;
    out[3] = x.angular.x, out[4] = x.angular.y, out[5] = x.angular.z;
}

static pair6 from_array(const double x[6]) { return (pair6){{x[0], x[1], x[2]}, {x[3], x[4], x[5]}}; }

pair6 matrix6_mul(const matrix6 *a, pair6 x)
{
    double v[6], out[6] = {0};
    to_array(x, v);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            out[i] += a->m[i][j] * v[j];
    return from_array(out);
}

matrix6 matrix6_sum(const matrix6 *a, const matrix6 *b, double scale)
{
    matrix6 out;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            out.m[i][j] = a->m[i][j] + scale * b->m[i][j];
    return out;
}

matrix6 matrix6_turned_over(const matrix6 *a)
{
    static const double sign[6] = {1, -1, -1, 1, -1, -1};
    matrix6 out;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            out.m[i][j] = sign[i] * sign[j] * a->m[i][j];
    return out;
}

/* (v_P, w) = H (v_Q, w) with H = [1 -[arm]; 0 1], so that a about Q is H' a H. */
matrix6 matrix6_moved(const matrix6 *a, vec3 arm)
{
    const double h[3][3] = {{0, arm.z, -arm.y}, {-arm.z, 0, arm.x}, {arm.y, -arm.x, 0}}; /* w x arm = h w */
    matrix6 half = *a, out;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                half.m[i][3 + j] += a->m[i][k] * h[k][j];
    out = half;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 6; j++)
            for (int k = 0; k < 3; k++)
                out.m[3 + i][j] += h[k][i] * half.m[k][j];
    return out;
}

static int largest_in_column(double m[6][7], int column)
{
    int best = column;
    for (int i = column + 1; i < 6; i++)
        if (fabs(m[i][column]) > fabs(m[best][column]))
            best = i;
    return best;
}

bool matrix6_solve(const matrix6 *a, pair6 b, pair6 *x)
{
    double m[6][7], out[6];
    to_array(b, out);
    *x = b;
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++)
            m[i][j] = a->m[i][j];
        m[i][6] = out[i];
    }
    for (int k = 0; k < 6; k++) {
        int best = largest_in_column(m, k);
        if (!(fabs(m[best][k]) > 0))
            return false;
        for (int j = 0; j < 7; j++) {
            double swap = m[k][j];
            m[k][j] = m[best][j];
            m[best][j] = swap;
        }
        for (int i = k + 1; i < 6; i++) {
            double factor = m[i][k] / m[k][k];
            for (int j = k; j < 7; j++)
                m[i][j] -= factor * m[k][j];
        }
    }
    for (int i = 5; i >= 0; i--) {
        out[i] = m[i][6];
        for (int j = i + 1; j < 6; j++)
            out[i] -= m[i][j] * out[j];
        out[i] /= m[i][i];
    }
    *x = from_array(out);
    return true;
}
