/* Rainflow counting against ASTM E1049's example, and damage-equivalent ranges against closed forms. */
#include "testing.h"

#include "base/transcendental.h"
#include "results/rainflow.h"

static double count_of(const rain_cycles *c, double range)
{
    double sum = 0;
    for (int32_t i = 0; i < c->list.count; i++)
        sum += fabs(c->list.data[i].range - range) < 1e-12 ? c->list.data[i].count : 0;
    return sum;
}

static double cycles_of(const rain_cycles *c)
{
    double sum = 0;
    for (int32_t i = 0; i < c->list.count; i++)
        sum += c->list.data[i].count;
    return sum;
}

/* E1049-85 (2017), figure 6: range 9: 0.5, 8: 1.0, 6: 0.5, 4: 1.5, 3: 0.5; one cycle of range 4 about a mean of 1. */
START_TEST(the_example_of_the_standard)
{
    context ctx;
    context_init(&ctx);
    const double value[] = {-2, 1, -3, 5, -1, 3, -4, 4, -2};
    rain_cycles c = {0};
    ck_assert(rainflow(&ctx, value, 9, &c));
    static const double table[][2] = {{9, 0.5}, {8, 1.0}, {7, 0}, {6, 0.5}, {5, 0}, {4, 1.5}, {3, 0.5}, {2, 0}, {1, 0}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        assert_absolute(count_of(&c, table[i][0]), table[i][1], 1e-15);
    assert_absolute(cycles_of(&c), 4, 1e-15);
    int whole = 0;
    for (int32_t i = 0; i < c.list.count; i++) {
        if (c.list.data[i].count < 1)
            continue;
        whole++;
        assert_absolute(c.list.data[i].range, 4, 0);
        assert_absolute(c.list.data[i].mean, 1, 0);
    }
    ck_assert_int_eq(whole, 1);
    rainflow_free(&ctx, &c);
}
END_TEST

/* Values between turning points, repeated ones and ones that are no numbers change nothing. */
START_TEST(only_turning_points_count)
{
    context ctx;
    context_init(&ctx);
    const double value[] = {-2, -1, 1, 1, 0, (double)NAN, -3, 5, 2, -1, -1, 3, -4, 0, 4, -2, -2};
    rain_cycles c = {0};
    ck_assert(rainflow(&ctx, value, sizeof value / sizeof *value, &c));
    assert_absolute(count_of(&c, 8), 1, 0);
    assert_absolute(count_of(&c, 4), 1.5, 0);
    assert_absolute(cycles_of(&c), 4, 0);
    rainflow_free(&ctx, &c);
}
END_TEST

/* N whole waves of range 2 A: the equivalent range of N cycles is 2 A with every slope, of k N cycles (1/k)^(1/m). */
START_TEST(waves_of_one_range_are_their_own_equivalent)
{
    context ctx;
    context_init(&ctx);
    enum { WAVES = 50, STEPS = 40 };
    double value[WAVES * STEPS + 1];
    for (int i = 0; i <= WAVES * STEPS; i++)
        value[i] = 10 + 3 * real_cos(2 * PI * i / STEPS);
    rain_cycles c = {0};
    ck_assert(rainflow(&ctx, value, WAVES * STEPS + 1, &c));
    assert_absolute(cycles_of(&c), WAVES, 1e-12);
    for (double m = 1; m < 12; m += 1.5) {
        assert_relative(equivalent_range(&c, m, WAVES), 6, 1e-9);
        assert_relative(equivalent_range(&c, m, 3 * WAVES), 6 * real_pow(1.0 / 3, 1 / m), 1e-9);
    }
    ck_assert(rainflow(&ctx, value, 1, &c));
    assert_absolute(equivalent_range(&c, 3, 1), 0, 0);
    rainflow_free(&ctx, &c);
}
END_TEST

TEST_MAIN("rainflow", the_example_of_the_standard, only_turning_points_count,
          waves_of_one_range_are_their_own_equivalent)
