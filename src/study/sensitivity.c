#include "study/sensitivity.h"

#include "base/random.h"
#include "study/series_set.h"

#include <math.h>
#include <string.h>

/* Streams of random numbers of this file. */
enum { STREAM_OWN_STRATA = 911, STREAM_OWN_PLACES, STREAM_PATHS, STREAM_ROWS };
enum { REPLICATES = 499 };

/* ---- points ---- */

bool sobol_points(context *ctx, int32_t n, int32_t k, int64_t seed, double *x)
{
    int32_t *stratum = memory_array(ctx, (size_t)n, sizeof *stratum);
    if (!stratum)
        return false;
    for (int32_t column = 0; column < 2 * k; column++) {
        random_stream strata = random_begin((uint64_t)seed, STREAM_OWN_STRATA, (uint32_t)column);
        random_stream places = random_begin((uint64_t)seed, STREAM_OWN_PLACES, (uint32_t)column);
        random_order(&strata, stratum, n);
        double *first = x + (column < k ? column : (int64_t)n * k + column - k);
        for (int32_t i = 0; i < n; i++)
            first[(int64_t)i * k] = (stratum[i] + random_unit(&places)) / n;
    }
    memory_free(ctx, stratum);
    const double *a = x, *b = x + (int64_t)n * k;
    for (int32_t c = 0; c < k; c++) {
        double *mixed = x + (int64_t)(c + 2) * n * k;
        memcpy(mixed, a, (size_t)n * (size_t)k * sizeof *mixed);
        for (int32_t i = 0; i < n; i++)
            mixed[(int64_t)i * k + c] = b[(int64_t)i * k + c];
    }
    return true;
}

void morris_points(int32_t r, int32_t k, int32_t levels, int64_t seed, double *x)
{
    /* Morris's step, by which every level is met as often as any other. */
    double step = levels / (2.0 * (levels - 1));
    for (int32_t path = 0; path < r; path++) {
        random_stream random = random_begin((uint64_t)seed, STREAM_PATHS, (uint32_t)path);
        int32_t order[SENSITIVITY_KEYS_MOST];
        double *point = x + (int64_t)path * (k + 1) * k;
        random_order(&random, order, k);
        for (int32_t i = 0; i < k; i++)
            point[i] = floor(random_unit(&random) * levels) / (levels - 1);
        for (int32_t s = 0; s < k; s++, point += k) {
            memcpy(point + k, point, (size_t)k * sizeof *point);
            double at = point[order[s]];
            /* The way that stays inside; where both do not exist there is one. */
            point[k + order[s]] = at + step <= 1 + 1e-9 ? at + step : at - step;
        }
    }
}

/* ---- Sobol's indices ---- */

typedef struct sobol_rows {
    const double *answer;
    const int32_t *row;
    int32_t n, k, count; /* n: rows of the design; count: of `row` */
} sobol_rows;

static double at(const sobol_rows *s, int32_t block, int32_t i) { return s->answer[(int64_t)block * s->n + s->row[i]]; }

/* Mean and variance of the answers of A and B. */
static double variance_of(const sobol_rows *s, double *mean)
{
    double sum = 0, square = 0;
    for (int32_t i = 0; i < s->count; i++)
        sum += at(s, 0, i) + at(s, 1, i);
    *mean = sum / (2.0 * s->count);
    for (int32_t i = 0; i < s->count; i++)
        for (int32_t block = 0; block < 2; block++)
            square += (at(s, block, i) - *mean) * (at(s, block, i) - *mean);
    return square / (2.0 * s->count - 1);
}

static void estimate(const sobol_rows *s, int32_t key, double *first, double *total)
{
    double mean = 0, variance = variance_of(s, &mean), v = 0, e = 0;
    for (int32_t i = 0; i < s->count; i++) {
        double a = at(s, 0, i), b = at(s, 1, i), mixed = at(s, key + 2, i);
        v += (b - mean) * (mixed - a) / s->count;
        e += 0.5 * (a - mixed) * (a - mixed) / s->count;
    }
    *first = v / variance;
    *total = e / variance;
}

/* Whether any two answers of A and B differ: a variance that is computed of equal ones need not be 0. */
static bool varies(const sobol_rows *s)
{
    for (int32_t i = 0; i < s->count; i++)
        if (at(s, 0, i) != at(s, 0, 0) || at(s, 1, i) != at(s, 0, 0))
            return true;
    return false;
}

