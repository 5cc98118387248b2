/* Loads that floes feel over the time in which their edges respond (docs/decisions/0176): what a step is must not
   decide what breaks. */
#include "ice/fracture_parts.h"
#include "sheet_rig.h"

/* A load at the middle of the side of a floe that floats. */
typedef struct edge {
    fracture_rig r;
    int32_t row;
    vec2 place;
    double capacity, time; /* of the edge [N], [s] */
} edge;

static const double AREA = 0.5;

static double response_time(const fracture_settings *s, double thickness, double area)
{
    double reach = fracture_edge_reach(s, &FRACTURE_RIG_ICE, thickness, area);
    return fracture_response_time(s, &FRACTURE_RIG_ICE, thickness, reach);
}

static void edge_make(edge *e, double dt, edge_load_rule rule, motion kind)
{
    fracture_rig_make(&e->r);
    e->r.settings.splitting = SPLITTING_NONE;
    e->r.settings.load_rule = rule;
    e->r.settings.time_step = dt;
    vec2 corner[4] = {{0, 0}, {200, 0}, {200, 200}, {0, 200}};
    e->row = fracture_rig_floe(&e->r, (polygon){corner, 4}, 1, kind);
    e->place = (vec2){0, -100};
    e->capacity = fracture_edge_stress(&e->r.settings, &FRACTURE_RIG_ICE, 1, 1, AREA, EDGE_STRAIGHT).wedge_capacity;
    e->time = response_time(&e->r.settings, 1, AREA);
}

static int edge_step(edge *e, double load)
{
    ck_assert(fracture_rig_load(&e->r, e->row, e->place, load, AREA));
    return fracture_rig_break(&e->r);
}

static void edge_free(edge *e) { fracture_rig_free(&e->r); }

/* Against the waves of an ice sheet on deep water, written out. */
START_TEST(time_of_response)
{
    fracture_settings s = fracture_rig_settings();
    for (int i = 0; i < 3; i++) {
        double h = 0.3 + 0.7 * i,
               radius = fracture_edge_stress(&s, &FRACTURE_RIG_ICE, h, 1, AREA, EDGE_STRAIGHT).breaking_radius;
        double k = PI / 4 / radius, stiffness = 5e9 * h * h * h / (12 * 0.91) * k * k * k * k + 1025 * 9.81;
        double time = sqrt((920 * h + 1025 / k) / stiffness);
        /* The radius is an estimate, to 5 %, and the time goes with up to its 2.5th power. */
        assert_relative(response_time(&s, h, AREA), time, 0.12);
    }
    double one = response_time(&s, 1, AREA);
    ck_assert_msg(one > 0.1 && one < 0.3, "%g s", one);
    ck_assert(response_time(&s, 1, 10) > one);
}
END_TEST

/* A load that stays breaks the edge once 1 - exp(-t/tau) of it is its capacity, whatever the step. */
START_TEST(a_load_that_stays)
{
    static const double STEPS[] = {0.04, 0.02, 0.01, 0.005};
    for (int i = 0; i < 4; i++) {
        edge e;
        edge_make(&e, STEPS[i], EDGE_LOAD_RESPONSE, MOTION_DYNAMIC);
        int steps = 1;
        while (steps < 1000 && edge_step(&e, 1.1 * e.capacity) == 0)
            steps++;
        double due = e.time * real_log(1.1 / 0.1);
        ck_assert_msg(steps * STEPS[i] >= due * (1 - 1e-9) && (steps - 1) * STEPS[i] < due, "after %g s, not %g",
                      steps * STEPS[i], due);
        ck_assert_double_ge(e.r.events.data[0].stress_ratio, 1);
        ck_assert_double_lt(e.r.events.data[0].stress_ratio, 1.1);
        edge_free(&e);
        edge_make(&e, STEPS[i], EDGE_LOAD_RESPONSE, MOTION_DYNAMIC);
        for (int k = 0; k < 100; k++)
            ck_assert_int_eq(edge_step(&e, 0.999 * e.capacity), 0);
        edge_free(&e);
    }
}
END_TEST

/* An impulse breaks the edge when it is its capacity times the time of response, however short it is; over a step it is
   any load. */
