/* A whole break, end to end (Nevel 1961): an inclined plate driven into the straight edge of level ice, through
   crushing, solve, fracture and integration. */
#include "base/transcendental.h"
#include "ice/fracture.h"
#include "ice_rig.h"

static const double FORCE = 311.743e3, AREA = 0.155871, TIME = 0.779357, RADIUS = 4.14196, LOADED = 0.299987;

/* What the plate meets, and how. */
typedef struct approach {
    double slope; /* x over z */
    double speed; /* [m/s] */
    bool gives, inertia;
} approach;

/* A plate 2 m wide that leans by `slope` (x over z) moves in +x; the ice begins at x = 0. */
static void ramp_scene(ice_rig *r, double dt, double slope, double speed)
{
    ice_rig_make(r, dt);
    int32_t row = ice_rig_plate(r, 60, 80, 1, MOTION_STATIC), ice = r->floes.body[row];
    r->bodies.position[ice] = (vec3){30, 0, 0};
    int32_t hull = ice_rig_slanted(r, slope, 1, 3);
    /* The first touch is at the upper or the lower edge of the ice. */
    r->bodies.position[hull] = (vec3){-0.5 * fabs(slope), 0, 0};
    r->bodies.velocity[hull] = (vec3){speed, 0, 0};
    ice_rig_pair(r, ice, hull);
}

static ice_rig_broken run_until_broken(double dt, approach a)
{
    ice_rig r;
    ramp_scene(&r, dt, a.slope, a.speed);
    r.settings.edges = (edge_compliance){a.gives, a.inertia, 1025, 9.81, 3, false, false};
    fracture_settings settings = {.time_step = dt,
                                  .water_density = 1025,
                                  .gravity = 9.81,
                                  .wedges = 3,
                                  .splitting_factor = 3,
                                  .narrowness = 4,
                                  .smallest_floe_area = 0.18,
                                  .smallest_piece_area = 0.009,
                                  .edge_threshold = 0.15,
                                  .edges_give = a.gives,
                                  .edge_inertia = a.inertia};
    ice_rig_broken b = ice_rig_until_broken(&r, &settings, 0.3 / a.speed);
    ice_rig_free(&r);
    return b;
}

/* At 45 degrees the force is the area times the strength, and the area grows by 0.2 m2/s: the break comes with the
   first step at which it is large enough. */
static void check_break(double dt, double slope)
{
    ice_rig_broken b = run_until_broken(dt, (approach){slope, 0.1, false, false});
    double time = dt * ceil(TIME / dt), area = 2 * 0.1 * time;
    ck_assert_int_eq(b.event.kind, FRACTURE_BENDING);
    assert_absolute(b.time, time, 1e-9);
    assert_relative(b.event.load, 2e6 * area, 1e-9);
    assert_relative(fabs(b.force.z), 2e6 * area, 1e-9);
    assert_relative(b.force.x, 2e6 * area, 1e-9);
    ck_assert((b.force.z < 0) == (slope > 0));
    /* First order in the time step: dt of loading more at most. */
    double more = dt / TIME;
    assert_relative(b.event.load, FORCE, more);
    assert_relative(b.event.loaded_radius, LOADED, more);
    assert_relative(b.event.crack_length, RADIUS, more);
    assert_vec3_close(b.event.place, ((vec3){0, 0, 0}), 1e-9);
    /* One remnant and four wedges. */
    ck_assert_int_eq(b.event.pieces, 5);
}

START_TEST(downward)
{
    for (double dt = 0.02; dt > 1e-3; dt /= 2)
        check_break(dt, 1);
}
END_TEST

START_TEST(upward)
{
    for (double dt = 0.02; dt > 1e-3; dt /= 2)
        check_break(dt, -1);
}
END_TEST

/* The same break where the edge gives: at the same load, after the way of the crushing and that of the tip, which
   Nevel's solution puts at P eta(0)/(k sum(b0) l^2) = 0.0907 m with eta(0) = 2.1632 at a/l = 0.020536 (Nevel 1961). */
static const double TIP = 0.090725, LATER = 1.686608;

static void check_give(double dt, double slope)
{
    ice_rig_broken b = run_until_broken(dt, (approach){slope, 0.1, true, false});
    ck_assert_int_eq(b.event.kind, FRACTURE_BENDING);
    ck_assert_msg(b.time >= LATER * (1 - 1e-4) && b.time < LATER * (1 + 1e-4) + dt, "broke after %.6f s, not %.6f",
                  b.time, LATER);
    /* First order in the time step: dt of loading more at most, by a stiffness that is nearly constant. */
    double more = 1.02 * dt / LATER + 1e-4;
    ck_assert(b.event.load > FORCE * (1 - 1e-4) && b.event.load < FORCE * (1 + more));
    assert_relative(b.event.loaded_radius, LOADED, more);
    assert_relative(b.event.crack_length, RADIUS, more);
    assert_relative(b.force.x, fabs(b.force.z), 1e-9);
    ck_assert((b.force.z < 0) == (slope > 0));
    ck_assert_int_eq(b.event.pieces, 5);
}

