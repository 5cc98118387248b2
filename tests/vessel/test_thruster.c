/* Thrusters step by step: shafts, azimuths, rudders, sectors, and what they push; the active set of their allocation.
 */
#include "supply_ship.h"

#include "base/random.h"
#include "vessel/allocation.h"

/* A thruster that follows its orders at once, but for what the test sets. */
static thruster_definition quick(thruster_kind kind)
{
    return (thruster_definition){.kind = kind,
                                 .place = {20, 5, 0},
                                 .ahead = 4e5,
                                 .astern = 1e5,
                                 .time_constant = 0,
                                 .speed_rate = 1e9,
                                 .turn_rate = 1e9,
                                 .cost = 1,
                                 .full_power = 2e6,
                                 .failure_time = HUGE_VAL};
}

static void open_with(bare_vessel *b, const thruster_definition *d)
{
    bare_vessel_open(b);
    assert_ok(thruster_add(&b->ctx, d, &b->vessels, &b->thrusters, &b->error), b->error);
}

/* The wrench on the vessel after one more step of dt. */
static wrench step(bare_vessel *b, double time, double dt)
{
    wrench load = {{0, 0, 0}, {0, 0, 0}}, sum = load;
    assert_ok(
        thruster_step(&b->ctx, &b->thrusters, &b->vessels, &b->bodies, time, dt, &load, &sum, &b->events, &b->error),
        b->error);
    assert_vec3_close(load.force, sum.force, 0);
    assert_vec3_close(load.moment, sum.moment, 0);
    return load;
}

/* While an azimuth turns at its rate it gives what helps: its order times the cosine of the angle left. */
START_TEST(azimuths_turn_at_their_rate)
{
    bare_vessel b;
    thruster_definition d = quick(THRUSTER_AZIMUTH);
    d.turn_rate = radians(10);
    open_with(&b, &d);
    thruster_table *t = &b.thrusters;
    t->order[0] = 1e5;
    t->order_angle[0] = radians(120);
    for (int i = 1; i <= 14; i++) {
        double left = radians(120 - 10 * (i - 1));
        wrench w = step(&b, i, 1);
        assert_absolute(t->angle[0], radians(i < 12 ? 10.0 * i : 120), 1e-12);
        double expected = left > 0 ? 1e5 * fmax(real_cos(left), 0) : 1e5;
        assert_absolute(t->thrust[0], expected, 1e-6);
        assert_vec3_close(w.force, vec3_make(expected * real_cos(t->angle[0]), expected * real_sin(t->angle[0]), 0),
                          1e-6);
        /* About the centre of mass: 20 m forward, 5 m to port. */
        assert_absolute(w.moment.z, 20 * w.force.y - 5 * w.force.x, 1e-3);
    }
    /* The short way round. */
    t->order_angle[0] = radians(-170);
    step(&b, 15, 1);
    assert_absolute(t->angle[0], radians(130), 1e-12);
    bare_vessel_close(&b);
}
END_TEST

START_TEST(shafts_have_a_rate_and_a_time)
{
    bare_vessel b;
    thruster_definition d = quick(THRUSTER_TUNNEL);
    d.speed_rate = 0.1;
    open_with(&b, &d);
    b.thrusters.order[0] = 4e5; /* full speed: in ten steps of 1 s */
    for (int i = 1; i <= 11; i++) {
        step(&b, i, 1);
        double n = fmin(0.1 * i, 1);
        assert_absolute(b.thrusters.thrust[0], 4e5 * n * n, 1e-3);
        assert_relative(thruster_power(&b.thrusters, 0), 2e6 * n * n * n, 1e-9);
    }
    bare_vessel_close(&b);
    d = quick(THRUSTER_TUNNEL);
    d.time_constant = 2;
    open_with(&b, &d);
    b.thrusters.order[0] = 4e5;
    step(&b, 1, 1);
    assert_relative(b.thrusters.speed[0], 1 - real_exp(-0.5), 1e-12);
    bare_vessel_close(&b);
}
END_TEST

