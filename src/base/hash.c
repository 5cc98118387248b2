/* Hashes of memory blocks.  Knows bytes only. */
#include "base/hash.h"
#include <nettle/sha2.h>
#include <string.h>

/* Odd multipliers: the fractional parts of the square roots of 2, 3, 5 and 7, lowest bit set. */
#define MULTIPLIER_0 0x6a09e667f3bcc909u
#define MULTIPLIER_1 0xbb67ae8584caa73bu
#define MULTIPLIER_2 0x3c6ef372fe94f82bu
#define MULTIPLIER_3 0xa54ff53a5f1d36f1u

/* One word into one lane.  Every operation is a bijection of the lane, so that two blocks which differ in one word
   never collide in that lane; the shift brings the well mixed high bits down where the next word enters. */
static inline uint64_t lane_mix(uint64_t lane, uint64_t word, uint64_t multiplier)
{
    lane = (lane ^ word) * multiplier;
    return lane ^ (lane >> 32);
}

/* Spreads every bit over all (finaliser of SplitMix64: Steele, Lea, Flood 2014, figure 16). */
static inline uint64_t spread(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static inline uint64_t word_at(const unsigned char *bytes)
{
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

uint64_t hash_bytes(const void *data, size_t size, uint64_t seed)
{
    const unsigned char *bytes = data;
    uint64_t a = seed ^ MULTIPLIER_3, b = seed ^ MULTIPLIER_2, c = seed ^ MULTIPLIER_1, d = seed ^ MULTIPLIER_0;
    size_t left = size;
    /* Four independent lanes: the multiplier's latency would otherwise bound the speed. */
    for (; left >= 32; left -= 32, bytes += 32) {
        a = lane_mix(a, word_at(bytes), MULTIPLIER_0);
        b = lane_mix(b, word_at(bytes + 8), MULTIPLIER_1);
        c = lane_mix(c, word_at(bytes + 16), MULTIPLIER_2);
        d = lane_mix(d, word_at(bytes + 24), MULTIPLIER_3);
    }
    uint64_t h = spread(a);
    h = spread(h ^ b);
    h = spread(h ^ c);
    h = spread(h ^ d);
    for (; left >= 8; left -= 8, bytes += 8)
        h = lane_mix(h, word_at(bytes), MULTIPLIER_0);
    if (left > 0) { /* padded with zeros; the size, below, tells padding from data */
        uint64_t word = 0;
        memcpy(&word, bytes, left);
        h = lane_mix(h, word, MULTIPLIER_1);
    }
    return spread(h ^ ((uint64_t)size * MULTIPLIER_2));
}

void sha256_text(const void *data, size_t size, char out[SHA256_TEXT_SIZE])
{
    static const char digits[] = "0123456789abcdef";
    struct sha256_ctx state;
    uint8_t digest[SHA256_DIGEST_SIZE];
    sha256_init(&state);
    if (size > 0)
        sha256_update(&state, size, data);
    sha256_digest(&state, sizeof digest, digest);
    for (size_t i = 0; i < sizeof digest; i++) {
        out[2 * i] = digits[digest[i] >> 4];
        out[2 * i + 1] = digits[digest[i] & 15];
    }
    out[64] = '\0';
}
