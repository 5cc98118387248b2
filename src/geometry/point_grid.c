/* Hashed cells; see point_grid.h. */
#include "geometry/point_grid.h"

/* Cells along the longest side of the box at most: cell numbers stay small, and cells do not shrink to nothing when
   only equal points are joined. */
#define MOST_CELLS 1048576.0

typedef struct cell {
    int32_t x, y, z;
} cell;

static cell cell_of(const point_grid *g, vec3 p)
{
    return (cell){(int32_t)floor((p.x - g->origin.x) / g->cell), (int32_t)floor((p.y - g->origin.y) / g->cell),
                  (int32_t)floor((p.z - g->origin.z) / g->cell)};
}

/* Primes of Teschner et al. (2003), then a final mix (Murmur3), because the table takes low bits only. */
static uint32_t bucket_of(const point_grid *g, cell c)
{
    uint32_t h = (uint32_t)c.x * 73856093u ^ (uint32_t)c.y * 19349663u ^ (uint32_t)c.z * 83492791u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return (h ^ (h >> 16)) & g->mask;
}

bool point_grid_init(context *ctx, point_grid *g, box3 box, double distance, int32_t expected)
{
    vec3 size = vec3_sub(box.hi, box.lo);
    double longest = fmax(fmax(size.x, size.y), size.z);
    *g = (point_grid){.origin = box.lo, .distance = distance, .cell = fmax(2 * distance, longest / MOST_CELLS)};
    if (!(g->cell > 0))
        g->cell = 1;
    uint32_t buckets = 16;
    while (buckets < 2 * (uint32_t)expected && buckets < UINT32_C(1) << 30)
        buckets *= 2;
    g->mask = buckets - 1;
    g->bucket = memory_array(ctx, buckets, sizeof *g->bucket);
    if (!g->bucket)
        return false;
    for (uint32_t i = 0; i < buckets; i++)
        g->bucket[i] = -1;
    return true;
}

void point_grid_free(context *ctx, point_grid *g)
{
    memory_free(ctx, g->bucket);
    array_free(ctx, &g->before);
    array_free(ctx, &g->point);
    g->bucket = NULL;
}

/* Within the distance; squares alone would call points one whose differences are too small to have any. */
static bool is_near(const point_grid *g, vec3 a, vec3 b)
{
    vec3 d = vec3_sub(a, b);
    double most = fmax(fmax(fabs(d.x), fabs(d.y)), fabs(d.z));
    return most <= g->distance && vec3_dot(d, d) <= g->distance * g->distance;
}

/* A cell is at least twice the distance wide, so that a ball reaches into two of them at most along each axis. */
int32_t point_grid_find(const point_grid *g, vec3 p)
{
    vec3 reach = {g->distance, g->distance, g->distance};
    cell lo = cell_of(g, vec3_sub(p, reach)), hi = cell_of(g, vec3_add(p, reach));
    int32_t best = -1;
    for (int32_t x = lo.x; x <= hi.x; x++)
        for (int32_t y = lo.y; y <= hi.y; y++)
            for (int32_t z = lo.z; z <= hi.z; z++)
                for (int32_t i = g->bucket[bucket_of(g, (cell){x, y, z})]; i >= 0; i = g->before.data[i])
                    if ((best < 0 || i < best) && is_near(g, g->point.data[i], p))
                        best = i;
    return best;
}

bool point_grid_add(context *ctx, point_grid *g, vec3 p)
{
    uint32_t b = bucket_of(g, cell_of(g, p));
    if (!array_push(ctx, &g->before, g->bucket[b]) || !array_push(ctx, &g->point, p))
        return false;
    g->bucket[b] = g->point.count - 1;
    return true;
}
