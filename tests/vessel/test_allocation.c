/* Allocation and thrusters: the supply ship of docs/oracles.md, limits, sectors, rates, failure. */
#include "supply_ship.h"

/* Cost of a set of thrusts as the solver counts it out of reach. */
static double cost_of(const allocation_column *c, int n, double lever, vec3 tau, const double *u)
{
    double cost = 0;
    vec3 miss = vec3_make(tau.x, tau.y, tau.z / lever);
    for (int i = 0; i < n; i++) {
        cost += c[i].weight * u[i] * u[i];
        miss = vec3_sub(miss, vec3_scale(vec3_make(c[i].effect.x, c[i].effect.y, c[i].effect.z / lever), u[i]));
    }
    return cost + 1e8 * vec3_dot(miss, miss);
}

START_TEST(residual_of_rounding_where_unsaturated)
{
    bare_vessel b;
    bare_vessel_open(&b);
    supply_thrusters(&b);
    const vec3 demands[] = {{1e5, 0, 0}, {0, 2e5, 0}, {0, 0, 5e6}, {3e5, -1.5e5, 4e6}, {-2e5, 1e5, -3e6}};
    for (int k = 0; k < 5; k++) {
        bool reached;
        vec3 miss = thruster_allocate(&b.thrusters, 0, 38.1, demands[k], &reached);
        vec3 scaled = vec3_make(miss.x, miss.y, miss.z / 38.1);
        vec3 wanted = vec3_make(demands[k].x, demands[k].y, demands[k].z / 38.1);
        ck_assert(reached);
        ck_assert_msg(vec3_length(scaled) <= 1e-12 * vec3_length(wanted), "residual %g", vec3_length(scaled));
        /* What the orders make together is what was demanded. */
        for (int32_t i = 0; i < b.thrusters.count; i++) {
            b.thrusters.thrust[i] = b.thrusters.order[i];
            b.thrusters.angle[i] = b.thrusters.order_angle[i];
        }
        assert_vec3_close(thruster_effect(&b.thrusters, 0), demands[k], 1e-9 * vec3_length(demands[k]));
    }
    /* Surge alone is shared by the mains, and the least square cost shares it evenly. */
    bool reached;
    thruster_allocate(&b.thrusters, 0, 38.1, demands[0], &reached);
    assert_relative(b.thrusters.order[4], 5e4, 1e-12);
    assert_relative(b.thrusters.order[5], 5e4, 1e-12);
    bare_vessel_close(&b);
}
END_TEST

/* Out of reach the answer is feasible, and no small move within the limits lowers the cost. */
START_TEST(optimal_within_the_limits)
{
    allocation_column c[6] = {{{0, 1, 30}, 1, -2e5, 2e5},    {{0, 1, 22}, 2, -2e5, 2e5}, {{0, 1, -22}, 1, -1e5, 2e5},
                              {{0, 1, -30}, 0.5, -2e5, 2e5}, {{1, 0, -8}, 1, -8e5, 8e5}, {{1, 0, 8}, 1, -1e5, 8e5}};
    const vec3 demands[] = {{2e6, 0, 0},        {0, 1e6, 0}, {5e5, 6e5, 1.2e7},
                            {-1e6, -2e5, -9e6}, {0, 0, 3e7}, {1e5, 6.5e5, 0}};
    for (int k = 0; k < 6; k++) {
        double u[6];
        bool reached;
        allocation_solve(c, 6, 38, demands[k], u, &reached);
        double best = cost_of(c, 6, 38, demands[k], u);
        for (int i = 0; i < 6; i++) {
            ck_assert(u[i] >= c[i].lo && u[i] <= c[i].hi);
            for (int j = 0; j < 6; j++) {
                for (int s = 0; s < 4; s++) {
                    double v[6];
                    memcpy(v, u, sizeof v);
                    v[i] = fmin(fmax(v[i] + (s & 1 ? 10 : -10), c[i].lo), c[i].hi);
                    v[j] = fmin(fmax(v[j] + (s & 2 ? 10 : -10), c[j].lo), c[j].hi);
                    ck_assert_msg(cost_of(c, 6, 38, demands[k], v) >= best * (1 - 1e-9), "demand %d: a better one", k);
                }
            }
        }
    }
}
END_TEST

START_TEST(azimuths_keep_out_of_forbidden_sectors_and_in_their_circle)
{
    bare_vessel b;
    bare_vessel_open(&b);
    for (int i = 0; i < 3; i++) {
        thruster_definition d = supply_tunnel(i == 0 ? 25 : -30);
        d.kind = THRUSTER_AZIMUTH;
        d.place.y = i == 0 ? 0 : i == 1 ? 7 : -7;
        d.forbidden_centre = i == 1 ? -0.5 * PI : 0.5 * PI; /* the aft ones must not blow at each other */
        d.forbidden_half = i == 0 ? 0 : radians(20);
        assert_ok(thruster_add(&b.ctx, &d, &b.vessels, &b.thrusters, &b.error), b.error);
    }
    for (int k = 0; k < 36; k++) {
        for (int size = 1; size <= 4; size++) {
            double a = 2 * PI * k / 36;
            vec3 tau = vec3_make(1.5e5 * size * real_cos(a), 1.5e5 * size * real_sin(a), 0);
            bool reached;
            vec3 miss = thruster_allocate(&b.thrusters, 0, 38, tau, &reached);
            for (int i = 0; i < 3; i++) {
                double off = plane_angle(b.thrusters.order_angle[i] - b.thrusters.forbidden_centre[i]);
                ck_assert(b.thrusters.order[i] >= 0 && b.thrusters.order[i] <= 2e5 * (1 + 1e-9));
                ck_assert(fabs(off) >= b.thrusters.forbidden_half[i] - 1e-9);
            }
            ck_assert(size > 1 || reached);
            ck_assert(!reached || vec3_length(miss) < 1);
        }
    }
    bare_vessel_close(&b);
}
END_TEST

