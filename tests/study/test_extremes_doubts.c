/* When answers come with the sentence that the data do not carry them. */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/extremes.h"
#include "study/extremes_notes.h"
#include "study/extremes_spread.h"
#include "study/profile.h"
#include "study/series_set.h"

enum { VALUES = 20000 };

static double exponential(random_stream *r) { return -real_log(1 - random_unit(r)); }

/* By rates, of independent values; in a part of one in 200 of another law, which the first levels know nothing of. */
static void answer(bool mixed, extreme_result *out)
{
    static double value[VALUES];
    random_stream r = random_begin(5, 91, 0);
    for (int i = 0; i < VALUES; i++)
        value[i] = mixed && random_unit(&r) < 0.005 ? 6 + 0.5 * exponential(&r) : sqrt(2 * exponential(&r));
    const series_part part = {value, VALUES};
    const series_set set = {&part, 1, 1};
    context ctx;
    fram_error error = {0};
    extreme_request ask;
    context_init(&ctx);
    extreme_request_default(&ask);
    ask.duration = 3.0 * VALUES;
    ask.order = 1;
    assert_ok(extremes_of_series(&ctx, &set, EXTREME_ACER, &ask, out, &error), error);
    ck_assert_msg(out->answered, "%s", out->note);
}

START_TEST(a_tail_that_changes_is_told)
{
    static extreme_result r;
    answer(false, &r);
    ck_assert_msg(!strstr(r.note, "do not carry"), "%s", r.note);
    answer(true, &r);
    ck_assert_msg(strstr(r.note, "the data do not carry the answer"), "%.4g (%.4g, %.4g), c %g: %s",
                  r.most_probable.level, r.most_probable.low, r.most_probable.high, r.tail.c, r.note);
}
END_TEST

START_TEST(draws_without_a_fit_are_told)
{
    static extreme_result r;
    extremes_doubt_tail(&r, &(acer_doubt){0.95, 10.5, false});
    ck_assert_str_eq(r.note, "");
    extremes_doubt_tail(&r, &(acer_doubt){0.8, (double)NAN, false});
    ck_assert_ptr_nonnull(strstr(r.note, "20 %"));
    r.note[0] = 0;
    extremes_doubt_tail(&r, &(acer_doubt){1, 11.5, true});
    ck_assert_ptr_nonnull(strstr(r.note, "upper half"));
}
END_TEST

/* The first digits of a northing are the same for all. */
START_TEST(notes_have_the_digits_that_tell_values_far_from_zero_apart)
{
    static const double peaks[] = {6534000.5, 6534020.25};
    static extreme_result r;
    extreme_request ask;
    extreme_request_default(&ask);
    r.method = EXTREME_GEV;
    r.law = (extreme_law){LAW_GEV, 6534199.8, 0.25, -0.75};
    r.level[0].level = 6534199;
    extremes_doubt(&r, &ask, ask.duration);
    extremes_cut_low(&r, 1, 6534199.8123);
    ck_assert_msg(strstr(r.note, "ends at 6534200.133 (") && strstr(r.note, "not over 6534199.812 are"), "%s", r.note);
    r = (extreme_result){.law = {LAW_WEIBULL, 6534000, 1, 2}};
    extremes_doubt_largest(&r, peaks, 2);
    ck_assert_msg(strstr(r.note, "seen, 6534020.25, is"), "%s", r.note);
    r = (extreme_result){.tail = {1, 4, 6534000, 2}};
    extremes_doubt_tail(&r, &(acer_doubt){1, 6534021.75, true});
    ck_assert_msg(strstr(r.note, "gives 6534021.75: the"), "%s", r.note);
}
END_TEST

static double power_of(double g, int power)
{
    return power < 0 ? 0 : real_pow(fabs(g), power) * (g < 0 && power % 2 ? -1 : 1);
}

