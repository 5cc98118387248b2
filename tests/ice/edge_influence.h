/* The deflection of a floating sheet's edge beside a point load there, by quadrature. */
#ifndef EDGE_INFLUENCE_H
#define EDGE_INFLUENCE_H

#include "base/transcendental.h"
#include "base/vec.h"

/* Half plane on Winkler's foundation under an edge load cos(k y), in units of l and P / (rho_w g l^2): w = Re of A
   e^(-m x) with m^2 = k^2 + i, free of moment and shear at x = 0. */
static inline double edge_wave_height(double k, double nu)
{
    double k2 = k * k, p = sqrt((sqrt(k2 * k2 + 1) + k2) / 2), q = 0.5 / p, c = (1 - nu) * k2;
    return 1 / (q * (1 - c * c) + 2 * c * p);
}

/* Simpson's rule to where the integrand, which falls as k^-3, is 1e-5. */
static inline double edge_influence(double y_over_l, double nu)
{
    enum { PARTS = 6000 };
    const double step = 60.0 / PARTS;
    double sum = 0;
    for (int i = 0; i <= PARTS; i++) {
        double weight = i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2;
        sum += weight * edge_wave_height(i * step, nu) * real_cos(i * step * y_over_l);
    }
    return sum * step / 3 / PI;
}

#endif
