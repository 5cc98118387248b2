/* Plane motion, controller, reference filter and observers: docs/oracles.md, 7, and known answers. */
#include "base/random.h"
#include "supply_ship.h"
#include "vessel/controller.h"
#include "vessel/observer.h"
#include "vessel/reference.h"

/* Eigenvalues of -M^-1 D: surge, and the pair of sway and yaw from trace and determinant. */
typedef struct poles {
    double surge, slow, fast;
} poles;

static poles poles_of(mat3 mass, mat3 damping)
{
    mat3 a = mat3_mul(mat3_inverse(mass), damping);
    double trace = a.m[1][1] + a.m[2][2], det = a.m[1][1] * a.m[2][2] - a.m[1][2] * a.m[2][1];
    double root = sqrt(0.25 * trace * trace - det);
    return (poles){-a.m[0][0], -(0.5 * trace - root), -(0.5 * trace + root)};
}

START_TEST(open_loop_poles_of_the_oracle)
{
    poles p = poles_of(supply_mass, supply_damping);
    assert_relative(p.surge, -7.707105e4 / 6.7644e6, 1e-12);
    /* det(s M + D) = 0 with the published numbers, solved by hand. */
    double a = 1.13412e7 * 4.452378e9 - 3.401568e7 * 3.401568e7;
    double bq = 1.13412e7 * 3.850073e8 + 2.546789e5 * 4.452378e9 - 3.401568e7 * (2.034159e6 + 6.725849e5);
    double c = 2.546789e5 * 3.850073e8 - 2.034159e6 * 6.725849e5, root = sqrt(bq * bq - 4 * a * c);
    assert_relative(p.slow, (-bq + root) / (2 * a), 1e-9);
    assert_relative(p.fast, (-bq - root) / (2 * a), 1e-9);
}
END_TEST

START_TEST(pid_step_of_the_oracle)
{
    pid_gains g = pid_gains_for(supply_mass, 0.1, 1);
    assert_relative(g.proportional.x, 6.7644e4, 1e-12);
    vec3 place = {0}, velocity = {0}, integral = {0}, none = {0};
    double dt = 1e-3, peak = 0, when = 0, mass = supply_mass.m[0][0];
    for (int n = 0; n < 1500000; n++) {
        vec3 tau = pid_step(&g, place, velocity, none, none, none, false, &integral, dt);
        velocity.x += dt * (1e5 + tau.x - supply_damping.m[0][0] * velocity.x) / mass;
        place.x += dt * velocity.x;
        if (place.x > peak) {
            peak = place.x;
            when = (n + 1) * dt;
        }
    }
    assert_absolute(peak, 1.212357, 2e-5);
    assert_absolute(when, 44.39, 0.01);
    assert_absolute(place.x, 0, 1e-6);
    assert_absolute(integral.x, 147.8328, 1e-4);
}
END_TEST

START_TEST(pid_works_in_the_frame_of_the_vessel)
{
    pid_gains g = {{1, 2, 3}, {10, 20, 30}, {0.5, 0.25, 0.125}};
    vec3 integral = {0}, none = {0};
    /* Heading 90 degrees, 1 m too far along Y: that is ahead. */
    vec3 tau = pid_step(&g, vec3_make(0, 1, 0.5 * PI), none, vec3_make(0, 0, 0.5 * PI), none, none, true, &integral, 1);
    assert_vec3_close(tau, vec3_make(-1, 0, 0), 1e-15);
    assert_vec3_close(integral, none, 0);
    tau = pid_step(&g, vec3_make(0, 0, 3), none, vec3_make(0, 0, -3), none, none, true, &integral, 1);
    assert_absolute(tau.z, 3 * (2 * PI - 6), 1e-12);
    tau = pid_step(&g, none, none, none, vec3_make(1, 0, 0), vec3_make(5, 6, 7), true, &integral, 1);
    assert_vec3_close(tau, vec3_make(15, 6, 7), 1e-12);
}
END_TEST

