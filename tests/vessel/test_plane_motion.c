/* Observers against their own equations. */
#include "supply_ship.h"

#include "vessel/observer.h"
#include "vessel/prescribed_path.h"

static const mat3 coupled = {{{6e6, 2e5, -3e6}, {2e5, 9e6, 4e7}, {-3e6, 4e7, 5e9}}};

/* Without damping, and with a bias that does not fade, the passive observer's error has a triple pole at -w: from a
   place that is off by E it is E (1 - 2 w t + w^2 t^2 / 2) exp(-w t). */
START_TEST(the_passive_observers_poles)
{
    const double w = 0.3, dt = 1e-4, off = 2;
    const plane_model m = {coupled, {{{0}}}};
    const passive_tuning tuning = {w, 1e12};
    for (int axis = 0; axis < 2; axis++) {
        const mat3 plain = {{{6e6, 0, 0}, {0, 9e6, 0}, {0, 0, 5e9}}};
        plane_model model = m;
        model.mass = plain;
        motion_estimate e = {.place = vec3_make(axis == 0 ? off : 0, axis == 1 ? off : 0, 0.7)};
        for (int i = 1; i <= 150000; i++) {
            passive_observer_step(&model, &tuning, &e, vec3_make(0, 0, 0), vec3_make(0, 0, 0.7), dt);
            if (i % 10000 == 0) {
                double t = i * dt, expected = off * (1 - 2 * w * t + 0.5 * w * w * t * t) * real_exp(-w * t);
                assert_absolute(axis == 0 ? e.place.x : e.place.y, expected, 2e-3);
            }
        }
    }
}
END_TEST

static motion_estimate plus(motion_estimate e, const double v[9], double h)
{
    e.place = vec3_add(e.place, vec3_make(h * v[0], h * v[1], h * v[2]));
    e.velocity = vec3_add(e.velocity, vec3_make(h * v[3], h * v[4], h * v[5]));
    e.bias = vec3_add(e.bias, vec3_make(h * v[6], h * v[7], h * v[8]));
    return e;
}

static void listed(motion_estimate e, double out[9])
{
    const vec3 all[3] = {e.place, e.velocity, e.bias};
    for (int i = 0; i < 3; i++)
        out[3 * i] = all[i].x, out[3 * i + 1] = all[i].y, out[3 * i + 2] = all[i].z;
}

/* Without noise the covariance of a single direction goes where the filter's own step takes a state displaced along it:
   the Jacobian against differences, where damping is explicit and where it is not. */
