#include "study/seeds.h"

#include "base/student.h"
#include "study/extremes.h"

#include <math.h>

seed_interval seed_interval_of(const double *value, int32_t count, double confidence)
{
    double sum = 0, square = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < count; i++) {
        if (isnan(value[i]))
            continue;
        sum += value[i];
        n++;
    }
    seed_interval out = {n > 0 ? sum / n : (double)NAN, (double)NAN};
    if (n < 2)
        return out;
    for (int32_t i = 0; i < count; i++)
        square += isnan(value[i]) ? 0 : (value[i] - out.mean) * (value[i] - out.mean);
    out.half = student_half(confidence, n - 1, square / (n - 1) / n);
    return out;
}

static bool is_narrow(const double *value, int32_t count, double within, double confidence)
{
    seed_interval i = seed_interval_of(value, count, confidence);
    return !(within > 0) || i.half <= within * fabs(i.mean);
}

seeds_extreme seeds_extreme_of(context *ctx, const study *s, double block)
{
    return (seeds_extreme){ctx, s->extremes.duration / block, s->extremes.confidence, s->extremes.gev};
}

/* Half the interval of the most probable largest value, of runs that ended well; equal ones leave nothing to ask. */
static bool is_known(const double *largest, int32_t count, double within, const seeds_extreme *rare)
{
    if (!(within > 0) || !rare)
        return true;
    double_array value = {0};
    extreme_result r = {.answered = false};
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = rare->times;
    ask.confidence = rare->confidence;
    ask.levels = 0;
    bool good = true, differ = false;
    for (int32_t i = 0; i < count && good; i++)
        if (!isnan(largest[i])) {
            good = array_push(rare->ctx, &value, largest[i]);
            differ = differ || largest[i] != value.data[0];
        }
    good = good && (!differ || extremes_of_maxima(rare->ctx, value.data, value.count, 1,
                                                  rare->gev ? EXTREME_GEV : EXTREME_GUMBEL, &ask, &r, NULL) == FRAM_OK);
    array_free(rare->ctx, &value);
    double half = 0.5 * (r.most_probable.high - r.most_probable.low);
    return good && (!differ || (r.answered && half <= within * fabs(r.most_probable.level)));
}

/* Two runs or more, and all of them failed: more would tell no more. */
static bool has_none(const double *value, int32_t count)
{
    bool none = count > 1;
    for (int32_t i = 0; i < count; i++)
        none = none && isnan(value[i]);
    return none;
}

int32_t seeds_wanted(const study_seeds *rule, const double *mean, const double *largest, const seeds_extreme *rare,
                     int32_t count)
{
    int32_t n = rule->least;
    while (n <= count && n < rule->most) {
        if (has_none(mean, n) || (is_narrow(mean, n, rule->mean_within, rule->confidence) &&
                                  is_narrow(largest, n, rule->largest_within, rule->confidence) &&
                                  is_known(largest, n, rule->extreme_within, rare)))
            break;
        int32_t batch = n / 4 > 1 ? n / 4 : 1;
        n = n + batch < rule->most ? n + batch : rule->most;
    }
    return n;
}
