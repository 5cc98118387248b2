/* The half plane x > 0 on a Winkler foundation, by Fourier transform along its edge.  In units of l and D/l^2 a load of
   wave number k along the edge obeys ((d/dx)^2 - k^2)^2 w + w = q, with M_x = 0 and V_x = 0 (with 2 - nu) at x = 0.  By
   reciprocity the deflection of the edge under a line load at x = s is the deflection at s under an edge load, a
   decaying solution exp(-p s) (A cos q s + B sin q s) with (p + iq)^2 = k^2 + i.  The edge moment follows from the
   edge's deflection alone: M_x = 0 makes M_y = (1 - nu^2) k^2 w. */
#include "ice/sheet.h"

#include "base/transcendental.h"
#include "base/vec.h"

/* Gauss-Legendre nodes and weights on -1 .. 1, the positive half. */
enum { HALF_NODES = 8 };
static const double NODE[HALF_NODES] = {0.0950125098376374402, 0.281603550779258913, 0.458016777657227386,
                                        0.617876244402643748,  0.755404408355003034, 0.865631202387831744,
                                        0.944575023073232576,  0.989400934991649933};
static const double WEIGHT[HALF_NODES] = {0.189450610455068496,  0.182603415044923589, 0.169156519395002538,
                                          0.149595988816576732,  0.124628971255533872, 0.0951585116824927848,
                                          0.0622535239386478929, 0.0271524594117540949};

static double node_at(int i) { return i < HALF_NODES ? -NODE[HALF_NODES - 1 - i] : NODE[i - HALF_NODES]; }
static double weight_at(int i) { return i < HALF_NODES ? WEIGHT[HALF_NODES - 1 - i] : WEIGHT[i - HALF_NODES]; }

/* The decaying solution under a unit edge load of wave number k. */
typedef struct edge_wave {
    double amplitude, decay, turn, ratio; /* A, p, q, B/A */
} edge_wave;

static edge_wave edge_wave_of(double k, double nu)
{
    double k2 = k * k, p = sqrt((sqrt(k2 * k2 + 1) + k2) / 2), q = 0.5 / p, c = (1 - nu) * k2;
    return (edge_wave){1 / (q * (1 - c * c) + 2 * c * p), p, q, c};
}

static double wave_at(const edge_wave *e, double s)
{
    return e->amplitude * real_exp(-e->decay * s) * (real_cos(e->turn * s) + e->ratio * real_sin(e->turn * s));
}

/* What a wave number k contributes to the edge moment at y = 0: k^2 times the mean over the load of wave times
   cos(k y). */
typedef struct edge_load {
    double size, nu;
} edge_load;
typedef double (*wave_response)(const edge_load *load, double k);

static double strip_response(const edge_load *load, double k)
{
    edge_wave e = edge_wave_of(k, load->nu);
    double phase = k * load->size;
    return k * k * e.amplitude * real_sin(phase) / phase;
}

/* Half disk: s = a sin t, |y| < a cos t; a row at s weighs 4 sin(k a cos t) / (pi a^2 k). */
static double half_disk_response(const edge_load *load, double k)
{
    /* The wave dies within 1/k of the edge: two parts in t follow it. */
    static const double PART[3] = {0, 0.25, PI / 2};
    edge_wave e = edge_wave_of(k, load->nu);
    double a = load->size, sum = 0;
    for (int part = 0; part < 2; part++) {
        double middle = (PART[part] + PART[part + 1]) / 2, half = (PART[part + 1] - PART[part]) / 2;
        for (int i = 0; i < 2 * HALF_NODES; i++) {
            double t = middle + half * node_at(i), s = real_sin(t), c = real_cos(t);
            sum += half * weight_at(i) * a * c * wave_at(&e, a * s) * real_sin(k * a * c);
        }
    }
    return 4 * k / (PI * a * a) * sum;
}

/* Integral over all wave numbers: steps that double from 1/4 of the foundation's own wave number on, and are never
   longer than half a period of the load's; up to `periods` of these. */
static double integrate_waves(wave_response response, const edge_load *load, int periods)
{
    double sum = 0, from = 0, step = PI / load->size, last = periods * 2 * step;
    while (from < last) {
        double length = fmin(fmax(0.25, from), step), middle = from + length / 2;
        for (int i = 0; i < 2 * HALF_NODES; i++)
            sum += length / 2 * weight_at(i) * response(load, middle + length / 2 * node_at(i));
        from += length;
    }
    return sum;
}

/* M_y = (1 - nu^2)/pi times the integral, sigma = 6 M_y / h^2. */
static double stress_factor(double nu) { return 6 * (1 - nu * nu) / PI; }

double sheet_stress_integral(double a_over_l, double poisson_ratio)
{
    edge_load load = {a_over_l, poisson_ratio};
    return stress_factor(poisson_ratio) * integrate_waves(half_disk_response, &load, 60);
}

