#include "study/extreme_law.h"

#include "base/near.h"
#include "base/transcendental.h"
#include "study/minimise.h"
#include "study/special.h"

#include <math.h>

/* A shape this near to 0 is the limit (Gumbel, exponential). */
#define SHAPE_ZERO 1e-9
/* Of the negative log likelihood. */
#define COST_TOLERANCE 1e-11

/* ---- laws ---- */

double extreme_law_exponent(const extreme_law *law, double x)
{
    double z = (x - law->location) / law->scale;
    if (law->kind == LAW_WEIBULL)
        return z > 0 ? real_pow(z, law->shape) : 0;
    if (law->kind == LAW_GUMBEL || fabs(law->shape) < SHAPE_ZERO)
        return law->kind == LAW_PARETO ? fmax(z, 0) : real_exp(-z);
    double base = 1 + law->shape * z;
    if (law->kind == LAW_PARETO)
        return base > 0 ? fmax(real_log(base) / law->shape, 0) : (double)INFINITY;
    if (base > 0)
        return real_pow(base, -1 / law->shape);
    return law->shape > 0 ? (double)INFINITY : 0;
}

double extreme_law_level(const extreme_law *law, double exponent)
{
    double shape = law->shape, z = 0;
    if (law->kind == LAW_WEIBULL)
        z = real_pow(exponent, 1 / shape);
    else if (law->kind == LAW_PARETO)
        z = fabs(shape) < SHAPE_ZERO ? exponent : (real_exp(shape * exponent) - 1) / shape;
    else if (law->kind == LAW_GUMBEL || fabs(shape) < SHAPE_ZERO)
        z = -real_log(exponent);
    else
        z = (real_pow(exponent, -shape) - 1) / shape;
    return law->location + law->scale * z;
}

/* But for -log shape, which all values have. */
static double weibull_cost(double shape, double log_z) { return near_exp(shape * log_z) - (shape - 1) * log_z; }

/* -log of the density times the scale, at a reduced value; of Weibull's law without -log shape. */
static double reduced_cost(const extreme_law *law, double z)
{
    double shape = law->shape;
    if (law->kind == LAW_WEIBULL)
        return z > 0 ? weibull_cost(shape, near_log(z)) : (double)INFINITY;
    if (law->kind == LAW_GUMBEL || fabs(shape) < SHAPE_ZERO)
        return law->kind == LAW_PARETO ? z : z + near_exp(-z);
    double base = 1 + shape * z;
    if (!(base > 0))
        return (double)INFINITY;
    double log_base = near_log(base);
    return (1 + 1 / shape) * log_base + (law->kind == LAW_PARETO ? 0 : near_exp(-log_base / shape));
}

double extreme_law_cost(const extreme_law *law, const double *value, int32_t count)
{
    if (!(law->scale > 0))
        return (double)INFINITY;
    double sum = count * real_log(law->scale);
    if (law->kind == LAW_WEIBULL)
        sum -= count * real_log(law->shape);
    for (int32_t i = 0; i < count && isfinite(sum); i++)
        sum += reduced_cost(law, (value[i] - law->location) / law->scale);
    return sum;
}

/* ---- L-moments (Hosking 1990), from unbiased probability-weighted moments ---- */

static void l_moments(const double *sorted, int32_t n, double origin, double l[3])
{
    double b0 = 0, b1 = 0, b2 = 0;
    for (int32_t i = 0; i < n; i++) {
        double x = sorted[i] - origin, p = (double)i / (n - 1);
        b0 += x / n;
        b1 += x * p / n;
        b2 += x * p * (i - 1) / (n - 2) / n;
    }
    l[0] = b0;
    l[1] = 2 * b1 - b0;
    l[2] = 6 * b2 - 6 * b1 + b0;
}

/* GEV: the approximation of Hosking, Wallis and Wood (1985) for the shape, refined by Newton's method on the ratio of
   L-moments. */
static double gev_ratio(double k)
{
    if (fabs(k) < 1e-7)
        return 2 * real_log(3) / real_log(2) - 3;
    return 2 * (1 - real_pow(3, -k)) / (1 - real_pow(2, -k)) - 3;
}

