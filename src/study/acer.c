#include "study/acer.h"

#include "base/channel_statistics.h"
#include "base/near.h"
#include "base/random.h"
#include "base/transcendental.h"
#include "study/minimise.h"

#include <math.h>
#include <string.h>

/* Stream of random numbers of this file: draws of batches. */
enum { STREAM_BATCHES = 903 };
/* Levels that a fit takes at least. */
enum { LEVELS_LEAST = 5 };
/* Powers that the law may have: below the tail is heavier, above it is lighter than of anything that was seen. */
#define POWER_LEAST 0.5
#define POWER_MOST 5.0
/* A fit this near to one of them would have gone on beyond it. */
#define POWER_NEAR_LEAST 0.05
#define POWER_NEAR_MOST 0.1
/* The law's origin lies below the first level by the exponential of this, in widths of the levels. */
#define PLACE_LEAST (-5.0)
#define PLACE_MOST 2.5
/* Logarithms of rates that fall by less from the first level to the last are equal, but for rounding. */
#define FALL_LEAST 1e-9

/* ---- counting ---- */

/* Greatest of the k - 1 values before each, by a queue of candidates that fall. */
typedef struct window {
    int32_t *index; /* ring of k places */
    int32_t room, first, count;
} window;

static void window_drop(window *w, int32_t oldest)
{
    while (w->count > 0 && w->index[w->first] < oldest) {
        w->first = (w->first + 1) % w->room;
        w->count--;
    }
}

static void window_add(window *w, const double *value, int32_t i)
{
    while (w->count > 0 && value[w->index[(w->first + w->count - 1) % w->room]] <= value[i])
        w->count--;
    w->index[(w->first + w->count) % w->room] = i;
    w->count++;
}

/* Number of levels that are below x. */
static int32_t levels_below(const acer_rates *r, double x)
{
    int32_t lo = 0, hi = r->levels;
    while (lo < hi) {
        int32_t mid = (lo + hi) / 2;
        if (r->level[mid] < x)
            lo = mid + 1;
        else
            hi = mid;
    }
    return lo;
}

/* Batches of a part, of nearly equal length and of `batch` values at least; a shorter part, which is independent of the
   others, is one of its own. */
static int32_t batches_of(const series_part *part, int32_t batch)
{
    return part->count < batch ? part->count > 0 : part->count / batch;
}

/* The value is over levels [from, to) and the greatest before it is not. */
static void count_part(acer_rates *r, const series_part *part, int32_t k, int32_t batch, window *w, int32_t *next)
{
    w->first = w->count = 0;
    int32_t batches = batches_of(part, batch);
    for (int32_t i = 0; i < part->count; i++) {
        int32_t b = *next + (int32_t)((int64_t)i * batches / part->count);
        int32_t *count = r->count.data + (int64_t)b * ACER_LEVELS;
        int32_t to = levels_below(r, part->value[i]), from = 0;
        window_drop(w, i - (k - 1));
        if (w->count > 0)
            from = levels_below(r, part->value[w->index[w->first]]);
        /* A level at the very greatest of those before is not below it. */
        for (int32_t l = from; l < to && i >= k - 1; l++)
            count[l]++;
        r->values.data[b] += i >= k - 1;
        if (k > 1)
            window_add(w, part->value, i);
    }
    *next += batches;
}

/* Parts shorter than k have no values: such batches tell nothing, and stand for no realization. */
static void drop_empty(acer_rates *r)
{
    int32_t kept = 0;
    for (int32_t b = 0; b < r->batches; b++) {
        if (r->values.data[b] == 0)
            continue;
        r->values.data[kept] = r->values.data[b];
        memmove(r->count.data + (int64_t)kept++ * ACER_LEVELS, r->count.data + (int64_t)b * ACER_LEVELS,
                ACER_LEVELS * sizeof *r->count.data);
    }
    r->batches = kept;
}

