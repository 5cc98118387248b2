/* What the results of station keeping are made of. */
#include "testing.h"

#include "base/transcendental.h"
#include "results/run_data.h"
#include "results/station_results.h"

#include <math.h>

START_TEST(envelope_of_offsets)
{
    const double time[] = {0, 1, 2, 3, 4}, x[] = {9, 2, 3, 0, -1}, y[] = {0, 0, 0.1, -4, -1};
    double out[ENVELOPE_DIRECTIONS];
    offset_envelope(time, x, y, 5, 0.5, out);
    assert_relative(out[0], sqrt(9.01), 1e-12);
    assert_relative(out[27], 4, 1e-12);
    assert_relative(out[22] + out[23], sqrt(2.0), 1e-12);
    for (int i = 1; i < 20; i++)
        ck_assert(!(out[i] > 0));
}
END_TEST

/* A direction's sector of 10 degrees reaches 5 to either side. */
START_TEST(sectors_lie_about_their_directions)
{
    for (int direction = 0; direction < ENVELOPE_DIRECTIONS; direction++) {
        for (int off = -4; off <= 4; off += 4) {
            double angle = radians(10.0 * direction + off), out[ENVELOPE_DIRECTIONS];
            const double time = 1, x = 3 * real_cos(angle), y = 3 * real_sin(angle);
            offset_envelope(&time, &x, &y, 1, 0, out);
            for (int i = 0; i < ENVELOPE_DIRECTIONS; i++)
                assert_absolute(out[i], i == direction ? 3 : 0, 1e-12);
        }
    }
}
END_TEST

/* Statistics begin with the first row that is not in the transient. */
START_TEST(the_transient_is_left_out)
{
    static double time[] = {0, 1, 2, 3, 4};
    csv_table_column column = {.name = "time", .value = {time, 5, 5}};
    run_data d = {.series = {.columns = {&column, 1, 1}, .rows = 5}};
    static const double transient[] = {0, 0.5, 1, 3.5, 9};
    static const int first[] = {0, 1, 1, 4, 5};
    for (int i = 0; i < 5; i++) {
        d.s.run.transient = transient[i];
        ck_assert_int_eq(run_first_row(&d), first[i]);
    }
    d.series.columns.count = 0;
    ck_assert_int_eq(run_first_row(&d), 0);
}
END_TEST

TEST_MAIN("station_results", envelope_of_offsets, sectors_lie_about_their_directions, the_transient_is_left_out)
