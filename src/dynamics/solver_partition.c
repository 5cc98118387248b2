/* Regions of the plane with about equally many bodies: strips along the longer side, each cut across.  Counting bins
   instead of sorting, so that it costs little more than reading the places. */
#include "dynamics/solver_batch.h"

/* Bodies of a region: enough that most contacts lie within regions, few enough that one region stays in a core's own
   cache and several threads find work. */
enum { REGION_BODIES = 512 };
/* A field of fewer bodies is halved when it has so many groups of contacts that half a sweep, about 20 us, takes many
   times what sharing it costs, and so many bodies that few groups lie across. */
enum { HALVED_GROUPS = 512, HALVED_BODIES = 256 };
enum { BINS = 512 };

typedef struct binning {
    double lo, scale;
    int32_t end[BINS]; /* counts, then part of each bin */
} binning;

static binning binning_make(double lo, double hi)
{
    binning b = {.lo = lo, .scale = hi > lo ? BINS / (hi - lo) : 0};
    return b;
}

static int bin_of(const binning *b, double x)
{
    double at = (x - b->lo) * b->scale;
    return at >= 0 ? (at < BINS ? (int)at : BINS - 1) : 0;
}

/* Counts become the part of `parts` that each bin belongs to. */
static void share_out(binning *b, int32_t count, int32_t parts)
{
    int64_t before = 0;
    for (int i = 0; i < BINS; i++) {
        int32_t here = b->end[i];
        b->end[i] = (int32_t)((before + here / 2) * parts / (count > 0 ? count : 1));
        before += here;
    }
}

static double along(const body_table *bodies, int32_t slot, bool y)
{
    return y ? bodies->position[slot].y : bodies->position[slot].x;
}

typedef struct extent {
    double lo[2], hi[2];
} extent;

static extent extent_of(const body_table *bodies, const int32_t *slots, int32_t count)
{
    extent e = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int32_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            double x = along(bodies, slots[i], k == 1);
            e.lo[k] = fmin(e.lo[k], x);
            e.hi[k] = fmax(e.hi[k], x);
        }
    }
    return e;
}

/* Strips and pieces of each strip, for regions that are about square. */
static void choose_counts(const extent *e, int32_t count, int32_t groups, int32_t *strips, int32_t *pieces)
{
    int32_t wanted = count / REGION_BODIES, least = groups >= HALVED_GROUPS && count >= HALVED_BODIES ? 2 : 1;
    wanted = wanted < least ? least : wanted > PARTITION_MOST ? PARTITION_MOST : wanted;
    double length = fmax(e->hi[0] - e->lo[0], e->hi[1] - e->lo[1]);
    double width = fmin(e->hi[0] - e->lo[0], e->hi[1] - e->lo[1]);
    *strips = wanted;
    while (*strips > 1 && length * (double)wanted < width * ((double)*strips * *strips))
        --*strips;
    *pieces = wanted / *strips;
}

/* How strips from `first` on are cut along one axis, where they reach from lo to hi. */
typedef struct cut {
    int32_t first, strips, pieces;
    bool y;
    double lo, hi;
} cut;
enum { STRIPS_AT_ONCE = 8 };

/* Numbers from `strips` on are regions of strips that are cut. */
static void cut_strips(const body_table *bodies, const int32_t *slots, int32_t count, int32_t *region, const cut *c)
{
    binning across[STRIPS_AT_ONCE];
    int32_t members[STRIPS_AT_ONCE] = {0};
    for (int32_t k = 0; k < STRIPS_AT_ONCE; k++)
        across[k] = binning_make(c->lo, c->hi);
    for (int32_t i = 0; i < count; i++) {
        int32_t k = region[slots[i]] - c->first;
        if (k < 0 || k >= STRIPS_AT_ONCE || region[slots[i]] >= c->strips)
            continue;
        across[k].end[bin_of(&across[k], along(bodies, slots[i], c->y))]++;
        members[k]++;
    }
    for (int32_t k = 0; k < STRIPS_AT_ONCE; k++)
        share_out(&across[k], members[k], c->pieces);
    for (int32_t i = 0; i < count; i++) {
        int32_t strip = region[slots[i]], k = strip - c->first;
        if (k >= 0 && k < STRIPS_AT_ONCE && strip < c->strips)
            region[slots[i]] =
                c->strips + strip * c->pieces + across[k].end[bin_of(&across[k], along(bodies, slots[i], c->y))];
    }
}

void bodies_partition(const body_table *bodies, const int32_t *slots, int32_t count, int32_t groups, int32_t *region,
                      int32_t *chunks)
{
    extent e = extent_of(bodies, slots, count);
    int32_t strips, pieces;
    choose_counts(&e, count, groups, &strips, &pieces);
    *chunks = strips * pieces;
    if (*chunks == 1) {
        for (int32_t i = 0; i < count; i++)
            region[slots[i]] = 0;
        return;
    }
    bool y = e.hi[1] - e.lo[1] > e.hi[0] - e.lo[0];
    binning bins = binning_make(e.lo[y], e.hi[y]);
    for (int32_t i = 0; i < count; i++)
        bins.end[bin_of(&bins, along(bodies, slots[i], y))]++;
    share_out(&bins, count, strips);
    for (int32_t i = 0; i < count; i++)
        region[slots[i]] = bins.end[bin_of(&bins, along(bodies, slots[i], y))];
    for (int32_t s = 0; s < strips; s += STRIPS_AT_ONCE)
        cut_strips(bodies, slots, count, region, &(cut){s, strips, pieces, !y, e.lo[!y], e.hi[!y]});
    for (int32_t i = 0; i < count; i++)
        region[slots[i]] -= strips;
}
