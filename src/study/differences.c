#include "study/differences.h"

#include "base/student.h"

#include <math.h>

/* ---- which ---- */

/* Number of keys in which two conditions differ, 2 for more; *key: the last of them. */
static int32_t keys_apart(const study *s, int32_t a, int32_t b, int32_t *key)
{
    int32_t n = 0;
    for (int32_t k = 0; k < s->keys.count && n < 2; k++) {
        if (study_values_same(study_value(s, a, k), study_value(s, b, k)))
            continue;
        n++;
        *key = k;
    }
    return n;
}

/* Whether each condition can be reached from each by pairs. */
static bool all_joined(const condition_pairs *pairs, int32_t conditions)
{
    int32_t group[COMPARED_ALL];
    for (int32_t c = 0; c < conditions; c++)
        group[c] = c;
    for (int32_t i = 0; i < pairs->count; i++) {
        int32_t from = group[pairs->data[i].condition], to = group[pairs->data[i].reference];
        for (int32_t c = 0; c < conditions; c++)
            group[c] = group[c] == from ? to : group[c];
    }
    for (int32_t c = 1; c < conditions; c++)
        if (group[c] != group[0])
            return false;
    return true;
}

static bool pair_all(context *ctx, const study *s, condition_pairs *out)
{
    array_clear(out);
    for (int32_t c = 1; c < s->conditions; c++)
        for (int32_t r = 0; r < c; r++) {
            int32_t key = -1, apart = keys_apart(s, c, r, &key);
            if (apart > 0 && !array_push(ctx, out, ((condition_pair){c, r, apart == 1 ? key : -1})))
                return false;
        }
    return true;
}

bool study_pairs(context *ctx, const study *s, condition_pairs *out)
{
    array_clear(out);
    if (s->design.kind != DESIGN_NONE || s->conditions > COMPARED_MOST)
        return true;
    for (int32_t c = 1; c < s->conditions; c++) {
        for (int32_t k = 0; k < s->keys.count; k++) {
            for (int32_t r = 0; r < c; r++) {
                int32_t key = -1;
                if (keys_apart(s, c, r, &key) != 1 || key != k)
                    continue;
                if (!array_push(ctx, out, ((condition_pair){c, r, k})))
                    return false;
                break;
            }
        }
    }
    return s->conditions > COMPARED_ALL || all_joined(out, s->conditions) || pair_all(ctx, s, out);
}

/* ---- how much ---- */

/* Mean and sum of squares about it, of what is a number (Welford 1962). */
typedef struct spread {
    double mean, square;
    int32_t count;
} spread;

static void spread_add(spread *s, double x)
{
    if (!isfinite(x))
        return;
    double before = x - s->mean;
    s->mean += before / ++s->count;
    s->square += before * (x - s->mean);
}

seed_interval difference_of_pairs(const double *a, const double *b, int32_t count, double confidence, int32_t *pairs)
{
    spread s = {0};
    for (int32_t i = 0; i < count; i++)
        spread_add(&s, a[i] - b[i]);
    *pairs = s.count;
    seed_interval out = {s.count > 0 ? s.mean : (double)NAN, (double)NAN};
    if (s.count > 1)
        out.half = student_half(confidence, s.count - 1, s.square / (s.count - 1) / s.count);
    return out;
}

seed_interval difference_of_means(const double *a, int32_t a_count, const double *b, int32_t b_count, double confidence,
                                  int32_t *freedom)
{
    spread x = {0}, y = {0};
    for (int32_t i = 0; i < a_count; i++)
        spread_add(&x, a[i]);
    for (int32_t i = 0; i < b_count; i++)
        spread_add(&y, b[i]);
    *freedom = 0;
    seed_interval out = {x.count > 0 && y.count > 0 ? x.mean - y.mean : (double)NAN, (double)NAN};
    if (x.count < 2 || y.count < 2)
        return out;
    double of_x = x.square / (x.count - 1) / x.count, of_y = y.square / (y.count - 1) / y.count, both = of_x + of_y;
    if (!isfinite(both))
        return out; /* of sums that overflow no share is a number */
    /* Samples without any scatter differ for certain. */
    *freedom = x.count + y.count - 2;
    if (both > 0) {
        /* By shares: squares of small variances vanish.  Whole degrees stay whole: 1/(1/93) is a hair below 93. */
        double share = of_x / both, rest = 1 - share;
        double degrees = 1 / (share * share / (x.count - 1) + rest * rest / (y.count - 1));
        *freedom = (int32_t)(degrees * (1 + 1e-12));
    }
    out.half = student_half(confidence, *freedom, both);
    return out;
}
