#include "base/time_ranks.h"

#include <math.h>

enum { BINS = (TIME_OCTAVE_MOST - TIME_OCTAVE_LEAST) * TIME_OCTAVE_BINS };

static int bin_of(double seconds)
{
    int exponent;
    if (!(seconds > 0))
        return 0;
    double part = 2 * frexp(seconds, &exponent) - 1; /* of the octave from 2^(exponent - 1) on */
    int octave = exponent - 1 - TIME_OCTAVE_LEAST;
    if (octave < 0)
        return 0;
    return octave < TIME_OCTAVE_MOST - TIME_OCTAVE_LEAST ? octave * TIME_OCTAVE_BINS + (int)(part * TIME_OCTAVE_BINS)
                                                         : BINS - 1;
}

/* The end of a bin [s]. */
static double end_of(int bin)
{
    return ldexp(1 + (bin % TIME_OCTAVE_BINS + 1) / (double)TIME_OCTAVE_BINS,
                 TIME_OCTAVE_LEAST + bin / TIME_OCTAVE_BINS);
}

void time_ranks_add(time_ranks *t, double seconds)
{
    t->count++;
    t->longest = seconds > t->longest ? seconds : t->longest;
    t->bin[bin_of(seconds)]++;
}

double time_ranks_at(const time_ranks *t, int thousandths)
{
    int64_t rank = (t->count / 1000) * thousandths + (t->count % 1000 * thousandths + 999) / 1000, below = 0;
    for (int i = 0; i < BINS; i++) {
        below += t->bin[i];
        if (below >= rank && below > 0)
            return end_of(i) < t->longest ? end_of(i) : t->longest;
    }
    return t->longest;
}