START_TEST(a_blow)
{
    static const double STEPS[] = {0.01, 0.005, 0.0025, 0.00125};
    for (int i = 0; i < 4; i++) {
        for (int strong = 0; strong < 2; strong++) {
            edge e;
            edge_make(&e, STEPS[i], EDGE_LOAD_RESPONSE, MOTION_DYNAMIC);
            double due = 1 / (1 - 0.5 * STEPS[i] / e.time); /* to first order */
            double impulse = (strong ? 1.02 * due : 0.98) * e.capacity * e.time;
            int broke = edge_step(&e, impulse / STEPS[i]);
            for (int k = 0; k < 10 && !broke; k++)
                broke = edge_step(&e, 0);
            ck_assert_int_eq(broke, strong);
            edge_free(&e);
            edge_make(&e, STEPS[i], EDGE_LOAD_STEP, MOTION_DYNAMIC);
            ck_assert_int_eq(edge_step(&e, impulse / STEPS[i]), 1);
            ck_assert_int_eq(e.r.edge_loads.count, 0);
            edge_free(&e);
        }
    }
}
END_TEST

/* Fixed ice feels its load at once, and nothing of it is remembered. */
START_TEST(fixed_ice)
{
    edge e;
    edge_make(&e, 0.005, EDGE_LOAD_RESPONSE, MOTION_STATIC);
    ck_assert_int_eq(edge_step(&e, 0.99 * e.capacity), 0);
    ck_assert_int_eq(e.r.edge_loads.count, 0);
    ck_assert_int_eq(edge_step(&e, 1.01 * e.capacity), 1);
    edge_free(&e);
    fracture_rig r;
    fracture_rig_make(&r);
    r.settings.load_rule = EDGE_LOAD_RESPONSE;
    sheet_make(&r, (box2){{0, 0}, {60, 60}}, 30, NULL);
    ck_assert(sheet_load(
        &r, (vec2){15, 0},
        1.01 * fracture_edge_stress(&r.settings, &FRACTURE_RIG_ICE, 1, 1, AREA, EDGE_STRAIGHT).wedge_capacity, AREA));
    ck_assert_int_eq(fracture_rig_break(&r), 1);
    ck_assert_int_eq(r.edge_loads.count, 0);
    fracture_rig_free(&r);
}
END_TEST

/* Felt so far under the patch at x, along the floe's own z. */
static double felt_at(const fracture_rig *r, double x)
{
    double felt = 0;
    for (int32_t i = 0; i < r->edge_loads.count; i++)
        if (fabs(r->edge_loads.place[i].x - x) < 1)
            felt -= r->edge_loads.load[i].z;
    return felt;
}

/* Two patches of one hull on one floe feel their own loads, in whatever order they come, while they wander; where they
   become one it feels both; what no patch is over any more is forgotten, and another hull begins anew. */
START_TEST(patches_come_and_go)
{
    edge e;
    edge_make(&e, 0.01, EDGE_LOAD_RESPONSE, MOTION_DYNAMIC);
    fracture_rig *r = &e.r;
    double part = 1 - real_exp(-0.01 / e.time), a = 0, b = 0;
    for (int k = 0; k < 5; k++) {
        double left = -30 + 0.1 * k, right = 30 - 0.1 * k;
        for (int turn = 0; turn < 2; turn++) {
            bool first = (turn + k) % 2 == 0;
            ck_assert(fracture_rig_load(r, e.row, (vec2){first ? left : right, -100}, first ? 1e5 : 2e4, AREA));
        }
        ck_assert_int_eq(fracture_rig_break(r), 0);
        a += part * (1e5 - a);
        b += part * (2e4 - b);
        ck_assert_int_eq(r->edge_loads.count, 2);
        assert_relative(felt_at(r, left), a, 1e-12);
        assert_relative(felt_at(r, right), b, 1e-12);
    }
    ck_assert(fracture_rig_load(r, e.row, (vec2){0, -100}, 0, AREA));
    ck_assert_int_eq(fracture_rig_break(r), 0);
    ck_assert_int_eq(r->edge_loads.count, 1);
    assert_relative(felt_at(r, 0), (1 - part) * (a + b), 1e-12);
    /* Another hull in the slot of the first one. */
    r->bodies.generation[r->hull]++;
    ck_assert(fracture_rig_load(r, e.row, (vec2){0, -100}, 0, AREA));
    ck_assert_int_eq(fracture_rig_break(r), 0);
    ck_assert_double_eq(felt_at(r, 0), 0);
    ck_assert(fracture_rig_load(r, e.row, (vec2){0, -100}, 1e5, AREA));
    ck_assert_int_eq(fracture_rig_break(r), 0);
    ck_assert_int_eq(fracture_rig_break(r), 0);
    ck_assert_int_eq(r->edge_loads.count, 0);
    edge_free(&e);
}
END_TEST

TEST_MAIN("fracture_response", time_of_response, a_load_that_stays, a_blow, fixed_ice, patches_come_and_go)
