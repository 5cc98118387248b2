#include "study/steadiness.h"

#include "base/student.h"

#include <math.h>

/* Means of shorter batches are not independent: batches of a sixteenth of a run, whatever its time scale, told a change
   in up to one of five AR(1) series (docs/extremes.md).  So many to a half at most of one part, and of all parts at
   least. */
#define SCALES_OF_HALF_BATCH 8.0
enum { HALF_BATCHES = 8, HALF_BATCHES_LEAST = 4 };
/* Of so many parts, which are independent, the differences of their halves tell, of whatever time scale. */
enum { PAIRS_LEAST = 8 };
#define CHANCE (1.0 / 700)

static double batch_mean(const double *value, int32_t count)
{
    double mean = 0;
    for (int32_t i = 0; i < count; i++)
        mean += value[i] / count;
    return mean;
}

/* ---- time scale without the change ---- */

/* Less its straight line: neither a step between halves nor a drift through them makes the time scale long. */
static void straighten(const double *value, int32_t count, double *out)
{
    double mean = batch_mean(value, count), slope = 0, square = 0, middle = 0.5 * (count - 1);
    for (int32_t i = 0; i < count; i++) {
        slope += (i - middle) * (value[i] - mean);
        square += (i - middle) * (i - middle);
    }
    slope = square > 0 ? slope / square : 0;
    for (int32_t i = 0; i < count; i++)
        out[i] = value[i] - mean - slope * (i - middle);
}

/* In values. */
static fram_status scale_of_halves(context *ctx, const series_set *s, double *scale, fram_error *error)
{
    int64_t values = 0;
    for (int32_t p = 0; p < s->count; p++)
        values += s->parts[p].count;
    series_part *parts = memory_array(ctx, (size_t)s->count, 2 * sizeof *parts);
    double *rest = memory_array(ctx, (size_t)values + 1, sizeof *rest), *at = rest;
    series_set halves = {.parts = parts, .step = 1};
    for (int32_t p = 0; p < s->count && parts && rest; p++) {
        int32_t count = s->parts[p].count / 2;
        for (int half = 0; half < 2 && count > 0; half++, at += count) {
            straighten(s->parts[p].value + half * count, count, at);
            parts[halves.count++] = (series_part){at, count};
        }
    }
    fram_status status = parts && rest ? FRAM_OK : error_memory(error);
    *scale = status == FRAM_OK && halves.count > 0 ? series_nature_of(&halves).time_scale : 1;
    memory_free(ctx, parts);
    memory_free(ctx, rest);
    return status;
}

/* ---- means ---- */

/* Mean of some numbers, and sum of squares about it. */
typedef struct number_sum {
    double mean, square;
    int32_t count;
} number_sum;

/* Welford (1962). */
static void sum_number(number_sum *s, double x)
{
    double before = x - s->mean;
    s->mean += before / ++s->count;
    s->square += before * (x - s->mean);
}

/* Of the differences of the halves of every part. */
static number_sum differences(const series_set *s)
{
    number_sum d = {0, 0, 0};
    for (int32_t p = 0; p < s->count; p++) {
        int32_t half = s->parts[p].count / 2;
        if (half > 0)
            sum_number(&d, batch_mean(s->parts[p].value + half, half) - batch_mean(s->parts[p].value, half));
    }
    return d;
}

/* Of the means of the batches of one half of every part. */
static number_sum means_of_half(const series_set *s, double scale, int half)
{
    number_sum h = {0, 0, 0};
    for (int32_t p = 0; p < s->count; p++) {
        double room = fmin(floor(0.5 * s->parts[p].count / (SCALES_OF_HALF_BATCH * scale)), HALF_BATCHES);
        /* A part that has no room for one is one: parts are independent. */
        int32_t batches = room < 1 ? 1 : (int32_t)room;
        int32_t length = s->parts[p].count / (2 * batches);
        for (int32_t b = half * batches; length > 0 && b < (half + 1) * batches; b++)
            sum_number(&h, batch_mean(s->parts[p].value + (int64_t)b * length, length));
    }
    return h;
}

/* By how many deviations by so many degrees of freedom, where that is more than chance has. */
static double beyond_chance(double difference, double variance, int freedom)
{
    double deviation = sqrt(variance);
    if (!(deviation > 0))
        return fabs(difference) > 0 ? HUGE_VAL : 0;
    return fabs(difference) > student_quantile(1 - CHANCE, freedom) * deviation ? fabs(difference) / deviation : 0;
}

fram_status halves_differ(context *ctx, const series_set *s, double *deviations, fram_error *error)
{
    const number_sum d = differences(s);
    double scale = 1;
    *deviations = d.count < PAIRS_LEAST ? 0 : beyond_chance(d.mean, d.square / (d.count - 1) / d.count, d.count - 1);
    if (d.count == 0 || d.count >= PAIRS_LEAST)
        return FRAM_OK;
    fram_status status = scale_of_halves(ctx, s, &scale, error);
    if (status != FRAM_OK)
        return status;
    const number_sum a = means_of_half(s, scale, 0), b = means_of_half(s, scale, 1);
    int freedom = a.count + b.count - 2;
    if (a.count >= HALF_BATCHES_LEAST)
        *deviations =
            beyond_chance(b.mean - a.mean, (a.square + b.square) / freedom * (1.0 / a.count + 1.0 / b.count), freedom);
    return FRAM_OK;
}
