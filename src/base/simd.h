/* Eight doubles at once.  For kernels (kernel.h): one source, compiled for each instruction set, the same bits on all.

   v8 is a vector of gcc and clang: + - * / and unary - work on it lane by lane, and a scalar may stand on one side
   (2 * a).  Where registers are narrower the compiler works in parts of 4 or 2 lanes.  Comparisons, minima and choices
   are the functions below: gcc takes the operators < == and the like apart into single lanes.  Keep a v8 in local
   variables and in functions marked V8_INLINE; to other functions pass pointers to doubles.  Load and store with
   v8_load and v8_store, which ask for no alignment, never through a v8 pointer.  Must not know what the lanes mean. */
#ifndef BASE_SIMD_H
#define BASE_SIMD_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

/* No vector passes through a real call, so how it would pass is of no interest (gcc asks for -Wno-psabi on its command
   line, which the build gives to kernels). */
#pragma GCC diagnostic ignored "-Wpsabi"

enum { V8_LANES = 8 };

typedef double v8 __attribute__((vector_size(64)));
/* One truth value per lane: all bits set or none.  & | ^ ~ combine masks. */
typedef long long v8_mask __attribute__((vector_size(64)));

#define V8_INLINE static inline __attribute__((always_inline))

/* ---- parts: what one register of this compilation holds.  Everything that gcc cannot split by itself is split here,
   by way of a union, which it sees through. ---- */

#if defined(__AVX512F__)
#define V8_PART_LANES 8
#elif defined(__AVX__)
#define V8_PART_LANES 4
#else
#define V8_PART_LANES 2
#endif
#define V8_PARTS (V8_LANES / V8_PART_LANES)

typedef double v8_part __attribute__((vector_size(8 * V8_PART_LANES)));
typedef long long v8_part_mask __attribute__((vector_size(8 * V8_PART_LANES)));
typedef double v8_part2 __attribute__((vector_size(16)));
typedef union v8_parts {
    v8 whole;
    v8_mask mask;
    v8_part part[V8_PARTS];
    v8_part_mask part_mask[V8_PARTS];
} v8_parts;

/* mask ? a : b */
V8_INLINE v8_part v8_part_select(v8_part_mask mask, v8_part a, v8_part b)
{
#if defined(__AVX__) && !defined(__AVX512F__)
    return (v8_part)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)mask);
#else
    return (v8_part)(((v8_part_mask)a & mask) | ((v8_part_mask)b & ~mask));
#endif
}

/* a < b ? a : b, which is what the instruction does with zeros and NaN, too. */
V8_INLINE v8_part v8_part_min(v8_part a, v8_part b)
{
#if defined(__AVX512F__)
    return (v8_part)_mm512_min_pd((__m512d)a, (__m512d)b);
#elif defined(__AVX__)
    return (v8_part)_mm256_min_pd((__m256d)a, (__m256d)b);
#elif defined(__SSE2__)
    return (v8_part)_mm_min_pd((__m128d)a, (__m128d)b);
#else
    return v8_part_select((v8_part_mask)(a < b), a, b);
#endif
}

/* a > b ? a : b */
V8_INLINE v8_part v8_part_max(v8_part a, v8_part b)
{
#if defined(__AVX512F__)
    return (v8_part)_mm512_max_pd((__m512d)a, (__m512d)b);
#elif defined(__AVX__)
    return (v8_part)_mm256_max_pd((__m256d)a, (__m256d)b);
#elif defined(__SSE2__)
    return (v8_part)_mm_max_pd((__m128d)a, (__m128d)b);
#else
    return v8_part_select((v8_part_mask)(a > b), a, b);
#endif
}

V8_INLINE v8_part v8_part_sqrt(v8_part a)
{
#if defined(__AVX512F__)
    return (v8_part)_mm512_sqrt_pd((__m512d)a);
#elif defined(__AVX__)
    return (v8_part)_mm256_sqrt_pd((__m256d)a);
#elif defined(__SSE2__)
    return (v8_part)_mm_sqrt_pd((__m128d)a);
#else
    return (v8_part){sqrt(a[0]), sqrt(a[1])};
#endif
}

/* Bit i set where lane i is. */
V8_INLINE unsigned v8_part_bits(v8_part_mask mask)
{
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask);
#elif defined(__AVX__)
    return (unsigned)_mm256_movemask_pd((__m256d)mask);
#elif defined(__SSE2__)
    return (unsigned)_mm_movemask_pd((__m128d)mask);
#else
    return (mask[0] != 0 ? 1u : 0u) | (mask[1] != 0 ? 2u : 0u);
#endif
}

V8_INLINE v8_part v8_part_set(double x)
{
#if defined(__AVX512F__)
    return (v8_part){x, x, x, x, x, x, x, x};
#elif defined(__AVX__)
    return (v8_part){x, x, x, x};
#else
    return (v8_part){x, x};
#endif
}

