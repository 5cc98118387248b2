/* Matrices of a vessel that take energy from every motion, or hold some in it: damping and added mass. */
#ifndef SIM_MATRIX_CHECK_H
#define SIM_MATRIX_CHECK_H

#include "fluid/matrix6.h"

/* Row of the first motion which with those before it gains energy, or has a negative mass, by the symmetric part of a
   matrix whose diagonal has no negative number; -1: none does.  rounding: part of the diagonal that is given to it;
   rows of zeros pass. */
int matrix_failing_row(const matrix6 *a, double rounding);
/* Mean of the two halves. */
double matrix_coupling(const matrix6 *a, int i, int j);

#endif
