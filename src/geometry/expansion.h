/* Sums and products of doubles without rounding, as expansions: lists of doubles whose exact sum is the value (Dekker
   1971, Knuth 1969, Shewchuk 1997).  What the exact predicates are made of.  Needs round to nearest, no fused
   multiply-add, and values whose products neither overflow nor lose bits below the least double: coordinates from 1e-70
   to 1e70. */
#ifndef GEOMETRY_EXPANSION_H
#define GEOMETRY_EXPANSION_H

/* sum + tail = a + b exactly. */
static inline void exact_sum(double a, double b, double *sum, double *tail)
{
    double s = a + b, b_part = s - a, a_part = s - b_part;
    *sum = s;
    *tail = (a - a_part) + (b - b_part);
}

/* high + low = a exactly, each of 26 bits. */
static inline void exact_split(double a, double *high, double *low)
{
    double c = 134217729.0 * a; /* 2^27 + 1 */
    *high = c - (c - a);
    *low = a - *high;
}

/* product + tail = a b exactly. */
static inline void exact_product(double a, double b, double *product, double *tail)
{
    double p = a * b, a_high, a_low, b_high, b_low;
    exact_split(a, &a_high, &a_low);
    exact_split(b, &b_high, &b_low);
    *product = p;
    *tail = a_low * b_low - (((p - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/* Add b to the expansion e of n doubles (room for n + 1), which stays exact, ordered by magnitude and free of zeros;
   returns the new n. */
static inline int expansion_add(double *e, int n, double b)
{
    int kept = 0;
    double sum = b;
    for (int i = 0; i < n; i++) {
        double tail;
        exact_sum(sum, e[i], &sum, &tail);
        if (tail != 0)
            e[kept++] = tail;
    }
    if (sum != 0)
        e[kept++] = sum;
    return kept;
}

/* Add a b; room for n + 2. */
static inline int expansion_add_product(double *e, int n, double a, double b)
{
    double product, tail;
    exact_product(a, b, &product, &tail);
    n = expansion_add(e, n, tail);
    return expansion_add(e, n, product);
}

/* The last component outweighs all others. */
static inline int expansion_sign(const double *e, int n) { return n == 0 ? 0 : e[n - 1] > 0 ? 1 : -1; }

static inline double expansion_estimate(const double *e, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += e[i];
    return sum;
}

#endif
