#include "study/extremes_spread.h"

#include "base/student.h"
#include "base/transcendental.h"
#include "study/special.h"

#include <math.h>

/* Time scales of a group at least. */
#define SCALES_OF_GROUP 20
/* The least that a jackknife makes of the variance of independent peaks.  Such peaks come under it once in 2,700 times
   by ten groups, never by forty; groups that are alike, as of a load that repeats itself, would leave no interval. */
#define SPREAD_LEAST 0.1

/* The series without its values from `from` up to `to`, counted over all parts; room for one part more than it has. */
static int32_t without(const series_set *s, int64_t from, int64_t to, series_part *out)
{
    int32_t count = 0;
    int64_t first = 0;
    for (int32_t p = 0; p < s->count; p++) {
        const series_part *part = &s->parts[p];
        int64_t a = from - first, b = to - first, n = part->count;
        if (a > 0)
            out[count++] = (series_part){part->value, (int32_t)(a < n ? a : n)};
        if (b < n && b > 0)
            out[count++] = (series_part){part->value + b, (int32_t)(n - b)};
        else if (b <= 0)
            out[count++] = *part;
        first += n;
    }
    return count;
}

static double mean_of(const series_set *s, int64_t *values)
{
    double sum = 0;
    *values = 0;
    for (int32_t p = 0; p < s->count; p++) {
        for (int32_t i = 0; i < s->parts[p].count; i++)
            sum += s->parts[p].value[i];
        *values += s->parts[p].count;
    }
    return *values > 0 ? sum / (double)*values : 0;
}

/* Fit to what is left, one group more where there is a law of it; false: no memory. */
static bool add_group(context *ctx, const series_set *left, double duration, double_array *peaks,
                      weibull_jackknife *out)
{
    int64_t values;
    double mean = mean_of(left, &values);
    if (!cluster_peaks(ctx, left, mean, 1, peaks))
        return false;
    values_sort(peaks);
    extreme_law *law = &out->law[out->groups];
    if (!extreme_law_fit(LAW_WEIBULL, FIT_LIKELIHOOD, peaks->data, peaks->count, mean, law))
        return true;
    out->peaks[out->groups++] = peaks->count * duration / ((double)values * left->step);
    return true;
}

fram_status jackknife_weibull(context *ctx, const series_set *s, const series_nature *nature, double duration,
                              weibull_jackknife *out, fram_error *error)
{
    double scales = (double)nature->values * s->step / nature->time_scale / SCALES_OF_GROUP;
    int groups = scales < JACKKNIFE_GROUPS ? (int)scales : JACKKNIFE_GROUPS;
    out->groups = 0;
    if (groups < JACKKNIFE_LEAST)
        return FRAM_OK;
    series_part *parts = memory_array(ctx, (size_t)s->count + 1, sizeof *parts);
    double_array peaks = {0};
    fram_status status = parts ? FRAM_OK : error_memory(error);
    for (int g = 0; g < groups && status == FRAM_OK && out->groups == g; g++) {
        int32_t count = without(s, nature->values * g / groups, nature->values * (g + 1) / groups, parts);
        const series_set left = {parts, count, s->step};
        if (!add_group(ctx, &left, duration, &peaks, out))
            status = error_memory(error);
        else
            status = work_continue(ctx, "leaving out groups", g + 1, groups, error);
    }
    /* Groups without which there is no law are those that hold many of few peaks, by which the law goes. */
    if (out->groups < groups)
        out->groups = 0;
    array_free(ctx, &peaks);
    memory_free(ctx, parts);
    return status;
}

/* Variance of the level, of independent peaks over a known location: by the inverse of Fisher's information of
   Weibull's law (Johnson, Kotz and Balakrishnan 1994, 21.4). */
static double fitted_variance(const extreme_law *law, int32_t count, double rare)
{
    double k = law->shape, by_scale = real_pow(rare, 1 / k),
           by_shape = -law->scale * by_scale * real_log(rare) / (k * k);
    double g = 1 - EULER_GAMMA, unit = 6 / (PI * PI) / count;
    double scales = (PI * PI / 6 + g * g) * unit * law->scale * law->scale / (k * k), shapes = unit * k * k,
           both = g * unit * law->scale;
    return by_scale * by_scale * scales + 2 * by_scale * by_shape * both + by_shape * by_shape * shapes;
}

double jackknife_bound(const weibull_jackknife *j, const extreme_law *law, int32_t count, double exponent,
                       double confidence)
{
    double mean = 0, square = 0, rare = 0;
    if (j->groups < JACKKNIFE_LEAST)
        return (double)NAN;
    for (int g = 0; g < j->groups; g++) {
        /* Welford (1962). */
        double log_rare = real_log(fmax(j->peaks[g] / exponent, 1));
        double level = extreme_law_level(&j->law[g], log_rare), before = level - mean;
        mean += before / (g + 1);
        square += before * (level - mean);
        rare += log_rare / j->groups;
    }
    double spread = square * (j->groups - 1) / j->groups / fitted_variance(law, count, fmax(rare, 1e-3));
    return student_quantile(confidence, j->groups - 1) * sqrt(fmax(spread, SPREAD_LEAST));
}

/* Way from the location to the level of the fit, in scales. */
static double fitted_way(const extreme_law *law, double rare)
{
    return fabs(law->shape) < 1e-9 ? rare : (real_exp(law->shape * rare) - 1) / law->shape;
}

/* Where along h = -log survival, from the location on, a fit finds its shape.  Of maxima: where the likelihood of
   Gumbel's law weighs a shape that changes slowly (x = g + shape'(h) g^3/6, of the reduced variate g, by Fisher's
   information of 1, g and g^2/2).  Of peaks: the mean of the exponential law; the likelihood weighs them at 2, and
   intervals of samples of some hundred peaks would then hold less than they say (docs/decisions/0311). */
#define MAXIMA_SHAPE_PLACE 1.1312120
#define PEAKS_SHAPE_PLACE 1

double penultimate_level(const extreme_law *law, double survival, double rare)
{
    double begin = -real_log(survival), shape = law->shape;
    if (!(survival > 0 && survival < 1 && begin > 0 && rare > 0))
        return law->location + law->scale * fitted_way(law, rare);
    /* shape(h) = power/h, h = -log survival, is that of the fit at the h by which the fit tells it. */
    double place = law->kind == LAW_GEV ? MAXIMA_SHAPE_PLACE : PEAKS_SHAPE_PLACE;
    double power = shape * (begin + place), end = begin + rare, exact;
    if (fabs(power + 1) < 1e-9)
        exact = begin * real_log(end / begin);
    else
        exact = begin / (power + 1) * (real_pow(end / begin, power + 1) - 1);
    return law->location + law->scale * exact;
}

double penultimate_shift(const extreme_law *law, double survival, double rare)
{
    return penultimate_level(law, survival, rare) - law->location - law->scale * fitted_way(law, rare);
}