/* Score of Gumbel's law when the values move by g^n/n!: of the derivative of the move and that of the density. */
static double score_of_move(double g, int n)
{
    static const double over[] = {1, 1, 2, 6};
    return (power_of(g, n) * (1 - real_exp(-g)) - n * power_of(g, n - 1)) / over[n];
}

/* The place at which a fit of the generalized law by likelihood finds the shape: a shape that is s at the location and
   grows by d with each unit of g is fitted as s + place d.  By Fisher's information of location, scale and shape, and
   of the move d g^3/6, integrated over Gumbel's density. */
static double place_of_maxima_shape(void)
{
    double in[4][4] = {{0}};
    const double step = 1e-3;
    for (double g = -6; g < 60; g += step) {
        double density = real_exp(-g - real_exp(-g));
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 4; k++)
                in[i][k] += score_of_move(g, i) * score_of_move(g, k) * density * step;
    }
    /* Gauss, without pivots: the information is positive definite. */
    for (int i = 0; i < 3; i++)
        for (int k = i + 1; k < 3; k++) {
            double part = in[k][i] / in[i][i];
            for (int j = i; j < 4; j++)
                in[k][j] -= part * in[i][j];
        }
    return in[2][3] / in[2][2];
}

/* A tail exp(-x^c) over a threshold, by the law that touches it there: the shift is what that law leaves out. */
START_TEST(the_limit_of_a_weibull_tail)
{
    static const double powers[] = {2, 1, 0.7};
    for (int i = 0; i < 3; i++) {
        double c = powers[i], begin = 5, rare = 6, place = real_pow(begin, 1 / c);
        /* scale: 1/hazard at the threshold; shape: that of the tail at the mean of its peaks. */
        extreme_law law = {LAW_PARETO, place, place / (begin * c), (1 / c - 1) / (begin + 1)};
        double truth = real_pow(begin + rare, 1 / c);
        double told = extreme_law_level(&law, rare) + penultimate_shift(&law, real_exp(-begin), rare);
        assert_relative(told, truth, 1e-9);
        law = (extreme_law){LAW_GEV, place, place / (begin * c), (1 / c - 1) / (begin + place_of_maxima_shape())};
        told = extreme_law_level(&law, real_exp(-rare)) + penultimate_shift(&law, real_exp(-begin), rare);
        assert_relative(told, truth, 1e-7);
    }
}
END_TEST

/* Maxima of blocks of a Gaussian series are on their way to the limit; the same maxima alone say nothing of it. */
START_TEST(maxima_of_a_series_know_of_their_limit)
{
    enum { LONG = 5000, BLOCK = 100 };
    static double value[LONG], most[LONG / BLOCK];
    random_stream r = random_begin(6, 93, 0);
    for (int i = 0; i < LONG; i++) {
        value[i] = random_normal(&r);
        most[i / BLOCK] = i % BLOCK == 0 ? value[i] : fmax(most[i / BLOCK], value[i]);
    }
    const series_part part = {value, LONG};
    const series_set set = {&part, 1, 1};
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = 3 * LONG;
    ask.block = BLOCK;
    static extreme_result of_series, alone;
    context ctx;
    context_init(&ctx);
    ck_assert(extremes_of_series(&ctx, &set, EXTREME_GEV, &ask, &of_series, NULL) == FRAM_OK);
    ck_assert(extremes_of_maxima(&ctx, most, LONG / BLOCK, BLOCK, EXTREME_GEV, &ask, &alone, NULL) == FRAM_OK);
    assert_relative(of_series.level[1].level, alone.level[1].level, 1e-12);
    ck_assert(of_series.law.shape < 0 && of_series.level[1].high > 1.005 * alone.level[1].high);
    assert_relative(of_series.level[1].low, alone.level[1].low, 1e-12);
}
END_TEST

/* Peaks of Weibull's law between crossings of the mean, 0, say nothing against it; some that are larger than it has,
   or all of them cut below what it has, do. */
