#include "geometry/space_curve.h"

#include "geometry/predicate.h"

#include <stdlib.h>

/* Cells of the curve along each side of the bounds: 2^LEVELS. */
enum { LEVELS = 20 };

/* Distance along Hilbert's curve of a cell (Hilbert 1891; the loop turns each quadrant into the frame of the first). */
static uint64_t curve_distance(uint32_t x, uint32_t y)
{
    uint64_t distance = 0;
    for (uint32_t side = 1u << (LEVELS - 1); side > 0; side /= 2) {
        uint32_t right = (x & side) != 0, up = (y & side) != 0;
        distance = 4 * distance + ((3 * right) ^ up);
        if (!up) {
            if (right) {
                x = ~x;
                y = ~y;
            }
            uint32_t swap = x;
            x = y;
            y = swap;
        }
    }
    return distance;
}

typedef struct ordered {
    uint64_t distance;
    int32_t index;
} ordered;

static int compare_ordered(const void *a, const void *b)
{
    const ordered *x = a, *y = b;
    if (x->distance != y->distance)
        return x->distance < y->distance ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

static uint32_t cell_at(double x, double lo, double size)
{
    double most = (double)((1u << LEVELS) - 1), cell = size > 0 ? floor((x - lo) / size * most) : 0;
    return (uint32_t)(cell < 0 ? 0 : cell > most ? most : cell);
}

bool space_curve_order(context *ctx, const vec2 *points, int32_t count, int32_t *order)
{
    ordered *list = memory_array(ctx, (size_t)count + 1, sizeof *list);
    if (!list)
        return false;
    vec2 lo = {HUGE_VAL, HUGE_VAL}, hi = {-HUGE_VAL, -HUGE_VAL};
    for (int32_t i = 0; i < count; i++) {
        lo = vec2_make(real_min(lo.x, points[i].x), real_min(lo.y, points[i].y));
        hi = vec2_make(real_max(hi.x, points[i].x), real_max(hi.y, points[i].y));
    }
    double size = real_max(hi.x - lo.x, hi.y - lo.y);
    for (int32_t i = 0; i < count; i++)
        list[i] = (ordered){curve_distance(cell_at(points[i].x, lo.x, size), cell_at(points[i].y, lo.y, size)), i};
    qsort(list, (size_t)count, sizeof *list, compare_ordered);
    for (int32_t i = 0; i < count; i++)
        order[i] = list[i].index;
    memory_free(ctx, list);
    return true;
}
