/* What the results of station keeping are made of. */
#include "testing.h"

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

TEST_MAIN("station_results", envelope_of_offsets)
