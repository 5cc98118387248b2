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

/* ---- vessels whose thrusters turn ---- */

#define LEVER 40.0

typedef enum layout { RUDDERS, NO_BOW, AZIMUTHS, SECTORS, LAYOUTS } layout;

static void add(bare_vessel *b, thruster_kind kind, double x, double y, double ahead, double sector)
{
    thruster_definition d = quick(kind);
    d.place = vec3_make(x, y, 0);
    d.ahead = ahead;
    d.astern = kind == THRUSTER_MAIN ? 0.625 * ahead : ahead;
    d.rudder = radians(35);
    d.forbidden_centre = radians(sector);
    d.forbidden_half = sector != 0 ? radians(15) : 0;
    assert_ok(thruster_add(&b->ctx, &d, &b->vessels, &b->thrusters, &b->error), b->error);
}

/* Alike to both sides. */
static thruster_table *open_layout(bare_vessel *b, layout which)
{
    bare_vessel_open(b);
    thruster_kind aft = which == RUDDERS || which == NO_BOW ? THRUSTER_MAIN : THRUSTER_AZIMUTH;
    for (int side = -1; side <= 1 && which != AZIMUTHS; side += 2)
        add(b, aft, -38, 5 * side, 4e5, which == SECTORS ? -90 * side : 0);
    if (which == AZIMUTHS)
        add(b, aft, -35, 0, 3e5, 0);
    if (which != NO_BOW)
        add(b, which == AZIMUTHS ? THRUSTER_AZIMUTH : THRUSTER_TUNNEL, which == AZIMUTHS ? 35 : 32, 0,
            which == AZIMUTHS ? 5e4 : 2.5e5, 0);
    return &b->thrusters;
}

/* Orders that the thrusters can follow, at random, many of them at a limit. */
static void order_at_random(thruster_table *t, random_stream *r)
{
    for (int32_t i = 0; i < t->count; i++) {
        double share = random_uniform(r, 0, 1.3), angle = random_uniform(r, -PI, PI);
        t->order[i] = t->ahead[i] * fmin(share, 1);
        t->order_angle[i] = t->kind[i] == THRUSTER_TUNNEL ? 0.5 * PI : thruster_allowed_angle(t, i, angle);
        if (t->kind[i] != THRUSTER_AZIMUTH && angle > 0) {
            t->order[i] *= -t->astern[i] / t->ahead[i];
            t->order_angle[i] = t->kind[i] == THRUSTER_TUNNEL ? 0.5 * PI : 0;
        }
    }
}

/* What the orders make, all of them such as the thrusters can follow; cost: the sum of their squares. */
static vec3 effect_of_orders(thruster_table *t, double *cost)
{
    *cost = 0;
    for (int32_t i = 0; i < t->count; i++) {
        ck_assert(t->order[i] <= t->ahead[i] * (1 + 1e-12) && t->order[i] >= -t->astern[i] * (1 + 1e-12));
        bool back = t->kind[i] == THRUSTER_MAIN && t->order[i] < 0;
        ck_assert(!back || t->order_angle[i] == 0);
        if (t->kind[i] != THRUSTER_TUNNEL)
            assert_absolute(plane_angle(thruster_allowed_angle(t, i, t->order_angle[i]) - t->order_angle[i]), 0, 1e-12);
        *cost += t->cost[i] * t->order[i] * t->order[i];
        t->thrust[i] = t->order[i];
        t->angle[i] = t->order_angle[i];
    }
    return thruster_effect(t, 0);
}

static double length_of(vec3 v) { return vec3_length(vec3_make(v.x, v.y, v.z / LEVER)); }

/* A thruster below this part of its thrust need not turn: its push counts, its direction does not. */
static double idle_rest(const thruster_table *t)
{
    double rest = 1e-6;
    for (int32_t i = 0; i < t->count; i++)
        rest += fabs(t->order[i]) <= 1e-3 * t->ahead[i] ? 2.5 * fabs(t->order[i]) : 0;
    return rest;
}

/* The most side force of a ruddered propeller that gives x along the ship. */
static double most_aside(double x)
{
    const double tangent_of_35 = 0.70020753820970978;
    return x < 0 ? 0 : fmin(x * tangent_of_35, sqrt(fmax(1.6e11 - x * x, 0)));
}

/* The least cost of a demand on two ruddered propellers and a tunnel, over a grid of the first one's surge: all else
   follows from the balance, the side force of the two in equal parts as far as both can.  Infinity: out of reach. */
static double least_cost_by_grid(vec3 tau)
{
    double least = HUGE_VAL;
    for (double x1 = -2.5e5; x1 <= 4e5; x1 += 50) {
        double x2 = tau.x - x1, sides = (32 * tau.y + 5 * x1 - 5 * x2 - tau.z) / 70, bow = tau.y - sides;
        double most1 = most_aside(x1), most2 = most_aside(x2);
        double y1 = fmin(fmax(0.5 * sides, -most1), most1), y2 = fmin(fmax(sides - y1, -most2), most2);
        y1 = sides - y2;
        if (x2 >= -2.5e5 && x2 <= 4e5 && fabs(bow) <= 2.5e5 && fabs(y1) <= most1)
            least = fmin(least, x1 * x1 + y1 * y1 + x2 * x2 + y2 * y2 + bow * bow);
    }
    return least;
}

