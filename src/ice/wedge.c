/* Nevel's wedge by Frobenius series (Nevel 1961).  The exponents at the tip are 0, 1, 1, 2; of the four
   solutions f0, f1, f2, fL two combinations decay far from the tip: TIP, which a unit force on the tip makes, and MOM,
   which a unit moment makes. */
#include "ice/wedge.h"

#include "base/transcendental.h"
#include "base/vec.h"

#include <stdbool.h>

enum { F0, F1, F2, FL, SOLUTIONS };
enum { DERIVATIVES = 4, MOST_TERMS = 40 };

/* TIP = TIP_0 f0 - MIXED f1 + f2/2,  MOM = MIXED f0 - MOM_1 f1 + fL. */
static const double TIP_0 = 2.188439615226476638837;
static const double MIXED = 1.854074677301371918434;
static const double MOM_1 = 1.554756088775888103718;

/* Terms smaller than this part of the first one are left out. */
static const double SMALLEST_TERM = 1e-20;

/* c_m = -c_(m-4) / (m (m-1)^2 (m-2)). */
static double next_coefficient(double c, double m) { return -c / (m * (m - 1) * (m - 1) * (m - 2)); }

/* Adds c x^m and its first three derivatives. */
static void add_power(double c, double m, double x, double power, double out[DERIVATIVES])
{
    double factor = c * power; /* power = x^m */
    for (int d = 0; d < DERIVATIVES; d++) {
        out[d] += factor;
        factor *= (m - d) / x;
    }
}

/* Adds c x^m ln x and its first three derivatives: x^(m-d) (p ln x + q). */
static void add_logarithm(double c, double m, double x, double power, double logarithm, double out[DERIVATIVES])
{
    double p = 1, q = 0, scale = c * power;
    for (int d = 0; d < DERIVATIVES; d++) {
        out[d] += scale * (p * logarithm + q);
        q = q * (m - d) + p;
        p *= m - d;
        scale /= x;
    }
}

/* The four solutions and their derivatives at x > 0. */
static void solutions(double x, double f[SOLUTIONS][DERIVATIVES])
{
    double x2 = x * x, x4 = x2 * x2, logarithm = real_log(x);
    for (int s = 0; s < SOLUTIONS; s++)
        for (int d = 0; d < DERIVATIVES; d++)
            f[s][d] = 0;
    for (int s = F0; s <= F2; s++) {
        double c = 1, m = s, power = s == F0 ? 1 : s == F1 ? x : x2, first = power;
        for (int k = 0; k < MOST_TERMS && fabs(c) * power > SMALLEST_TERM * first; k++) {
            add_power(c, m, x, power, f[s]);
            m += 4;
            power *= x4;
            c = next_coefficient(c, m);
        }
    }
    /* fL is the derivative of x^r + ... in its exponent r at r = 1: logarithms with the coefficients of f1, and powers
       with their derivatives. */
    double c = 1, rate = 0, m = 1, power = x;
    for (int k = 0; k < MOST_TERMS && fabs(c) * power > SMALLEST_TERM * x; k++) {
        add_logarithm(c, m, x, power, logarithm, f[FL]);
        add_power(c * rate, m, x, power, f[FL]);
        m += 4;
        power *= x4;
        c = next_coefficient(c, m);
        rate -= 1 / m + 2 / (m - 1) + 1 / (m - 2);
    }
}

/* Integral of x f_s over 0 .. x, for f0 and f1. */
static double moment_integral(int s, double x)
{
    double x2 = x * x, x4 = x2 * x2, c = 1, m = s, power = s == F0 ? x2 : x2 * x, first = power, sum = 0;
    for (int k = 0; k < MOST_TERMS && fabs(c) * power > SMALLEST_TERM * first; k++) {
        sum += c * power / (m + 2);
        m += 4;
        power *= x4;
        c = next_coefficient(c, m);
    }
    return sum;
}

static double pressure(const wedge *w) { return 2 / (w->load_length * w->load_length); }

