#include "sim/capability_growth.h"

#include "base/channel_statistics.h"
#include "base/transcendental.h"

/* As the header says. */
static const double COUNTS = 0.1;

load_halves load_halves_find(const double *time, const double *x, const double *y, int32_t count, double after)
{
    int32_t first = first_time_after(time, count, after), middle = (first + count) / 2;
    double mean[2][2] = {{0, 0}, {0, 0}};
    for (int32_t i = first; i < count; i++) {
        int32_t values = i >= middle ? count - middle : middle - first;
        mean[i >= middle][0] += x[i] / values;
        mean[i >= middle][1] += y[i] / values;
    }
    return (load_halves){sqrt(mean[0][0] * mean[0][0] + mean[0][1] * mean[0][1]),
                         sqrt(mean[1][0] * mean[1][0] + mean[1][1] * mean[1][1])};
}

/* How much larger the second half is: 1 where there is none, infinite where only the second has any. */
static double growth_of(load_halves h)
{
    if (h.first > 0)
        return h.second / h.first;
    return h.second > 0 ? HUGE_VAL : 1;
}

/* All runs at a speed. */
typedef struct speed_growth {
    load_halves all;   /* sums */
    double most, from; /* of the direction that grows most [rad] */
} speed_growth;

static speed_growth growth_at(const load_halves *half, int32_t directions, int32_t speeds, int32_t k)
{
    speed_growth g = {.all = {0, 0}};
    double largest = 0;
    for (int32_t i = 0; i < directions; i++) {
        load_halves one = half[i * speeds + k];
        g.all.first += one.first;
        g.all.second += one.second;
        largest = fmax(largest, one.first + one.second);
    }
    for (int32_t i = 0; i < directions; i++) {
        load_halves one = half[i * speeds + k];
        if (one.first + one.second < COUNTS * largest || !(growth_of(one) > g.most))
            continue;
        g.most = growth_of(one);
        g.from = 2 * PI * i / directions;
    }
    return g;
}

/* Of one direction chance alone makes halves differ; of all at a speed it does so less. */
void load_growth_find(const load_halves *half, int32_t directions, int32_t speeds, double speed_step,
                      capability_loads *l)
{
    double largest = 0;
    for (int32_t k = 0; k < speeds; k++) {
        const speed_growth g = growth_at(half, directions, speeds, k);
        largest = fmax(largest, g.all.first + g.all.second);
    }
    l->growth = 0;
    for (int32_t k = 0; k < speeds; k++) {
        const speed_growth g = growth_at(half, directions, speeds, k);
        if (!(growth_of(g.all) > l->growth) || g.all.first + g.all.second < COUNTS * largest)
            continue;
        l->growth = growth_of(g.all);
        l->growth_speed = (k + 1) * speed_step;
        l->growth_most = g.most;
        l->growth_from = g.from;
    }
}