static extreme_law gev_of_moments(const double l[3])
{
    double ratio = l[2] / l[1], c = 2 / (3 + ratio) - real_log(2) / real_log(3), k = 7.8590 * c + 2.9554 * c * c;
    for (int i = 0; i < 20; i++) {
        double slope = (gev_ratio(k + 1e-6) - gev_ratio(k - 1e-6)) / 2e-6;
        double step = (gev_ratio(k) - ratio) / slope;
        k -= step;
        if (fabs(step) < 1e-13)
            break;
    }
    extreme_law law = {.kind = LAW_GEV, .shape = -k};
    if (fabs(k) < 1e-6) {
        law.scale = l[1] / real_log(2);
        law.location = l[0] - EULER_GAMMA * law.scale;
        return law;
    }
    double gamma = gamma_function(1 + k);
    law.scale = l[1] * k / (gamma * (1 - real_pow(2, -k)));
    law.location = l[0] - law.scale * (1 - gamma) / k;
    return law;
}

static bool fit_moments(law_kind kind, const double *sorted, int32_t n, double location, extreme_law *out)
{
    double l[3], origin = kind == LAW_PARETO ? location : 0;
    l_moments(sorted, n, origin, l);
    *out = (extreme_law){.kind = kind, .location = location};
    if (kind == LAW_GUMBEL) {
        out->scale = l[1] / real_log(2);
        out->location = l[0] - EULER_GAMMA * out->scale;
    } else if (kind == LAW_GEV) {
        *out = gev_of_moments(l);
    } else if (kind == LAW_PARETO) {
        /* Hosking and Wallis (1987). */
        out->shape = 2 - l[0] / l[1];
        out->scale = l[0] * (1 - out->shape);
    } else {
        return false;
    }
    return out->scale > 0 && isfinite(out->scale) && isfinite(out->location) && isfinite(out->shape);
}

/* ---- maximum likelihood ---- */

/* Root of an increasing function between lo and hi, to neighbouring numbers or nearly: false position by the Illinois
   rule (Dowell and Jarratt 1971), with a halving every third time. */
#define LAW_ROOT_NEAR 4e-16
typedef double (*rising_function)(const double *value, int32_t n, double origin, double x);
static double root_of(rising_function f, const double *value, int32_t n, double origin, double lo, double hi)
{
    double below = f(value, n, origin, lo), above = f(value, n, origin, hi);
    int side = 0;
    for (int i = 0; hi - lo > LAW_ROOT_NEAR * fabs(hi); i++) {
        double part = i % 3 == 2 ? 0.5 : below / (below - above), x = lo + part * (hi - lo);
        if (!(x > lo && x < hi))
            x = lo + 0.5 * (hi - lo);
        if (!(x > lo && x < hi))
            break;
        double here = f(value, n, origin, x);
        if (here < 0) {
            lo = x;
            below = here;
            above *= side < 0 ? 0.5 : 1;
            side = -1;
        } else {
            hi = x;
            above = here;
            below *= side > 0 ? 0.5 : 1;
            side = 1;
        }
    }
    return hi;
}

/* Gumbel: scale - mean + sum x exp(-x/scale)/sum exp(-x/scale), of values from an origin, which does
   not change the root. */
static double gumbel_equation(const double *sorted, int32_t n, double origin, double scale)
{
    double mean = 0, above = 0, below = 0;
    for (int32_t i = 0; i < n; i++) {
        double x = sorted[i] - origin, weight = near_exp(-x / scale);
        mean += x / n;
        above += x * weight;
        below += weight;
    }
    return scale - mean + above / below;
}

static void fit_gumbel(const double *sorted, int32_t n, extreme_law *law)
{
    double spread = sorted[n - 1] - sorted[0], sum = 0;
    law->scale = root_of(gumbel_equation, sorted, n, sorted[0], 1e-6 * spread, spread);
    for (int32_t i = 0; i < n; i++)
        sum += real_exp(-(sorted[i] - sorted[0]) / law->scale) / n;
    law->location = sorted[0] - law->scale * real_log(sum);
}

/* Weibull: sum x^k log x/sum x^k - 1/k - mean log x, of values over their greatest, both from the location. */
static double weibull_equation(const double *value, int32_t n, double location, double k)
{
    double mean = 0, above = 0, below = 0;
    for (int32_t i = 0; i < n; i++) {
        double log_x = near_log((value[i] - location) / (value[n - 1] - location)), weight = near_exp(k * log_x);
        mean += log_x / n;
        above += log_x * weight;
        below += weight;
    }
    return above / below - 1 / k - mean;
}

/* A sample in what a law is fitted to. */
typedef struct law_sample {
    law_kind kind;
    const double *value;
    int32_t count;
    double location, unit; /* of GPD; of the scale's logarithm */
} law_sample;

static bool is_shape(double shape) { return shape > SHAPE_LEAST && shape < FIT_SHAPE_MOST; }