START_TEST(edge_that_gives)
{
    for (double dt = 0.02; dt > 1e-3; dt /= 4) {
        check_give(dt, 1);
        check_give(dt, -1);
    }
    assert_relative(LATER * 0.1 - TIP, AREA / 2, 1e-4);
}
END_TEST

/* The same with inertia, by one unknown: the load P = p A of the area A = 2 (v t - w) that the plate crushes, and the
   tip's deflection w = P eta(0)/(k sum(b0) l^2) tip under a load that has risen for 2 J/P, until the wedges' moment,
   which rising makes smaller, is the ice's. */
typedef struct rising {
    double time, load, radius;
} rising;

static rising march(double speed)
{
    const edge_compliance e = {true, true, 1025, 9.81, 3, false, false};
    const fracture_settings s = {.water_density = 1025, .gravity = 9.81, .wedges = 3};
    const ice_material m = ICE_RIG_MATERIAL;
    double dt = 1e-5 / speed, load = 0, impulse = 0, deflection = 0;
    for (int step = 1; step < 40000; step++) {
        double area = 2 * (speed * step * dt - deflection);
        load = 2e6 * area;
        impulse += load * dt;
        edge_stand stand = {.wedges = 1, .rise = edge_rise_time(impulse, load)};
        deflection = load / edge_stiffness(&e, &m, 1, area, stand);
        edge_stress b = fracture_edge_stress(&s, &m, 1, load, area, EDGE_STRAIGHT);
        wedge_ramp r = edge_rise(&e, &m, 1, b.wedge_radius, stand.rise);
        if (b.wedge_stress * r.moment >= m.flexural_strength)
            return (rising){step * dt, load, b.breaking_radius * r.place};
    }
    ck_abort_msg("no break");
    return (rising){0};
}

START_TEST(edge_with_inertia)
{
    static const double SPEEDS[] = {0.3, 1};
    for (int i = 0; i < 4; i++) {
        double speed = SPEEDS[i / 2], dt = (i % 2 ? 1e-4 : 4e-4) / speed;
        ice_rig_broken b = run_until_broken(dt, (approach){i % 2 ? -1 : 1, speed, true, true});
        rising exact = march(speed);
        /* First order in the time step: dt of loading more at most; the march is 0.01 % off. */
        double more = dt / exact.time + 2e-4;
        ck_assert_msg(fabs(b.time - exact.time) < 2 * dt, "broke after %.6f s, not %.6f", b.time, exact.time);
        assert_relative(b.event.load, exact.load, 2 * more);
        assert_relative(b.event.crack_length, exact.radius, 2 * more);
    }
}
END_TEST

/* Load and length rise and fall with speed, from those of an edge without inertia. */
START_TEST(inertia_and_speed)
{
    static const double SPEEDS[] = {0.004, 0.3, 1, 3};
    double load = FORCE, radius = RADIUS;
    for (int i = 0; i < 4; i++) {
        ice_rig_broken b = run_until_broken(1e-3 / SPEEDS[i], (approach){1, SPEEDS[i], true, true});
        if (i == 0) {
            assert_relative(b.event.load, FORCE, 0.01);
            assert_relative(b.event.crack_length, RADIUS, 0.01);
            continue;
        }
        ck_assert(b.event.load > load && b.event.crack_length < radius);
        load = b.event.load;
        radius = b.event.crack_length;
    }
    ck_assert(load > 1.05 * FORCE && radius < 0.5 * RADIUS);
}
END_TEST

/* Exactly the oracle's state, between two time steps. */
START_TEST(critical_state)
{
    fracture_settings s = {.water_density = 1025, .gravity = 9.81, .wedges = 3};
    ice_material m = ICE_RIG_MATERIAL;
    edge_stress e = fracture_edge_stress(&s, &m, 1, FORCE, AREA, EDGE_STRAIGHT);
    assert_relative(e.wedge_stress, m.flexural_strength, 1e-5);
    assert_relative(e.wedge_radius, LOADED, 1e-5);
    assert_relative(e.breaking_radius, RADIUS, 2e-6);
    assert_relative(2e6 * AREA, FORCE, 1e-5);
    assert_relative(AREA / 0.2, TIME, 1e-5);
}
END_TEST

TEST_MAIN("fracture_oracles", downward, upward, edge_that_gives, edge_with_inertia, inertia_and_speed, critical_state)