static const char *note_of_peaks(bool large, bool cut, extreme_result *out)
{
    enum { PEAKS = 4000 };
    static double value[2 * PEAKS];
    random_stream r = random_begin(7, 95, 0);
    double sum = 0;
    for (int i = 0; i < PEAKS; i++) {
        double peak = sqrt(2 * exponential(&r));
        peak = cut ? fmin(peak, 2.6) : large && i % 800 == 400 ? 2.5 * peak + 4 : peak;
        value[2 * i] = peak;
        sum += peak;
    }
    for (int i = 0; i < PEAKS; i++)
        value[2 * i + 1] = -sum / PEAKS;
    const series_part part = {value, 2 * PEAKS};
    const series_set set = {&part, 1, 1};
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = 2.0 * PEAKS;
    context ctx;
    context_init(&ctx);
    ck_assert(extremes_of_series(&ctx, &set, EXTREME_WEIBULL, &ask, out, NULL) == FRAM_OK);
    ck_assert_msg(out->answered, "%s", out->note);
    return out->note;
}

START_TEST(a_largest_peak_that_the_law_does_not_have_is_told)
{
    static extreme_result r;
    ck_assert_msg(!strstr(note_of_peaks(false, false, &r), "this law"), "%s", r.note);
    ck_assert_msg(strstr(note_of_peaks(true, false, &r), "levels are too low"), "%s", r.note);
    ck_assert_msg(strstr(note_of_peaks(false, true, &r), "levels are too high"), "%s", r.note);
}
END_TEST

/* First-order autoregression: its time scale is (1 + a) / (1 - a) / 2 steps, at least one, and no longer in twenty
   files than in one. */
START_TEST(time_scales_do_not_grow_with_the_data)
{
    enum { FILES = 20, EACH = 30000 };
    static double value[FILES][EACH];
    for (double a = 0; a < 1; a += 0.9) {
        series_part parts[FILES];
        for (uint32_t k = 0; k < FILES; k++) {
            random_stream r = random_begin(3, 17, k);
            double x = random_normal(&r);
            for (int32_t i = 0; i < EACH; i++) {
                value[k][i] = x;
                x = a * x + sqrt(1 - a * a) * random_normal(&r);
            }
            parts[k] = (series_part){value[k], EACH};
        }
        for (int32_t count = 1; count <= FILES; count += FILES - 1) {
            const series_set set = {parts, count, 0.1};
            double found = series_nature_of(&set).time_scale, wanted = 0.1 * fmax(1, 0.5 * (1 + a) / (1 - a));
            ck_assert_msg(fabs(found / wanted - 1) < 0.1, "a %g, %d files: %g s instead of %g", a, count, found,
                          wanted);
        }
    }
}
END_TEST