/* A small thrust astern does not take the rudders away: one propeller pulls astern, the other one steers. */
START_TEST(ruddered_propellers_steer_while_they_hold_astern)
{
    const vec3 demands[] = {
        {-14.4e3, -66.8e3, 1127e3}, {-7.4e3, 100e3, -976e3}, {0, 60e3, 0},     {3e4, 2e5, 1e6},
        {-1e5, 2e4, 8e5},           {-2e5, -8e4, 0},         {-4.5e5, 0, 1e5}, {-15e3, -291e3, 10190e3}};
    bare_vessel b;
    thruster_table *t = open_layout(&b, RUDDERS);
    for (int k = 0; k < 8; k++) {
        bool reached;
        double cost, least = least_cost_by_grid(demands[k]);
        thruster_allocate(t, 0, LEVER, demands[k], &reached);
        ck_assert_msg(reached == (least < HUGE_VAL), "demand %d", k);
        vec3 made = effect_of_orders(t, &cost);
        if (!reached)
            continue;
        assert_absolute(length_of(vec3_sub(made, demands[k])), 0, idle_rest(t));
        ck_assert_msg(cost < (1 + 1e-9) * least && cost > (1 - 2e-3) * least, "demand %d: %g, by the grid %g", k, cost,
                      least);
    }
    bare_vessel_close(&b);
}
END_TEST

/* By hand: on arms alike and without a moment each end gives half of the sway, so that the weak bow gives all its
   thrust across and the stern the surge. */
START_TEST(an_azimuth_at_its_limit_turns_to_what_is_needed)
{
    bare_vessel b;
    thruster_table *t = open_layout(&b, AZIMUTHS);
    for (int k = 0; k < 2; k++) {
        bool reached;
        double cost;
        vec3 tau = {1.5e5, k ? 1.0002e5 : 0.9998e5, 0};
        thruster_allocate(t, 0, LEVER, tau, &reached);
        ck_assert(reached == (k == 0));
        ck_assert(length_of(vec3_sub(effect_of_orders(t, &cost), tau)) < (k ? 20 : 1e-3));
        assert_absolute(t->order[1], 5e4, 1);
        assert_absolute(t->order_angle[1], 0.5 * PI, radians(2));
    }
    bare_vessel_close(&b);
}
END_TEST

/* What some orders make is reached at no more than their cost, and the mirrored demand by the mirrored orders; of twice
   that no more is missed than by any of forty orders. */
START_TEST(no_other_orders_are_better)
{
    random_stream r = random_begin(12, 0, 0);
    for (layout which = RUDDERS; which < LAYOUTS; which++) {
        bare_vessel b, mirror;
        thruster_table *t = open_layout(&b, which), *m = open_layout(&mirror, which);
        for (int trial = 0; trial < 40; trial++) {
            bool reached;
            double asked, cost, mirrored;
            order_at_random(t, &r);
            vec3 tau = vec3_scale(effect_of_orders(t, &asked), 1 - 1e-4);
            thruster_allocate(t, 0, LEVER, tau, &reached);
            vec3 made = effect_of_orders(t, &cost);
            ck_assert_msg(reached, "layout %d, trial %d: not reached", which, trial);
            ck_assert(length_of(vec3_sub(made, tau)) <= idle_rest(t) + 1e-7 * length_of(tau));
            ck_assert_msg(cost <= asked, "layout %d, trial %d: dearer", which, trial);
            thruster_allocate(m, 0, LEVER, vec3_make(tau.x, -tau.y, -tau.z), &reached);
            made = effect_of_orders(m, &mirrored);
            ck_assert(length_of(vec3_sub(made, vec3_make(tau.x, -tau.y, -tau.z))) <=
                      idle_rest(m) + 1e-7 * length_of(tau));
            assert_relative(mirrored, cost, 1e-6);
            vec3 missed = thruster_allocate(t, 0, LEVER, vec3_scale(tau, 2), &reached);
            double least = length_of(missed) * (1 - 1e-6) - 1e-6 * length_of(tau);
            for (int other = 0; other < 40; other++) {
                order_at_random(t, &r);
                made = effect_of_orders(t, &cost);
                ck_assert_msg(length_of(vec3_sub(vec3_scale(tau, 2), made)) >= least, "layout %d, trial %d: nearer",
                              which, trial);
            }
        }
        bare_vessel_close(&b);
        bare_vessel_close(&mirror);
    }
}
END_TEST