double sheet_stress_strip(double c_over_l, double poisson_ratio)
{
    edge_load load = {c_over_l, poisson_ratio};
    return stress_factor(poisson_ratio) * integrate_waves(strip_response, &load, 1000);
}

double sheet_disk_of_strip(double c_over_l) { return c_over_l * (0.73 + 0.06 * fmin(c_over_l, 2)); }

double sheet_edge_deflection(double poisson_ratio)
{
    /* The integrand falls as k^-3: on to k = 1/u. */
    double sum = 0;
    enum { STEPS = 64 };
    for (int half = 0; half < 2; half++) {
        for (int j = 0; j < STEPS; j++) {
            double length = 1.0 / STEPS, middle = (j + 0.5) * length;
            for (int i = 0; i < 2 * HALF_NODES; i++) {
                double u = middle + length / 2 * node_at(i), k = half ? 1 / u : u;
                double weight = length / 2 * weight_at(i) * (half ? k * k : 1);
                sum += weight * edge_wave_of(k, poisson_ratio).amplitude;
            }
        }
    }
    return sum / PI;
}

/* (1/pi) times the integral of wave amplitude times cos(k y) over all k, at multiples of the step, for a Poisson's
   ratio of 0.3, and nothing at the end. */
static const double INFLUENCE_STEP = 0.25;
enum { INFLUENCES = 21 };
static const double INFLUENCE[INFLUENCES] = {0.4620, 0.4403, 0.3987, 0.3499, 0.2997, 0.2514,  0.2070,
                                             0.1674, 0.1329, 0.1035, 0.0790, 0.0590, 0.0429,  0.0303,
                                             0.0205, 0.0132, 0.0078, 0.0040, 0.0014, -0.0003, 0};

double sheet_edge_influence(double y_over_l)
{
    double at = fabs(y_over_l) / INFLUENCE_STEP;
    if (!(at < INFLUENCES - 1))
        return 0;
    int i = (int)at;
    return INFLUENCE[i] + (at - i) * (INFLUENCE[i + 1] - INFLUENCE[i]);
}

double sheet_stress_closed_form(double a_over_l, double poisson_ratio)
{
    double nu = poisson_ratio, a2 = a_over_l * a_over_l;
    double bracket = real_log(12 * (1 - nu * nu) / (100 * a2 * a2)) + 3.84 - 4 * nu / 3 + (1 + 2 * nu) * a_over_l / 2;
    return 3 * (1 + nu) / (PI * (3 + nu)) * bracket;
}

/* sheet_stress_integral as a double Chebyshev series, in ln(a/l) between the closed form's end and the table's, and in
   nu between 0 and 1/2; interpolates the integral at the Chebyshev nodes, to 3e-5 everywhere. */
enum { LOAD_TERMS = 10, RATIO_TERMS = 5 };
static const double STRESS_SERIES[LOAD_TERMS][RATIO_TERMS] = {
    {1.02836032, 0.04638322, -0.01657818, -0.00062416, -0.00011110},
    {-1.15577058, -0.07844458, 0.01461028, 0.00047496, 0.00010501},
    {0.15675204, 0.02536256, 0.00028116, 0.00010504, 0.00000670},
    {0.02739248, 0.00096834, -0.00043498, -0.00002220, -0.00000499},
    {0.00103871, -0.00077895, -0.00014735, -0.00001245, -0.00000180},
    {-0.00103016, -0.00021423, -0.00001500, -0.00000192, -0.00000015},
    {-0.00035199, -0.00001375, 0.00000488, 0.00000029, 0.00000008},
    {-0.00004816, 0.00000778, 0.00000246, 0.00000022, 0.00000004},
    {0.00000476, 0.00000305, 0.00000049, 0.00000005, 0.00000001},
    {0.00000399, 0.00000053, 0.00000002, 0.00000000, 0.00000000},
};

/* Sum of c[i] T_i(x), Clenshaw's way. */
static double chebyshev_sum(const double *c, int count, double x)
{
    double b1 = 0, b2 = 0;
    for (int i = count - 1; i > 0; i--) {
        double b = 2 * x * b1 - b2 + c[i];
        b2 = b1;
        b1 = b;
    }
    return x * b1 - b2 + c[0];
}

double sheet_stress(double a_over_l, double poisson_ratio)
{
    if (a_over_l <= SHEET_CLOSED_FORM_MOST)
        return sheet_stress_closed_form(a_over_l, poisson_ratio);
    double a = fmin(a_over_l, SHEET_TABLE_MOST), row[LOAD_TERMS];
    double x = 2 * real_log(a / SHEET_CLOSED_FORM_MOST) / real_log(SHEET_TABLE_MOST / SHEET_CLOSED_FORM_MOST) - 1;
    for (int i = 0; i < LOAD_TERMS; i++)
        row[i] = chebyshev_sum(STRESS_SERIES[i], RATIO_TERMS, 4 * poisson_ratio - 1);
    return chebyshev_sum(row, LOAD_TERMS, x);
}
