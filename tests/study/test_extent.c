/* What steps take in packed ice, from two looks at a run: where time is a straight line in the contacts, it is exact.
 */
#include "testing.h"

#include "study/extent.h"

static double line(double contacts) { return 2e-4 + 1e-6 * contacts; }

START_TEST(time_goes_on_with_contacts)
{
    const step_look early = {line(50), 50, 300}, late = {line(800), 800, 300};
    assert_relative(packed_step_time(&early, &late), line(6 * 300), 1e-12);
}
END_TEST

START_TEST(it_is_no_less_than_what_was_seen)
{
    const step_look few = {line(50), 50, 300}, many = {line(800), 800, 300}, slow = {1, 50, 300}, full = {1, 1900, 300};
    assert_relative(packed_step_time(&many, &few), line(800), 1e-12); /* ice that came apart */
    assert_relative(packed_step_time(&few, &few), line(50), 1e-12);
    assert_relative(packed_step_time(&slow, &many), 1, 1e-12); /* a clock that stumbled */
    assert_relative(packed_step_time(&few, &full), 1, 1e-12);  /* floes that are not convex */
}
END_TEST

TEST_MAIN("extent", time_goes_on_with_contacts, it_is_no_less_than_what_was_seen)