static void check_jacobian(double dt)
{
    const plane_model m = {coupled, {{{1e5, 0, 0}, {0, 3e5, 2e6}, {0, 1e6, 4e8}}}};
    const kalman_tuning quiet = {{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, 500};
    const motion_estimate at = {{3, -4, 0.8}, {1.2, -0.4, 0.03}, {4e5, -7e5, 3e6}};
    const vec3 tau = {1e5, 2e5, -1e6};
    const double scale[9] = {1, 1, 0.1, 1, 1, 0.1, 1e6, 1e6, 1e7};
    for (int k = 0; k < 9; k++) {
        double v[9] = {0}, ahead[9], behind[9];
        v[k] = scale[k];
        kalman_covariance p, none;
        memset(&p, 0, sizeof p);
        memset(&none, 0, sizeof none);
        p.of[KALMAN_STATES * k + k] = v[k] * v[k];
        motion_estimate e = at, f = plus(at, v, 1e-4), g = plus(at, v, -1e-4);
        kalman_predict(&m, &quiet, &e, &p, tau, dt);
        kalman_predict(&m, &quiet, &f, &none, tau, dt);
        kalman_predict(&m, &quiet, &g, &none, tau, dt);
        listed(f, ahead);
        listed(g, behind);
        for (int r = 0; r < 9; r++) {
            for (int c = 0; c < 9; c++) {
                double a = (ahead[r] - behind[r]) / 2e-4, b = (ahead[c] - behind[c]) / 2e-4;
                ck_assert_msg(fabs(p.of[KALMAN_STATES * r + c] - a * b) <= 1e-6 * scale[r] * scale[c],
                              "direction %d, entry (%d, %d): %g, by differences %g", k, r, c,
                              p.of[KALMAN_STATES * r + c], a * b);
            }
        }
    }
}

START_TEST(the_kalman_filters_jacobian)
{
    check_jacobian(0.5);
    check_jacobian(6);
}
END_TEST

/* A heading measured across half a turn is a small miss; measuring makes the covariance smaller, by the rule of two
   variances. */
START_TEST(a_measurement)
{
    const kalman_tuning tuning = {{3, 3, 0.2}, {0, 0, 0}, {0, 0, 0}, 500};
    kalman_covariance p = kalman_begin(&tuning, 0, vec3_make(1, 1, 1), vec3_make(1, 1, 1));
    motion_estimate e = {.place = {0, 0, 3.1}};
    p.of[0] = 16;                          /* of x: 4 m */
    p.of[3] = p.of[KALMAN_STATES * 3] = 2; /* x with surge */
    kalman_correct(&tuning, &e, &p, vec3_make(5, 0, -3.1));
    assert_absolute(e.place.x, 5 * 16.0 / 25, 1e-12);
    assert_absolute(e.velocity.x, 5 * 2.0 / 25, 1e-12);
    assert_absolute(p.of[0], 16 * 9.0 / 25, 1e-12);
    assert_absolute(p.of[3], 2 * 9.0 / 25, 1e-12);
    /* Both are known to 0.2 rad: half way to 2 pi - 3.1. */
    assert_absolute(e.place.z, 0.5 * (3.1 + 2 * PI - 3.1), 1e-12);
}
END_TEST

/* A load that may change three times as fast across the vessel as along it is believed to do so on every heading. */
START_TEST(a_bias_is_unsure_along_the_vessel)
{
    const plane_model m = {{{{3e6, 0, 0}, {0, 6e6, 0}, {0, 0, 3e9}}}, {{{0}}}};
    const kalman_tuning tuning = {{1, 1, 0.1}, {0, 0, 0}, {3e3, 9e3, 1e5}, 500};
    const double heading = 0.7, dt = 0.5;
    kalman_covariance p = kalman_begin(&tuning, heading, vec3_make(0, 0, 0), vec3_make(1e4, 3e4, 1e6));
    vec3 ahead = plane_to_global(heading, vec3_make(1, 0, 0)), aside = plane_to_global(heading, vec3_make(0, 1, 0));
    for (int steps = 0; steps < 2; steps++) {
        double kept = steps == 0 ? 1 : (1 - dt / 500) * (1 - dt / 500), more = steps == 0 ? 0 : dt;
        const double *xx = &p.of[KALMAN_STATES * 6 + 6], *yx = xx + KALMAN_STATES;
        double along = ahead.x * (xx[0] * ahead.x + xx[1] * ahead.y) + ahead.y * (yx[0] * ahead.x + yx[1] * ahead.y);
        double mixed = ahead.x * (xx[0] * aside.x + xx[1] * aside.y) + ahead.y * (yx[0] * aside.x + yx[1] * aside.y);
        double across = aside.x * (xx[0] * aside.x + xx[1] * aside.y) + aside.y * (yx[0] * aside.x + yx[1] * aside.y);
        assert_relative(along, 1e8 * kept + 9e6 * more, 1e-12);
        assert_relative(across, 9e8 * kept + 81e6 * more, 1e-12);
        assert_absolute(mixed, 0, 1e-4);
        motion_estimate e = {.place = {0, 0, heading}};
        kalman_predict(&m, &tuning, &e, &p, vec3_make(0, 0, 0), dt);
    }
}
END_TEST

/* A driven hull goes to where its path is at the end of the step, and turns as the path does. */
START_TEST(a_hull_follows_its_path)
{
    bare_vessel b;
    waypoint_table path = {0};
    bare_vessel_open(&b);
    b.vessels.mode[0] = VESSEL_PRESCRIBED;
    b.vessels.centre[0] = vec3_make(2, 0, 0); /* 2 m ahead of the ship's origin */
    b.bodies.position[0] = vec3_make(2, 0, 0);
    ck_assert(table_resize(&b.ctx, &path, &waypoint_table_info, 2));
    path.time[1] = 10;
    path.place[1] = vec3_make(30, -10, 1);
    vessel_follow(&b.vessels, &path, &b.bodies, 0.5, 0.5);
    vec3 v = b.bodies.velocity[0];
    assert_vec3_close(b.bodies.angular_velocity[0], vec3_make(0, 0, 0.1), 1e-12);
    assert_vec3_close(v, vec3_make((1.5 + 2 * real_cos(0.05) - 2) / 0.5, (-0.5 + 2 * real_sin(0.05)) / 0.5, 0), 1e-12);
    table_free(&b.ctx, &path, &waypoint_table_info);
    bare_vessel_close(&b);
}
END_TEST

TEST_MAIN("plane_motion", a_hull_follows_its_path, the_passive_observers_poles, the_kalman_filters_jacobian,
          a_measurement, a_bias_is_unsure_along_the_vessel)