/* Independent Weibull peaks over a mean that is far from them: the jackknife's bound is that of the fit. */
START_TEST(independent_peaks_keep_their_bound)
{
    enum { PEAKS = 2000, SAMPLES = 4 };
    static double value[2 * PEAKS];
    double ratio = 0;
    context ctx;
    context_init(&ctx);
    for (uint32_t k = 0; k < SAMPLES; k++) {
        random_stream r = random_begin(6, 92, k);
        for (int i = 0; i < 2 * PEAKS; i++)
            value[i] = i % 2 ? -1.5 : 1 + real_pow(exponential(&r), 0.5);
        const series_part part = {value, 2 * PEAKS};
        const series_set set = {&part, 1, 1};
        series_nature nature = series_nature_of(&set);
        static weibull_jackknife j;
        ck_assert(jackknife_weibull(&ctx, &set, &nature, 3.0 * 2 * PEAKS, &j, NULL) == FRAM_OK);
        ck_assert_int_eq(j.groups, JACKKNIFE_GROUPS);
        for (int g = 0; g < j.groups; g++)
            assert_relative(j.peaks[g], 3.0 * PEAKS, 1e-9);
        double_array peaks = {0};
        extreme_law law;
        ck_assert(cluster_peaks(&ctx, &set, 1, 1, &peaks));
        values_sort(&peaks);
        ck_assert(extreme_law_fit(LAW_WEIBULL, FIT_LIKELIHOOD, peaks.data, peaks.count, 1, &law));
        for (int g = 0; g < j.groups; g++) {
            double_array left = {0};
            for (int i = 0; i < PEAKS; i++)
                if (i / (PEAKS / j.groups) != g)
                    ck_assert(array_push(&ctx, &left, value[2 * i]));
            values_sort(&left);
            ck_assert(extreme_law_fit(LAW_WEIBULL, FIT_LIKELIHOOD, left.data, left.count, 1, &j.law[g]));
            array_free(&ctx, &left);
        }
        double bound = jackknife_bound(&j, &law, PEAKS, 1, 0.95) / 2.0227;
        ratio += bound * bound / SAMPLES;
        /* Groups that come out the same leave an interval of some width. */
        for (int g = 0; g < j.groups; g++)
            j.law[g] = law;
        assert_relative(jackknife_bound(&j, &law, PEAKS, 1, 0.95), sqrt(0.1) * 2.0227, 1e-4);
        array_free(&ctx, &peaks);
    }
    /* A variance of 39 degrees of freedom, four times: 1 within three deviations of 0.11. */
    ck_assert_msg(fabs(ratio - 1) < 0.34, "%g", ratio);
}
END_TEST

/* Over a threshold that is low the greatest values of clusters have another law than the values (Eastoe and Tawn 2012):
   the interval goes as far as the tail of either tells. */
START_TEST(intervals_of_peaks_go_as_far_as_the_tail_of_the_values)
{
    enum { LONG = 20000 };
    static double value[LONG];
    random_stream r = random_begin(11, 7, 1);
    double x = random_normal(&r), exponent = 1;
    for (int i = 0; i < LONG; i++) {
        value[i] = x;
        x = 0.8 * x + 0.6 * random_normal(&r);
    }
    const series_part part = {value, LONG};
    const series_set set = {&part, 1, 1};
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = 3 * LONG;
    ask.stability = false;
    static extreme_result told;
    context ctx;
    context_init(&ctx);
    ck_assert(extremes_of_series(&ctx, &set, EXTREME_POT, &ask, &told, NULL) == FRAM_OK);
    double_array peaks = {0}, over = {0};
    ck_assert(cluster_peaks(&ctx, &set, told.threshold, (int)floor(told.separation + 0.5), &peaks));
    for (int i = 0; i < LONG; i++)
        if (value[i] > told.threshold)
            ck_assert(array_push(&ctx, &over, value[i]));
    values_sort(&peaks);
    values_sort(&over);
    ck_assert_int_eq(peaks.count, told.sample);
    extreme_law law;
    ck_assert(extreme_law_fit(LAW_PARETO, FIT_LIKELIHOOD, over.data, over.count, told.threshold, &law));
    profile_question q = {&told.law, peaks.data, peaks.count, 3, exponent, 0.95, .ctx = &ctx};
    level_interval scatter = profile_interval(&q);
    double survival = (double)over.count / LONG, rare = real_log(3.0 * peaks.count);
    double of_clusters = penultimate_shift(&told.law, survival, rare);
    double of_values = penultimate_level(&law, survival, rare) - scatter.level;
    ck_assert(of_values > of_clusters + 0.01 && of_clusters > 0);
    assert_relative(told.most_probable.high, scatter.high + of_values, 1e-12);
    assert_relative(told.most_probable.low, scatter.low, 1e-12);
    assert_relative(told.most_probable.level, scatter.level, 1e-12);
    array_free(&ctx, &peaks);
    array_free(&ctx, &over);
}
END_TEST