static void outer_profile(const wedge *w, double f[SOLUTIONS][DERIVATIVES], double out[DERIVATIVES])
{
    for (int d = 0; d < DERIVATIVES; d++)
        out[d] = w->outer[0] * (TIP_0 * f[F0][d] - MIXED * f[F1][d] + 0.5 * f[F2][d]) +
                 w->outer[1] * (MIXED * f[F0][d] - MOM_1 * f[F1][d] + f[FL][d]);
}

void wedge_profile(const wedge *w, double xi, double out[4])
{
    double f[SOLUTIONS][DERIVATIVES];
    solutions(xi, f);
    if (xi >= w->load_length) {
        outer_profile(w, f, out);
        return;
    }
    for (int d = 0; d < DERIVATIVES; d++)
        out[d] = (d == 0 ? pressure(w) : 0) + w->inner[0] * f[F0][d] + w->inner[1] * f[F1][d];
}

/* Beyond the load the wedge feels its moments alone: by reciprocity (Betti 1872) a force at s < x acts there as f0(s)
   tip forces and -f1(s) tip moments.  Under the load, eta and eta' go on where they are beyond it; eta'' and eta'''
   then do too. */
static void set_coefficients(wedge *w)
{
    double a = w->load_length, p = pressure(w);
    w->outer[0] = p * moment_integral(F0, a);
    w->outer[1] = -p * moment_integral(F1, a);
    double f[SOLUTIONS][DERIVATIVES], eta[DERIVATIVES];
    solutions(a, f);
    outer_profile(w, f, eta);
    double wronskian = f[F0][0] * f[F1][1] - f[F0][1] * f[F1][0];
    double value = eta[0] - p, slope = eta[1];
    w->inner[0] = (value * f[F1][1] - slope * f[F1][0]) / wronskian;
    w->inner[1] = (slope * f[F0][0] - value * f[F0][1]) / wronskian;
}

/* eta''' and its slope, from the equation itself. */
static void third_derivative(const wedge *w, double xi, double *value, double *slope)
{
    double eta[DERIVATIVES];
    wedge_profile(w, xi, eta);
    *value = eta[3];
    *slope = (xi < w->load_length ? pressure(w) : 0) - eta[0] - 2 * eta[3] / xi;
}

/* The law for small loads, x_max = 0.97043 (a/l)^(1/3), with a correction that holds it elsewhere. */
double wedge_breaking_estimate(double a_over_l)
{
    double a = fmin(fmax(a_over_l, WEDGE_LEAST_LOAD), WEDGE_MOST_LOAD);
    return 0.97043 * real_cbrt(a) * (1 + 0.6 * real_pow(a, 0.55));
}

/* The root of eta''' by Newton's way, kept inside a bracket. */
static double largest_curvature_at(const wedge *w)
{
    double value, slope;
    double x = wedge_breaking_estimate(w->load_length), low = 0.25 * x, high = 2 * x;
    for (int i = 0; i < 100; i++) {
        third_derivative(w, x, &value, &slope);
        if (value > 0)
            low = x;
        else
            high = x;
        double next = slope < 0 ? x - value / slope : low;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (fabs(next - x) <= 1e-15 * x)
            break;
        x = next;
    }
    return x;
}

static wedge wedge_begin(double a_over_l)
{
    wedge w = {.load_length = fmin(fmax(a_over_l, WEDGE_LEAST_LOAD), WEDGE_MOST_LOAD)};
    set_coefficients(&w);
    w.tip_deflection = pressure(&w) + w.inner[0];
    return w;
}

double wedge_tip_deflection(double a_over_l) { return wedge_begin(a_over_l).tip_deflection; }

wedge wedge_solve(double a_over_l)
{
    wedge w = wedge_begin(a_over_l);
    w.x_max = largest_curvature_at(&w);
    double eta[DERIVATIVES];
    wedge_profile(&w, w.x_max, eta);
    w.curvature = eta[2];
    w.capacity = 1 / eta[2];
    return w;
}
