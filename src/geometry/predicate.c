/* Exact sign of an orientation; see predicate.h. */
#include "geometry/predicate.h"
#include "geometry/expansion.h"

/* Relative error of the plain determinant, (3 + 16 u) u with u = 2^-53 (Shewchuk 1997, section 4.2). */
#define FILTER 3.3306690738754716e-16

/* ax by - ax cy - cx by - ay bx + ay cx + cy bx: the determinant without differences, so without rounding. */
static int exact_orientation(vec2 a, vec2 b, vec2 c)
{
    const double factor[6][2] = {{a.x, b.y}, {-a.x, c.y}, {-c.x, b.y}, {-a.y, b.x}, {a.y, c.x}, {c.y, b.x}};
    double e[12];
    int n = 0;
    for (int i = 0; i < 6; i++)
        n = expansion_add_product(e, n, factor[i][0], factor[i][1]);
    return expansion_sign(e, n);
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

bool segment_contains(vec2 a, vec2 b, vec2 p) { return in_box(a, b, p) && orientation(a, b, p) == 0; }

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
