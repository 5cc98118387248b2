#include "base/channel_statistics.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static int falling(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

/* Mean of the highest third of the peaks; peaks are few enough for a fixed room: the smallest are dropped beyond it. */
enum { MOST_PEAKS = 8192 };

static void add_peak(double *peaks, int32_t *count, double peak)
{
    if (*count < MOST_PEAKS)
        peaks[(*count)++] = peak;
}

/* Upwards (side 1) or downwards (-1) of the mean; *found: how many. */
static double significant_peak(const double *value, int32_t first, int32_t count, double mean, double side,
                               int32_t *found)
{
    double peaks[MOST_PEAKS], peak = 0, sum = 0;
    bool beyond = false;
    *found = 0;
    for (int32_t i = first; i < count; i++) {
        if (side * value[i] > side * mean) {
            peak = beyond ? fmax(peak, side * value[i]) : side * value[i];
            beyond = true;
        } else if (beyond) {
            add_peak(peaks, found, peak);
            beyond = false;
        }
    }
    if (beyond)
        add_peak(peaks, found, peak);
    qsort(peaks, (size_t)*found, sizeof *peaks, falling);
    int32_t third = (*found + 2) / 3;
    for (int32_t i = 0; i < third; i++)
        sum += peaks[i] / third;
    return *found > 0 ? side * sum : 0;
}

channel_statistics channel_statistics_of(const double *time, const double *value, int32_t count, double transient)
{
    const double none = (double)NAN;
    int32_t first = 0, above;
    while (first < count && time[first] < transient)
        first++;
    if (first == count)
        return (channel_statistics){none, none, none, none, none, none, none, 0};
    channel_statistics s = {.least = value[first], .greatest = value[first]};
    for (int32_t i = first; i < count; i++) {
        s.mean += value[i] / (count - first);
        s.least = fmin(s.least, value[i]);
        s.greatest = fmax(s.greatest, value[i]);
    }
    double square = 0;
    for (int32_t i = first; i < count; i++)
        square += (value[i] - s.mean) * (value[i] - s.mean) / (count - first);
    s.deviation = sqrt(square);
    s.significant_above = significant_peak(value, first, count, s.mean, 1, &above);
    bool down = -s.least > s.greatest;
    s.peak = down ? s.least : s.greatest;
    s.peaks = above;
    s.significant = down ? significant_peak(value, first, count, s.mean, -1, &s.peaks) : s.significant_above;
    return s;
}
