/* Nevel's wedge against the table and the profile of his own solution (docs/theory.md). */
#include "base/transcendental.h"
#include "ice/wedge.h"
#include "testing.h"

typedef struct wedge_row {
    double load, tip, place, capacity;
} wedge_row;
static const wedge_row TABLE[] = {
    {0.02, 2.163818617915, 0.2808643296747, 1.078441313397}, {0.05, 2.127262063347, 0.3925105836296, 1.151137366693},
    {0.10, 2.067333645437, 0.5114858883249, 1.255469567682}, {0.20, 1.951214140576, 0.6781105308157, 1.451822389831},
    {0.50, 1.632347223958, 1.035387852438, 2.101864701022},  {1.00, 1.194259321462, 1.541472476599, 3.700604211907}};

START_TEST(table_of_the_wedge)
{
    for (size_t i = 0; i < sizeof TABLE / sizeof *TABLE; i++) {
        wedge w = wedge_solve(TABLE[i].load);
        assert_relative(w.tip_deflection, TABLE[i].tip, 1e-10);
        assert_relative(w.x_max, TABLE[i].place, 1e-11);
        assert_relative(w.capacity, TABLE[i].capacity, 1e-11);
    }
}
END_TEST

START_TEST(profile)
{
    wedge w = wedge_solve(0.1);
    double eta[4];
    wedge_profile(&w, 1, eta);
    assert_relative(eta[0], 0.7919154165856, 1e-11);
    assert_relative(eta[1], -0.9014103533277, 1e-11);
    assert_relative(eta[2], 0.7073923370887, 1e-11);
    wedge_profile(&w, w.x_max, eta);
    assert_relative(1 / eta[2], w.capacity, 1e-15);
    assert_absolute(eta[3], 0, 1e-10);
}
END_TEST

/* The load's end is no kink, and nothing but the table is left of the tip's singular terms. */
START_TEST(continuity)
{
    for (double a = 0.005; a <= 3; a *= 1.3) {
        wedge w = wedge_solve(a);
        double left[4], right[4];
        wedge_profile(&w, a * (1 - 1e-15), left);
        wedge_profile(&w, a, right);
        assert_absolute(left[0], right[0], 2e-11);
        assert_absolute(left[1], right[1], 1e-12);
        assert_absolute(left[2], right[2], 1e-11);
        assert_absolute(left[3], right[3], 1e-10 * (1 + fabs(right[3])));
    }
}
END_TEST

/* The largest eta'' is the largest, at any load. */
START_TEST(largest_curvature)
{
    for (double a = 0.005; a <= 2; a *= 1.1) {
        wedge w = wedge_solve(a);
        for (double x = 0.01; x < 6; x += 0.01) {
            double eta[4];
            wedge_profile(&w, x, eta);
            ck_assert(eta[2] <= w.curvature * (1 + 1e-12));
        }
    }
}
END_TEST

/* The equation itself, by differences of the profile; and vertical balance, integral xi eta = 1. */
START_TEST(equation_and_balance)
{
    wedge w = wedge_solve(0.3);
    double sum = 0;
    enum { STEPS = 6000 };
    for (int i = 0; i < STEPS; i++) {
        double x = 6.0 * (i + 0.5) / STEPS, eta[4];
        wedge_profile(&w, x, eta);
        sum += x * eta[0] * 6.0 / STEPS;
    }
    /* The rest of the balance is the shear at xi = 6. */
    double eta[4];
    wedge_profile(&w, 6, eta);
    assert_absolute(sum + eta[2] + 6 * eta[3], 1, 1e-6);
    for (double x = 0.15; x < 3; x += 0.2) {
        double low[4], high[4], here[4], step = 1e-5, p = x < 0.3 ? 2 / 0.09 : 0;
        wedge_profile(&w, x - step, low);
        wedge_profile(&w, x + step, high);
        wedge_profile(&w, x, here);
        assert_absolute(x * (high[3] - low[3]) / (2 * step) + 2 * here[3] + x * here[0], x * p, 2e-6);
    }
}
END_TEST

START_TEST(laws)
{
    /* Small loads: the place of the break, and Nevel's own fit for the capacity. */
    assert_relative(wedge_solve(1e-3).x_max, 0.97043 * 0.1, 0.03);
    for (double a = 0.02; a <= 0.6; a += 0.02)
        assert_relative(wedge_solve(a).capacity, 1.05 + 2 * a + 0.5 * a * a * a, 0.011);
    /* Outside its range a load counts as its end. */
    assert_bits(wedge_solve(0).x_max, wedge_solve(WEDGE_LEAST_LOAD).x_max);
    assert_bits(wedge_solve(100).capacity, wedge_solve(WEDGE_MOST_LOAD).capacity);
    /* Larger loads break farther out and later. */
    double place = 0, capacity = 0;
    for (double a = 0.005; a <= 3; a *= 1.01) {
        wedge w = wedge_solve(a);
        ck_assert(w.x_max > place && w.capacity > capacity);
        place = w.x_max;
        capacity = w.capacity;
    }
}
END_TEST

TEST_MAIN("wedge", table_of_the_wedge, profile, continuity, largest_curvature, equation_and_balance, laws)
