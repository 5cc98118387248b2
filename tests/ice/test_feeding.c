/* Counting of tiles; what feeding does in a run is tested in tests/sim/test_feeding.c. */
#include "base/random.h"
#include "ice/feeding_parts.h"
#include "testing.h"

/* Everywhere what the formula says, next to halves and on them too. */
START_TEST(periods_are_those_of_the_formula)
{
    random_stream random = random_begin(1, 0, 0);
    for (int i = 0; i < 200000; i++) {
        double period = random_uniform(&random, 0.1, 3000), x = random_uniform(&random, -4, 4) * period;
        if (i % 4 == 0) /* a few roundings from a half */
            x = period * (floor(random_uniform(&random, -4, 4)) + 0.5 + random_uniform(&random, -4e-16, 4e-16));
        ck_assert(feeding_periods(x, period) == floor(x / period + 0.5));
    }
}
END_TEST

TEST_MAIN("feeding", periods_are_those_of_the_formula)
