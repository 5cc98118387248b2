/* Size laws: quantiles against closed forms, samples against their laws. */
#include "base/transcendental.h"
#include "ice/field_size.h"
#include "testing.h"

/* Values of the normal distribution to 15 digits (Abramowitz and Stegun 1964, table 26.1). */
START_TEST(the_normal_distribution_is_right)
{
    assert_absolute(normal_distribution(0), 0.5, 1e-16);
    assert_absolute(normal_distribution(1), 0.841344746068543, 1e-14);
    assert_absolute(normal_distribution(2), 0.977249868051821, 1e-14);
    assert_absolute(normal_distribution(-3), 1.34989803163009e-3, 1e-16);
    assert_relative(normal_distribution(-8), 6.22096057427178e-16, 1e-6);
    assert_absolute(normal_distribution(40), 1, 0);
    for (int i = -300; i <= 300; i++)
        assert_absolute(normal_distribution(i / 50.0), 0.5 * erfc(-i / 50.0 / sqrt(2)), 2e-15);
}
END_TEST

static const double edges[] = {2, 4, 8, 16}, weights[] = {1, 0, 3};
static const size_law laws[] = {
    {.kind = SIZE_UNIFORM, .lo = 3, .hi = 9},
    {.kind = SIZE_LOGNORMAL, .mean = 10, .deviation = 5},
    {.kind = SIZE_LOGNORMAL, .mean = 10, .deviation = 5, .lo = 5, .hi = 30},
    {.kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = 1.7},
    {.kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = 0},
    {.kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = -1},
    {.kind = SIZE_HISTOGRAM, .edge = edges, .weight = weights, .bins = 3},
};
enum { LAW_COUNT = sizeof laws / sizeof *laws };

START_TEST(part_and_quantile_are_inverse)
{
    for (int k = 0; k < LAW_COUNT; k++) {
        ck_assert_ptr_null(size_law_fault(&laws[k]));
        for (int i = 1; i < 200; i++)
            assert_absolute(size_law_part(&laws[k], size_law_quantile(&laws[k], i / 200.0)), i / 200.0, 1e-9);
    }
}
END_TEST

/* Between bounds that leave rounding of a law there is nothing to draw from. */
START_TEST(next_to_nothing_is_refused)
{
    size_law law = {.kind = SIZE_LOGNORMAL, .mean = 20, .deviation = 1, .lo = 40, .hi = 60};
    ck_assert_ptr_nonnull(size_law_fault(&law));
    law.lo = 25;
    ck_assert_ptr_null(size_law_fault(&law));
}
END_TEST

/* A floe of the very smallest size is no proof against a law. */
START_TEST(the_least_diameter_of_a_power_law_has_nothing_under_it)
{
    double sample[4] = {4, size_law_quantile(&laws[3], 0.375), size_law_quantile(&laws[3], 0.625),
                        size_law_quantile(&laws[3], 0.875)};
    ck_assert(laws[3].kind == SIZE_POWER && laws[3].lo == 4);
    assert_bits(size_law_part(&laws[3], 4), 0);
    assert_absolute(size_law_distance(&laws[3], sample, 4), 0.25, 1e-9);
}
END_TEST

START_TEST(quantiles_have_their_closed_forms)
{
    /* (1 - u (1 - 10^-1.7))^(-1/1.7) 4 at the median */
    assert_relative(size_law_quantile(&laws[3], 0.5), 4 * pow(1 - 0.5 * (1 - pow(10, -1.7)), -1 / 1.7), 1e-13);
    assert_relative(size_law_quantile(&laws[4], 0.5), 4 * sqrt(10), 1e-13);
    assert_relative(size_law_quantile(&laws[1], 0.5), 10 / sqrt(1.25), 1e-9);
    assert_relative(size_law_quantile(&laws[6], 0.125), 3, 1e-13);
    assert_relative(size_law_quantile(&laws[6], 0.625), 12, 1e-13);
}
END_TEST

