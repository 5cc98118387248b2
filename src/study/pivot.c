#include "study/pivot.h"

#include "base/near.h"
#include "base/transcendental.h"

#include <math.h>

/* Logarithm of the density, against its greatest, that bounds the integral; and the step of the walk to there. */
#define FALL 40.0
#define WALK 0.02
/* Part of a sum that is left out. */
#define REST 1e-17
/* Ends of intervals, in fitted scales. */
#define PIVOT_END_NEAR 1e-10

/* ---- the law of the scale ---- */

/* log sum exp(ratio a), and the sum of a, with a = -(x - location)/scale, which follows the law of least values. */
static double log_sum_at(const double *value, int32_t count, const extreme_law *fit, double ratio, double *sum_a)
{
    double sum = 0;
    *sum_a = 0;
    for (int32_t i = 0; i < count; i++) {
        double a = (fit->location - value[i]) / fit->scale;
        *sum_a += a;
        sum += near_exp(ratio * a);
    }
    return real_log(sum);
}

/* Of log ratio: (n - 1) log ratio + ratio sum a - n log sum exp(ratio a). */
static double log_density(const double *value, int32_t count, const extreme_law *fit, double log_ratio, double *log_sum)
{
    double ratio = real_exp(log_ratio), sum_a;
    *log_sum = log_sum_at(value, count, fit, ratio, &sum_a);
    return (count - 1) * log_ratio + ratio * sum_a - count * *log_sum;
}

/* Where the density has fallen, from 0 on in a direction; the walk widens as it goes. */
static double density_end(const double *value, int32_t count, const extreme_law *fit, double top, double step)
{
    double at = 0, unused;
    for (int i = 0; i < 200 && log_density(value, count, fit, at, &unused) > top - FALL; i++, step *= 1.05)
        at += step;
    return at;
}

void gumbel_pivot_make(const double *value, int32_t count, const extreme_law *fit, gumbel_pivot *out)
{
    double unused, top = log_density(value, count, fit, 0, &unused), sum = 0;
    double low = density_end(value, count, fit, top, -WALK), high = density_end(value, count, fit, top, WALK);
    *out = (gumbel_pivot){.location = fit->location, .scale = fit->scale, .count = count};
    for (int32_t k = 2; k < count; k++)
        out->log_factorial += real_log(k);
    for (int i = 0; i < PIVOT_POINTS; i++) {
        double at = low + (high - low) * i / (PIVOT_POINTS - 1);
        out->weight[i] = real_exp(log_density(value, count, fit, at, &out->log_sum[i]) - top);
        out->ratio[i] = real_exp(at);
        sum += out->weight[i];
    }
    for (int i = 0; i < PIVOT_POINTS; i++)
        out->weight[i] /= sum;
}

/* ---- the law of a level ---- */

/* That the gamma variable of whole order n stays below x, with log x: from the side of n whose sum is short. */
static double gamma_below(int32_t n, double log_factorial, double log_x)
{
    double x = real_exp(log_x), sum = 0;
    if (x > 1e15)
        return 1;
    /* x^(n - 1) exp(-x)/(n - 1)! */
    double first = real_exp((n - 1) * log_x - x - log_factorial);
    if (x >= n) {
        for (double term = first, k = n - 1; term > REST * sum && k >= 0; k--) {
            sum += term;
            term *= k / x;
        }
        return 1 - sum;
    }
    for (double term = first * x / n, k = n + 1; term > REST * sum; k++) {
        sum += term;
        term *= x / k;
    }
    return sum;
}

/* That (level - fitted location)/(fitted scale) is below t. */
static double below(const gumbel_pivot *p, double log_exponent, double t)
{
    double sum = 0;
    for (int i = 0; i < PIVOT_POINTS; i++)
        sum += p->weight[i] * gamma_below(p->count, p->log_factorial, log_exponent + t * p->ratio[i] + p->log_sum[i]);
    return sum;
}

static double quantile(const gumbel_pivot *p, double log_exponent, double part)
{
    double lo = -log_exponent - 1, hi = -log_exponent + 1, step = 1;
    for (; below(p, log_exponent, lo) > part && step < 1e12; step *= 2)
        lo -= step;
    for (step = 1; below(p, log_exponent, hi) < part && step < 1e12; step *= 2)
        hi += step;
    while (hi - lo > PIVOT_END_NEAR * (1 + fabs(hi))) {
        double mid = 0.5 * (lo + hi);
        if (below(p, log_exponent, mid) < part)
            lo = mid;
        else
            hi = mid;
    }
    return hi;
}

double gumbel_pivot_below(const gumbel_pivot *p, double exponent, double x)
{
    return below(p, real_log(exponent), (x - p->location) / p->scale);
}

level_interval gumbel_pivot_interval(const gumbel_pivot *p, double exponent, double confidence)
{
    double log_exponent = real_log(exponent);
    return (level_interval){p->location - p->scale * log_exponent,
                            p->location + p->scale * quantile(p, log_exponent, 0.5 - 0.5 * confidence),
                            p->location + p->scale * quantile(p, log_exponent, 0.5 + 0.5 * confidence)};
}

/* ---- laws that the values may be of ---- */

void gumbel_pivot_draw(const gumbel_pivot *p, random_stream *random, extreme_law *out)
{
    double part = random_unit(random), sum = 0, gamma = 0;
    int i = 0;
    /* Points are as far apart in the logarithm of the ratio: the law between them is taken as straight. */
    while (i < PIVOT_POINTS - 2 && sum + p->weight[i] < part)
        sum += p->weight[i++];
    double within = fmin(fmax((part - sum) / p->weight[i], 0), 1) - 0.5;
    int to = within < 0 && i > 0 ? i - 1 : i + 1;
    within = fabs(within);
    double ratio = real_exp((1 - within) * real_log(p->ratio[i]) + within * real_log(p->ratio[to]));
    double log_sum = (1 - within) * p->log_sum[i] + within * p->log_sum[to];
    /* The gamma variable of order n is a sum of n exponential ones. */
    for (int32_t k = 0; k < p->count; k++)
        gamma -= near_log(1 - random_unit(random));
    *out = (extreme_law){LAW_GUMBEL, p->location + p->scale * (real_log(gamma) - log_sum) / ratio, p->scale / ratio, 0};
}
