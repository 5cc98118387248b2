/* A propeller's jet against published decay, and against the momentum that it must keep. */
#include "testing.h"

#include "base/transcendental.h"
#include "fluid/jet.h"

static const double WATER = 1025;

static jet jet_make(double thrust, double diameter, double spread)
{
    jet j = {.along = {1, 0}, .spread = spread, .length = 1e4};
    jet_set_thrust(&j, thrust, diameter, 0, WATER);
    return j;
}

/* By hand for 100 kN on 2 m at rest: sqrt(2e5 / (1025 pi)) = 7.881 m/s; contraction to half the area. */
START_TEST(slipstream_is_that_of_momentum_theory)
{
    jet j = jet_make(1e5, 2, 0.18);
    assert_relative(j.speed, 7.8809, 1e-4);
    assert_relative(j.diameter, 1.41421356, 1e-8);
    jet_set_thrust(&j, 1e5, 2, 5, WATER);
    assert_relative(j.speed, sqrt(25 + 2e5 / (WATER * PI)) - 5, 1e-12);
}
END_TEST

/* U / U0 on the axis: 6.2 D0 / x for a nozzle (Albertson et al. 1950), 2.8 D0 / x for a propeller (Blaauw and van de
   Kaa 1978), which are rounded; and the core before it. */
START_TEST(slows_down_as_published)
{
    static const double spread[] = {0.081, 0.18}, factor[] = {6.2, 2.8};
    for (int i = 0; i < 2; i++) {
        jet j = jet_make(1e5, 2, spread[i]);
        assert_relative(jet_speed(&j, 10 * j.diameter, 0), j.speed * factor[i] / 10, 0.01);
        assert_relative(jet_speed(&j, 50 * j.diameter, 0), j.speed * factor[i] / 50, 0.01);
        ck_assert_double_eq(jet_speed(&j, 0.9 * factor[i] * j.diameter, 0), j.speed);
        ck_assert_double_eq(jet_speed(&j, -1, 0), 0);
    }
}
END_TEST

/* log10(U / U0 * x / D0) = 0.79 - 33 (r / x)^2 of Albertson et al., and exp(-15.4 (r / x)^2) of Blaauw. */
START_TEST(spreads_as_published)
{
    jet nozzle = jet_make(1e5, 2, 0.081), propeller = jet_make(1e5, 2, 0.18);
    for (int i = 0; i <= 4; i++) {
        double x = 20 * nozzle.diameter, r = 0.04 * i * x;
        double speed = nozzle.speed * nozzle.diameter / x * real_pow(10, 0.79 - 33 * 0.0016 * i * i);
        assert_relative(jet_speed(&nozzle, x, r), speed, 0.02);
        assert_relative(jet_speed(&propeller, x, r) / jet_speed(&propeller, x, 0), real_exp(-15.4 * 0.0016 * i * i),
                        0.005);
    }
}
END_TEST

/* rho int U^2 dA, by rings. */
static double momentum_at(const jet *j, double x)
{
    double sum = 0, step = (0.5 * j->diameter + 6 * j->spread * x) / 4000;
    for (int i = 0; i < 4000; i++) {
        double r = (i + 0.5) * step, u = jet_speed(j, x, r);
        sum += u * u * 2 * PI * r * step;
    }
    return WATER * sum;
}

START_TEST(carries_the_thrust_at_any_distance)
{
    static const double at[] = {0.01, 0.5, 1, 2, 2.77, 2.79, 5, 10, 50};
    jet j = jet_make(3e5, 3, 0.18);
    for (int i = 0; i < 9; i++)
        assert_relative(momentum_at(&j, at[i] * j.diameter), 3e5, 1e-5);
    jet_set_thrust(&j, 3e5, 3, 4, WATER);
    ck_assert(momentum_at(&j, 10) < 3e5);
}
END_TEST