static void ask_series(const double *value, int count, extreme_method method, double duration, extreme_result *out)
{
    const series_part part = {value, count};
    const series_set set = {&part, 1, 1};
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = duration;
    ask.stability = false;
    ask.probability[0] = 0.001;
    context ctx;
    context_init(&ctx);
    ck_assert(extremes_of_series(&ctx, &set, method, &ask, out, NULL) == FRAM_OK);
}

/* Bursts in a series of little else, most of them in a group of their own: where fewer than ten are left without one
   there is no jackknife, and an interval as wide as ten peaks make it. */
START_TEST(few_peaks_have_an_interval)
{
    static const struct {
        int bursts;
        bool pair, jackknife;
    } cases[] = {{10, false, false}, {11, true, false}, {11, false, true}};
    static double value[VALUES];
    static extreme_result r;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        random_stream random = random_begin(15, 7, 1);
        for (int i = 0; i < VALUES; i++)
            value[i] = 0.02 * random_unit(&random);
        for (int i = 0; i < cases[k].bursts; i++)
            value[i == 10 && cases[k].pair ? 16750 : 520 + 1800 * i] = 20 + 5 * (i * 7 % 11);
        ask_series(value, VALUES, EXTREME_WEIBULL, VALUES, &r);
        ck_assert_int_eq(r.sample, cases[k].bursts);
        ck_assert_str_eq(r.interval, cases[k].jackknife ? "profile likelihood, scaled by a jackknife over groups"
                                                        : "profile likelihood");
        for (int i = -1; i < 3; i++) {
            const level_interval *at = i < 0 ? &r.most_probable : &r.level[i];
            ck_assert_msg(at->high - at->low > 0.2 * at->level && at->high < 10 * at->level && at->low > 0,
                          "case %zu: %g (%g to %g)", k, at->level, at->low, at->high);
        }
    }
}
END_TEST

/* Rates of a sine are the same at all levels: no tail falls from there, but by rounding. */
START_TEST(rates_that_do_not_fall_have_no_tail)
{
    static double value[VALUES];
    static extreme_result r;
    for (int i = 0; i < VALUES; i++)
        value[i] = sin(0.05 * i);
    for (int m = 0; m < 2; m++) {
        ask_series(value, VALUES, m ? EXTREME_UPCROSSING : EXTREME_ACER, 3.0 * VALUES, &r);
        ck_assert_msg(!r.answered && strstr(r.note, "do not fall"), "%g: %s", r.most_probable.level, r.note);
    }
}
END_TEST

/* The same series in one part and in a hundred short ones: rates are of the values that can exceed, those that have k -
   1 of their part before them. */
START_TEST(rates_of_short_parts_are_those_of_a_long_one)
{
    enum { ORDER = 39, PARTS = 100, LENGTH = VALUES / PARTS };
    static double value[VALUES];
    static series_part parts[PARTS];
    random_stream random = random_begin(14, 7, 1);
    double x = 0;
    for (int i = 0; i < VALUES; i++) {
        x = 0.9 * x + random_normal(&random);
        value[i] = x;
        parts[i / LENGTH] = (series_part){value + i / LENGTH * LENGTH, LENGTH};
    }
    const series_part whole = {value, VALUES};
    const series_set sets[] = {{&whole, 1, 1}, {parts, PARTS, 1}};
    double rate[2];
    context ctx;
    context_init(&ctx);
    for (int k = 0; k < 2; k++) {
        acer_rates r;
        ck_assert(acer_count(&ctx, &sets[k], ORDER, 3, LENGTH, &r));
        ck_assert_int_eq(acer_values(&r), k ? PARTS * (LENGTH - ORDER + 1) : VALUES - ORDER + 1);
        rate[k] = (double)acer_exceedances(&r, 0) / (double)acer_values(&r);
        acer_free(&ctx, &r);
    }
    /* Some 170 exceedances, of which four in five are the same. */
    ck_assert_msg(fabs(rate[1] / rate[0] - 1) < 0.08, "%g", rate[1] / rate[0]);
    /* Batches cover all of a part, and a shorter part is one. */
    static const int32_t batch[] = {LENGTH + 1, LENGTH - 1, 60}, batches[] = {PARTS, PARTS, 3 * PARTS};
    for (int k = 0; k < 3; k++) {
        acer_rates r;
        ck_assert(acer_count(&ctx, &sets[1], ORDER, 3, batch[k], &r));
        ck_assert_int_eq(r.batches, batches[k]);
        ck_assert_int_eq(acer_values(&r), PARTS * (LENGTH - ORDER + 1));
        assert_relative((double)acer_exceedances(&r, 0) / (double)acer_values(&r), rate[1], 1e-12);
        acer_free(&ctx, &r);
    }
}
END_TEST

