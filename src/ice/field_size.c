/* Laws of floe size; see field_size.h. */
#include "ice/field_size.h"

#include "base/random.h"
#include "base/sort.h"
#include "base/transcendental.h"
#include <math.h>

/* Halvings of an inverse. */
enum { HALVINGS = 200, SHIFT_HALVINGS = 60 };
/* After so many diameters, some milliseconds, the caller is asked whether to go on. */
enum { SLICES_A_WORD = 1024 };
/* More floes than this are a mistake in the units rather than a field. */
static const double MOST_FLOES = 5e6;
/* Floes so near each other are of one size, relative: rounding parts what is packed, and cells meet their areas to
   0.2 %.  Half the width of the histogram of floes that are all of one size. */
static const double ONE_SIZE = 0.01;
/* |b| of a power law under which it is D^0: the formula for b loses eps/b, this one b log(hi/lo). */
static const double FLAT = 1e-8;

const char *size_bins_fault(const double *edge, const double *weight, int32_t bins, int32_t *bin)
{
    double sum = 0;
    *bin = 0;
    if (bins < 1 || !(edge[0] >= 0))
        return "a histogram needs bins of positive diameters";
    if (edge[0] == 0)
        return "the first bin with floes begins at 0 m: give the smallest diameter that you have";
    for (; *bin < bins; ++*bin) {
        if (!isfinite(edge[*bin + 1]) || !isfinite(weight[*bin]))
            return "the edges and weights of a histogram must be finite numbers";
        if (!(edge[*bin + 1] > edge[*bin]))
            return "the edges of a histogram must ascend";
        if (!(weight[*bin] >= 0))
            return "the weights of a histogram must not be negative";
        sum += weight[*bin];
    }
    *bin = -1;
    return sum > 0 ? NULL : "the weights of a histogram must not all be zero";
}

static double lognormal_part(const size_law *law, double d);

/* Less of a law than this between its bounds is next to nothing, and rounding decides what is drawn. */
static const double LEAST_PART = 1e-9;

const char *size_law_fault(const size_law *law)
{
    bool mean = law->kind == SIZE_CONSTANT || law->kind == SIZE_LOGNORMAL;
    bool range = law->kind == SIZE_UNIFORM || law->kind == SIZE_POWER;
    if (mean && !(law->mean > 0 && law->mean < HUGE_VAL))
        return "the mean diameter must be positive";
    if (law->kind == SIZE_LOGNORMAL && !(law->deviation > 0 && law->deviation < HUGE_VAL))
        return "the deviation of a lognormal law must be positive";
    if (range && !(law->lo > 0 && law->hi < HUGE_VAL))
        return "the smallest diameter must be positive";
    if ((range || (law->kind == SIZE_LOGNORMAL && law->hi > 0)) && !(law->hi >= law->lo))
        return "the largest diameter must not be less than the smallest";
    if (law->kind == SIZE_POWER && !(fabs(law->exponent) <= 20))
        return "the exponent of a power law must be between -20 and 20";
    if (law->kind == SIZE_LOGNORMAL &&
        !((law->hi > 0 ? lognormal_part(law, law->hi) : 1) - lognormal_part(law, law->lo) > LEAST_PART))
        return "next to nothing of the lognormal law lies between the smallest and the largest diameter";
    int32_t bin;
    return law->kind == SIZE_HISTOGRAM ? size_bins_fault(law->edge, law->weight, law->bins, &bin) : NULL;
}

double normal_distribution(double x)
{
    double z = fabs(x), tail = 0;
    if (z <= 37) {
        double e = real_exp(-z * z / 2);
        if (z < 7.07106781186547) {
            double up = 3.52624965998911e-02 * z + 0.700383064443688;
            up = up * z + 6.37396220353165;
            up = up * z + 33.912866078383;
            up = up * z + 112.079291497871;
            up = up * z + 221.213596169931;
            up = up * z + 220.206867912376;
            double down = 8.83883476483184e-02 * z + 1.75566716318264;
            down = down * z + 16.064177579207;
            down = down * z + 86.7807322029461;
            down = down * z + 296.564248779674;
            down = down * z + 637.333633378831;
            down = down * z + 793.826512519948;
            down = down * z + 440.413735824752;
            tail = e * up / down;
        } else {
            double f = z + 0.65;
            f = z + 4 / f;
            f = z + 3 / f;
            f = z + 2 / f;
            f = z + 1 / f;
            tail = e / (f * 2.506628274631);
        }
    }
    return x > 0 ? 1 - tail : tail;
}

/* Inverse of normal_distribution, by halving. */
static double normal_distribution_inverse(double u)
{
    double lo = -38, hi = 38;
    for (int i = 0; i < HALVINGS && lo < hi; i++) {
        double middle = 0.5 * (lo + hi);
        if (middle <= lo || middle >= hi)
            break;
        if (normal_distribution(middle) < u)
            lo = middle;
        else
            hi = middle;
    }
    return hi;
}

