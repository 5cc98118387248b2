/* The area that two polygons have in common, without their intersection. */
#include "geometry/polygon.h"
#include "geometry/predicate.h"

/* An edge as a function of x: y = left_y + slope (x - left), with +1 for the upper side of the polygon and -1 for the
   lower one.  A polygon is the signed sum of the regions under its edges. */
typedef struct edge_line {
    double left, right, left_y, slope, sign;
} edge_line;

/* Edge from a to b relative to the origin; false when it is vertical, and encloses nothing with the ground. */
static bool edge_line_of(vec2 a, vec2 b, vec2 origin, edge_line *e)
{
    bool upper = a.x > b.x; /* of a counter-clockwise ring */
    vec2 from = vec2_sub(upper ? b : a, origin), to = vec2_sub(upper ? a : b, origin);
    if (to.x <= from.x)
        return false;
    *e = (edge_line){from.x, to.x, from.y, (to.y - from.y) / (to.x - from.x), upper ? 1 : -1};
    return true;
}

/* Integral of the lower of the two lines over the x they have in common; both are above 0. */
static double common_integral(const edge_line *e, const edge_line *f)
{
    double left = real_max(e->left, f->left), right = real_min(e->right, f->right), width = right - left;
    if (width <= 0)
        return 0;
    double e_left = e->left_y + e->slope * (left - e->left), e_right = e->left_y + e->slope * (right - e->left);
    double f_left = f->left_y + f->slope * (left - f->left), f_right = f->left_y + f->slope * (right - f->left);
    double above_left = e_left - f_left, above_right = e_right - f_right;
    if (above_left <= 0 && above_right <= 0)
        return 0.5 * width * (e_left + e_right);
    if (above_left >= 0 && above_right >= 0)
        return 0.5 * width * (f_left + f_right);
    double above = real_max(above_left, above_right); /* e crosses f: take away the triangle above it */
    return 0.5 * width * (e_left + e_right - above * above / (fabs(above_left) + fabs(above_right)));
}

/* Product of the two signed sums: the region under both of two edges is the one under the lower.  Most edges lie beside
   each other, and are passed over before their slopes are divided. */
double polygon_overlap_area(polygon a, polygon b)
{
    box2 p = polygon_bounds(a), q = polygon_bounds(b);
    if (p.lo.x >= q.hi.x || q.lo.x >= p.hi.x || p.lo.y >= q.hi.y || q.lo.y >= p.hi.y)
        return 0;
    vec2 origin = {real_max(p.lo.x, q.lo.x), real_min(p.lo.y, q.lo.y)};
    double sum = 0;
    for (int32_t i = 0; i < a.count; i++) {
        edge_line e, f;
        vec2 begin = a.vertex[i], end = a.vertex[i + 1 < a.count ? i + 1 : 0];
        double left = real_min(begin.x, end.x), right = real_max(begin.x, end.x);
        if (left >= q.hi.x || right <= q.lo.x || !edge_line_of(begin, end, origin, &e))
            continue;
        double along = 0;
        for (int32_t k = 0; k < b.count; k++) {
            vec2 from = b.vertex[k], to = b.vertex[k + 1 < b.count ? k + 1 : 0];
            bool beside = real_min(from.x, to.x) >= right || real_max(from.x, to.x) <= left;
            if (!beside && edge_line_of(from, to, origin, &f))
                along += f.sign * common_integral(&e, &f);
        }
        sum += e.sign * along;
    }
    return sum;
}