START_TEST(reference_is_smooth_and_arrives)
{
    const reference_filter f = {0.05, 1, 0.5, radians(0.5)};
    reference_state s = {{0, 0, radians(170)}, {0, 0, 0}, {0, 0, 0}};
    double fastest = 0, turn = 0, dt = 0.5;
    for (int n = 0; n < 4000; n++) {
        reference_step(&f, &s, vec3_make(50, -5, radians(-170)), dt);
        fastest = testing_larger(fastest, fabs(s.velocity.x));
        turn = testing_larger(turn, s.place.z);
        ck_assert(s.place.x < 52);
    }
    ck_assert(fastest <= 0.5 && fastest > 0.4);
    assert_absolute(s.place.x, 50, 1e-6);
    assert_absolute(s.place.y, -5, 1e-6);
    assert_absolute(degrees(s.place.z), 190, 1e-6); /* the short way */
    ck_assert(turn < radians(191));
}
END_TEST

/* Its speed is the largest in whatever direction it goes, straight to where it shall be; a place that it is sent to on
   its way is reached as well. */
START_TEST(reference_goes_straight)
{
    const reference_filter f = {0.05, 1, 0.5, radians(0.5)};
    reference_state s = {0};
    double fastest = 0, dt = 0.5;
    for (int n = 0; n < 1000; n++) {
        reference_step(&f, &s, vec3_make(80, 60, 0), dt);
        fastest = testing_larger(fastest, hypot(s.velocity.x, s.velocity.y));
        assert_absolute(0.8 * s.place.y - 0.6 * s.place.x, 0, 1e-12);
    }
    ck_assert_msg(fastest <= 0.5 * (1 + 1e-12) && fastest > 0.499, "it goes at up to %g m/s", fastest);
    assert_absolute(s.place.x, 80, 0.02);
    for (int n = 0; n < 2000; n++) {
        reference_step(&f, &s, n < 100 ? vec3_make(80, 200, 0) : vec3_make(300, 100, 0), dt);
        fastest = testing_larger(fastest, hypot(s.velocity.x, s.velocity.y));
    }
    ck_assert(fastest <= 0.5 * (1 + 1e-12));
    assert_vec3_close(s.place, vec3_make(300, 100, 0), 0.5);
}
END_TEST

START_TEST(waypoints_in_their_time)
{
    context ctx;
    context_init(&ctx);
    waypoint_table path = {0};
    ck_assert(table_resize(&ctx, &path, &waypoint_table_info, 2));
    path.time[0] = 10, path.place[0] = vec3_make(1, 2, 3);
    path.time[1] = 20, path.place[1] = vec3_make(4, 5, 6);
    vec3 home = {7, 8, 9};
    assert_vec3_close(reference_target(&path, 0, home, 9.9), home, 0);
    assert_vec3_close(reference_target(&path, 0, home, 10), path.place[0], 0);
    assert_vec3_close(reference_target(&path, 0, home, 1e9), path.place[1], 0);
    assert_vec3_close(reference_target(&path, 1, home, 1e9), home, 0);
    table_free(&ctx, &path, &waypoint_table_info);
}
END_TEST

/* A supply ship pushed by a force that jumps, seen through noise; errors of the last part of the run. */
typedef struct observer_error {
    double place, bias; /* root mean square */
} observer_error;

