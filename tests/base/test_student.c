/* Student's t against published quantiles and the normal limit. */
#include "testing.h"

#include "base/student.h"

#include <limits.h>

/* Two-sided 95 % and 99 % (Abramowitz and Stegun 1964, table 26.10). */
START_TEST(quantiles_are_those_of_the_table)
{
    static const struct {
        int freedom;
        double t95, t99;
    } table[] = {{1, 12.706, 63.657}, {2, 4.303, 9.925},  {3, 3.182, 5.841},  {4, 2.776, 4.604},  {5, 2.571, 4.032},
                 {10, 2.228, 3.169},  {19, 2.093, 2.861}, {30, 2.042, 2.750}, {60, 2.000, 2.660}, {120, 1.980, 2.617}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        assert_absolute(student_quantile(0.95, table[i].freedom), table[i].t95, 5.1e-4);
        assert_absolute(student_quantile(0.99, table[i].freedom), table[i].t99, 5.1e-4);
    }
    assert_absolute(student_quantile(0.95, 100000), 1.959988, 2e-6);
}
END_TEST

/* Also of what a damaged file may make of them. */
START_TEST(quantiles_of_any_degrees_end)
{
    ck_assert(isnan(student_quantile(0.95, 0)) && isnan(student_quantile(0.95, INT_MIN)));
    assert_relative(student_quantile(0.95, INT_MAX), 1.959963985, 2e-6);
    ck_assert(isnan(student_half(0.95, 2, HUGE_VAL)) && isnan(student_half(0.95, 2, (double)NAN)));
    assert_relative(student_half(0.95, 2, 4), 8.606, 2e-4);
}
END_TEST

START_TEST(the_quantile_inverts_the_distribution)
{
    for (int freedom = 1; freedom < 40; freedom++)
        for (double confidence = 0.05; confidence < 0.999; confidence += 0.09)
            assert_relative(student_within(student_quantile(confidence, freedom), freedom), confidence, 1e-12);
    for (int freedom = 1; freedom < 40; freedom++)
        ck_assert(student_within((double)INFINITY, freedom) == 1 && student_within(1e200, freedom) == 1);
}
END_TEST

TEST_MAIN("student", quantiles_are_those_of_the_table, quantiles_of_any_degrees_end,
          the_quantile_inverts_the_distribution)