/* Least lane of a part, halves first. */
V8_INLINE double v8_part_least(v8_part a)
{
#if defined(__AVX512F__)
    __m256d half = _mm256_min_pd(_mm512_castpd512_pd256((__m512d)a), _mm512_extractf64x4_pd((__m512d)a, 1));
    v8_part2 pair = (v8_part2)_mm_min_pd(_mm256_castpd256_pd128(half), _mm256_extractf128_pd(half, 1));
#elif defined(__AVX__)
    v8_part2 pair = (v8_part2)_mm_min_pd(_mm256_castpd256_pd128((__m256d)a), _mm256_extractf128_pd((__m256d)a, 1));
#else
    v8_part2 pair = a;
#endif
    return pair[0] < pair[1] ? pair[0] : pair[1];
}

/* p[0], p[2], .. and p[1], p[3], .., as many of each as a part has lanes */
V8_INLINE void v8_part_load_pairs(const double *p, v8_part *even, v8_part *odd)
{
    v8_part a, b;
    memcpy(&a, p, sizeof a);
    memcpy(&b, p + V8_PART_LANES, sizeof b);
#if defined(__AVX512F__)
    *even = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    *odd = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
#elif defined(__AVX__)
    *even = __builtin_shufflevector(a, b, 0, 2, 4, 6);
    *odd = __builtin_shufflevector(a, b, 1, 3, 5, 7);
#else
    *even = __builtin_shufflevector(a, b, 0, 2);
    *odd = __builtin_shufflevector(a, b, 1, 3);
#endif
}

/* ---- memory ---- */

/* x in all lanes */
V8_INLINE v8 v8_set(double x) { return (v8){x, x, x, x, x, x, x, x}; }

/* p[0..7] */
V8_INLINE v8 v8_load(const double *p)
{
    v8_parts x;
    for (int i = 0; i < V8_PARTS; i++)
        memcpy(&x.part[i], p + V8_PART_LANES * i, sizeof x.part[i]);
    return x.whole;
}

V8_INLINE void v8_store(double *p, v8 a)
{
    v8_parts x = {.whole = a};
    for (int i = 0; i < V8_PARTS; i++)
        memcpy(p + V8_PART_LANES * i, &x.part[i], sizeof x.part[i]);
}

/* base[index[0..7]] */
V8_INLINE v8 v8_gather(const double *base, const int32_t index[8])
{
    return (v8){base[index[0]], base[index[1]], base[index[2]], base[index[3]],
                base[index[4]], base[index[5]], base[index[6]], base[index[7]]};
}