static double gev_cost(const void *of, const double *x)
{
    const law_sample *s = of;
    const extreme_law law = {LAW_GEV, s->location + s->unit * x[0], s->unit * real_exp(x[1]), x[2]};
    return is_shape(x[2]) && fabs(x[1]) < 50 ? extreme_law_cost(&law, s->value, s->count) : (double)INFINITY;
}

static double pareto_cost(const void *of, const double *x)
{
    const law_sample *s = of;
    const extreme_law law = {LAW_PARETO, s->location, s->unit * real_exp(x[0]), x[1]};
    return is_shape(x[1]) && fabs(x[0]) < 50 ? extreme_law_cost(&law, s->value, s->count) : (double)INFINITY;
}

/* Begun from the Gumbel law and from the L-moments: the better is taken. */
static bool fit_gev(const double *sorted, int32_t n, extreme_law *law)
{
    extreme_law from[2] = {{.kind = LAW_GUMBEL}, {.kind = LAW_GEV}};
    fit_gumbel(sorted, n, &from[0]);
    if (!fit_moments(LAW_GEV, sorted, n, 0, &from[1]))
        from[1] = from[0];
    double best = (double)INFINITY;
    const law_sample s = {LAW_GEV, sorted, n, from[0].location, from[0].scale};
    for (int i = 0; i < 2; i++) {
        double x[3] = {(from[i].location - s.location) / s.unit, real_log(from[i].scale / s.unit), from[i].shape};
        const double step[3] = {0.2, 0.2, 0.1};
        double cost = minimise(gev_cost, &s, 3, x, step, COST_TOLERANCE, MINIMISE_TO_THE_END);
        if (!(cost < best))
            continue;
        best = cost;
        *law = (extreme_law){LAW_GEV, s.location + s.unit * x[0], s.unit * real_exp(x[1]), x[2]};
    }
    return isfinite(best);
}

static bool fit_pareto(const double *sorted, int32_t n, extreme_law *law)
{
    double mean = 0;
    for (int32_t i = 0; i < n; i++)
        mean += (sorted[i] - law->location) / n;
    const law_sample s = {LAW_PARETO, sorted, n, law->location, mean};
    double x[2] = {0, 0};
    const double step[2] = {0.2, 0.1};
    double cost = minimise(pareto_cost, &s, 2, x, step, COST_TOLERANCE, MINIMISE_TO_THE_END);
    law->scale = s.unit * real_exp(x[0]);
    law->shape = x[1];
    return isfinite(cost);
}

static bool fit_weibull(const double *sorted, int32_t n, extreme_law *law)
{
    double lo = 1e-3, hi = 1e3, sum = 0, greatest = sorted[n - 1] - law->location;
    law->shape = root_of(weibull_equation, sorted, n, law->location, lo, hi);
    for (int32_t i = 0; i < n; i++)
        sum += real_pow((sorted[i] - law->location) / greatest, law->shape) / n;
    law->scale = greatest * real_pow(sum, 1 / law->shape);
    return law->shape > lo && law->shape < hi;
}

/* A generalized law that shrinks to k equal values has scale^(-k + (n - k)/shape) as its likelihood, which has no
   greatest value where k is 1/(1 + shape) of n or more. */
int32_t extreme_law_tied(const double *sorted, int32_t count, double shape)
{
    int32_t tied = 1;
    while (tied < count && !(sorted[tied] > sorted[0]))
        tied++;
    return tied > 1 && tied * (1 + shape) >= count ? tied : 0;
}

bool extreme_law_fit(law_kind kind, law_fit how, const double *sorted, int32_t count, double location, extreme_law *out)
{
    *out = (extreme_law){.kind = kind, .location = location};
    if (count < LAW_VALUES_LEAST || !(sorted[count - 1] > sorted[0]))
        return false;
    bool peaks = kind == LAW_PARETO || kind == LAW_WEIBULL;
    if (peaks ? !(sorted[0] > location) : extreme_law_tied(sorted, count, FIT_SHAPE_MOST) > 0)
        return false;
    if (how == FIT_MOMENTS)
        return fit_moments(kind, sorted, count, location, out);
    switch (kind) {
    case LAW_GUMBEL:
        fit_gumbel(sorted, count, out);
        return out->scale > 0;
    case LAW_GEV:
        return fit_gev(sorted, count, out);
    case LAW_PARETO:
        return fit_pareto(sorted, count, out);
    case LAW_WEIBULL:
        return fit_weibull(sorted, count, out);
    }
    return false;
}