START_TEST(samples_follow_their_law_and_meet_the_area)
{
    context ctx;
    context_init(&ctx);
    for (int k = 0; k < LAW_COUNT; k++) {
        double area = 0, mean = size_law_quantile(&laws[k], 0.5);
        real_array d = {0};
        fram_error e = {0};
        assert_ok(size_law_draw(&ctx, &laws[k], 500 * mean * mean, 9, 1, &d, &e), e);
        ck_assert_int_gt(d.count, 100);
        bool sorted = true;
        for (int32_t i = 0; i < d.count; i++) {
            area += PI / 4 * d.data[i] * d.data[i];
            sorted = sorted && (i == 0 || d.data[i] >= d.data[i - 1]);
        }
        ck_assert(!sorted);
        /* The histogram has a gap that one floe jumps across. */
        assert_relative(area, 500 * mean * mean, laws[k].kind == SIZE_HISTOGRAM ? 1e-3 : 1e-9);
        ck_assert_double_le(size_law_distance(&laws[k], d.data, d.count), 1.0001 / d.count);
        array_free(&ctx, &d);
    }
}
END_TEST

/* Metres for kilometres, and diameters whose squares are none. */
START_TEST(too_many_floes_are_refused)
{
    static const double mean[] = {1e-2, 1e-200};
    context ctx;
    context_init(&ctx);
    for (int k = 0; k < 2; k++) {
        const size_law dust = {.kind = SIZE_CONSTANT, .mean = mean[k]};
        real_array d = {0};
        fram_error e = {0};
        assert_fails(size_law_draw(&ctx, &dust, 1e6, 9, 1, &d, &e), e, FRAM_ERROR_INPUT, "make the domain smaller");
        ck_assert_int_eq(d.count, 0);
    }
}
END_TEST

/* Laws of one diameter are met by floes that rounding, or the areas of cells, part from it: in the histogram, too. */
START_TEST(rounding_is_no_other_size)
{
    static const size_law of_one[] = {{.kind = SIZE_CONSTANT, .mean = 8},
                                      {.kind = SIZE_UNIFORM, .lo = 8, .hi = 8},
                                      {.kind = SIZE_POWER, .lo = 8, .hi = 8, .exponent = 1.7}};
    static const double off[] = {1e-15, 1e-3, 9e-3};
    for (int k = 0; k < 9; k++) {
        const size_law *law = &of_one[k / 3];
        const double o = off[k % 3];
        double sample[4] = {8 * (1 + o), 8 * (1 - o), 8, 8 * (1 - o)};
        size_histogram h;
        size_law_histogram(law, sample, 4, &h);
        for (int i = 0; i < SIZE_BINS; i++)
            assert_absolute(h.bin[i], h.expected[i], 0);
        assert_absolute(size_law_distance(law, sample, 4), 0, 0);
        sample[3] = 8.1;
        assert_absolute(size_law_distance(law, sample, 4), 0.25, 0);
    }
}
END_TEST

/* A sample of half its diameter is found out. */
START_TEST(the_distance_sees_a_wrong_sample)
{
    double wrong[100];
    for (int i = 0; i < 100; i++)
        wrong[i] = 0.5 * size_law_quantile(&laws[0], (i + 0.5) / 100);
    ck_assert_double_gt(size_law_distance(&laws[0], wrong, 100), 0.7);
    const size_law constant = {.kind = SIZE_CONSTANT, .mean = 5};
    double equal[4] = {5, 5, 5, 6};
    assert_absolute(size_law_distance(&constant, equal, 4), 0.25, 1e-15);
}
END_TEST

TEST_MAIN("field_size", the_normal_distribution_is_right, part_and_quantile_are_inverse, next_to_nothing_is_refused,
          the_least_diameter_of_a_power_law_has_nothing_under_it, quantiles_have_their_closed_forms,
          samples_follow_their_law_and_meet_the_area, too_many_floes_are_refused, rounding_is_no_other_size,
          the_distance_sees_a_wrong_sample)