bool acer_count(context *ctx, const series_set *s, int32_t k, double tail, int32_t batch, acer_rates *out)
{
    *out = (acer_rates){.step = s->step, .levels = ACER_LEVELS, .full = batch >= k ? batch - k + 1 : 1};
    double greatest = -(double)INFINITY;
    int64_t batches = 0;
    for (int32_t p = 0; p < s->count; p++) {
        for (int32_t i = 0; i < s->parts[p].count; i++)
            greatest = fmax(greatest, s->parts[p].value[i]);
        batches += batches_of(&s->parts[p], batch);
    }
    if (!(greatest > tail))
        out->levels = 0;
    for (int32_t l = 0; l < out->levels; l++)
        out->level[l] = tail + (greatest - tail) * l / ACER_LEVELS;
    window w = {memory_array(ctx, (size_t)k, sizeof *w.index), k, 0, 0};
    out->batches = (int32_t)batches;
    bool good = w.index && batches < INT32_MAX / ACER_LEVELS &&
                array_resize(ctx, &out->count, (int32_t)batches * ACER_LEVELS) &&
                array_resize(ctx, &out->values, (int32_t)batches);
    if (good && batches > 0) {
        memset(out->count.data, 0, (size_t)out->count.count * sizeof *out->count.data);
        memset(out->values.data, 0, (size_t)out->values.count * sizeof *out->values.data);
    }
    int32_t next = 0;
    for (int32_t p = 0; good && p < s->count; p++)
        count_part(out, &s->parts[p], k, batch, &w, &next);
    memory_free(ctx, w.index);
    if (good)
        drop_empty(out);
    else
        acer_free(ctx, out);
    return good;
}

void acer_free(context *ctx, acer_rates *r)
{
    array_free(ctx, &r->count);
    array_free(ctx, &r->values);
}

int64_t acer_exceedances(const acer_rates *r, int32_t level)
{
    int64_t sum = 0;
    for (int32_t b = 0; b < r->batches; b++)
        sum += r->count.data[(int64_t)b * ACER_LEVELS + level];
    return sum;
}

int64_t acer_values(const acer_rates *r)
{
    int64_t sum = 0;
    for (int32_t b = 0; b < r->batches; b++)
        sum += r->values.data[b];
    return sum;
}

double acer_effective_batches(const acer_rates *r)
{
    double sum = 0, squares = 0;
    for (int32_t b = 0; b < r->batches; b++) {
        double n = fmin(r->full, (double)r->values.data[b]);
        sum += n;
        squares += n * n;
    }
    return squares > 0 ? sum * sum / squares : 0;
}

/* ---- the law of the tail ---- */

/* Logarithms of rates and their weights. */
typedef struct tail_points {
    double level[ACER_LEVELS], log_rate[ACER_LEVELS], weight[ACER_LEVELS];
    int32_t count;
} tail_points;

static void add_point(tail_points *t, double level, int64_t exceedances, double values)
{
    /* Of a Poisson number: relative half width of the 95 % interval of the rate, which fewer than four do not give. */
    if (exceedances < 4)
        return;
    double half = NORMAL_95 / sqrt((double)exceedances);
    double width = real_log((1 + half) / (1 - half));
    t->level[t->count] = level;
    t->log_rate[t->count] = real_log((double)exceedances / values);
    t->weight[t->count++] = 1 / (width * width);
}

/* For b and c that are given the best log q and a are those of a straight line (Naess and Gaidai 2009); its cost. */
static double fit_line(const tail_points *t, double b, double c, acer_tail *out)
{
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, u[ACER_LEVELS] = {0};
    for (int32_t i = 0; i < t->count; i++) {
        u[i] = near_exp(c * near_log(t->level[i] - b));
        w += t->weight[i];
        x += t->weight[i] * u[i];
        y += t->weight[i] * t->log_rate[i];
    }
    x /= w;
    y /= w;
    for (int32_t i = 0; i < t->count; i++) {
        xx += t->weight[i] * (u[i] - x) * (u[i] - x);
        xy += t->weight[i] * (u[i] - x) * (t->log_rate[i] - y);
    }
    double a = -xy / xx, log_q = y + a * x, cost = 0;
    if (!(a * (u[t->count - 1] - u[0]) > FALL_LEAST) || !isfinite(a))
        return (double)INFINITY;
    for (int32_t i = 0; i < t->count; i++) {
        double miss = t->log_rate[i] - (log_q - a * u[i]);
        cost += t->weight[i] * miss * miss;
    }
    if (out)
        *out = (acer_tail){real_exp(log_q), a, b, c};
    return cost / w;
}

