/* Random sizes over decades, for tests that draw floes, cracks and loads. */
#ifndef SIZES_H
#define SIZES_H

#include "base/random.h"
#include "base/transcendental.h"

#include <math.h>

/* N(>D) ~ D^-b truncated to 0 < lo <= D <= hi; b = 0 is uniform in log D.  One step of the counter. */
static inline double random_power_law(random_stream *r, double lo, double hi, double b)
{
    double u = random_unit(r), x;
    if (fabs(b) > 0)
        x = lo *
            real_pow(1 - u * (1 - real_pow(lo / hi, b)), -1 / b); /* inverse of (1 - (D/lo)^-b) / (1 - (hi/lo)^-b) */
    else
        x = lo * real_pow(hi / lo, u);
    return fmin(fmax(x, lo), hi); /* rounding only */
}

#endif
