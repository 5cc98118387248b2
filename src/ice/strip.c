/* The free beam on an elastic foundation under a force at one end (Hetenyi 1946), with b = 1/(sqrt(2) l), s = b x,
   t = b (L - x):
       w(0) = 2 p b/k (sinh(bL) cosh(bL) - sin(bL) cos(bL)) / (sinh^2(bL) - sin^2(bL)),
       M = p/b (sinh(bL) sin(s) sinh(t) - sin(bL) sinh(s) sin(t)) / (sinh^2(bL) - sin^2(bL)). */
#include "ice/strip.h"

#include "base/transcendental.h"

#include <math.h>

/* Below this bL the strip is rigid: M differs by less than 1e-7, and the difference of squares loses digits. */
static const double RIGID = 0.03;
/* Above it the far end is of no consequence: exp(-2 bL) is rounding. */
static const double INFINITE = 20;

static double hyperbolic_sine(double x) { return (real_exp(x) - real_exp(-x)) / 2; }
static double hyperbolic_cosine(double x) { return (real_exp(x) + real_exp(-x)) / 2; }

/* dM/ds but for a positive factor: the shear force. */
static double shear(double end, double s)
{
    double t = end - s;
    return hyperbolic_sine(end) * (real_cos(s) * hyperbolic_sine(t) - real_sin(s) * hyperbolic_cosine(t)) -
           real_sin(end) * (hyperbolic_cosine(s) * real_sin(t) - hyperbolic_sine(s) * real_cos(t));
}

strip strip_solve(double length_over_l)
{
    double root = sqrt(2.0), end = length_over_l / root;
    if (!(end < INFINITE))
        return (strip){PI / 4 * root, real_exp(-PI / 4), 1 / root};
    if (end < RIGID)
        return (strip){length_over_l / 3, 4.0 / 27 * length_over_l, length_over_l / 4};
    double low = 0, high = fmin(end / 2, 1.1);
    for (int i = 0; i < 50; i++) {
        double middle = (low + high) / 2;
        if (shear(end, middle) > 0)
            low = middle;
        else
            high = middle;
    }
    double s = (low + high) / 2, a = hyperbolic_sine(end), c = real_sin(end);
    double above = a * real_sin(s) * hyperbolic_sine(end - s) - c * hyperbolic_sine(s) * real_sin(end - s);
    double stiffness = (a * a - c * c) / (a * hyperbolic_cosine(end) - c * real_cos(end)) / root;
    return (strip){s * root, root * above / (a * a - c * c), stiffness};
}