/* b lies below the first level by exp(x[0]) widths of the levels. */
static double location_of(const tail_points *t, double x)
{
    return t->level[0] - real_exp(x) * (t->level[t->count - 1] - t->level[0]);
}

static double tail_cost(const void *of, const double *x)
{
    const tail_points *t = of;
    if (!(x[0] > PLACE_LEAST && x[0] < PLACE_MOST && x[1] > POWER_LEAST && x[1] < POWER_MOST))
        return (double)INFINITY;
    return fit_line(t, location_of(t, x[0]), x[1], NULL);
}

static bool fit_points(const tail_points *t, const double start[2], double width, double tolerance, int descents,
                       acer_tail *out)
{
    if (t->count < LEVELS_LEAST)
        return false;
    const double step[2] = {width, 0.6 * width};
    double x[2] = {start[0], start[1]};
    double cost = minimise(tail_cost, t, 2, x, step, tolerance, descents);
    return isfinite(cost) && isfinite(fit_line(t, location_of(t, x[0]), x[1], out));
}

static tail_points points_of(const acer_rates *r)
{
    tail_points t = {.count = 0};
    for (int32_t l = 0; l < r->levels; l++)
        add_point(&t, r->level[l], acer_exceedances(r, l), (double)acer_values(r));
    return t;
}

static bool fit_afresh(const tail_points *t, acer_tail *out)
{
    const double start[2] = {0, 1.5};
    return fit_points(t, start, 0.5, 1e-9, MINIMISE_TO_THE_END, out);
}

bool acer_fit(const acer_rates *r, acer_tail *out)
{
    const tail_points t = points_of(r);
    return fit_afresh(&t, out);
}

/* Of the upper half of the levels alone. */
static bool fit_upper(const tail_points *all, double tolerance, int descents, acer_tail *out)
{
    const double start[2] = {0, 1.5};
    tail_points t = {.count = 0};
    for (int32_t i = all->count / 2; i < all->count; i++, t.count++) {
        t.level[t.count] = all->level[i];
        t.log_rate[t.count] = all->log_rate[i];
        t.weight[t.count] = all->weight[i];
    }
    return fit_points(&t, start, 0.5, tolerance, descents, out);
}

double acer_level(const acer_tail *tail, double step, double time, double exponent)
{
    double fall = real_log(tail->q * time / (step * exponent)) / tail->a;
    return fall > 0 ? tail->b + real_pow(fall, 1 / tail->c) : tail->b;
}

bool acer_is_at_bound(const acer_tail *tail)
{
    return tail->c < POWER_LEAST + POWER_NEAR_LEAST || tail->c > POWER_MOST - POWER_NEAR_MOST;
}

/* ---- bootstrap over batches ---- */

/* A draw speaks of two fits: of all levels, and of their upper half, where has_upper. */
typedef struct tail_draw {
    acer_tail all, upper;
    bool has_upper;
} tail_draw;