/* Astern a thruster gives what it is asked for, up to its own limit, and a rudder does nothing. */
START_TEST(astern)
{
    bare_vessel b;
    thruster_definition d = quick(THRUSTER_TUNNEL);
    open_with(&b, &d);
    b.thrusters.order[0] = -0.5e5;
    wrench w = step(&b, 1, 1);
    assert_vec3_close(w.force, vec3_make(0, -0.5e5, 0), 1e-6);
    b.thrusters.order[0] = -9e5;
    assert_vec3_close(step(&b, 2, 1).force, vec3_make(0, -1e5, 0), 1e-6);
    b.thrusters.order[0] = 9e5;
    assert_vec3_close(step(&b, 3, 1).force, vec3_make(0, 4e5, 0), 1e-6);
    bare_vessel_close(&b);
    d = quick(THRUSTER_MAIN);
    d.rudder = radians(30);
    open_with(&b, &d);
    b.thrusters.order_angle[0] = radians(30);
    b.thrusters.order[0] = 2e5;
    step(&b, 1, 1);
    w = step(&b, 2, 1);
    assert_vec3_close(w.force, vec3_make(2e5 * real_cos(radians(30)), 2e5 * real_sin(radians(30)), 0), 1e-6);
    assert_vec3_close(thruster_effect(&b.thrusters, 0), vec3_make(w.force.x, w.force.y, w.moment.z), 1e-6);
    b.thrusters.order[0] = -0.8e5;
    assert_vec3_close(step(&b, 3, 1).force, vec3_make(-0.8e5, 0, 0), 1e-6);
    bare_vessel_close(&b);
}
END_TEST

/* A direction inside a forbidden sector becomes the nearer edge of it. */
START_TEST(the_nearer_edge_of_a_sector)
{
    for (int side = -1; side <= 1; side += 2) {
        bare_vessel b;
        bare_vessel_open(&b);
        for (int i = 0; i < 2; i++) {
            thruster_definition d = quick(THRUSTER_AZIMUTH);
            d.place = vec3_make(i ? -20 : 20, 0, 0);
            d.forbidden_centre = 0.5 * PI;
            d.forbidden_half = i ? 0 : radians(30);
            assert_ok(thruster_add(&b.ctx, &d, &b.vessels, &b.thrusters, &b.error), b.error);
        }
        /* Mostly to port, 10 degrees off the middle of the sector. */
        vec3 tau = vec3_make(2e5 * real_cos(radians(90 - 10 * side)), 2e5 * real_sin(radians(90 - 10 * side)), 0);
        bool reached;
        thruster_allocate(&b.thrusters, 0, 20, tau, &reached);
        assert_absolute(b.thrusters.order_angle[0], radians(90 - 30 * side), 1e-9);
        bare_vessel_close(&b);
    }
}
END_TEST

/* Out of reach, no thrust may move within its limits and lower the cost: the slope of the cost by a thrust is zero
   where it is free, does not fall inwards where it is at a limit. */
START_TEST(nothing_is_gained_by_leaving_a_limit)
{
    random_stream r = random_begin(11, 0, 0);
    enum { COUNT = 8 };
    const double lever = 30, dear = 1e8;
    int limited = 0;
    for (int trial = 0; trial < 3000; trial++) {
        allocation_column c[COUNT];
        double u[COUNT];
        for (int i = 0; i < COUNT; i++) {
            double angle = random_uniform(&r, 0, 2 * PI);
            c[i] = (allocation_column){{real_cos(angle), real_sin(angle), random_uniform(&r, -40, 40)},
                                       random_uniform(&r, 0.5, 2),
                                       -random_uniform(&r, 0, 2e5),
                                       random_uniform(&r, 0, 2e5)};
        }
        vec3 tau = {random_uniform(&r, -6e5, 6e5), random_uniform(&r, -6e5, 6e5), random_uniform(&r, -1e7, 1e7)};
        bool reached;
        vec3 miss = allocation_solve(c, COUNT, lever, tau, u, &reached), sum = tau;
        double dearest = 0;
        for (int i = 0; i < COUNT; i++) {
            sum = vec3_mad(sum, c[i].effect, -u[i]);
            dearest = fmax(dearest, c[i].weight);
        }
        assert_vec3_close(miss, sum, 1e-6 * vec3_length(tau));
        if (reached)
            continue;
        vec3 y = vec3_scale(vec3_make(sum.x, sum.y, sum.z / lever), dear * dearest);
        double small = 1e-5 * vec3_length(y);
        for (int i = 0; i < COUNT; i++) {
            vec3 e = {c[i].effect.x, c[i].effect.y, c[i].effect.z / lever};
            double slope = c[i].weight * u[i] - vec3_dot(e, y);
            ck_assert(u[i] >= c[i].lo && u[i] <= c[i].hi);
            ck_assert_msg(u[i] == c[i].lo || slope < small, "trial %d: less of thrust %d costs less", trial, i);
            ck_assert_msg(u[i] == c[i].hi || slope > -small, "trial %d: more of thrust %d costs less", trial, i);
            limited += u[i] == c[i].lo || u[i] == c[i].hi;
        }
    }
    ck_assert_int_gt(limited, 1000);
}
END_TEST

TEST_MAIN("thruster", azimuths_turn_at_their_rate, shafts_have_a_rate_and_a_time, astern, the_nearer_edge_of_a_sector,
          nothing_is_gained_by_leaving_a_limit)