START_TEST(a_rudder_gives_side_force_ahead_only)
{
    bare_vessel b;
    bare_vessel_open(&b);
    thruster_definition bow = supply_tunnel(30), stern = supply_main(0);
    stern.rudder = radians(25);
    assert_ok(thruster_add(&b.ctx, &bow, &b.vessels, &b.thrusters, &b.error), b.error);
    assert_ok(thruster_add(&b.ctx, &stern, &b.vessels, &b.thrusters, &b.error), b.error);
    bool reached;
    thruster_allocate(&b.thrusters, 0, 38, vec3_make(4e5, 0, -2e6), &reached);
    ck_assert(reached && b.thrusters.order_angle[1] > 0 && b.thrusters.order_angle[1] < radians(25));
    thruster_allocate(&b.thrusters, 0, 38, vec3_make(-4e5, 0, -2e6), &reached);
    ck_assert(!reached && b.thrusters.order[1] < 0 && b.thrusters.order_angle[1] == 0);
    bare_vessel_close(&b);
}
END_TEST

START_TEST(shafts_lag_and_fail)
{
    bare_vessel b;
    bare_vessel_open(&b);
    supply_thrusters(&b);
    thruster_table *t = &b.thrusters;
    t->failure_time[4] = 0.5;
    t->speed_rate[5] = 0.1;
    for (int i = 0; i < 6; i++)
        t->order[i] = t->ahead[i];
    wrench loads = {0}, sum = {0};
    double dt = 0.01;
    for (int n = 0; n < 100; n++) {
        loads = sum = (wrench){0};
        assert_ok(thruster_step(&b.ctx, t, &b.vessels, &b.bodies, n * dt, dt, &loads, &sum, &b.events, &b.error),
                  b.error);
    }
    /* n = 1 - exp(-t / T_n), T = K n |n|. */
    double n1 = 1 - real_exp(-1);
    assert_relative(t->thrust[0], 2e5 * n1 * n1, 1e-9);
    assert_relative(t->speed[5], 0.1, 1e-9);
    ck_assert(t->failed[4] && t->thrust[4] == 0);
    ck_assert_int_eq(b.events.count, 1);
    ck_assert_int_eq(b.events.kind[0], EVENT_THRUSTER_FAILURE);
    ck_assert_int_eq(b.events.number[0], 4);
    assert_absolute(b.events.time[0], 0.5, 1e-12);
    char text[120];
    event_text(&b.events, 0, NULL, 300, text, sizeof text);
    ck_assert(strstr(text, "thruster 5 failed"));
    assert_vec3_close(loads.force, sum.force, 0);
    vec3 effect = thruster_effect(t, 0);
    assert_absolute(loads.force.x, effect.x, 1e-6);
    assert_absolute(loads.force.y, effect.y, 1e-6);
    assert_absolute(loads.moment.z, effect.z, 1e-3);
    /* The tunnels lie 3 m under the centre of mass: a push to port heels to port, about -x... */
    assert_relative(loads.moment.x, 3 * loads.force.y, 1e-9);
    /* A failed thruster takes no part. */
    bool reached;
    thruster_allocate(t, 0, 38.1, vec3_make(1e5, 0, 0), &reached);
    ck_assert(reached && t->order[4] == 0);
    assert_relative(t->order[5], 1e5, 1e-9);
    assert_relative(thruster_power(t, 0), 2e5 * 6.25 * n1 * n1 * n1, 1e-9);
    bare_vessel_close(&b);
}
END_TEST

START_TEST(refusals)
{
    bare_vessel b;
    bare_vessel_open(&b);
    thruster_definition d = supply_tunnel(30);
    d.ahead = 0;
    assert_fails(thruster_add(&b.ctx, &d, &b.vessels, &b.thrusters, &b.error), b.error, FRAM_ERROR_INPUT,
                 "expected a positive number of newtons, found 0");
    ck_assert_str_eq(b.error.key, "thrust");
    d = supply_tunnel(30);
    d.cost = 0;
    assert_fails(thruster_add(&b.ctx, &d, &b.vessels, &b.thrusters, &b.error), b.error, FRAM_ERROR_INPUT,
                 "expected a positive number, found 0");
    ck_assert_str_eq(b.error.key, "cost");
    d = supply_tunnel(30);
    d.forbidden_half = 2;
    assert_fails(thruster_add(&b.ctx, &d, &b.vessels, &b.thrusters, &b.error), b.error, FRAM_ERROR_INPUT,
                 "an angle from 0");
    ck_assert_int_eq(b.thrusters.count, 0);
    failing_memory memory;
    context ctx = failing_context(&memory, 1);
    d = supply_tunnel(30);
    ck_assert_int_eq(thruster_add(&ctx, &d, &b.vessels, &b.thrusters, &b.error), FRAM_ERROR_MEMORY);
    bare_vessel_close(&b);
}
END_TEST

TEST_MAIN("allocation", residual_of_rounding_where_unsaturated, optimal_within_the_limits,
          azimuths_keep_out_of_forbidden_sectors_and_in_their_circle, a_rudder_gives_side_force_ahead_only,
          shafts_lag_and_fail, refusals)