/* The whole of what a dear tunnel and two propellers astern give, at a corner of each. */
START_TEST(a_dear_thruster_is_used_to_its_end)
{
    bare_vessel b;
    bare_vessel_open(&b);
    thruster_table *t = &b.thrusters;
    for (int side = 1; side >= -1; side -= 2)
        add(&b, THRUSTER_MAIN, -38, 5 * side, 4e5, 0);
    add(&b, THRUSTER_TUNNEL, 33, 0, 1e5, 0);
    t->astern[0] = t->astern[1] = 2e5;
    for (double cost = 1; cost < 2e6; cost *= 10) {
        bool reached;
        t->cost[2] = cost;
        thruster_allocate(t, 0, LEVER, vec3_make(-399996, 99999, 3299967), &reached);
        ck_assert_msg(reached, "cost %g", cost);
        assert_relative(t->order[0] + t->order[1], -399996, 1e-6);
        assert_relative(t->order[2], 99999, 1e-6);
    }
    bare_vessel_close(&b);
}
END_TEST

/* Tunnels close together turn the vessel with large thrusts: the price of a miss alone leaves some 1e-6 of it. */
START_TEST(what_the_price_of_a_miss_leaves_is_reached)
{
    bare_vessel b;
    bare_vessel_open(&b);
    thruster_table *t = &b.thrusters;
    const double tunnels[3][3] = {{12.89, 39.7e3, 6.8e3}, {-16.39, 7.2e3, 4.8e3}, {-16.42, 40.5e3, 13.4e3}};
    for (int i = 0; i < 3; i++) {
        add(&b, THRUSTER_TUNNEL, tunnels[i][0], 0, tunnels[i][1], 0);
        t->astern[i] = tunnels[i][2];
    }
    /* The foremost one gives all it can, so that the two others, 30 mm apart, push against each other. */
    t->order[0] = 39.7e3, t->order[1] = 7e3, t->order[2] = -13e3;
    bool reached;
    double cost;
    const vec3 tau = effect_of_orders(t, &cost);
    vec3 miss = thruster_allocate(t, 0, LEVER, tau, &reached);
    ck_assert(reached);
    ck_assert(length_of(miss) < 1e-9 * length_of(tau));
    assert_vec3_close(effect_of_orders(t, &cost), tau, 1e-3);
    bare_vessel_close(&b);
}
END_TEST

/* What a controller of senseless gains demands: not met, and no order is lost by it. */
START_TEST(demands_that_are_no_numbers_leave_the_orders)
{
    const double sizes[] = {1e90, 1e160, HUGE_VAL, -HUGE_VAL, (double)NAN};
    for (layout which = RUDDERS; which < LAYOUTS; which++) {
        bare_vessel b;
        thruster_table *t = open_layout(&b, which);
        for (int k = 0; k < 5; k++) {
            bool reached;
            double before, cost;
            thruster_allocate(t, 0, LEVER, vec3_make(3e4, 1e4, 2e5), &reached);
            vec3 made = effect_of_orders(t, &before);
            thruster_allocate(t, 0, LEVER, vec3_make(sizes[k], 1e4, 2e5), &reached);
            ck_assert_msg(!reached, "layout %d, %g", which, sizes[k]);
            vec3 now = effect_of_orders(t, &cost);
            if (k > 0)
                assert_vec3_close(now, made, 0);
            ck_assert(k > 0 || now.x > made.x);
        }
        bare_vessel_close(&b);
    }
}
END_TEST

/* Around a circle, within reach and beyond it, the thrusts of azimuths go with the demand, as its root where one is
   turned at its limit. */
START_TEST(small_changes_of_the_demand_are_small_ones_of_the_thrust)
{
    bare_vessel b;
    thruster_table *t = open_layout(&b, AZIMUTHS);
    for (int size = 1; size <= 4; size++) {
        vec2 before[2] = {{0, 0}, {0, 0}};
        for (int k = 0; k <= 720; k++) {
            bool reached;
            double angle = radians(0.5 * k), most = 0.7e5 * size;
            thruster_allocate(t, 0, LEVER, vec3_make(most * real_cos(angle), most * real_sin(angle), 2e5), &reached);
            for (int i = 0; i < 2; i++) {
                vec2 f = {t->order[i] * real_cos(t->order_angle[i]), t->order[i] * real_sin(t->order_angle[i])};
                double change = vec2_length(vec2_sub(f, before[i])), of_demand = radians(0.5) * most;
                ck_assert_msg(k == 0 || change < of_demand + sqrt(2 * t->ahead[1] * of_demand),
                              "thruster %d, %g deg: %g N", i, 0.5 * k, change);
                before[i] = f;
            }
        }
    }
    bare_vessel_close(&b);
}
END_TEST

TEST_MAIN("thruster", azimuths_turn_at_their_rate, shafts_have_a_rate_and_a_time, astern, the_nearer_edge_of_a_sector,
          nothing_is_gained_by_leaving_a_limit, ruddered_propellers_steer_while_they_hold_astern,
          an_azimuth_at_its_limit_turns_to_what_is_needed, no_other_orders_are_better,
          a_dear_thruster_is_used_to_its_end, what_the_price_of_a_miss_leaves_is_reached,
          demands_that_are_no_numbers_leave_the_orders, small_changes_of_the_demand_are_small_ones_of_the_thrust)