/* Runs shorter than the order, or little longer: of a series of twelve batches they make none of twenty. */
START_TEST(batches_without_values_stand_for_no_run)
{
    enum { ORDER = 39, EMPTY = 16, SHORT = 8, BATCHES = 12, LENGTH = 200 };
    static double value[VALUES];
    static extreme_result result;
    series_part parts[1 + EMPTY + SHORT] = {{value, BATCHES * LENGTH}};
    for (int i = 0; i < EMPTY + SHORT; i++)
        parts[1 + i] = (series_part){value + BATCHES * LENGTH + i * ORDER, i < EMPTY ? ORDER - 1 : ORDER};
    random_stream random = random_begin(14, 7, 1);
    double x = 0;
    for (int i = 0; i < VALUES; i++) {
        x = 0.9 * x + random_normal(&random);
        value[i] = x;
    }
    const series_part whole = {value, VALUES};
    const series_set set = {parts, 1 + EMPTY + SHORT, 1}, one = {&whole, 1, 1};
    acer_rates r;
    context ctx;
    context_init(&ctx);
    ck_assert(acer_count(&ctx, &set, ORDER, 3, LENGTH, &r));
    ck_assert_int_eq(r.batches, BATCHES + SHORT);
    for (int b = 0; b < r.batches; b++)
        ck_assert_int_gt(r.values.data[b], 0);
    assert_absolute(acer_effective_batches(&r), BATCHES, 0.1);
    acer_free(&ctx, &r);
    /* Runs that are longer than a batch count no less for it. */
    series_part longer[20];
    for (int i = 0; i < 20; i++)
        longer[i] = (series_part){value + i * 2 * LENGTH, i < 10 ? LENGTH : LENGTH + 3 * LENGTH / 5};
    ck_assert(acer_count(&ctx, &(series_set){longer, 20, 1}, ORDER, 3, LENGTH, &r));
    assert_absolute(acer_effective_batches(&r), 20, 1e-12);
    acer_free(&ctx, &r);
    /* Equal short ones are as many as there are: runs are independent. */
    for (int i = 0; i < 20; i++)
        longer[i].count = LENGTH / 2;
    ck_assert(acer_count(&ctx, &(series_set){longer, 20, 1}, ORDER, 3, LENGTH, &r));
    assert_absolute(acer_effective_batches(&r), 20, 1e-12);
    acer_free(&ctx, &r);
    extreme_request ask;
    extreme_request_default(&ask);
    ask.duration = VALUES;
    ask.order = ORDER;
    ck_assert(extremes_of_series(&ctx, &set, EXTREME_ACER, &ask, &result, NULL) == FRAM_OK);
    ck_assert_msg(!result.answered && strstr(result.note, "too short for a bootstrap"), "%s", result.note);
    ck_assert(extremes_of_series(&ctx, &one, EXTREME_ACER, &ask, &result, NULL) == FRAM_OK);
    ck_assert_msg(result.answered, "%s", result.note);
}
END_TEST

