/* What water does to a ship that goes ahead: regression, added mass counted once, rudders. */
#include "testing.h"

#include "vessel/manoeuvre.h"
#include "vessel/rudder.h"

#include "base/transcendental.h"

/* Kirchhoff's terms of a ship that slides and turns, by themselves: d/dt of the momentum of the water, in the plane. */
static void kirchhoff(const manoeuvring *m, double u, double v, double r, double *y, double *n)
{
    double along = m->a11 * u, aside = m->a22 * v + m->a26 * r;
    *y = -r * along;
    *n = -(u * aside - v * along);
}

/* Lift and Kirchhoff's terms together are the regression, whatever the added mass: the moment of Munk acts once. */
START_TEST(moment_of_munk_acts_once)
{
    manoeuvring m = {.mass = 1.5e7, .inertia = 2e10, .a11 = 8e5, .a22 = 9e6, .a26 = 4e7};
    m.whole = hull_lift_of(121, 25, 8.8, 14537, 1025);
    hull_lift l = manoeuvring_lift(&m);
    for (int i = 0; i < 27; i++) {
        double u = 1 + i % 3, v = 0.4 * (i / 3 % 3 - 1), r = 0.01 * (i / 9 - 1), y, n;
        kirchhoff(&m, u, v, r, &y, &n);
        y += u * (l.y_v * v + l.y_r * r);
        n += u * (l.n_v * v + l.n_r * r);
        assert_absolute(y, u * (m.whole.y_v * v + m.whole.y_r * r), 1e-3);
        assert_absolute(n, u * (m.whole.n_v * v + m.whole.n_r * r), 1e-1);
    }
    /* What goes with u v is a table's: nothing is put in for the moment of Munk, which does not act then. */
    manoeuvring tabled = m;
    tabled.whole.y_v = tabled.whole.n_v = 0;
    hull_lift turns = manoeuvring_lift(&tabled);
    ck_assert(turns.y_v == 0 && turns.n_v == 0 && turns.y_r == l.y_r && turns.n_r == l.n_r);
    m.a11 = m.a22 = m.a26 = 0;
    assert_relative(manoeuvring_lift(&m).n_v, m.whole.n_v, 1e-15);
}
END_TEST

/* About a point 3 m farther aft the same motion has another sway there, the same force and another moment. */
START_TEST(lift_is_moved_with_its_moment)
{
    hull_lift l = hull_lift_of(60, 14, 5, 2100, 1025), to = hull_lift_moved(l, 3);
    double v = 0.4, r = 0.02, there = v - 3 * r;
    double y = l.y_v * v + l.y_r * r, n = l.n_v * v + l.n_r * r;
    assert_relative(to.y_v * there + to.y_r * r, y, 1e-12);
    assert_relative(to.n_v * there + to.n_r * r, n + 3 * y, 1e-12);
}
END_TEST

/* By hand: two rudders of 8 m2 and aspect 1.5 behind propellers of 5 m: slope 6.13 x 1.5 / 3.75, height 3.464 m, all in
   the race; block 0.6: wake 0.13. */
START_TEST(rudder_force_by_hand)
{
    rudder r = rudder_of(16, 2, 5, 0.6, 1025);
    assert_relative(r.slope, 2.452, 1e-9);
    assert_relative(r.wake, 0.13, 1e-9);
    assert_relative(r.covered, 1, 1e-15);
    assert_relative(rudder_speed(&r, 4, 0), 0.87 * 4, 1e-12);
    double disc = 2 * PI / 4 * 25, far = sqrt(3.48 * 3.48 + 3e5 / (0.5 * 1025 * disc));
    assert_relative(rudder_speed(&r, 4, 3e5), 3.48 + 0.6 * (far - 3.48), 1e-12);
    double speed = rudder_speed(&r, 4, 3e5), normal = 0.5 * 1025 * 16 * 2.452 * speed * speed * real_sin(0.3);
    steering_force f = rudder_force(&r, 4, 0, 3e5, 0.3);
    assert_relative(f.aside, -1.31 * normal * real_cos(0.3), 1e-9);
    assert_relative(f.ahead, 3e5 - 0.61 * normal * real_sin(0.3), 1e-9);
    /* At rest, and with way and no thrust, it steers too; a stern that swings to port is pushed back. */
    ck_assert(rudder_force(&r, 0, 0, 3e5, 0.3).aside < -3e4);
    ck_assert(rudder_force(&r, 4, 0, -1e5, 0.3).aside < -3e4);
    ck_assert(rudder_force(&r, 4, 0.5, 3e5, 0).aside < 0);
    assert_absolute(rudder_force(&r, 4, 0, 3e5, -0.3).aside, -f.aside, 1e-6);
}
END_TEST

START_TEST(angle_gives_the_force_that_is_asked)
{
    rudder with = rudder_of(16, 2, 5, 0.6, 1025), none = {0};
    for (int i = -5; i <= 5; i++) {
        double angle = 0.1 * i, stern = 0.1 * (i % 3);
        steering_force f = rudder_force(&with, 4, stern, 3e5, angle);
        assert_absolute(rudder_angle_for(&with, 4, stern, 3e5, f.aside, angle), angle, 1e-9);
        f = rudder_force(&none, 4, stern, 3e5, angle);
        assert_absolute(f.aside, -3e5 * real_sin(angle), 1e-6);
        assert_absolute(f.ahead, 3e5 * real_cos(angle), 1e-6);
        assert_absolute(rudder_angle_for(&none, 4, stern, 3e5, f.aside, angle), angle, 1e-9);
    }
    /* The least area of a ship of 121 x 25 x 8.8 m by the rule: 1 % of the lateral area times 1.64. */
    assert_relative(rudder_area(121, 25, 8.8, 0.546), 0.01 * 121 * 8.8 * (1 + 50 * 0.1128099 * 0.1128099), 1e-4);
}
END_TEST

/* No other angle gives a ship that moves so more force to starboard. */
START_TEST(no_angle_turns_more_than_the_most)
{
    const rudder with = rudder_of(16, 2, 5, 0.6, 1025), none = {0};
    for (int k = -3; k <= 6; k++) {
        double aside = -0.8 * k, most = rudder_most_angle(&with, 4, aside, 3e5);
        double best = -rudder_force(&with, 4, aside, 3e5, most).aside;
        for (int i = 0; i <= 180; i++)
            ck_assert(-rudder_force(&with, 4, aside, 3e5, radians(0.5 * i)).aside <= best * (1 + 1e-12));
    }
    assert_absolute(rudder_most_angle(&with, 4, 0, 3e5), radians(35), 1e-12);
    assert_absolute(rudder_most_angle(&none, 4, 0, 3e5), radians(90), 1e-12);
}
END_TEST

TEST_MAIN("manoeuvre", moment_of_munk_acts_once, lift_is_moved_with_its_moment, rudder_force_by_hand,
          angle_gives_the_force_that_is_asked, no_angle_turns_more_than_the_most)
