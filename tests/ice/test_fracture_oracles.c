/* A whole break, end to end (Nevel 1961): an inclined plate driven into the straight edge of level ice, through
   crushing, solve, fracture and integration. */
#include "base/transcendental.h"
#include "ice/fracture.h"
#include "ice_rig.h"

static const double FORCE = 311.743e3, AREA = 0.155871, TIME = 0.779357, RADIUS = 4.14196, LOADED = 0.299987;

typedef struct breaking {
    double time;
    fracture_event event;
    vec3 force; /* on the ice when it broke [N] */
} breaking;

/* A plate 2 m wide that leans by `slope` (x over z) moves in +x at 0.1 m/s; the ice begins at x = 0. */
static void ramp_scene(ice_rig *r, double dt, double slope)
{
    ice_rig_make(r, dt);
    int32_t row = ice_rig_plate(r, 60, 80, 1, MOTION_STATIC), ice = r->floes.body[row];
    r->bodies.position[ice] = (vec3){30, 0, 0};
    mesh plate = {0};
    ck_assert(mesh_make_box(&r->ctx, (vec3){-10, -1, -3}, (vec3){0, 1, 3}, &plate));
    for (int32_t i = 0; i < plate.vertex.count; i++)
        plate.vertex.data[i].x += slope * plate.vertex.data[i].z;
    int32_t hull = ice_rig_hull(r, &plate, MOTION_PRESCRIBED, MATERIAL_HULL);
    /* The first touch is at the upper or the lower edge of the ice. */
    r->bodies.position[hull] = (vec3){-0.5 * fabs(slope), 0, 0};
    r->bodies.velocity[hull] = (vec3){0.1, 0, 0};
    ice_rig_pair(r, ice, hull);
}

static breaking run_until_broken(double dt, double slope, bool gives)
{
    ice_rig r;
    ramp_scene(&r, dt, slope);
    r.settings.edges = (edge_compliance){gives, 1025, 9.81, 3, false};
    fracture_scratch *scratch = fracture_scratch_create(&r.ctx);
    fracture_settings settings = {.time_step = dt,
                                  .water_density = 1025,
                                  .gravity = 9.81,
                                  .wedges = 3,
                                  .splitting_factor = 3,
                                  .narrowness = 4,
                                  .smallest_floe_area = 0.18,
                                  .smallest_piece_area = 0.009,
                                  .edge_threshold = 0.15,
                                  .edges_give = gives};
    fracture_event_array events = {0};
    breaking b = {0};
    for (int step = 0; step * dt < 3 && events.count == 0; step++) {
        fram_error e = {0};
        ice_rig_crush(&r);
        wrench *loads = memory_array(&r.ctx, (size_t)r.bodies.count, sizeof *loads);
        ck_assert(loads);
        assert_ok(solver_solve(&r.ctx, r.solve, &r.solver, dt, &r.bodies, loads, &r.joints, &r.contacts, &r.memory,
                               &r.report, &e),
                  e);
        memory_free(&r.ctx, loads);
        b.force = ice_rig_force(&r);
        b.time = step * dt;
        fracture_state state = {&r.bodies,      &r.shapes, &r.floes, &r.contacts, &r.memory,
                                &r.next_number, NULL,      NULL,     NULL,        NULL};
        assert_ok(fracture_run(&r.ctx, scratch, &settings, r.plane, &r.patches, &state, &events, &e), e);
        integrate_poses(&r.ctx, &r.bodies, dt);
    }
    ck_assert_int_eq(events.count, 1);
    b.event = events.data[0];
    array_free(&r.ctx, &events);
    fracture_scratch_free(&r.ctx, scratch);
    ice_rig_free(&r);
    return b;
}

/* At 45 degrees the force is the area times the strength, and the area grows by 0.2 m2/s: the break comes with the
   first step at which it is large enough. */
static void check_break(double dt, double slope)
{
    breaking b = run_until_broken(dt, slope, false);
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
    breaking b = run_until_broken(dt, slope, true);
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

TEST_MAIN("fracture_oracles", downward, upward, edge_that_gives, critical_state)
