#include "study/averaged.h"

#include "base/transcendental.h"

#include <math.h>

/* An end is found this near, in scales of the generalized law; and how far out one is looked for, in doublings. */
#define END_NEAR 1e-7
enum { DOUBLINGS_MOST = 40 };

double averaged_weight(const extreme_law *gumbel, const extreme_law *any, const double *value, int32_t count)
{
    /* The criterion is twice the cost and a price of k parameters, 2 k n/(n - k - 1). */
    double gain = extreme_law_cost(gumbel, value, count) - extreme_law_cost(any, value, count);
    double price = 3.0 * count / (count - 4) - 2.0 * count / (count - 3);
    return 1 / (1 + real_exp(gain - price));
}

typedef struct averaged_look {
    const gumbel_pivot *p;
    const profile_question *q;
    double least, weight;
    bool high;
} averaged_look;

/* What both laws leave beyond x, on the side that is looked at. */
static double tail_at(const averaged_look *look, double x)
{
    double below = gumbel_pivot_below(look->p, look->q->exponent / look->q->exposure, x);
    double beyond = profile_beyond(look->q, look->least, x, look->high);
    return look->weight * (look->high ? 1 - below : below) + (1 - look->weight) * beyond;
}

/* Between two points, at one of which the tail is larger than `part` and at the other smaller. */
static double end_between(const averaged_look *look, double larger, double smaller, double part)
{
    double mid = 0.5 * (larger + smaller);
    /* Of values far from zero neighbouring numbers may lie farther apart than that. */
    while (fabs(smaller - larger) > END_NEAR * look->q->law->scale && mid != larger && mid != smaller) {
        *(tail_at(look, mid) > part ? &larger : &smaller) = mid;
        mid = 0.5 * (larger + smaller);
    }
    return smaller;
}

static double averaged_end(const averaged_look *look, double of_gumbel, double part)
{
    double step = (look->high ? 1 : -1) * look->q->law->scale, larger = of_gumbel, smaller = of_gumbel;
    bool outwards = tail_at(look, of_gumbel) > part;
    for (int i = 0; i < DOUBLINGS_MOST; i++, step *= 2) {
        if (outwards) {
            larger = smaller;
            smaller += step;
            if (!(tail_at(look, smaller) > part))
                return end_between(look, larger, smaller, part);
        } else {
            smaller = larger;
            larger -= step;
            if (tail_at(look, larger) > part)
                return end_between(look, larger, smaller, part);
        }
    }
    /* No end inwards: not with a tail that grows to a half there. */
    return outwards ? step * (double)INFINITY : of_gumbel;
}

level_interval averaged_interval(const gumbel_pivot *p, level_interval exact, const profile_question *q, double weight)
{
    averaged_look look = {.p = p, .q = q, .least = profile_least(q), .weight = weight};
    double part = 0.5 - 0.5 * q->confidence;
    exact.low = averaged_end(&look, exact.low, part);
    look.high = true;
    exact.high = averaged_end(&look, exact.high, part);
    return exact;
}
