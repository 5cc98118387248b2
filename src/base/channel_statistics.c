#include "base/channel_statistics.h"

#include <math.h>
#include <stdlib.h>

/* Part of a time: more than the last of the 12 digits of a series, half of which is 5e-12 at most, and far less than a
   step also where times are seconds since 1970 (1.7e9). */
#define TIME_SLACK 1e-11

bool time_is_after(double time, double from) { return from == 0 ? time >= 0 : time - from > TIME_SLACK * fabs(time); }

int32_t first_time_after(const double *time, int32_t count, double from)
{
    int32_t first = 0;
    while (first < count && !time_is_after(time[first], from))
        first++;
    return first;
}

static int falling(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

/* One side of a channel's mean: values upwards (side 1) or downwards (-1) of it, those downwards with the other sign.
 */
typedef struct channel_side {
    const double *value;
    int32_t first, count;
    double mean, side;
} channel_side;

/* The outermost value of the next time beyond the mean, from *at on; false: there is none. */
static bool next_peak(const channel_side *c, int32_t *at, double *peak)
{
    bool beyond = false;
    for (; *at < c->count; (*at)++) {
        double value = c->side * c->value[*at];
        if (value > c->side * c->mean) {
            *peak = beyond ? fmax(*peak, value) : value;
            beyond = true;
        } else if (beyond) {
            return true;
        }
    }
    return beyond;
}

/* Peaks that are sorted at once: those of hours.  Of more, as of days, only those about the least of the highest third
   are, which takes a few looks at the channel more and no memory. */
enum { MOST_PEAKS = 8192 };

typedef struct peak_range {
    int32_t count;
    double least, greatest, sum;
} peak_range;

/* Those over lo and up to hi; the first MOST_PEAKS of them into peaks. */
static peak_range peaks_between(const channel_side *c, double lo, double hi, double *peaks)
{
    peak_range r = {.least = HUGE_VAL, .greatest = -HUGE_VAL};
    double peak = 0;
    for (int32_t at = c->first; next_peak(c, &at, &peak);) {
        if (!(peak > lo && peak <= hi))
            continue;
        if (r.count < MOST_PEAKS)
            peaks[r.count] = peak;
        r.count++;
        r.least = fmin(r.least, peak);
        r.greatest = fmax(r.greatest, peak);
        r.sum += peak;
    }
    return r;
}

/* Mean of the highest third of the peaks on a side; *found: how many peaks. */
static double significant_peak(const channel_side *c, int32_t *found)
{
    double peaks[MOST_PEAKS], lo = -HUGE_VAL, hi = HUGE_VAL, over = 0; /* over: the sum of those over hi */
    peak_range r = peaks_between(c, lo, hi, peaks);
    int32_t third = (r.count + 2) / 3, left = third;
    *found = r.count;
    if (third == 0)
        return 0;
    while (r.count > MOST_PEAKS && r.least < r.greatest) { /* the last of the highest third lies over lo, up to hi */
        double middle = 0.5 * r.least + 0.5 * r.greatest;
        if (!(middle < r.greatest))
            middle = r.least;
        peak_range upper = peaks_between(c, middle, hi, peaks);
        if (upper.count >= left) {
            lo = middle;
            r = upper;
        } else {
            left -= upper.count;
            over += upper.sum;
            hi = middle;
            r = peaks_between(c, lo, hi, peaks);
        }
    }
    if (r.count > MOST_PEAKS) /* all of one size */
        return c->side * (over + left * r.greatest) / third;
    qsort(peaks, (size_t)r.count, sizeof *peaks, falling);
    double mean = over / third;
    for (int32_t i = 0; i < left; i++)
        mean += peaks[i] / third;
    return c->side * mean;
}

channel_statistics channel_statistics_of(const double *time, const double *value, int32_t count, double transient)
{
    const double none = (double)NAN;
    int32_t first = first_time_after(time, count, transient), above;
    if (first == count)
        return (channel_statistics){none, none, none, none, none, none, none, 0};
    channel_statistics s = {.least = value[first], .greatest = value[first]};
    for (int32_t i = first; i < count; i++) {
        s.mean += value[i] / (count - first);
        s.least = fmin(s.least, value[i]);
        s.greatest = fmax(s.greatest, value[i]);
    }
    if (s.least == s.greatest && isfinite(s.mean)) /* of equal values a mean by a sum is a rounding off */
        s.mean = s.least;
    double square = 0;
    for (int32_t i = first; i < count; i++)
        square += (value[i] - s.mean) * (value[i] - s.mean) / (count - first);
    s.deviation = sqrt(square);
    const channel_side up = {value, first, count, s.mean, 1}, down = {value, first, count, s.mean, -1};
    s.significant_above = significant_peak(&up, &above);
    bool downwards = -s.least > s.greatest;
    s.peak = downwards ? s.least : s.greatest;
    s.peaks = above;
    s.significant = downwards ? significant_peak(&down, &s.peaks) : s.significant_above;
    if (s.least == s.greatest) /* no peaks: the value that is held */
        s.significant = s.significant_above = s.least;
    return s;
}

/* As the header says. */
enum { LAGS_ALL = 512 };

double correlation_integral(lag_covariance *covariance, const void *of, int32_t lags, bool sparse)
{
    double variance = covariance(of, 0), sum = 0.5;
    int32_t before = 1, next = 1;
    for (int32_t lag = 1; variance > 0 && lag < lags; lag += next) {
        double c = covariance(of, lag) / variance;
        if (!(c > 0))
            break;
        next = sparse ? 1 + lag / LAGS_ALL : 1;
        sum += 0.5 * (before + next) * c;
        before = next;
    }
    return sum;
}