static observer_error observe(bool kalman, double noise)
{
    const plane_model model = {in_axes_of_fram(supply_mass), in_axes_of_fram(supply_damping)};
    const passive_tuning passive = {0.3, 1000};
    const kalman_tuning tuning = {{fmax(noise, 0.02), fmax(noise, 0.02), 1e-3}, {1e4, 1e4, 1e5}, {2e4, 2e4, 2e5}, 1000};
    motion_estimate e = {0};
    kalman_covariance p = kalman_begin(&tuning, 1, vec3_make(0.1, 0.1, 0.01), vec3_make(1e5, 1e5, 1e6));
    vec3 place = {0, 0, 1}, velocity = {0}, tau = {0};
    e.place = place;
    random_stream r = random_begin(3, 1, 0);
    double dt = 0.2, sums[2] = {0};
    int counted = 0;
    for (int n = 0; n < 3000; n++) {
        double t = n * dt;
        vec3 force = t < 100 ? vec3_make(1e5, 0, 0) : vec3_make(-5e4, 1e5, 1e6); /* global */
        tau = vec3_scale(plane_to_vessel(place.z, force), -0.9);
        vec3 all = vec3_add(tau, plane_to_vessel(place.z, force));
        all = vec3_sub(all, mat3_mul_vec(model.damping, velocity));
        velocity = vec3_mad(velocity, mat3_mul_vec(mat3_inverse(model.mass), all), dt);
        place = vec3_mad(place, plane_to_global(place.z, velocity), dt);
        vec3 seen = vec3_make(place.x + noise * random_normal(&r), place.y + noise * random_normal(&r),
                              place.z + 0.05 * noise * random_normal(&r));
        if (kalman) {
            kalman_predict(&model, &tuning, &e, &p, tau, dt);
            kalman_correct(&tuning, &e, &p, seen);
        } else {
            passive_observer_step(&model, &passive, &e, tau, seen, dt);
        }
        if (t > 200) {
            sums[0] += (e.place.x - place.x) * (e.place.x - place.x) + (e.place.y - place.y) * (e.place.y - place.y);
            sums[1] += (e.bias.x - force.x) * (e.bias.x - force.x) + (e.bias.y - force.y) * (e.bias.y - force.y);
            counted++;
        }
    }
    for (int i = 0; i < 9; i++)
        ck_assert(!kalman || p.of[10 * i] > 0);
    return (observer_error){sqrt(sums[0] / counted), sqrt(sums[1] / counted)};
}

START_TEST(observers_find_place_and_load)
{
    for (int kalman = 0; kalman < 2; kalman++) {
        observer_error clean = observe(kalman, 0), noisy = observe(kalman, 0.1);
        ck_assert_msg(clean.place < 0.02 && clean.bias < 5e3, "kalman %d: clean %g m, %g N", kalman, clean.place,
                      clean.bias);
        ck_assert_msg(noisy.place < 0.1 && noisy.bias < 5e4, "kalman %d: noisy %g m, %g N", kalman, noisy.place,
                      noisy.bias);
        ck_assert(noisy.bias > clean.bias);
    }
}
END_TEST

/* However long the time between calls: the error of a place that does not change, seen without noise, has a triple pole
   at exp(-w dt), where there is neither damping nor forgetting. */
START_TEST(poles_of_a_passive_observer_that_is_called_seldom)
{
    static const double products[] = {0.3, 0.8, 1.5, 10}, calls[] = {0.5, 4};
    const plane_model model = {supply_mass, {{{0}}}};
    for (int i = 0; i < 8; i++) {
        double wdt = products[i / 2], dt = calls[i % 2], pole = real_exp(-wdt);
        const passive_tuning tuning = {wdt / dt, 1e30};
        motion_estimate e = {{1, 0, 0}, {0.1, 0, 0}, {1e4, 0, 0}};
        const vec3 none = {0, 0, 0};
        double x[12];
        for (int n = 0; n < 12; n++) {
            x[n] = e.place.x;
            passive_observer_step(&model, &tuning, &e, none, none, dt);
        }
        for (int n = 3; n < 12; n++)
            assert_absolute(x[n], 3 * pole * x[n - 1] - 3 * pole * pole * x[n - 2] + pole * pole * pole * x[n - 3],
                            1e-9);
    }
}
END_TEST

