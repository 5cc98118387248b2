#include "study/series_set.h"

#include "base/channel_statistics.h"
#include "base/sort.h"

#include <math.h>

/* ---- nature ---- */

/* Pairs of values that a correlation is told from at each lag, about; and the longest lag, as a part of the values. */
enum { SCALE_PAIRS = 20000, LAG_PART = 4 };

typedef struct series_pairs {
    const series_set *s;
    double mean;
    int64_t stride; /* from where a pair begins to where the next one does: not that of lags, which are all looked at */
} series_pairs;

static double series_covariance(const void *of, int32_t lag)
{
    const series_pairs *pairs = of;
    double sum = 0;
    int64_t n = 0;
    for (int32_t p = 0; p < pairs->s->count; p++) {
        const series_part *part = &pairs->s->parts[p];
        for (int64_t i = 0; i + lag < part->count; i += pairs->stride, n++)
            sum += (part->value[i] - pairs->mean) * (part->value[i + lag] - pairs->mean);
    }
    return n > 0 ? sum / (double)n : 0;
}

static double time_scale(const series_set *s, const series_nature *n)
{
    const series_pairs pairs = {s, n->mean, (n->values - 1) / SCALE_PAIRS + 1};
    int32_t lags = (int32_t)(n->values / s->count / LAG_PART);
    return fmax(correlation_integral(series_covariance, &pairs, lags, pairs.stride > 1), 1) * s->step;
}

series_nature series_nature_of(const series_set *s)
{
    series_nature n = {.least = (double)INFINITY, .greatest = -(double)INFINITY};
    double sum = 0, square = 0;
    for (int32_t p = 0; p < s->count; p++) {
        for (int32_t i = 0; i < s->parts[p].count; i++) {
            double x = s->parts[p].value[i];
            sum += x;
            n.least = fmin(n.least, x);
            n.greatest = fmax(n.greatest, x);
        }
        n.values += s->parts[p].count;
    }
    if (n.values == 0)
        return n;
    if (!(n.least < n.greatest)) { /* of equal values a mean by a sum is off by rounding, and that would have a scale */
        n.mean = n.least;
        n.time_scale = s->step;
        return n;
    }
    n.mean = sum / (double)n.values;
    for (int32_t p = 0; p < s->count; p++)
        for (int32_t i = 0; i < s->parts[p].count; i++)
            square += (s->parts[p].value[i] - n.mean) * (s->parts[p].value[i] - n.mean);
    n.deviation = sqrt(square / (double)n.values);
    n.time_scale = time_scale(s, &n);
    return n;
}

/* ---- maxima ---- */

int64_t series_values_over(const series_set *s, double level)
{
    int64_t over = 0;
    for (int32_t p = 0; p < s->count; p++)
        for (int32_t i = 0; i < s->parts[p].count; i++)
            over += s->parts[p].value[i] > level;
    return over;
}

bool block_maxima(context *ctx, const series_set *s, int32_t length, double_array *out)
{
    array_clear(out);
    for (int32_t p = 0; p < s->count; p++) {
        const series_part *part = &s->parts[p];
        for (int64_t from = 0; from + length <= part->count; from += length) {
            double greatest = part->value[from];
            for (int64_t i = from + 1; i < from + length; i++)
                greatest = fmax(greatest, part->value[i]);
            if (!array_push(ctx, out, greatest))
                return false;
        }
    }
    return true;
}

bool cluster_peaks(context *ctx, const series_set *s, double threshold, int32_t apart, double_array *out)
{
    array_clear(out);
    for (int32_t p = 0; p < s->count; p++) {
        const series_part *part = &s->parts[p];
        bool inside = false;
        int32_t below = 0;
        for (int32_t i = 0; i < part->count; i++) {
            double x = part->value[i];
            if (!(x > threshold)) {
                inside = inside && ++below < apart;
                continue;
            }
            below = 0;
            if (inside)
                out->data[out->count - 1] = fmax(out->data[out->count - 1], x);
            else if (!array_push(ctx, out, x))
                return false;
            inside = true;
        }
    }
    return true;
}

void values_sort(double_array *a) { numbers_sort(a->data, a->count); }

double sorted_quantile(const double *sorted, int32_t count, double p)
{
    double at = p * (count - 1);
    int32_t i = (int32_t)floor(at);
    if (i + 1 >= count)
        return sorted[count - 1];
    return sorted[i] + (at - i) * (sorted[i + 1] - sorted[i]);
}
