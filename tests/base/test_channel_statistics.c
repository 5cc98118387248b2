/* Statistics of a channel whose peaks are known. */
#include "testing.h"

#include "base/channel_statistics.h"

#include <math.h>

START_TEST(statistics_of_a_channel)
{
    enum { N = 2000 };
    double time[N], value[N];
    for (int i = 0; i < N; i++) {
        time[i] = 0.01 * i;
        double tooth = i % 100 < 50 ? 1 : 0;
        value[i] = i < 500 ? 1e9 : tooth * (1 + i / 100 % 3); /* peaks of 1, 2 and 3 */
    }
    channel_statistics s = channel_statistics_of(time, value, N, 5);
    ck_assert_int_eq(s.peaks, 10); /* those of 1 do not exceed the mean */
    assert_relative(s.mean, 1, 1e-12);
    assert_relative(s.significant, 3, 1e-12);
    assert_absolute(s.greatest, 3, 0);
    assert_absolute(s.least, 0, 0);
    assert_relative(s.deviation, sqrt(0.5 * 14 / 3 - 1), 1e-12);
    s = channel_statistics_of(time, value, N, 1e9);
    ck_assert(s.mean == 0 && s.peaks == 0);
}
END_TEST

TEST_MAIN("channel_statistics", statistics_of_a_channel)