/* Nor does damping of the model, or a bias that is soon forgotten, blow up steps that are long against them. */
START_TEST(observers_of_a_damped_model_that_are_called_seldom)
{
    static const double products[] = {0, 0.2, 0.6, 1, 2, 5, 1e3}, calls[] = {1.5, 6, 100};
    const vec3 none = {0, 0, 0};
    for (int i = 0; i < 7 * 3 * 2; i++) {
        double dt = 15, share = products[i / 6] / dt, memory = i % 2 ? 1e30 : 0.3 * dt;
        const vec3 m = plane_diagonal(supply_mass);
        const plane_model model = {{{{m.x, 0, 0}, {0, m.y, 0}, {0, 0, m.z}}},
                                   {{{share * m.x, 0, 0}, {0, share * m.y, 0}, {0, 0, share * m.z}}}};
        const passive_tuning tuning = {calls[i / 2 % 3] / dt, memory};
        motion_estimate e = {{1, 2, 0.1}, {0.1, 0, 0}, {1e4, 0, 0}}, f = e;
        f.bias = none;
        for (int n = 0; n < 100; n++)
            passive_observer_step(&model, &tuning, &e, none, none, dt);
        /* The bias of a model that hardly moves is found slowly. */
        double most = products[i / 6] < 10 ? 1e-2 : 5;
        ck_assert_msg(vec3_length(e.place) < most && fabs(e.velocity.x) < most, "%g: at %g m, with %g m/s",
                      products[i / 6], vec3_length(e.place), e.velocity.x);
        const kalman_tuning kalman = {{1, 1, 0.1}, none, none, memory};
        kalman_covariance p = kalman_begin(&kalman, 0, vec3_make(1, 1, 0.1), vec3_make(1e5, 1e5, 1e6));
        double speed = f.velocity.x, variance = p.of[10 * 3];
        for (int j = 0; j < 9; j++)
            p.of[10 * j] *= j < 6;
        for (int n = 0; n < 20; n++) {
            kalman_predict(&model, &kalman, &f, &p, none, dt);
            ck_assert(f.velocity.x >= 0 && f.velocity.x <= speed && p.of[10 * 3] <= variance);
            speed = f.velocity.x;
            variance = p.of[10 * 3];
        }
    }
}
END_TEST

/* A filter that is faster than its calls arrives without going past, and no later. */
START_TEST(reference_of_a_filter_that_is_called_seldom)
{
    static const double frequency[] = {0.05, 0.5, 1, 5, 1e6};
    for (int i = 0; i < 5; i++) {
        const reference_filter f = {frequency[i], 1, 0.5, radians(0.5)};
        reference_state s = {0};
        double dt = 8;
        for (int n = 0; n < 100; n++) {
            reference_step(&f, &s, vec3_make(20, 0, radians(10)), dt);
            ck_assert_msg(fabs(s.place.x) < 22 && fabs(s.velocity.x) < 0.5 * (1 + 1e-12), "%g rad/s: at %g m",
                          frequency[i], s.place.x);
            /* 20 m at 0.5 m/s, and what the filter takes to get under way and to stop. */
            ck_assert(frequency[i] < 0.5 || n < 7 || fabs(s.place.x - 20) < 0.5);
        }
        assert_vec3_close(s.place, vec3_make(20, 0, radians(10)), 1e-3);
        assert_vec3_close(s.velocity, vec3_make(0, 0, 0), 1e-3);
    }
}
END_TEST

START_TEST(vaning_turns_the_bow_into_the_ice)
{
    const vaning v = {radians(1), 60, 1e4};
    double heading = 0, dt = 1;
    ck_assert(vaning_step(&v, heading, vec3_make(0, 5e3, 0), dt) == 0);
    for (int n = 0; n < 1000; n++)
        heading = vaning_step(&v, heading, vec3_make(0, 5e5, 0), dt); /* ice pushes towards Y: bow to -Y */
    assert_absolute(degrees(heading), -90, 0.1);
    assert_absolute(vaning_step(&v, 0, vec3_make(0, 5e5, 0), dt), -radians(1), 1e-12);
}
END_TEST

TEST_MAIN("controller", open_loop_poles_of_the_oracle, pid_step_of_the_oracle, pid_works_in_the_frame_of_the_vessel,
          reference_is_smooth_and_arrives, reference_goes_straight, waypoints_in_their_time,
          observers_find_place_and_load, poles_of_a_passive_observer_that_is_called_seldom,
          observers_of_a_damped_model_that_are_called_seldom, reference_of_a_filter_that_is_called_seldom,
          vaning_turns_the_bow_into_the_ice)
