#include "results/load_statistics.h"

#include "base/channel_statistics.h"
#include "base/sort.h"
#include "io/chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* LOAD_PAIRS: pairs of values that a correlation is told from at each lag, about. */
enum { LEVELS = 120, BARS = 30, LOAD_PAIRS = 20000 };

typedef struct load_pairs {
    const double *value;
    int32_t count, stride; /* of values; from where a pair begins to where the next one does */
    double mean;
} load_pairs;

static double load_covariance(const void *of, int32_t lag)
{
    const load_pairs *p = of;
    int32_t n = (p->count - 1) / p->stride + 1;
    double sum = 0;
    for (int64_t i = 0; i + lag < p->count; i += p->stride)
        sum += (p->value[i] - p->mean) * (p->value[i + lag] - p->mean) / n;
    return sum;
}

static double integral_time_scale(const double *value, int32_t count, double step)
{
    load_pairs pairs = {value, count, (count - 1) / LOAD_PAIRS + 1, 0};
    for (int32_t i = 0; i < count; i++)
        pairs.mean += value[i] / count;
    return correlation_integral(load_covariance, &pairs, count, pairs.stride > 1) * step;
}

static bool add_level(context *ctx, load_distribution *d, double level, double part)
{
    double n = d->independent, z2 = NORMAL_95 * NORMAL_95, centre = (part + z2 / (2 * n)) / (1 + z2 / n);
    double half = NORMAL_95 / (1 + z2 / n) * sqrt(part * (1 - part) / n + z2 / (4 * n * n));
    return array_push(ctx, &d->level, level) && array_push(ctx, &d->exceeded, part) &&
           array_push(ctx, &d->low, fmax(0, centre - half)) && array_push(ctx, &d->high, fmin(1, centre + half));
}

static bool find_exceedance(context *ctx, const double *sorted, int32_t count, load_distribution *d)
{
    double least = sorted[0], greatest = sorted[count - 1];
    int32_t below = 0;
    for (int i = 0; i < LEVELS; i++) {
        double level = least + (greatest - least) * i / (LEVELS - 1);
        while (below < count && sorted[below] <= level)
            below++;
        if (!add_level(ctx, d, level, (double)(count - below) / count))
            return false;
    }
    return true;
}

static bool find_histogram(context *ctx, const double *sorted, int32_t count, load_distribution *d)
{
    double least = sorted[0], width = (sorted[count - 1] - least) / BARS;
    if (!(width > 0))
        width = fmax(fabs(least), 1) / BARS;
    int32_t at = 0;
    for (int i = 0; i <= BARS; i++) {
        int32_t from = at;
        while (at < count && i < BARS && (sorted[at] < least + (i + 1) * width || i == BARS - 1))
            at++;
        if (!array_push(ctx, &d->bar, least + i * width) || !array_push(ctx, &d->density, (double)(at - from) / count))
            return false;
    }
    return true;
}

bool load_distribution_of(context *ctx, const double *value, int32_t count, double step, double window,
                          load_distribution *out)
{
    *out = (load_distribution){.independent = 1};
    if (count < 1)
        return true;
    out->time_scale = fmax(integral_time_scale(value, count, step), 0.5 * window);
    out->independent = fmax(1, count * step / (2 * out->time_scale));
    double *sorted = memory_array(ctx, (size_t)count, sizeof *sorted);
    if (!sorted)
        return false;
    memcpy(sorted, value, (size_t)count * sizeof *sorted);
    numbers_sort(sorted, count);
    bool good = find_exceedance(ctx, sorted, count, out) && find_histogram(ctx, sorted, count, out);
    memory_free(ctx, sorted);
    return good;
}

void load_distribution_tell(const load_distribution *d, bool with_distance, char out[LOAD_WORTH_SIZE])
{
    int n = snprintf(out, LOAD_WORTH_SIZE, "%.0f independent value%s", d->independent, d->independent < 1.5 ? "" : "s");
    if (with_distance && d->independent > 1)
        snprintf(out + n, LOAD_WORTH_SIZE - (size_t)n, ", one every %.3g s", 2 * d->time_scale);
}

void load_distribution_free(context *ctx, load_distribution *d)
{
    array_free(ctx, &d->level);
    array_free(ctx, &d->exceeded);
    array_free(ctx, &d->low);
    array_free(ctx, &d->high);
    array_free(ctx, &d->bar);
    array_free(ctx, &d->density);
}

static void load_range(const double *value, int32_t count, double *low, double *high)
{
    for (int32_t i = 0; i < count; i++)
        if (isfinite(value[i])) {
            *low = fmin(*low, value[i]);
            *high = fmax(*high, value[i]);
        }
}

double load_spikes_cut(double *raw, const double *const *averaged, int32_t lines, int32_t count, load_cut *cut,
                       double axis[2])
{
    double low = 0, high = 0, least = 0, greatest = 0;
    for (int32_t k = 0; k < lines; k++)
        load_range(averaged[k], count, &low, &high);
    load_range(raw, count, &least, &greatest);
    double margin = 0.1 * (high - low), from = low - margin, to = high + margin;
    /* The axis of what is drawn then. */
    double bottom = fmin(low, fmax(least, from)), top = fmax(high, fmin(greatest, to));
    double pad = CHART_PAD * (top - bottom), largest = -least >= greatest ? least : greatest;
    bottom -= bottom < 0 ? pad : 0;
    top += top > 0 ? pad : 0;
    *cut = LOAD_CUT_NONE;
    axis[0] = axis[1] = 0;
    if (!(high > low) || (least >= bottom && greatest <= top))
        return largest;
    *cut = largest < bottom || largest > top ? LOAD_CUT_LARGEST : LOAD_CUT_SOME;
    for (int32_t i = 0; i < count; i++)
        if (isfinite(raw[i]))
            raw[i] = fmin(fmax(raw[i], bottom - pad), top + pad);
    axis[0] = bottom, axis[1] = top;
    return largest;
}