/* Of the draws that have indices, if most do. */
static void percentiles(double_array *a, double *low, double *high)
{
    int32_t n = 0;
    for (int32_t i = 0; i < a->count; i++)
        if (isfinite(a->data[i]))
            a->data[n++] = a->data[i];
    *low = *high = (double)NAN;
    if (2 * n <= a->count)
        return;
    a->count = n;
    values_sort(a);
    *low = sorted_quantile(a->data, a->count, 0.025);
    *high = sorted_quantile(a->data, a->count, 0.975);
}

static bool bootstrap_index(context *ctx, const sobol_rows *s, int32_t key, sobol_index *out)
{
    double_array first = {0}, total = {0};
    int32_array row = {0};
    bool good = array_resize(ctx, &row, s->count) && array_resize(ctx, &first, REPLICATES) &&
                array_resize(ctx, &total, REPLICATES);
    for (uint32_t b = 0; good && b < REPLICATES; b++) {
        random_stream random = random_begin(1, STREAM_ROWS, b);
        for (int32_t i = 0; i < s->count; i++)
            row.data[i] = s->row[(int32_t)(random_unit(&random) * s->count)];
        const sobol_rows drawn = {s->answer, row.data, s->n, s->k, s->count};
        first.data[b] = total.data[b] = (double)NAN;
        if (varies(&drawn))
            estimate(&drawn, key, &first.data[b], &total.data[b]);
    }
    if (good) {
        percentiles(&first, &out->first_low, &out->first_high);
        percentiles(&total, &out->total_low, &out->total_high);
    }
    array_free(ctx, &first);
    array_free(ctx, &total);
    array_free(ctx, &row);
    return good;
}

static bool row_is_whole(const double *answer, int32_t n, int32_t k, int32_t row)
{
    for (int32_t block = 0; block < k + 2; block++)
        if (!isfinite(answer[(int64_t)block * n + row]))
            return false;
    return true;
}

int32_t sobol_indices(context *ctx, const double *answer, int32_t n, int32_t k, sobol_index *out)
{
    double none = (double)NAN;
    int32_array row = {0};
    bool good = true;
    for (int32_t i = 0; i < n && good; i++)
        good = !row_is_whole(answer, n, k, i) || array_push(ctx, &row, i);
    const sobol_rows s = {answer, row.data, n, k, row.count};
    bool carries = row.count >= SOBOL_ROWS_LEAST && varies(&s);
    for (int32_t key = 0; key < k && good; key++) {
        out[key] = (sobol_index){none, none, none, none, none, none};
        if (!carries)
            continue;
        estimate(&s, key, &out[key].first, &out[key].total);
        good = bootstrap_index(ctx, &s, key, &out[key]);
    }
    int32_t count = row.count;
    array_free(ctx, &row);
    return good ? count : -1;
}

/* ---- Morris's effects ---- */

void morris_effects(const double *answer, const double *x, int32_t r, int32_t k, morris_effect *out)
{
    double square[SENSITIVITY_KEYS_MOST] = {0};
    memset(out, 0, (size_t)k * sizeof *out);
    for (int32_t path = 0; path < r; path++) {
        for (int32_t s = 0; s < k; s++) {
            int64_t from = (int64_t)path * (k + 1) + s;
            const double *a = x + from * k, *b = a + k;
            int32_t key = 0;
            while (key < k - 1 && a[key] == b[key])
                key++;
            double effect = (answer[from + 1] - answer[from]) / (b[key] - a[key]);
            if (!isfinite(effect))
                continue;
            /* Welford (1962). */
            double before = effect - out[key].mu;
            out[key].mu += before / ++out[key].count;
            square[key] += before * (effect - out[key].mu);
            out[key].mu_star += fabs(effect);
        }
    }
    for (int32_t key = 0; key < k; key++) {
        morris_effect *e = &out[key];
        e->mu_star = e->count > 0 ? e->mu_star / e->count : (double)NAN;
        e->mu = e->count > 0 ? e->mu : (double)NAN;
        e->sigma = e->count > 1 ? sqrt(square[key] / (e->count - 1)) : (double)NAN;
    }
}
