/* Numbers and vectors of as many bodies, points or triangles as one register holds, for kernels that need no more than
   that at once (kernel.h, simd.h); lanes.h has eight at a time.  Knows nothing of what the lanes mean. */
#ifndef BASE_PARTS_H
#define BASE_PARTS_H

#include "base/simd.h"
#include "base/vec.h"

typedef v8_part real;
typedef v8_part_mask mask;

typedef struct real3 {
    real x, y, z;
} real3;

/* V8_PART_LANES doubles, wherever they begin. */
V8_INLINE real load(const double *p)
{
    real x;
    memcpy(&x, p, sizeof x);
    return x;
}

V8_INLINE void store(double *p, real x) { memcpy(p, &x, sizeof x); }

/* 0, 1, 2 ... */
#if V8_PART_LANES == 8
#define PART_NUMBERS ((v8_part){0, 1, 2, 3, 4, 5, 6, 7})
#elif V8_PART_LANES == 4
#define PART_NUMBERS ((v8_part){0, 1, 2, 3})
#else
#define PART_NUMBERS ((v8_part){0, 1})
#endif

/* Points from ring[first] on, of `count` of which memory up to `readable` may be read; what stands beyond `count` has
   no meaning. */
V8_INLINE void load_points(const vec2 *ring, int32_t count, int32_t readable, int32_t first, real *x, real *y)
{
    if (first + V8_PART_LANES <= readable) {
        v8_part_load_pairs(&ring[first].x, x, y);
        return;
    }
    double room[2 * V8_PART_LANES];
    for (int32_t i = 0; i < V8_PART_LANES; i++) {
        vec2 v = ring[first + i < count ? first + i : 0];
        room[2 * i] = v.x;
        room[2 * i + 1] = v.y;
    }
    v8_part_load_pairs(room, x, y);
}

V8_INLINE real choose(mask m, real a, real b) { return v8_part_select(m, a, b); }
/* a < b and a <= b in every lane */
V8_INLINE mask less(real a, real b) { return (mask)(a < b); }
V8_INLINE mask less_equal(real a, real b) { return (mask)(a <= b); }
V8_INLINE bool any(mask m) { return v8_part_bits(m) != 0; }
V8_INLINE real magnitude(real a) { return (real)((mask)a & INT64_MAX); }
V8_INLINE real3 choose3(mask m, real3 a, real3 b)
{
    return (real3){choose(m, a.x, b.x), choose(m, a.y, b.y), choose(m, a.z, b.z)};
}

/* Sum of eight lanes, in the order of v8_sum. */
V8_INLINE double parts_sum(const real lanes[V8_PARTS])
{
    v8_parts all;
    for (int h = 0; h < V8_PARTS; h++)
        all.part[h] = lanes[h];
    return v8_sum(all.whole);
}

V8_INLINE real3 add(real3 a, real3 b) { return (real3){a.x + b.x, a.y + b.y, a.z + b.z}; }
V8_INLINE real3 sub(real3 a, real3 b) { return (real3){a.x - b.x, a.y - b.y, a.z - b.z}; }
V8_INLINE real3 scale(real3 a, real s) { return (real3){s * a.x, s * a.y, s * a.z}; }
V8_INLINE real dot(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/* A symmetric tensor, xx yy zz xy xz yz, times a vector. */
V8_INLINE real3 sym3_times(const real s[6], real3 a)
{
    return (real3){s[0] * a.x + s[3] * a.y + s[4] * a.z, s[3] * a.x + s[1] * a.y + s[5] * a.z,
                   s[4] * a.x + s[5] * a.y + s[2] * a.z};
}
V8_INLINE real3 cross(real3 a, real3 b)
{
    return (real3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

#endif
