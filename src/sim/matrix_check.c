#include "sim/matrix_check.h"

#include <math.h>

double matrix_coupling(const matrix6 *a, int i, int j) { return 0.5 * (a->m[i][j] + a->m[j][i]); }

/* Cholesky's factors of the symmetric part over the roots of its diagonal. */
int matrix_failing_row(const matrix6 *a, double rounding)
{
    matrix6 l = {0};
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j <= i; j++) {
            double scale = sqrt(a->m[i][i] * a->m[j][j]);
            double left = (scale > 0 ? matrix_coupling(a, i, j) / scale : 0) + (i == j ? rounding : 0);
            for (int k = 0; k < j; k++)
                left -= l.m[i][k] * l.m[j][k];
            if (i == j && !(left > 0))
                return i;
            l.m[i][j] = i == j ? sqrt(left) : left / l.m[j][j];
        }
    }
    return -1;
}
