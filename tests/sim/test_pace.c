/* sim/pace: nothing is said before it is known, and what is said follows the pace of late. */
#include "sim/pace.h"
#include "testing.h"

START_TEST(the_first_steps_frighten_nobody)
{
    /* An hour to go: a first step of 0.02 s that took 8.2 s would make 410 h of it. */
    pace p = {0};
    ck_assert(isnan(pace_left(&p, 8.2, 100.02, 3700)));
    ck_assert(isnan(pace_left(&p, 8.4, 100.42, 3700)));
    ck_assert(isnan(pace_left(&p, 9.3, 100.02, 3700)));
    /* From there on at two simulated seconds a second. */
    assert_relative(pace_left(&p, 10.2, 104.02, 3700), 0.5 * (3700 - 104.02), 1e-12);
    ck_assert_double_eq(pace_left(&p, 11, 3700, 3700), 0);
}
END_TEST

START_TEST(a_change_of_pace_is_followed)
{
    pace p = {0};
    double wall = 0, time = 0, left = 0;
    for (; wall < 60; wall += 0.2, time += 2)
        left = pace_left(&p, wall, time, 1e4);
    assert_relative(left, (1e4 - time + 2) / 10, 1e-9);
    for (double until = wall + 31; wall < until; wall += 0.2, time += 0.2)
        left = pace_left(&p, wall, time, 1e4);
    /* After two spans nothing is left of the faster one. */
    assert_relative(left, 1e4 - time + 0.2, 1e-9);
}
END_TEST

TEST_MAIN("pace", the_first_steps_frighten_nobody, a_change_of_pace_is_followed)
