#include "study/proportion.h"

#include "base/transcendental.h"

#include <math.h>

/* ln of count over good. */
static double log_choose(int32_t count, int32_t good)
{
    int32_t few = good < count - good ? good : count - good;
    double sum = 0;
    for (int32_t i = 1; i <= few; i++)
        sum += real_log((double)(count - few + i) / i);
    return sum;
}

/* Chance of `good` or more of count > good > 0 with a probability p <= good / count: terms fall from the first one. */
static double chance_of_more(int32_t good, int32_t count, double ln_choose, double p)
{
    double term = 1, sum = 0, odds = p / (1 - p);
    for (int32_t j = good; term > 1e-17 * sum; j++) {
        sum += term;
        term *= odds * (count - j) / (j + 1);
    }
    return sum * real_exp(ln_choose + good * real_log(p) + (count - good) * real_log(1 - p));
}

/* The probability with which `good` or more are as rare as this, at most a half. */
static double lower_end(int32_t good, int32_t count, double rare)
{
    if (good == 0)
        return 0;
    if (good == count)
        return real_exp(real_log(rare) / count);
    double lo = 0, hi = (double)good / count, ln_choose = log_choose(count, good);
    /* Until the two are neighbours: at hi the chance is a half at least, since the median is `good` there. */
    for (double mid = 0.5 * (lo + hi); mid > lo && mid < hi; mid = 0.5 * (lo + hi)) {
        if (chance_of_more(good, count, ln_choose, mid) < rare)
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

proportion proportion_of(int32_t good, int32_t count, double confidence)
{
    const double rare = 0.5 * (1 - confidence), none = (double)NAN;
    if (count <= 0)
        return (proportion){none, none, none};
    return (proportion){(double)good / count, lower_end(good, count, rare), 1 - lower_end(count - good, count, rare)};
}