/* Blocks that met no ice: with many such there is no generalized law, with more no law of maxima at all. */
START_TEST(many_maxima_that_are_equal_carry_no_answer)
{
    enum { ALL = 50 };
    static const struct {
        int zeros;
        bool gev, gumbel;
    } cases[] = {{8, true, true}, {9, false, true}, {19, false, true}, {20, false, false}};
    extreme_request ask;
    extreme_request_default(&ask);
    static extreme_result r;
    context ctx;
    context_init(&ctx);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double value[ALL], shift = k > 1 ? 6534000 : 0;
        for (int i = 0; i < ALL; i++)
            value[i] = shift + fmax(0, i + 1 - cases[k].zeros);
        for (int m = 0; m < 2; m++) {
            char why[64];
            snprintf(why, sizeof why, "%d of 50 maxima are equal, %.7g, the least", cases[k].zeros, shift);
            ck_assert(extremes_of_maxima(&ctx, value, ALL, 45, m ? EXTREME_GEV : EXTREME_GUMBEL, &ask, &r, NULL) ==
                      FRAM_OK);
            ck_assert_msg(r.answered == (m ? cases[k].gev : cases[k].gumbel), "%d, %d: %s", cases[k].zeros, m, r.note);
            ck_assert_msg(r.answered || strstr(r.note, why), "%s", r.note);
        }
    }
}
END_TEST

/* Rates and peaks are told over a level or threshold, and know nothing of what is under it. */
START_TEST(levels_under_the_law_s_own_are_not_told)
{
    static const extreme_method over[] = {EXTREME_ACER, EXTREME_UPCROSSING, EXTREME_POT, EXTREME_WEIBULL};
    static double value[VALUES];
    static extreme_result r;
    random_stream random = random_begin(12, 7, 1);
    for (int i = 0; i < VALUES; i++)
        value[i] = random_normal(&random);
    for (int m = 0; m < 4; m++) {
        bool rates = m < 2;
        ask_series(value, VALUES, over[m], VALUES, &r);
        ck_assert_msg(r.answered, "%s", r.note);
        double least = r.threshold, once = rates ? r.tail.b : 0;
        /* Of so many peaks or exceedances one in the time, and a tenth less or more. */
        once =
            rates ? 1 / (r.tail.q * real_exp(-r.tail.a * real_pow(least - once, r.tail.c))) : VALUES / (double)r.sample;
        ask_series(value, VALUES, over[m], 0.9 * once, &r);
        ck_assert_msg(!r.answered && strstr(r.note, "fewer than one"), "%s", r.note);
        ck_assert(isnan(r.most_probable.level) && isnan(r.level[2].level));
        ask_series(value, VALUES, over[m], 1.5 * once, &r);
        ck_assert_msg(r.answered && strstr(r.note, "are not told"), "%s", r.note);
        ck_assert(r.most_probable.level > least && isnan(r.level[0].level) && isnan(r.level[0].high));
        ck_assert(r.level[2].level > r.most_probable.level);
    }
}
END_TEST

/* What the limit of a heavy tail leaves out is more than the way from the threshold to the level. */
START_TEST(no_end_of_an_interval_lies_under_the_law_s_location)
{
    static const extreme_method methods[] = {EXTREME_POT, EXTREME_GEV};
    static double value[VALUES];
    static extreme_result r;
    random_stream random = random_begin(13, 7, 1);
    for (int i = 0; i < VALUES; i++)
        value[i] = real_pow(1 - random_unit(&random), -0.5) - 1;
    for (int m = 0; m < 2; m++) {
        ask_series(value, VALUES, methods[m], VALUES, &r);
        ck_assert(r.answered && r.law.shape > 0.3);
        ck_assert_msg(r.level[2].low >= r.law.location && r.level[1].low >= r.law.location, "%g, %g: %g",
                      r.level[1].low, r.level[2].low, r.law.location);
    }
}
END_TEST