/* The mean of U^2 over a rectangle, by 400 x 400 points. */
static double mean_square(const jet *j, double x, double y, double length, double width, double depth)
{
    double sum = 0;
    for (int i = 0; i < 400; i++)
        for (int k = 0; k < 400; k++) {
            double px = x + length * ((i + 0.5) / 400 - 0.5), py = y + width * ((k + 0.5) / 400 - 0.5);
            double u = px < j->length ? jet_speed(j, px, sqrt(py * py + depth * depth)) : 0;
            sum += u * u / 160000;
        }
    return sum;
}

static jet_share over_rectangle(const jet *j, double x, double y, double length, double width, double depth)
{
    vec2 corner[4] = {{-0.5 * length, -0.5 * width},
                      {0.5 * length, -0.5 * width},
                      {0.5 * length, 0.5 * width},
                      {-0.5 * length, 0.5 * width}};
    mat3 level = quat_matrix(quat_identity());
    return jet_over(j, (polygon){corner, 4}, vec3_make(x, y, depth), level, 0);
}

/* Small, wide, long, aside, behind and ahead; the propeller 3 m down. */
START_TEST(mean_over_a_floe_is_that_of_many_points)
{
    static const double floe[][4] = {{20, 0, 4, 4}, {40, 0, 20, 60}, {60, 5, 100, 20}, {30, 8, 12, 5}, {95, 0, 30, 10}};
    jet j = jet_make(4e5, 4, 0.18);
    j.length = 100;
    for (int i = 0; i < 5; i++) {
        const double *f = floe[i];
        jet_share share = over_rectangle(&j, f[0], f[1], f[2], f[3], 3);
        assert_relative(share.speed * share.speed, mean_square(&j, f[0], f[1], f[2], f[3], 3), 0.02);
    }
    ck_assert_double_eq(over_rectangle(&j, -10, 0, 10, 10, 3).speed, 0);
    ck_assert_double_eq(over_rectangle(&j, 5, 40, 10, 10, 3).speed, 0);
    ck_assert_double_eq(over_rectangle(&j, 150, 0, 10, 10, 3).speed, 0);
}
END_TEST

/* At a jet's edge close to a wide propeller U^2 is too small for a number to be divided by: it counts as nothing. */
START_TEST(edges_of_a_jet_are_finite)
{
    jet j = jet_make(1e5, 20, 0.18);
    for (int i = 4; i < 20; i++)
        for (int k = 0; k < 25; k++) {
            double x = 0.05 * i, y = 5 + 0.1 * k;
            jet_share share = over_rectangle(&j, x, y, 0.02, 0.2, 0.5 * j.diameter);
            ck_assert_msg(isfinite(share.speed) && isfinite(share.arm.x) && isfinite(share.arm.y), "%g %g: %g %g %g", x,
                          y, share.speed, share.arm.x, share.arm.y);
            ck_assert(share.speed >= 0 && share.speed <= j.speed);
            ck_assert(fabs(share.arm.y) <= 0.1 && fabs(share.arm.x) <= 0.01);
        }
}
END_TEST

/* A floe beside the axis meets the jet on its inner side; one that turned with the jet meets the same. */
START_TEST(acts_where_it_meets_the_floe)
{
    jet j = jet_make(4e5, 4, 0.18), turned = j;
    jet_share share = over_rectangle(&j, 30, 10, 10, 20, 0);
    ck_assert(share.arm.y < -2 && share.arm.y > -10);
    assert_absolute(over_rectangle(&j, 30, 0, 10, 20, 0).arm.y, 0, 1e-9);
    vec2 corner[4] = {{-5, -10}, {5, -10}, {5, 10}, {-5, 10}};
    turned.along = vec2_make(0, 1);
    jet_share other = jet_over(&turned, (polygon){corner, 4}, vec3_make(-10, 30, 0),
                               quat_matrix(quat_from_roll_pitch_yaw(0, 0, 0.5 * PI)), 0);
    assert_relative(other.speed, share.speed, 1e-9);
    assert_relative(other.arm.x, -share.arm.y, 1e-9);
}
END_TEST

TEST_MAIN("jet", slipstream_is_that_of_momentum_theory, slows_down_as_published, spreads_as_published,
          carries_the_thrust_at_any_distance, mean_over_a_floe_is_that_of_many_points, edges_of_a_jet_are_finite,
          acts_where_it_meets_the_floe)
