/* Measures of a polygon, and where a point lies relative to it. */
#include "geometry/polygon.h"
#include "geometry/predicate.h"

double polygon_area(polygon p)
{
    double twice = 0;
    for (int32_t i = 2; i < p.count; i++)
        twice += vec2_cross(vec2_sub(p.vertex[i - 1], p.vertex[0]), vec2_sub(p.vertex[i], p.vertex[0]));
    return 0.5 * twice;
}

double polygon_perimeter(polygon p)
{
    double sum = 0;
    for (int32_t i = 0; i < p.count; i++)
        sum += vec2_length(vec2_sub(p.vertex[i + 1 < p.count ? i + 1 : 0], p.vertex[i]));
    return sum;
}

/* Sums over the triangles (first vertex, a, b) of the exact integrals of 1, (x, y), y^2, x^2 and xy, then the parallel
   axis theorem. */
polygon_moments polygon_moments_of(polygon p)
{
    double area = 0, xx = 0, yy = 0, xy = 0;
    vec2 first = {0, 0};
    for (int32_t i = 2; i < p.count; i++) {
        vec2 a = vec2_sub(p.vertex[i - 1], p.vertex[0]), b = vec2_sub(p.vertex[i], p.vertex[0]);
        double twice = vec2_cross(a, b);
        area += twice / 2;
        first = vec2_add(first, vec2_scale(vec2_add(a, b), twice / 6));
        xx += twice * (a.y * a.y + a.y * b.y + b.y * b.y) / 12;
        yy += twice * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
        xy += twice * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y) / 24;
    }
    if (area == 0)
        return (polygon_moments){.centroid = p.count > 0 ? p.vertex[0] : vec2_make(0, 0)};
    vec2 c = vec2_scale(first, 1 / area);
    return (polygon_moments){.area = area,
                             .centroid = vec2_add(p.vertex[0], c),
                             .xx = xx - area * c.y * c.y,
                             .yy = yy - area * c.x * c.x,
                             .xy = xy - area * c.x * c.y};
}

box2 polygon_bounds(polygon p)
{
    box2 b = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int32_t i = 0; i < p.count; i++) {
        b.lo = vec2_make(real_min(b.lo.x, p.vertex[i].x), real_min(b.lo.y, p.vertex[i].y));
        b.hi = vec2_make(real_max(b.hi.x, p.vertex[i].x), real_max(b.hi.y, p.vertex[i].y));
    }
    return b;
}

/* Crossings of the ray to the right, an edge being closed at its lower end and open at its upper one. */
bool polygon_contains(polygon p, vec2 point)
{
    bool inside = false;
    for (int32_t i = 0, j = p.count - 1; i < p.count; j = i++) {
        vec2 a = p.vertex[j], b = p.vertex[i];
        if (segment_contains(a, b, point))
            return true;
        if ((a.y <= point.y) != (b.y <= point.y) && orientation(a, b, point) == (b.y > a.y ? 1 : -1))
            inside = !inside;
    }
    return inside;
}

vec2 segment_nearest(vec2 a, vec2 b, vec2 point)
{
    vec2 e = vec2_sub(b, a);
    double square = vec2_dot(e, e), t = square > 0 ? vec2_dot(vec2_sub(point, a), e) / square : 0;
    if (t <= 0)
        return a;
    if (t >= 1)
        return b;
    return vec2_add(a, vec2_scale(e, t));
}

vec2 polygon_nearest_boundary(polygon p, vec2 point, int32_t *edge)
{
    vec2 best = point;
    double least = HUGE_VAL;
    int32_t found = -1;
    for (int32_t i = 0; i < p.count; i++) {
        vec2 q = segment_nearest(p.vertex[i], p.vertex[i + 1 < p.count ? i + 1 : 0], point), d = vec2_sub(q, point);
        double square = vec2_dot(d, d);
        if (square < least) {
            least = square;
            best = q;
            found = i;
        }
    }
    if (edge)
        *edge = found;
    return best;
}