/* Mean and deviation of the logarithm. */
static void lognormal_parameters(const size_law *law, double *mu, double *sigma)
{
    double variation = law->deviation / law->mean, variance = real_log(1 + variation * variation);
    *mu = real_log(law->mean) - variance / 2;
    *sigma = sqrt(variance);
}

static double lognormal_part(const size_law *law, double d)
{
    double mu, sigma;
    lognormal_parameters(law, &mu, &sigma);
    return d > 0 ? normal_distribution((real_log(d) - mu) / sigma) : 0;
}

static double lognormal_quantile(const size_law *law, double u)
{
    double mu, sigma, from = lognormal_part(law, law->lo), to = law->hi > 0 ? lognormal_part(law, law->hi) : 1;
    lognormal_parameters(law, &mu, &sigma);
    double d = real_exp(mu + sigma * normal_distribution_inverse(from + u * (to - from)));
    d = d < law->lo ? law->lo : d;
    return law->hi > 0 && d > law->hi ? law->hi : d;
}

static double power_quantile(const size_law *law, double u)
{
    double lo = law->lo, hi = law->hi, b = law->exponent, d;
    if (fabs(b) < FLAT)
        d = lo * real_pow(hi / lo, u);
    else
        d = lo * real_pow(1 - u * (1 - real_pow(lo / hi, b)), -1 / b);
    return d < lo ? lo : d > hi ? hi : d;
}

static double power_part(const size_law *law, double d)
{
    double lo = law->lo, hi = law->hi, b = law->exponent;
    if (hi == lo)
        return d < lo ? 0 : 1;
    if (d <= lo)
        return 0;
    if (d >= hi)
        return 1;
    if (fabs(b) < FLAT)
        return real_log(d / lo) / real_log(hi / lo);
    return (1 - real_pow(lo / d, b)) / (1 - real_pow(lo / hi, b));
}

static double weight_sum(const size_law *law)
{
    double sum = 0;
    for (int32_t i = 0; i < law->bins; i++)
        sum += law->weight[i];
    return sum;
}

static double histogram_quantile(const size_law *law, double u)
{
    double left = u * weight_sum(law);
    for (int32_t i = 0; i < law->bins; i++) {
        double w = law->weight[i];
        if (left <= w && w > 0)
            return law->edge[i] + (law->edge[i + 1] - law->edge[i]) * left / w;
        left -= w;
    }
    int32_t last = law->bins;
    while (last > 1 && law->weight[last - 1] == 0)
        last--;
    return law->edge[last];
}

static double histogram_part(const size_law *law, double d)
{
    double sum = 0;
    for (int32_t i = 0; i < law->bins && d > law->edge[i]; i++) {
        double width = law->edge[i + 1] - law->edge[i];
        sum += law->weight[i] * (d >= law->edge[i + 1] ? 1 : (d - law->edge[i]) / width);
    }
    return sum / weight_sum(law);
}

double size_law_quantile(const size_law *law, double u)
{
    switch (law->kind) {
    case SIZE_CONSTANT:
        break;
    case SIZE_UNIFORM:
        return law->lo + u * (law->hi - law->lo);
    case SIZE_LOGNORMAL:
        return lognormal_quantile(law, u);
    case SIZE_POWER:
        return power_quantile(law, u);
    case SIZE_HISTOGRAM:
        return histogram_quantile(law, u);
    }
    return law->mean;
}

double size_law_part(const size_law *law, double d)
{
    switch (law->kind) {
    case SIZE_CONSTANT:
        break;
    case SIZE_UNIFORM:
        return d < law->lo ? 0 : d >= law->hi ? 1 : (d - law->lo) / (law->hi - law->lo);
    case SIZE_LOGNORMAL: {
        double from = lognormal_part(law, law->lo), to = law->hi > 0 ? lognormal_part(law, law->hi) : 1;
        double part = (lognormal_part(law, d) - from) / (to - from);
        return part < 0 ? 0 : part > 1 ? 1 : part;
    }
    case SIZE_POWER:
        return power_part(law, d);
    case SIZE_HISTOGRAM:
        return histogram_part(law, d);
    }
    return d >= law->mean ? 1 : 0;
}

static double disc_area(double d) { return PI / 4 * d * d; }

double size_law_mean_area(const size_law *law, int slices)
{
    double sum = 0;
    for (int i = 0; i < slices; i++)
        sum += disc_area(size_law_quantile(law, (i + 0.5) / slices));
    return sum / slices;
}

/* The diameters of n slices, each at its own random place in it, moved by `shift`; *area: of all together. */
static fram_status fill_slices(context *ctx, const size_law *law, const double *place, int32_t n, double shift,
                               double *d, double *area_sum, fram_error *error)
{
    double area = 0;
    for (int32_t i = 0; i < n; i++) {
        if (i % SLICES_A_WORD == 0) {
            fram_status status = work_continue(ctx, "drawing the sizes of the floes", i, n, error);
            if (status != FRAM_OK)
                return status;
        }
        double at = place[i] + shift;
        at = at < 0 ? 0 : at > 1 ? 1 : at;
        d[i] = size_law_quantile(law, (i + at) / n);
        area += disc_area(d[i]);
    }
    *area_sum = area;
    return FRAM_OK;
}

