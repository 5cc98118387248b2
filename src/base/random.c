/* Philox 4x32-10 and the distributions drawn from it.  See random.h. */
#include "base/random.h"
#include "base/transcendental.h"
#include <math.h>

/* Multipliers and Weyl increments of Philox 4x32 (Salmon et al. 2011, table 2 and section 4.3). */
#define PHILOX_MULTIPLIER_0 0xD2511F53u
#define PHILOX_MULTIPLIER_1 0xCD9E8D57u
#define PHILOX_WEYL_0 0x9E3779B9u
#define PHILOX_WEYL_1 0xBB67AE85u
enum { PHILOX_ROUNDS = 10 };

void random_philox(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4])
{
    uint32_t c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3];
    uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < PHILOX_ROUNDS; round++) {
        uint64_t p0 = (uint64_t)PHILOX_MULTIPLIER_0 * c0, p1 = (uint64_t)PHILOX_MULTIPLIER_1 * c2;
        c0 = (uint32_t)(p1 >> 32) ^ c1 ^ k0;
        c1 = (uint32_t)p1;
        c2 = (uint32_t)(p0 >> 32) ^ c3 ^ k1;
        c3 = (uint32_t)p0;
        k0 += PHILOX_WEYL_0;
        k1 += PHILOX_WEYL_1;
    }
    out[0] = c0;
    out[1] = c1;
    out[2] = c2;
    out[3] = c3;
}

random_stream random_begin(uint64_t seed, uint32_t stream, uint32_t id)
{
    return (random_stream){.seed = seed, .stream = stream, .id = id, .counter = 0};
}

/* The 128 bits of one draw. */
static void draw(random_stream *r, uint64_t bits[2])
{
    const uint32_t counter[4] = {(uint32_t)r->counter, (uint32_t)(r->counter >> 32), r->id, r->stream};
    const uint32_t key[2] = {(uint32_t)r->seed, (uint32_t)(r->seed >> 32)};
    uint32_t out[4];
    random_philox(counter, key, out);
    r->counter++;
    bits[0] = out[0] | (uint64_t)out[1] << 32;
    bits[1] = out[2] | (uint64_t)out[3] << 32;
}

/* The upper 53 bits as a multiple of 2^-53 in [0, 1). */
static double unit_from_bits(uint64_t bits) { return (double)(bits >> 11) * 0x1p-53; }

uint64_t random_bits(random_stream *r)
{
    uint64_t bits[2];
    draw(r, bits);
    return bits[0];
}

double random_unit(random_stream *r) { return unit_from_bits(random_bits(r)); }

double random_uniform(random_stream *r, double lo, double hi)
{
    double x = lo + (hi - lo) * random_unit(r);
    return x < hi ? x : lo; /* the sum may round up to hi */
}

double random_normal(random_stream *r)
{
    uint64_t bits[2];
    draw(r, bits);
    /* Box and Muller 1958; 1 - u is in (0, 1], where the logarithm is finite. */
    return sqrt(-2 * real_log(1 - unit_from_bits(bits[0]))) * real_cos(2 * PI * unit_from_bits(bits[1]));
}

double random_lognormal(random_stream *r, double mean, double deviation)
{
    double variation = deviation / mean;
    double variance = real_log(1 + variation * variation); /* of the logarithm */
    return mean * real_exp(sqrt(variance) * random_normal(r) - variance / 2);
}

void random_order(random_stream *r, int32_t *order, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        order[i] = i;
    for (int32_t i = count - 1; i > 0; i--) {
        int32_t j = (int32_t)(random_unit(r) * (i + 1)), keep = order[i];
        order[i] = order[j];
        order[j] = keep;
    }
}
