/* What steps take in packed ice, from two looks at a run: where time is a straight line in the contacts, it is exact.
 */
#include "testing.h"

#include "study/extent.h"

static double line(double contacts) { return 2e-4 + 1e-6 * contacts; }

START_TEST(time_goes_on_with_contacts)
{
    const step_look early = {line(50), 50, 300, 0}, late = {line(800), 800, 300, 0};
    assert_relative(packed_step_time(&early, &late), line(6 * 300), 1e-12);
}
END_TEST

START_TEST(it_is_no_less_than_what_was_seen)
{
    const step_look few = {line(50), 50, 300, 0}, many = {line(800), 800, 300, 0}, slow = {1, 50, 300, 0},
                    full = {1, 1900, 300, 0};
    assert_relative(packed_step_time(&many, &few), line(800), 1e-12); /* ice that came apart */
    assert_relative(packed_step_time(&few, &few), line(50), 1e-12);
    assert_relative(packed_step_time(&slow, &many), 1, 1e-12); /* a clock that stumbled */
    assert_relative(packed_step_time(&few, &full), 1, 1e-12);  /* floes that are not convex */
}
END_TEST

/* Time of a step that grows by a straight line with the steps: the mean over the run is that of its line. */
START_TEST(time_goes_on_with_pieces)
{
    const step_look early = {1e-4 + 1e-7 * 100, 0, 10, 100}, late = {1e-4 + 1e-7 * 600, 0, 60, 600};
    double run = 0, stays = 0;
    for (int i = 0; i < 5000; i++) {
        run += fmax(1e-4 + 1e-7 * i, late.time) / 5000;
        stays += fmin(fmax(1e-4 + 1e-7 * i, late.time), 1e-4 + 1e-7 * 1600) / 5000;
    }
    assert_relative(breaking_step_time(&early, &late, 5000, (double)INFINITY), run, 1e-3);
    assert_relative(breaking_step_time(&early, &late, 5000, 1000), stays, 1e-3);
}
END_TEST

START_TEST(whole_ice_stays_as_it_is)
{
    const step_look early = {1e-4, 0, 10, 100}, late = {3e-4, 0, 10, 600}, broken = {3e-4, 0, 11, 600};
    assert_relative(breaking_step_time(&early, &late, 5000, 1000), 3e-4, 0);
    assert_relative(breaking_step_time(&early, &broken, 600, 1000), 3e-4, 0);
    assert_relative(breaking_step_time(&broken, &early, 5000, 1000), 1e-4, 0);
}
END_TEST

TEST_MAIN("extent", time_goes_on_with_contacts, it_is_no_less_than_what_was_seen, time_goes_on_with_pieces,
          whole_ice_stays_as_it_is)