/* Rows become columns: lane i of the new a[j] is lane j of the old a[i]. */
V8_INLINE void v8_transpose(v8 a[8])
{
#if defined(__AVX512F__)
    v8 b[8], c[8];
    for (int i = 0; i < 8; i += 2) { /* single lanes of neighbours: columns j and j + 1 side by side */
        b[i] = __builtin_shufflevector(a[i], a[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        b[i + 1] = __builtin_shufflevector(a[i], a[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int i = 0; i < 8; i += 4) { /* then pairs of lanes, twice */
        for (int j = 0; j < 2; j++) {
            c[i + j] = __builtin_shufflevector(b[i + j], b[i + j + 2], 0, 1, 4, 5, 8, 9, 12, 13);
            c[i + j + 2] = __builtin_shufflevector(b[i + j], b[i + j + 2], 2, 3, 6, 7, 10, 11, 14, 15);
        }
    }
    for (int j = 0; j < 4; j++) {
        a[j] = __builtin_shufflevector(c[j], c[j + 4], 0, 1, 4, 5, 8, 9, 12, 13);
        a[j + 4] = __builtin_shufflevector(c[j], c[j + 4], 2, 3, 6, 7, 10, 11, 14, 15);
    }
#else
    v8_parts in[8], out[8];
    for (int i = 0; i < 8; i++)
        in[i].whole = a[i];
    for (int h = 0; h < V8_PARTS; h++) { /* square blocks of one part */
        for (int k = 0; k < V8_PARTS; k++) {
            int row = V8_PART_LANES * h, column = V8_PART_LANES * k;
#if defined(__AVX__)
            v8_part b0 = __builtin_shufflevector(in[row].part[k], in[row + 1].part[k], 0, 4, 2, 6);
            v8_part b1 = __builtin_shufflevector(in[row].part[k], in[row + 1].part[k], 1, 5, 3, 7);
            v8_part b2 = __builtin_shufflevector(in[row + 2].part[k], in[row + 3].part[k], 0, 4, 2, 6);
            v8_part b3 = __builtin_shufflevector(in[row + 2].part[k], in[row + 3].part[k], 1, 5, 3, 7);
            out[column].part[h] = __builtin_shufflevector(b0, b2, 0, 1, 4, 5);
            out[column + 1].part[h] = __builtin_shufflevector(b1, b3, 0, 1, 4, 5);
            out[column + 2].part[h] = __builtin_shufflevector(b0, b2, 2, 3, 6, 7);
            out[column + 3].part[h] = __builtin_shufflevector(b1, b3, 2, 3, 6, 7);
#else
            out[column].part[h] = __builtin_shufflevector(in[row].part[k], in[row + 1].part[k], 0, 2);
            out[column + 1].part[h] = __builtin_shufflevector(in[row].part[k], in[row + 1].part[k], 1, 3);
#endif
        }
    }
    for (int i = 0; i < 8; i++)
        a[i] = out[i].whole;
#endif
}

/* Rows of eight doubles: lane i of column[j] is base[8 index[i] + j].  When several columns are wanted, much faster
   than a v8_gather for each; columns that are not used cost little. */
V8_INLINE void v8_gather_rows(const double *base, const int32_t index[8], v8 column[8])
{
    for (int i = 0; i < V8_LANES; i++)
        column[i] = v8_load(base + (ptrdiff_t)V8_LANES * index[i]);
    v8_transpose(column);
}

/* The inverse, in ascending order: of equal indices the last stays.  Changes column. */
V8_INLINE void v8_scatter_rows(double *base, const int32_t index[8], v8 column[8])
{
    v8_transpose(column);
    for (int i = 0; i < V8_LANES; i++)
        v8_store(base + (ptrdiff_t)V8_LANES * index[i], column[i]);
}

/* The same of one part: lane i of column[j] is base[8 index[i] + j].  Written out: gcc 12 goes through memory where
   registers stand in arrays that loops run over. */
#if V8_PART_LANES == 4
V8_INLINE void v8_part_gather_four(const double *base, const int32_t *index, v8_part column[4])
{
    v8_part a0, a1, a2, a3;
    memcpy(&a0, base + (ptrdiff_t)V8_LANES * index[0], sizeof a0);
    memcpy(&a1, base + (ptrdiff_t)V8_LANES * index[1], sizeof a1);
    memcpy(&a2, base + (ptrdiff_t)V8_LANES * index[2], sizeof a2);
    memcpy(&a3, base + (ptrdiff_t)V8_LANES * index[3], sizeof a3);
    v8_part b0 = __builtin_shufflevector(a0, a1, 0, 4, 2, 6), b1 = __builtin_shufflevector(a0, a1, 1, 5, 3, 7);
    v8_part b2 = __builtin_shufflevector(a2, a3, 0, 4, 2, 6), b3 = __builtin_shufflevector(a2, a3, 1, 5, 3, 7);
    column[0] = __builtin_shufflevector(b0, b2, 0, 1, 4, 5);
    column[1] = __builtin_shufflevector(b1, b3, 0, 1, 4, 5);
    column[2] = __builtin_shufflevector(b0, b2, 2, 3, 6, 7);
    column[3] = __builtin_shufflevector(b1, b3, 2, 3, 6, 7);
}

V8_INLINE void v8_part_scatter_four(double *base, const int32_t *index, const v8_part column[4])
{
    v8_part b0 = __builtin_shufflevector(column[0], column[1], 0, 4, 2, 6);
    v8_part b1 = __builtin_shufflevector(column[0], column[1], 1, 5, 3, 7);
    v8_part b2 = __builtin_shufflevector(column[2], column[3], 0, 4, 2, 6);
    v8_part b3 = __builtin_shufflevector(column[2], column[3], 1, 5, 3, 7);
    v8_part a0 = __builtin_shufflevector(b0, b2, 0, 1, 4, 5), a1 = __builtin_shufflevector(b1, b3, 0, 1, 4, 5);
    v8_part a2 = __builtin_shufflevector(b0, b2, 2, 3, 6, 7), a3 = __builtin_shufflevector(b1, b3, 2, 3, 6, 7);
    memcpy(base + (ptrdiff_t)V8_LANES * index[0], &a0, sizeof a0);
    memcpy(base + (ptrdiff_t)V8_LANES * index[1], &a1, sizeof a1);
    memcpy(base + (ptrdiff_t)V8_LANES * index[2], &a2, sizeof a2);
    memcpy(base + (ptrdiff_t)V8_LANES * index[3], &a3, sizeof a3);
}
#elif V8_PART_LANES == 2
V8_INLINE void v8_part_gather_two(const double *base, const int32_t *index, v8_part column[2])
{
    v8_part a, b;
    memcpy(&a, base + (ptrdiff_t)V8_LANES * index[0], sizeof a);
    memcpy(&b, base + (ptrdiff_t)V8_LANES * index[1], sizeof b);
    column[0] = __builtin_shufflevector(a, b, 0, 2);
    column[1] = __builtin_shufflevector(a, b, 1, 3);
}

V8_INLINE void v8_part_scatter_two(double *base, const int32_t *index, const v8_part column[2])
{
    v8_part a = __builtin_shufflevector(column[0], column[1], 0, 2);
    v8_part b = __builtin_shufflevector(column[0], column[1], 1, 3);
    memcpy(base + (ptrdiff_t)V8_LANES * index[0], &a, sizeof a);
    memcpy(base + (ptrdiff_t)V8_LANES * index[1], &b, sizeof b);
}
#endif

V8_INLINE void v8_part_gather_rows(const double *base, const int32_t *index, v8_part column[8])
{
#if V8_PART_LANES == 8
    v8_gather_rows(base, index, column);
#elif V8_PART_LANES == 4
    v8_part_gather_four(base, index, column);
    v8_part_gather_four(base + 4, index, column + 4);
#else
    v8_part_gather_two(base, index, column);
    v8_part_gather_two(base + 2, index, column + 2);
    v8_part_gather_two(base + 4, index, column + 4);
    v8_part_gather_two(base + 6, index, column + 6);
#endif
}

/* The inverse, in ascending order.  Changes column. */
V8_INLINE void v8_part_scatter_rows(double *base, const int32_t *index, v8_part column[8])
{
#if V8_PART_LANES == 8
    v8_scatter_rows(base, index, column);
#elif V8_PART_LANES == 4
    v8_part_scatter_four(base, index, column);
    v8_part_scatter_four(base + 4, index, column + 4);
#else
    v8_part_scatter_two(base, index, column);
    v8_part_scatter_two(base + 2, index, column + 2);
    v8_part_scatter_two(base + 4, index, column + 4);
    v8_part_scatter_two(base + 6, index, column + 6);
#endif
}

/* ---- arithmetic ---- */

/* a < b ? a : b in every lane, hence b where one is NaN */
V8_INLINE v8 v8_min(v8 a, v8 b)
{
    v8_parts x = {.whole = a}, y = {.whole = b}, z;
    for (int i = 0; i < V8_PARTS; i++)
        z.part[i] = v8_part_min(x.part[i], y.part[i]);
    return z.whole;
}

/* a > b ? a : b in every lane, hence b where one is NaN */
V8_INLINE v8 v8_max(v8 a, v8 b)
{
    v8_parts x = {.whole = a}, y = {.whole = b}, z;
    for (int i = 0; i < V8_PARTS; i++)
        z.part[i] = v8_part_max(x.part[i], y.part[i]);
    return z.whole;
}

V8_INLINE v8 v8_abs(v8 a) { return (v8)((v8_mask)a & INT64_MAX); }

V8_INLINE v8 v8_sqrt(v8 a)
{
    v8_parts x = {.whole = a}, z;
    for (int i = 0; i < V8_PARTS; i++)
        z.part[i] = v8_part_sqrt(x.part[i]);
    return z.whole;
}

/* Sum of the lanes, always ((0 + 1) + (2 + 3)) + ((4 + 5) + (6 + 7)) */
V8_INLINE double v8_sum(v8 a) { return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7])); }

/* ---- masks ---- */

V8_INLINE v8_mask v8_less(v8 a, v8 b)
{
    v8_parts x = {.whole = a}, y = {.whole = b}, z;
    for (int i = 0; i < V8_PARTS; i++)
        z.part_mask[i] = (v8_part_mask)(x.part[i] < y.part[i]);
    return z.mask;
}

V8_INLINE v8_mask v8_less_equal(v8 a, v8 b)
{
    v8_parts x = {.whole = a}, y = {.whole = b}, z;
    for (int i = 0; i < V8_PARTS; i++)
        z.part_mask[i] = (v8_part_mask)(x.part[i] <= y.part[i]);
    return z.mask;
}

/* mask ? a : b in every lane */
V8_INLINE v8 v8_select(v8_mask mask, v8 a, v8 b)
{
    v8_parts m = {.mask = mask}, x = {.whole = a}, y = {.whole = b}, z;
    for (int i = 0; i < V8_PARTS; i++)
        z.part[i] = v8_part_select(m.part_mask[i], x.part[i], y.part[i]);
    return z.whole;
}

/* Bit i of the result is set where lane i of the mask is: 0 for none, 255 for all. */
V8_INLINE unsigned v8_bits(v8_mask mask)
{
    v8_parts m = {.mask = mask};
    unsigned bits = 0;
    for (int i = 0; i < V8_PARTS; i++)
        bits |= v8_part_bits(m.part_mask[i]) << (V8_PART_LANES * i);
    return bits;
}

V8_INLINE bool v8_any(v8_mask mask) { return v8_bits(mask) != 0; }
V8_INLINE bool v8_all(v8_mask mask) { return v8_bits(mask) == 255; }

#endif
