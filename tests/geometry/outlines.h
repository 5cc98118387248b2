/* Random outlines for the tests of the planar rooms: stars, convex rings, degenerate copies of them.
   Knows base and polygon.h only. */
#ifndef TESTS_GEOMETRY_OUTLINES_H
#define TESTS_GEOMETRY_OUTLINES_H

#include "base/random.h"
#include "base/transcendental.h"
#include "geometry/polygon.h"
#include "testing.h"

/* Room for the vertices of any outline made here. */
#define OUTLINE_ROOM 128

/* A star-shaped ring of n vertices about `centre`, each at a random radius in [lo, hi]: simple, mostly concave. */
static inline polygon outline_star(random_stream *r, vec2 centre, double lo, double hi, int32_t n, vec2 *out)
{
    double turn = random_uniform(r, 0, 2 * PI);
    for (int32_t i = 0; i < n; i++) {
        double angle = turn + 2 * PI * (i + random_uniform(r, 0, 0.5)) / n, radius = random_uniform(r, lo, hi);
        out[i] = vec2_make(centre.x + radius * real_cos(angle), centre.y + radius * real_sin(angle));
    }
    return (polygon){out, n};
}

/* n points of a circle at random angles in ascending order: convex. */
static inline polygon outline_convex(random_stream *r, vec2 centre, double radius, int32_t n, vec2 *out)
{
    return outline_star(r, centre, radius, radius, n, out);
}

static inline int32_t outline_count(random_stream *r, int32_t lo, int32_t hi)
{
    return hi <= lo ? lo : lo + (int32_t)(random_bits(r) % (uint64_t)(hi - lo + 1));
}

/* Every coordinate rounded to a multiple of `step`. */
static inline void outline_snap(vec2 *v, int32_t n, double step)
{
    for (int32_t i = 0; i < n; i++)
        v[i] = vec2_make(step * floor(v[i].x / step + 0.5), step * floor(v[i].y / step + 0.5));
}

/* Largest distance between two vertices, over all pairs. */
static inline double polygon_diameter(polygon p)
{
    double most = 0;
    for (int32_t i = 0; i < p.count; i++)
        for (int32_t k = 0; k < i; k++)
            most = fmax(most, vec2_length(vec2_sub(p.vertex[i], p.vertex[k])));
    return most;
}

static inline double list_area(const polygon_list *l)
{
    double sum = 0;
    for (int32_t i = 0; i < polygon_list_count(l); i++)
        sum += polygon_area(polygon_list_get(l, i));
    return sum;
}

#endif