/* Fits end at a shape of 1.5: that of a heavier tail stays there. */
START_TEST(a_shape_at_the_bound_of_fits_is_told)
{
    enum { MAXIMA = 40 };
    static extreme_result r;
    double value[MAXIMA];
    extreme_request ask;
    context ctx;
    context_init(&ctx);
    extreme_request_default(&ask);
    ask.duration = MAXIMA;
    for (int heavy = 0; heavy < 2; heavy++) {
        const extreme_law law = {LAW_GEV, 10, 2, heavy ? 2 : 1.1};
        for (int i = 0; i < MAXIMA; i++)
            value[i] = extreme_law_level(&law, -real_log((i + 0.5) / MAXIMA));
        ck_assert(extremes_of_maxima(&ctx, value, MAXIMA, 1, EXTREME_GEV, &ask, &r, NULL) == FRAM_OK);
        ck_assert_msg((strstr(r.note, "The shape, 1.5, is at the bound") != NULL) == heavy, "shape %g: %s", r.law.shape,
                      r.note);
        ck_assert_msg((strstr(r.note, "its variance is infinite") != NULL) != heavy, "shape %g: %s", r.law.shape,
                      r.note);
        ck_assert(r.level[1].high > 3 * r.level[1].level);
    }
}
END_TEST

/* Of lines that parted at 300 kN and more. */
START_TEST(levels_that_parted_lines_did_not_hold_are_not_told)
{
    static const extreme_result found = {.answered = true,
                                         .most_probable = {2e5, 1e5, 3e5},
                                         .level = {{2.9e5, 1e5, 4e5}, {3e5, 1e5, 4e5}, {4e5, 3e5, 6e5}}};
    static extreme_result r[5];
    for (int i = 0; i < 5; i++)
        r[i] = found;
    extremes_cut_parted(&r[0], 3, 0, 5, false, HUGE_VAL);
    ck_assert(r[0].answered && isfinite(r[0].level[2].level) && r[0].note[0] == '\0');
    extremes_cut_parted(&r[1], 3, 2, 5, false, 3e5);
    ck_assert(r[1].answered && isfinite(r[1].most_probable.level) && isfinite(r[1].level[0].level));
    ck_assert(isnan(r[1].level[1].level) && isnan(r[1].level[2].level));
    ck_assert_msg(strstr(r[1].note, "in 2 of 5 runs") && strstr(r[1].note, "levels from 300 kN"), "%s", r[1].note);
    extremes_cut_parted(&r[2], 3, 2, 5, true, HUGE_VAL);
    ck_assert(!r[2].answered && isnan(r[2].level[0].level));
    /* Least tensions have no such end. */
    extremes_cut_parted(&r[3], 3, 2, 5, false, HUGE_VAL);
    ck_assert(r[3].answered && isfinite(r[3].level[2].level) && strstr(r[3].note, "fewer lines."));
    /* Those of a model are in newtons. */
    extremes_cut_parted(&r[4], 3, 2, 5, false, 3.4567);
    ck_assert_msg(strstr(r[4].note, "levels from 3.457 N on"), "%s", r[4].note);
}
END_TEST

TEST_MAIN("extremes_doubts", few_peaks_have_an_interval, a_shape_at_the_bound_of_fits_is_told,
          time_scales_do_not_grow_with_the_data, levels_that_parted_lines_did_not_hold_are_not_told,
          many_maxima_that_are_equal_carry_no_answer, rates_of_short_parts_are_those_of_a_long_one,
          rates_that_do_not_fall_have_no_tail, levels_under_the_law_s_own_are_not_told,
          no_end_of_an_interval_lies_under_the_law_s_location, intervals_of_peaks_go_as_far_as_the_tail_of_the_values,
          a_largest_peak_that_the_law_does_not_have_is_told, a_tail_that_changes_is_told, draws_without_a_fit_are_told,
          notes_have_the_digits_that_tell_values_far_from_zero_apart, batches_without_values_stand_for_no_run,
          the_limit_of_a_weibull_tail, maxima_of_a_series_know_of_their_limit, independent_peaks_keep_their_bound)