/* Of a draw of batches, the fit going on from the whole's; percentiles need no more digits than the data have. */
static bool draw_tail(const acer_rates *r, const acer_tail *whole, uint32_t replicate, tail_draw *out)
{
    random_stream random = random_begin(1, STREAM_BATCHES, replicate);
    int64_t sum[ACER_LEVELS] = {0}, values = 0;
    for (int32_t i = 0; i < r->batches; i++) {
        int32_t b = (int32_t)(random_unit(&random) * r->batches);
        values += r->values.data[b];
        for (int32_t l = 0; l < r->levels; l++)
            sum[l] += r->count.data[(int64_t)b * ACER_LEVELS + l];
    }
    tail_points t = {.count = 0};
    for (int32_t l = 0; l < r->levels; l++)
        add_point(&t, r->level[l], sum[l], (double)values);
    if (t.count < LEVELS_LEAST)
        return false;
    double width = t.level[t.count - 1] - t.level[0];
    const double start[2] = {fmin(fmax(real_log((t.level[0] - whole->b) / width), PLACE_LEAST + 0.3), PLACE_MOST - 0.3),
                             fmin(fmax(whole->c, POWER_LEAST + 0.1), POWER_MOST - 0.1)};
    out->has_upper = fit_upper(&t, 1e-6, 1, &out->upper);
    return fit_points(&t, start, 0.2, 1e-6, 1, &out->all);
}

/* A sound tail is told to change once in a hundred times. */
#define UPPER_CONFIDENCE 0.99

/* Levels by the upper half less those by all, of the draws; `difference` is room for as many as there are draws. */
static void look_at_upper(const acer_rates *r, const tail_draw *draw, int32_t draws, double time, double exponent,
                          double_array *difference, acer_doubt *out)
{
    acer_tail upper;
    const tail_points t = points_of(r);
    out->upper =
        fit_upper(&t, 1e-9, MINIMISE_TO_THE_END, &upper) ? acer_level(&upper, r->step, time, exponent) : (double)NAN;
    difference->count = 0;
    for (int32_t i = 0; i < draws; i++)
        if (draw[i].has_upper)
            difference->data[difference->count++] =
                acer_level(&draw[i].upper, r->step, time, exponent) - acer_level(&draw[i].all, r->step, time, exponent);
    values_sort(difference);
    out->upper_differs = false;
    if (isnan(out->upper) || difference->count <= ACER_REPLICATES / 2)
        return;
    double low = sorted_quantile(difference->data, difference->count, 0.5 - 0.5 * UPPER_CONFIDENCE);
    double high = sorted_quantile(difference->data, difference->count, 0.5 + 0.5 * UPPER_CONFIDENCE);
    out->upper_differs = (low > 0) == (high > 0);
}

fram_status acer_intervals(context *ctx, const acer_rates *r, const acer_tail *fit, double time, const double *exponent,
                           int32_t count, double confidence, level_interval *out, acer_doubt *doubt, fram_error *error)
{
    ARRAY(tail_draw) tail = {0};
    double_array level = {0};
    fram_status status = FRAM_OK;
    for (uint32_t i = 0; status == FRAM_OK && i < ACER_REPLICATES; i++) {
        tail_draw one;
        if (draw_tail(r, fit, i, &one) && !array_push(ctx, &tail, one))
            status = error_memory(error);
        else
            status = work_continue(ctx, "drawing bootstrap samples", i + 1, ACER_REPLICATES, error);
    }
    *doubt = (acer_doubt){.fitted = (double)tail.count / ACER_REPLICATES};
    if (status == FRAM_OK && !array_resize(ctx, &level, tail.count))
        status = error_memory(error);
    if (status == FRAM_OK)
        look_at_upper(r, tail.data, tail.count, time, exponent[0], &level, doubt);
    level.count = tail.count;
    for (int32_t k = 0; status == FRAM_OK && k < count; k++) {
        out[k] = (level_interval){acer_level(fit, r->step, time, exponent[k]), (double)NAN, (double)NAN};
        for (int32_t i = 0; i < tail.count; i++)
            level.data[i] = acer_level(&tail.data[i].all, r->step, time, exponent[k]);
        values_sort(&level);
        if (tail.count <= ACER_REPLICATES / 2)
            continue;
        out[k].low = sorted_quantile(level.data, level.count, 0.5 - 0.5 * confidence);
        out[k].high = sorted_quantile(level.data, level.count, 0.5 + 0.5 * confidence);
    }
    array_free(ctx, &tail);
    array_free(ctx, &level);
    return status;
}
