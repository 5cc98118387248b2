/* Exact sign of an orientation; see predicate.h.  Needs round to nearest and no fused multiply-add. */
#include "geometry/predicate.h"

/* Relative error of the plain determinant, (3 + 16 u) u with u = 2^-53 (Shewchuk 1997, section 4.2). */
#define FILTER 3.3306690738754716e-16
/* Splits a double into two halves of 26 bits: 2^27 + 1. */
#define SPLITTER 134217729.0

/* sum + tail = a + b exactly (Knuth). */
static void exact_sum(double a, double b, double *sum, double *tail)
{
    double s = a + b, b_part = s - a, a_part = s - b_part;
    *sum = s;
    *tail = (a - a_part) + (b - b_part);
}

/* high + low = a exactly, each of 26 bits (Dekker). */
static void split(double a, double *high, double *low)
{
    double c = SPLITTER * a;
    *high = c - (c - a);
    *low = a - *high;
}

/* product + tail = a b exactly (Dekker). */
static void exact_product(double a, double b, double *product, double *tail)
{
    double p = a * b, a_high, a_low, b_high, b_low;
    split(a, &a_high, &a_low);
    split(b, &b_high, &b_low);
    *product = p;
    *tail = a_low * b_low - (((p - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/* Add b to the expansion e of n doubles, which stays exact and ordered by magnitude; returns the new n. */
static int expansion_add(double *e, int n, double b)
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

/* ax by - ax cy - cx by - ay bx + ay cx + cy bx: the determinant without differences, so without rounding. */
static int exact_orientation(vec2 a, vec2 b, vec2 c)
{
    const double factor[6][2] = {{a.x, b.y}, {-a.x, c.y}, {-c.x, b.y}, {-a.y, b.x}, {a.y, c.x}, {c.y, b.x}};
    double e[12];
    int n = 0;
    for (int i = 0; i < 6; i++) {
        double product, tail;
        exact_product(factor[i][0], factor[i][1], &product, &tail);
        n = expansion_add(e, n, tail);
        n = expansion_add(e, n, product);
    }
    return n == 0 ? 0 : e[n - 1] > 0 ? 1 : -1;
}

int orientation(vec2 a, vec2 b, vec2 c)
{
    double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    double det = left - right, bound = FILTER * (fabs(left) + fabs(right));
    if (det > bound)
        return 1;
    if (det < -bound)
        return -1;
    if ((a.x == c.x || b.y == c.y) && (a.y == c.y || b.x == c.x))
        return 0; /* a line along an axis: common, and no reason for the slow way */
    return exact_orientation(a, b, c);
}

static bool in_box(vec2 a, vec2 b, vec2 p)
{
    return p.x >= real_min(a.x, b.x) && p.x <= real_max(a.x, b.x) && p.y >= real_min(a.y, b.y) &&
           p.y <= real_max(a.y, b.y);
}

bool segment_contains(vec2 a, vec2 b, vec2 p)
{
    return in_box(a, b, p) && orientation(a, b, p) == 0;
}

bool segments_touch(vec2 a, vec2 b, vec2 c, vec2 d)
{
    if (real_max(a.x, b.x) < real_min(c.x, d.x) || real_max(c.x, d.x) < real_min(a.x, b.x) ||
        real_max(a.y, b.y) < real_min(c.y, d.y) || real_max(c.y, d.y) < real_min(a.y, b.y))
        return false;
    int ab_c = orientation(a, b, c), ab_d = orientation(a, b, d);
    if (ab_c * ab_d > 0)
        return false;
    /* With both of c, d on the line ab, all four points are on it and the boxes of the segments decide. */
    return orientation(c, d, a) * orientation(c, d, b) <= 0;
}
