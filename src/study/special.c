#include "study/special.h"

#include "base/transcendental.h"

#include <math.h>

/* Lanczos's series with g = 7 and nine terms. */
double gamma_function(double x)
{
    static const double term[9] = {0.99999999999980993,  676.5203681218851,     -1259.1392167224028,
                                   771.32342877765313,   -176.61502916214059,   12.507343278686905,
                                   -0.13857109526572012, 9.9843695780195716e-6, 1.5056327351493116e-7};
    if (x < 0.5)
        return PI / (real_sin(PI * x) * gamma_function(1 - x));
    double sum = term[0], t = x + 6.5;
    for (int i = 1; i < 9; i++)
        sum += term[i] / (x - 1 + i);
    return sqrt(2 * PI) * real_pow(t, x - 0.5) * real_exp(-t) * sum;
}
