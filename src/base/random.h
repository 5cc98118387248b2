/* Counter-based random numbers: a draw is a pure function of (seed, stream, id, counter), so that results do not
   depend on the order in which threads or events ask.  Philox 4x32-10 (Salmon et al. 2011). */
#ifndef BASE_RANDOM_H
#define BASE_RANDOM_H

#include <stdint.h>

/* One sequence.  The counter is the whole state: keep it in a state table when the sequence outlives a step. */
typedef struct random_stream {
    uint64_t seed;
    uint32_t stream; /* what the numbers are for; enum of the room that draws */
    uint32_t id;     /* which object they are for */
    uint64_t counter;
} random_stream;

/* The sequence of (seed, stream, id) from its start. */
random_stream random_begin(uint64_t seed, uint32_t stream, uint32_t id);

/* Every draw below takes exactly one step of the counter. */
uint64_t random_bits(random_stream *r);
double random_unit(random_stream *r);                          /* uniform in [0, 1), a multiple of 2^-53 */
double random_uniform(random_stream *r, double lo, double hi); /* uniform in [lo, hi); lo when hi <= lo */
double random_normal(random_stream *r);                        /* mean 0, standard deviation 1 */
/* mean > 0 and deviation >= 0 are of the variable itself, not of its logarithm */
double random_lognormal(random_stream *r, double mean, double deviation);

/* A random order of 0 .. count - 1 (Fisher and Yates), all as probable: count - 1 draws. */
void random_order(random_stream *r, int32_t *order, int32_t count);

/* The generator itself: 128 bits from a 128-bit counter and a 64-bit key. */
void random_philox(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]);

#endif
