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

static void find_peaks(const double *value, int32_t first, int32_t count, channel_statistics *s)
{
    double peaks[MOST_PEAKS], peak = 0;
    bool above = false;
    for (int32_t i = first; i < count; i++) {
        if (value[i] > s->mean) {
            peak = above ? fmax(peak, value[i]) : value[i];
            above = true;
        } else if (above) {
            add_peak(peaks, &s->peaks, peak);
            above = false;
        }
    }
    if (above)
        add_peak(peaks, &s->peaks, peak);
    if (s->peaks == 0)
        return;
    qsort(peaks, (size_t)s->peaks, sizeof *peaks, falling);
    int32_t third = (s->peaks + 2) / 3;
    for (int32_t i = 0; i < third; i++)
        s->significant += peaks[i] / third;
}

channel_statistics channel_statistics_of(const double *time, const double *value, int32_t count, double transient)
{
    channel_statistics s = {0};
    int32_t first = 0;
    while (first < count && time[first] < transient)
        first++;
    if (first == count)
        return s;
    s.least = s.greatest = value[first];
    for (int32_t i = first; i < count; i++) {
        s.mean += value[i] / (count - first);
        s.least = fmin(s.least, value[i]);
        s.greatest = fmax(s.greatest, value[i]);
    }
    double square = 0;
    for (int32_t i = first; i < count; i++)
        square += (value[i] - s.mean) * (value[i] - s.mean) / (count - first);
    s.deviation = sqrt(square);
    find_peaks(value, first, count, &s);
    return s;
}