fram_status size_law_draw(context *ctx, const size_law *law, double area, uint64_t seed, uint32_t stream,
                          real_array *out, fram_error *error)
{
    double each = size_law_mean_area(law, SIZE_SLICES);
    if (!(area < (MOST_FLOES + 0.5) * each))
        return error_set(
            error, FRAM_ERROR_INPUT, NULL, 0, "populations",
            "floes of this law have %g m2 in the mean, so that more than %g would make up %g m2, and no more "
            "can be drawn; make the domain smaller or the floes larger",
            each, MOST_FLOES, area);
    double wanted = floor(area / each + 0.5);
    int32_t n = wanted < 1 ? 1 : (int32_t)wanted, first = out->count;
    double *place = memory_array(ctx, (size_t)n, sizeof *place);
    if (!place || !array_reserve(ctx, out, first + n)) {
        memory_free(ctx, place);
        return error_memory(error);
    }
    double *d = out->data + first;
    out->count += n;
    for (int32_t i = 0; i < n; i++) {
        random_stream r = random_begin(seed, stream, (uint32_t)i);
        place[i] = random_unit(&r);
    }
    double lo = -1, hi = 1, found;
    fram_status status = FRAM_OK;
    for (int k = 0; k < SHIFT_HALVINGS && law->kind != SIZE_CONSTANT && status == FRAM_OK; k++) {
        double middle = 0.5 * (lo + hi);
        status = fill_slices(ctx, law, place, n, middle, d, &found, error);
        if (status == FRAM_OK && found < area)
            lo = middle;
        else
            hi = middle;
    }
    if (status == FRAM_OK)
        status = fill_slices(ctx, law, place, n, 0.5 * (lo + hi), d, &found, error);
    if (status != FRAM_OK) {
        out->count = first;
        memory_free(ctx, place);
        return status;
    }
    for (int32_t i = n - 1; i > 0; i--) { /* Fisher and Yates */
        random_stream r = random_begin(seed, stream, (uint32_t)i);
        r.counter = 1;
        int32_t k = (int32_t)(random_unit(&r) * (i + 1));
        double swap = d[i];
        d[i] = d[k];
        d[k] = swap;
    }
    memory_free(ctx, place);
    return FRAM_OK;
}

/* A law of one diameter is a step, where a sample that meets it but for rounding would be half of it off. */
bool size_law_is_one_size(const size_law *law, double *size)
{
    bool range = law->kind == SIZE_UNIFORM || law->kind == SIZE_POWER;
    *size = range ? law->lo : law->mean;
    return law->kind == SIZE_CONSTANT || (range && law->lo >= law->hi);
}

static bool is_of_size(double d, double size) { return fabs(d - size) <= ONE_SIZE * size; }

double size_law_distance(const size_law *law, double *sample, int32_t count)
{
    double most = 0, size;
    bool one = size_law_is_one_size(law, &size);
    if (count > 0)
        numbers_sort(sample, count);
    for (int32_t i = 0; i < count; i++) {
        if (one) {
            most += is_of_size(sample[i], size) ? 0 : 1.0 / count;
            continue;
        }
        double part = size_law_part(law, sample[i]);
        most = fmax(most, fmax(part - (double)i / count, (i + 1.0) / count - part));
    }
    return most;
}

void size_law_histogram(const size_law *law, const double *sample, int32_t count, size_histogram *out)
{
    double lo = HUGE_VAL, hi = 0, size;
    bool one = size_law_is_one_size(law, &size);
    for (int32_t i = 0; i < count; i++) {
        lo = fmin(lo, sample[i]);
        hi = fmax(hi, sample[i]);
    }
    *out = (size_histogram){0};
    if (count < 1)
        return;
    if (!(hi > lo * (1 + 2 * ONE_SIZE))) {
        lo *= 1 - ONE_SIZE;
        hi *= 1 + ONE_SIZE;
    }
    for (int k = 0; k <= SIZE_BINS; k++)
        out->edge[k] = k < SIZE_BINS ? lo * real_pow(hi / lo, (double)k / SIZE_BINS) : hi;
    for (int k = 0; k < SIZE_BINS; k++) {
        double before = k > 0 ? size_law_part(law, out->edge[k]) : 0;
        double after = k + 1 < SIZE_BINS ? size_law_part(law, out->edge[k + 1]) : 1;
        out->expected[k] = count * (after - before);
    }
    for (int32_t i = 0; i < count; i++) {
        double d = one && is_of_size(sample[i], size) ? size : sample[i];
        int k = 0;
        while (k + 1 < SIZE_BINS && d > out->edge[k + 1])
            k++;
        out->bin[k]++;
    }
}
